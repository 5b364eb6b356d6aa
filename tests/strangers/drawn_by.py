"""Drawings written by Inkscape and ezdxf: the seams must agree with shapely's, computed from the same files as read by svgelements and ezdxf.

Usage: drawn_by.py TOOL DIRECTORY [FILE...]

FILEs are drawings that another program wrote; they are compared alone. Without any, Inkscape changes the drawings of this page by its own
commands (shapes to paths, unions, turns, clones) and writes each as its own SVG, as a plain SVG and as DXF.
"""
import math
import os
import re
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from functools import reduce

import ezdxf
import numpy as np
import shapely
import svgelements as se
from shapely.geometry import LineString, Polygon

import drawn_seams

CHORD = 5e-5  # mm: how far a chord may be from its curve
JOINED = 1e-4  # mm: nearer ends of a DXF's curves are one
TOLERANCE = drawn_seams.TOLERANCE + 1e-4  # mm: programs write six to nine digits

# Name: the page's unit, the shapes of the air, Inkscape's actions, and the area in mm^2 if there is a formula for it.
RIM = '<rect id="rim" x="20" y="20" width="150" height="110" rx="15" ry="12"/>'
RIM_AREA = 150 * 110 - (4 - math.pi) * 15 * 12
SPOT = '<ellipse id="spot" cx="70" cy="80" rx="12" ry="8" transform="rotate(20 70 80)"/>'
SPOT_AREA = math.pi * 12 * 8
INKSCAPE = {
    "shapes": ("mm", RIM + SPOT, "select-clear", RIM_AREA - SPOT_AREA),
    "paths": ("mm", RIM + SPOT, "select-by-id:rim,spot; object-to-path", RIM_AREA - SPOT_AREA),
    "turned": ("cm", RIM + SPOT, "select-all:all; transform-rotate:17", RIM_AREA - SPOT_AREA),
    "cloned": (
        "in",
        RIM + '<circle id="spot" cx="60" cy="75" r="9"/>',
        "select-by-id:spot; clone; transform-translate:230,-60; transform-scale:1.5",
        None,
    ),
    "united": (
        "mm",
        '<rect id="rim" x="20" y="40" width="120" height="60"/><circle id="more" cx="130" cy="70" r="45"/>',
        "select-by-id:rim,more; path-union",
        None,
    ),
    "cut": (
        "mm",
        '<path id="rim" d="M20,30 C80,0 120,60 180,30 S190,120 150,130 60,110 20,120 Z"/><circle id="more" cx="100" cy="75" r="14"/>',
        "select-by-id:rim,more; path-difference",
        None,
    ),
}
WIDTH, HEIGHT = 200, 160  # mm, of every page
UNITS = {"mm": 1.0, "cm": 10.0, "in": 25.4}


def page(unit, shapes):
    """A drawing as text: one layer of the air, one of the port."""
    width, height = WIDTH / UNITS[unit], HEIGHT / UNITS[unit]
    layer = '<g id="{0}" inkscape:label="{0}" inkscape:groupmode="layer" style="fill:none;stroke:#000000;stroke-width:0.2">{1}</g>'
    port = '<path id="hose" d="M16,72 H24"/>' if "rim" in shapes else ""
    names = 'xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
    size = f'width="{width}{unit}" height="{height}{unit}" viewBox="0 0 {WIDTH} {HEIGHT}"'
    return f"<svg {names} {size}>{layer.format('air', shapes)}{layer.format('port', port)}</svg>"


def by_inkscape(folder):
    """Writes all of Inkscape's drawings, and returns the paths of the files."""
    own, plain = [], []
    files = []
    for name, (unit, shapes, does, _) in INKSCAPE.items():
        source = os.path.join(folder, f"{name}.svg")
        with open(source, "w", encoding="utf-8") as file:
            file.write(page(unit, shapes))
        ends = [os.path.join(folder, name + end) for end in ("-own.svg", "-plain.svg", "-outlines.dxf")]
        own.append(f"file-open:{source}; {does}; export-type:svg; export-filename:{ends[0]}; export-do; file-close")
        plain.append(f"file-open:{ends[0]}; export-plain-svg; export-filename:{ends[1]}; export-do; file-close")
        files += ends
    # Inkscape keeps the option for plain SVG until it ends.
    actions = "\n".join([*own, *plain, "quit", ""])
    shell = subprocess.run(["inkscape", "--shell"], input=actions, capture_output=True, text=True, timeout=60)

    def outlines(own):
        target = own.replace("-own.svg", "-outlines.dxf")
        flags = ["--export-extension=org.ekips.output.dxf_outlines", f"--export-filename={target}"]
        return subprocess.run(["inkscape", *flags, own], capture_output=True, text=True, timeout=60)

    with ThreadPoolExecutor(2) as pool:
        runs = [shell, *pool.map(outlines, files[::3])]
    missing = [file for file in files if not os.path.exists(file)]
    if missing:
        sys.exit(f"Inkscape did not write {missing}\n" + "\n".join(run.stderr[-500:] for run in runs))
    return files


