#!/usr/bin/env python3
"""Compares the weld that paper leaves in a heat press with the sealed shape, by Shapely.

Usage: press.py TOOL DIRECTORY [COUNT [FIRST]]. Needs shapely, svgelements and NumPy.

The drawings are of this script: blobs of arcs and lines with islands, barriers and ports, COUNT of them from seed FIRST, and the shipped
stars. Welded is the fabric of a piece without paper. It must hold every band, but for `creep` no more than the air may be lost, and
paper leaves the piece through the ports only.
"""

import json
import math
import random
import subprocess
import sys
from pathlib import Path

import numpy as np
from shapely.geometry import LineString, Point, Polygon
from shapely.ops import unary_union
from svgelements import SVG
from svgelements import Path as SvgPath

tool, out = sys.argv[1], Path(sys.argv[2])
count = int(sys.argv[3]) if len(sys.argv) > 3 else 25
first = int(sys.argv[4]) if len(sys.argv) > 4 else 0
out.mkdir(parents=True, exist_ok=True)
CREEP, BAND = 0.3, 3.0
# Arcs become chords that leave them by less than this, mm; files round to four decimals.
CHORD, EXACT = 0.0005, 0.01


def points(path):
    """The corners of a path of lines and arcs."""
    line = []
    for segment in path:
        kind = type(segment).__name__
        if kind == "Move":
            continue
        steps = 1
        if kind == "Arc":
            radius = abs(segment.rx)
            angle = 2 * math.acos(max(0.0, 1 - CHORD / max(radius, 1e-9)))
            steps = max(1, math.ceil(abs(segment.sweep) / max(angle, 1e-3)))
        start = segment.start
        if not line and start is not None:
            line.append((start.x, start.y))
        line.extend((p.x, p.y) for p in (segment.point(i / steps) for i in range(1, steps + 1)))
    return line


def layers(file):
    """The paths of an SVG by the id of their group, in mm: the files' viewBox is in mm, and nothing is transformed."""
    found = {}
    from xml.etree import ElementTree

    root = ElementTree.parse(file).getroot()
    for group in root.iter("{http://www.w3.org/2000/svg}g"):
        for element in group:
            name = element.tag.rsplit("}", 1)[1]
            if name == "path":
                # A path of a label has several strokes; those of seams and cuts have one.
                found.setdefault(group.get("id"), []).append(points(SvgPath(element.get("d"))))
            elif name == "circle":
                x, y, r = (float(element.get(key)) for key in ("cx", "cy", "r"))
                found.setdefault(group.get("id"), []).append(list(Point(x, y).buffer(r).exterior.coords))
    return found


def region(outer, holes):
    shape = unary_union([Polygon(line).buffer(0) for line in outer])
    return shape.difference(unary_union([Polygon(line).buffer(0) for line in holes])) if holes else shape


def judged(directory, name, band):
    """The largest faults: how far paper reaches into a band, and how far welded fabric into the air beyond the creep, mm."""
    manifest = json.loads((directory / "manifest.json").read_text())
    worst = 0.0
    for number in sorted({file["paper_sheet"] for file in manifest["files"] if "paper_sheet" in file}):
        paper_layers = layers(directory / f"paper-{number}-separator.svg")
        seal = layers(directory / f"sheet-{number}-seal.svg")
        outline = layers(directory / f"sheet-{number}-outline.svg")
        paper = region(paper_layers["separator-edge"], paper_layers.get("separator-window", []))
        fabric = region(outline["cut-outside"], outline.get("cut-hole", []))
        seams = [line for key in ("seal", "seal-inner", "seal-outer") for line in seal.get(key, [])]
        lines = [LineString(line) for line in seams]
        # Round brackets at ends: an iron is round.
        bands = unary_union([line.buffer(band / 2, quad_segs=400) for line in lines]).intersection(fabric)
        welded = fabric.difference(paper)
        # Every band is welded, as wide as it is stated.
        lost = bands.difference(welded)
        depth = 0.0 if lost.is_empty else max(Point(p).distance(welded) for part in parts(lost) for p in part.exterior.coords)
        assert depth <= EXACT, (name, number, "paper in a band", depth)
        # Air is what lies between the bands; paper covers it but for the creep. Stars have the round corners that an iron makes. Of a
        # drawing a press seals sharp corners of the fabric, too.
        join = "mitre" if "seal" in seal else "round"
        edges = unary_union([line.buffer(band / 2, quad_segs=400, join_style=join, mitre_limit=50) for line in lines])
        tubes = regions(fabric, edges)
        air = [tube for tube in tubes if tube.intersection(paper).area > 0.2 * tube.area]
        assert air, (name, number, "no air")
        for tube in air:
            inside = tube.buffer(-(CREEP + EXACT), join_style="mitre", mitre_limit=50)
            bare = inside.difference(paper)
            assert bare.area < 0.05, (name, number, "air that welds", bare.area, bare.representative_point())
        # No paper outside of the air, and across the cut only where a hose goes in.
        stray = paper.difference(unary_union(air).buffer(EXACT))
        stray = stray.difference(fabric.exterior.buffer(2 * band) if fabric.geom_type == "Polygon" else unary_union([part.exterior.buffer(2 * band) for part in fabric.geoms]))
        assert stray.area < 0.05, (name, number, "paper outside of the air", stray.area)
        worst = max(worst, depth)
    return worst


