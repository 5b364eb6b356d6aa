"""Inkscape, librsvg and Chromium open every cutting SVG of a build: as large as it should be, and no empty page.

Usage: drawn.py DIRECTORY [chromium]

Inkscape is asked where the edges of every layer lie, and has to agree with the lines and arcs that ezdxf reads in the DXF of
the same part. It answers with six digits only, so each edge is first moved to 0, where they are enough.
"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import tomllib

from PIL import Image

import boxes

TOLERANCE = 0.001  # mm, of every edge
DARK = 64  # of 255: the darkest pixel of a page that is not taken for an empty one
PX = 96.0 / 25.4  # a millimetre at 100 %


def layers(dxf):
    """{layer: (left, bottom, right, top)} in mm, exactly."""
    found = {}
    for layer, box in boxes.shapes(dxf):
        found.setdefault(layer, []).append(box)
    return {layer: boxes.union(all_of_it) for layer, all_of_it in found.items()}


def page(svg):
    """The left and upper edge of the page in the drawing's own coordinates, and its size, mm."""
    with open(svg, encoding="utf-8") as file:
        box = re.search(r'viewBox="([^"]+)"', file.read()).group(1)
    left, top, width, height = map(float, box.split())
    # A drawing whose origin is the page's corner is flipped about its middle, one around an axis about that.
    return (left, height if (left, top) == (0, 0) else -top, width, height)


def inkscape(jobs, pictures):
    """The error of the edges of each layer, mm, and a picture of each file at 100 %."""
    actions, asked = [], []
    for svg, picture in zip(jobs, pictures):
        left, top, _, _ = page(svg)
        actions.append(f"file-open:{svg}; export-background:white; export-dpi:96; export-filename:{picture}; export-do")
        for layer, (x0, y0, x1, y1) in layers(svg.removesuffix(".svg") + ".dxf").items():
            x, y, w, h = ((x0 - left) * PX, (top - y1) * PX, (x1 - x0) * PX, (y1 - y0) * PX)
            asked.append((svg, layer))
            # Scaled by 2 about its middle, its left edge goes left by half its width.
            actions.append(
                f"select-clear; select-by-id:{layer}; transform-translate:{-x!r},{-y!r}; query-x; query-y; "
                f"transform-scale:2; transform-translate:{w / 2!r},{h / 2!r}; query-x; query-y"
            )
        actions.append("file-close")
    shell = subprocess.run(
        ["inkscape", "--shell"], input="\n".join([*actions, "quit", ""]), capture_output=True, text=True, check=True
    )
    numbers = [float(line) for line in shell.stdout.splitlines() if re.fullmatch(r"-?[0-9.]+(e-?[0-9]+)?", line)]
    if len(numbers) != 4 * len(asked):
        sys.exit(f"{jobs[0]}: Inkscape gave {len(numbers)} answers to {4 * len(asked)} questions\n{shell.stderr}")
    for k, place in enumerate(asked):
        a, b, c, d = numbers[4 * k : 4 * k + 4]
        # Left and upper edge; right and lower one, of which the second question has the half size that is too much.
        yield place, max(abs(a), abs(b), abs(a + 2 * (a - c)), abs(b + 2 * (b - d))) / PX


def chromium(jobs, work):
    """Darkest pixel of each file at 100 %, several beside each other as documents of their own."""
    sizes = [tuple(math.ceil(side * PX) for side in page(svg)[2:]) for svg in jobs]
    frame = '<iframe src="file://{}" width="{}" height="{}" style="border:0;position:absolute;left:0;top:{}px"></iframe>'
    tops = [sum(h for _, h in sizes[:k]) for k in range(len(sizes))]
    frames = [frame.format(os.path.abspath(svg), w, h, top) for svg, (w, h), top in zip(jobs, sizes, tops)]
    html, shot = os.path.join(work, "all.html"), os.path.join(work, "all.png")
    with open(html, "w", encoding="utf-8") as file:
        file.write("<!doctype html><body style='margin:0;background:white'>" + "".join(frames))
    size = f"--window-size={max(w for w, _ in sizes)},{sum(h for _, h in sizes)}"
    flags = ["--headless", "--no-sandbox", "--hide-scrollbars", "--disable-gpu", f"--user-data-dir={work}/profile", size]
    subprocess.run(["chromium", *flags, f"--screenshot={shot}", f"file://{html}"], capture_output=True, check=True, timeout=120)
    image = Image.open(shot).convert("L")
    for svg, (w, h), top in zip(jobs, sizes, tops):
        yield svg, image.crop((0, top, w, top + h)).getextrema()[0]


def darkest(picture):
    # Librsvg leaves empty areas transparent.
    image = Image.open(picture).convert("RGBA")
    return Image.alpha_composite(Image.new("RGBA", image.size, "white"), image).convert("L").getextrema()[0]


def main():
    folder, browser = sys.argv[1], sys.argv[2:] == ["chromium"]
    manifest = json.load(open(os.path.join(folder, "manifest.json"), encoding="utf-8"))
    cutting = ("seal-svg", "outline-svg", "mask-svg", "frame-svg")
    jobs = [os.path.join(folder, f["path"]) for f in manifest["files"] if f["kind"] in cutting]
    problems, worst = [], 0.0
    # The manifest gives the sizes of the frame's plates, too; the tool runs half a kerf outside of it.
    with open(os.path.join(folder, "spec.toml"), "rb") as file:
        spec = tomllib.load(file)
    kerf = next((spec[part]["kerf"] for part in ("frame", "cut") if "kerf" in spec.get(part, {})), "0 mm")
    for plate in manifest["plates"]:
        drawing = os.path.join(folder, f"plate-{plate['plates'][0]}-frame.dxf")
        left, _, right, _ = layers(drawing)["frame-edge"]
        wide = 2 * plate["radius_mm"] + float(kerf.removesuffix("mm"))
        if abs(right - left - wide) > 2 * TOLERANCE:
            problems.append(f"{drawing}: {right - left:.4f} mm wide, the manifest says {wide:.4f} mm")
    with tempfile.TemporaryDirectory() as work:
        pictures = [os.path.join(work, f"{k}.png") for k in range(len(jobs))]
        for (svg, layer), off in inkscape(jobs, pictures):
            worst = max(worst, off)
            if not off <= TOLERANCE:
                problems.append(f"{svg}: Inkscape has an edge of {layer} {off:.6f} mm beside that of the DXF")
        shades = [("Inkscape", svg, darkest(picture)) for svg, picture in zip(jobs, pictures)]
        for svg in jobs:
            picture = os.path.join(work, "rsvg.png")
            subprocess.run(["rsvg-convert", "--dpi-x=96", "--dpi-y=96", svg, "-o", picture], check=True)
            shades.append(("librsvg", svg, darkest(picture)))
        if browser:
            shades += [("Chromium", svg, shade) for svg, shade in chromium(jobs, work)]
    problems += [f"{svg}: darkest pixel {s} of 255 in {who}, not below {DARK}" for who, svg, s in shades if s >= DARK]
    if problems:
        sys.exit("\n".join(problems))
    tone = {who: max(s for w, _, s in shades if w == who) for who, _, _ in shades}
    print(f"{folder}: {len(jobs)} drawings, edges within {worst:.6f} mm in Inkscape, darkest pixels {tone}")


main()