def by_ezdxf(folder):
    """Writes a drawing of every entity that is a curve, in inches, some in blocks of blocks; answers with the paths of the files."""
    files = []
    for version in ("R2000", "R2018"):
        document = ezdxf.new(version)
        document.header["$INSUNITS"] = 1
        sheet, on = document.modelspace(), {"layer": "air"}
        sheet.add_line((1, 1), (6, 1), on)
        sheet.add_arc((6, 2), 1, 270, 360, dxfattribs=on)
        sheet.add_lwpolyline([(7, 2, 0.3), (7, 3, 0), (7, 4.5, 0)], format="xyb", dxfattribs=on)
        sheet.add_ellipse((6, 4.5), (1, 0), 0.5, 0, math.pi / 2, dxfattribs=on)
        sheet.add_open_spline([(6, 5), (5, 5.6), (3.5, 4.2), (2, 5), (1, 5)], 3, dxfattribs=on)
        sheet.add_rational_spline([(1, 5), (0.2, 3), (1, 1)], [1, 0.7, 1], 2, dxfattribs=on)
        sheet.add_circle((2.5, 3), 0.4, on)
        # Entities on layer 0 of a block belong to the layer of the block's reference.
        eye, pair = document.blocks.new("eye"), document.blocks.new("pair")
        eye.add_ellipse((0, 0), (0.4, 0), 0.6)
        pair.add_blockref("eye", (0, 0), {"rotation": 30})
        pair.add_blockref("eye", (1.4, 0))
        sheet.add_blockref("pair", (4.2, 3), {**on, "rotation": 10, "xscale": 0.9, "yscale": 0.9, "zscale": 0.9})
        sheet.add_line((4, 1.8), (4.8, 2), {"layer": "weld"})
        sheet.add_point((3.5, 1), {"layer": "port"})
        files.append(os.path.join(folder, f"entities-{version}.dxf"))
        document.saveas(files[-1])
    return files


def of_svg(file):
    """{layer: lines as arrays of complex numbers in mm, Y up} of an SVG, by svgelements."""
    drawing = se.SVG.parse(file, ppi=96)
    # svgelements takes a millimetre for 0.0393701 in, so the scale is taken from the page.
    with open(file, encoding="utf-8") as text:
        width, unit = re.search(r'\bwidth="([0-9.]+)(mm|cm|in)"', text.read()).groups()
    scale = float(width) * UNITS[unit] / drawing.width
    layers = {}

    def walk(item, layer):
        if isinstance(item, (se.Group, se.Use)):
            for child in item:
                walk(child, item.id if item.id in ("air", "port", "weld") else layer)
        elif isinstance(item, se.Shape):
            for part in abs(se.Path(item)).as_subpaths():
                layers.setdefault(layer, []).append(np.concatenate([sampled(piece) for piece in se.Path(part) if not isinstance(piece, se.Move)]))

    def sampled(piece):
        if isinstance(piece, (se.Line, se.Close)):
            points = [piece.start, piece.end]
        else:
            # A quarter of a circle of r mm leaves its chords by r (pi / 4 n)^2 / 2.
            n = max(16, math.ceil(math.sqrt(piece.length(error=1e-3) * scale / CHORD)))
            points = piece.npoint(np.linspace(0, 1, n))
            return (points[:, 0] - 1j * points[:, 1]) * scale
        return np.array([complex(p.x, -p.y) * scale for p in points])

    walk(drawing, None)
    return layers