def parts(shape):
    return [part for part in getattr(shape, "geoms", [shape]) if part.geom_type == "Polygon"]


def regions(fabric, bands):
    """The regions of the fabric between the bands. A port is open: its channel belongs to the air as far as the cut."""
    return [part for part in parts(fabric.difference(bands)) if part.area > 0.5]


def arc_blob(dice):
    """A closed outline of lines and circular arcs around the origin, as SVG data, with its corners."""
    corners = dice.randint(4, 9)
    turns = sorted(dice.uniform(0, 2 * math.pi) for _ in range(corners))
    even = [2 * math.pi * i / corners for i in range(corners)]
    turns = [0.7 * e + 0.3 * t for e, t in zip(even, turns)]
    radii = [dice.uniform(60, 100) for _ in turns]
    at = [(r * math.cos(t), r * math.sin(t)) for r, t in zip(radii, turns)]
    data = f"M {at[0][0]:.4f} {at[0][1]:.4f}"
    for (ax, ay), (bx, by) in zip(at, at[1:] + at[:1]):
        if dice.random() < 0.5:
            chord = math.hypot(bx - ax, by - ay)
            radius = chord * dice.uniform(0.8, 3.0)
            data += f" A {radius:.4f} {radius:.4f} 0 0 {dice.randint(0, 1)} {bx:.4f} {by:.4f}"
        else:
            data += f" L {bx:.4f} {by:.4f}"
    return data + " Z", at


def drawing(seed, folder):
    """A random drawing, and its spec; the port lies in the middle of a straight side."""
    dice = random.Random(seed)
    while True:
        data, at = arc_blob(dice)
        sides = [i for i, part in enumerate(data.split(" Z")[0].replace("M", "|M").replace("A", "|A").replace("L", "|L").split("|")[2:]) if part.startswith("L")]
        sides = [i for i in sides if math.dist(at[i], at[(i + 1) % len(at)]) > 45]
        if sides:
            break
    i = dice.choice(sides)
    (ax, ay), (bx, by) = at[i], at[(i + 1) % len(at)]
    mx, my = (ax + bx) / 2, (ay + by) / 2
    nx, ny = (by - ay) / math.dist((ax, ay), (bx, by)), -(bx - ax) / math.dist((ax, ay), (bx, by))
    islands = "".join(
        f'<circle cx="{dice.uniform(-25, 25):.3f}" cy="{y + dice.uniform(-5, 5):.3f}" r="{dice.uniform(5, 9):.3f}"/>'
        for y in dice.sample([-28, 0, 28], dice.randint(0, 3))
    )
    weld = f'<g id="weld"><path d="M {-45} {dice.uniform(-6, 6):.3f} h {dice.uniform(4, 9):.3f}"/></g>' if dice.random() < 0.4 else ""
    (folder / "blob.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="300mm" height="300mm" viewBox="-150 -150 300 300">'
        f'<g id="air"><path d="{data}"/>{islands}</g>{weld}'
        f'<g id="port"><path d="M {mx - 4 * nx:.4f} {my - 4 * ny:.4f} L {mx + 4 * nx:.4f} {my + 4 * ny:.4f}"/></g></svg>'
    )
    seam = ', seam = ["weld"]' if weld else ""
    spec = folder / "blob.toml"
    spec.write_text(
        f'schema = 1\nname = "blob {seed}"\n[drawing]\nfile = "blob.svg"\npassage = "1 mm"\n'
        f'layers = {{ air = ["air"], port = ["port"]{seam} }}\n[seal]\nband = "{BAND} mm"\n[machine]\nprofile = "press"\n[press]\n'
    )
    return spec


KINDS = "seal-svg,outline-svg,separator-svg"


def build(spec, target):
    return subprocess.run([tool, "build", spec, "-o", target, "--only", KINDS, "-q", "--anyway"], capture_output=True, text=True)


made, refused, worst, seed = 0, 0, 0.0, first
while made < count:
    folder = out / f"blob-{seed}"
    folder.mkdir(exist_ok=True)
    answer = build(drawing(seed, folder), folder / "made")
    seed += 1
    if answer.returncode:
        # Some random drawings have bands that meet: they are refused, and never half made.
        assert answer.returncode == 1 and not (folder / "made").exists(), answer.stderr
        refused += 1
        assert refused < 20 + 9 * count, answer.stderr
        continue
    made += 1
    worst = max(worst, judged(folder / "made", f"blob {seed - 1}", BAND))

stars = 0
for design in sorted(Path("designs").glob("*.toml")):
    text = design.read_text()
    if "[star]" not in text or "[press]" in text:
        continue
    lines = [line for line in text.splitlines() if line.split("=")[0].strip() not in ("speed", "temperature", "overlap", "profile", "program", "feed_floor")]
    text = "\n".join(line for line in lines if line.strip() != "[machine]")
    pressed = out / design.name
    pressed.write_text(text + '\n[machine]\nprofile = "press"\n[press]\n')
    target = out / design.stem
    answer = build(pressed, target)
    assert answer.returncode == 0, (design, answer.stderr)
    band = 2.0
    for line in lines:
        if line.split("=")[0].strip() == "band":
            band = float(line.split('"')[1].split()[0])
    worst = max(worst, judged(target, design.name, band))
    stars += 1
print(f"{made} random drawings ({refused} refused) and {stars} designs of stars: the weld is the sealed shape within {worst:.4f} mm and the creep of {CREEP} mm")