def of_dxf(file):
    """The same of a DXF, by ezdxf."""
    document = ezdxf.readfile(file)
    unit = {1: 25.4, 4: 1.0, 5: 10.0}[document.header["$INSUNITS"]]
    layers = {}

    def walk(entity, outside):
        layer = outside if entity.dxf.layer == "0" else entity.dxf.layer
        if entity.dxftype() in ("INSERT", "LWPOLYLINE"):
            for part in entity.virtual_entities():
                walk(part, layer)
            return
        kind = entity.dxftype()
        if kind == "POINT":
            places = [entity.dxf.location]
        elif kind == "LINE":
            places = [entity.dxf.start, entity.dxf.end]
        else:
            # Ezdxf's paths are cubics that only come near to arcs and rational splines; its entities compute exact points.
            places = entity.flattening(CHORD / unit, *([16] if kind in ("ELLIPSE", "SPLINE") else []))
        points = np.array([complex(p.x, p.y) * unit for p in places])
        # Inkscape ends each drawing with curves of no length, and FreeCAD polylines with such lines.
        if kind == "POINT" or len(points) and abs(points - points[0]).max() > JOINED:
            layers.setdefault(layer, []).append(points)

    for entity in document.modelspace():
        walk(entity, "0")
    return layers


def region(lines):
    """The area inside an odd number of the closed curves that the lines form end to end."""
    loops, open_ones = [], list(lines)
    while open_ones:
        chain = open_ones.pop()
        while abs(chain[0] - chain[-1]) > JOINED:
            near = [k for k, line in enumerate(open_ones) if min(abs(line[0] - chain[-1]), abs(line[-1] - chain[-1])) <= JOINED]
            if not near:
                raise ValueError(f"a curve ends at {chain[-1]}")
            line = open_ones.pop(near[0])
            chain = np.concatenate([chain, (line if abs(line[0] - chain[-1]) <= JOINED else line[::-1])[1:]])
        loops.append(Polygon(np.stack([chain.real, chain.imag], axis=1)))
    return reduce(shapely.symmetric_difference, loops)


def compared(tool, file, area):
    """The distance of a drawing's seams from the expected ones, mm; or a message about its fault."""
    layers = of_svg(file) if file.endswith(".svg") else of_dxf(file)
    air = region(layers["air"])
    if area is not None and abs(air.area / area - 1) > 1e-3:
        return f"{file}: {air.area:.1f} mm2 of air are read, {area:.1f} were drawn"
    spec = os.path.splitext(file)[0] + ".toml"
    roles = "\n".join(f'{role} = ["{layer}"]' for role, layer in (("air", "air"), ("port", "port"), ("seam", "weld")) if layer in layers)
    name = os.path.basename(spec)[:-5]
    with open(spec, "w", encoding="utf-8") as text:
        text.write(f'schema = 1\nname = "{name}"\n[drawing]\nfile = "{os.path.basename(file)}"\n[drawing.layers]\n{roles}\n')
    run = subprocess.run([tool, "build", spec, "-q", "-o", spec[:-5]], capture_output=True, text=True, timeout=20)
    if run.returncode != 0:
        return f"{file}: refused\n{run.stderr[:800]}"
    welds = [LineString(np.stack([line.real, line.imag], axis=1)) for line in layers.get("weld", [])]
    far = drawn_seams.worst(spec[:-5], air, [line.mean() for line in layers.get("port", [])], welds)
    return far if far <= TOLERANCE else f"{file}: a seam is {far:.6f} mm beside the one expected, {TOLERANCE} mm are allowed"


def main():
    tool, folder, *others = sys.argv[1:]
    folder = os.path.abspath(folder)
    os.makedirs(folder, exist_ok=True)
    files = [(os.path.abspath(file), None) for file in others]
    if not files:
        files = [(file, INKSCAPE[os.path.basename(file).split("-")[0]][3]) for file in by_inkscape(folder)]
        files += [(file, None) for file in by_ezdxf(folder)]
    with ProcessPoolExecutor(2) as pool:
        found = list(pool.map(compared, [tool] * len(files), *zip(*files)))
    complaints = [text for text in found if isinstance(text, str)]
    if complaints:
        sys.exit("\n".join(complaints))
    print(f"{len(files)} drawings of other programs within {max(found):.4f} mm")


if __name__ == "__main__":
    main()
