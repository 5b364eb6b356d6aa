"""Laser programs cut every contour that has to be cut, and no other.

Usage: laser.py DIRECTORY...

MeerK40t (PyPI) loads each SVG and DXF of an outline, a mask or a frame into its default operations, plans the job as for a
GRBL laser, and what it would send is read: the feed of its default cut is 60 mm/min. At its defaults all
has to be cut; holes come before what they lie in once its option "Keep effect lines together" is off. K40 Whisperer is in no registry. Its
rules are short and stand in `k40_whisperer`: a line that is pure red is cut, pure blue engraved, all else goes to the raster.
"""
import json
import math
import os
import re
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import boxes

CUT_FEED = 60.0  # mm/min of MeerK40t's default cut
STEP = 0.06  # mm; it plans in thousandths of an inch, 0.0254 mm, at both ends


def wanted(dxf):
    """Boxes of all contours that have to be cut, mm."""
    return [box for layer, box in boxes.shapes(dxf) if layer != "label"]


def cuts(program):
    """Boxes of the runs burnt at the feed of cuts, in order, and whether each run is closed."""
    at, feed, power, run, found = (0.0, 0.0), 0.0, 0.0, [], []
    with open(program, encoding="utf-8", newline=None) as file:
        lines = file.read().split("\n")
    for line in [*lines, "G0 X0 Y0"]:
        words = {letter: float(value) for letter, value in re.findall(r"([GXYSF])(-?[0-9.]+)", line)}
        feed, power = words.get("F", feed), words.get("S", power)
        to = (words.get("X", at[0]), words.get("Y", at[1]))
        if words.get("G") == 1 and power > 0 and abs(feed - CUT_FEED) < 0.5:
            run = (run or [at]) + [to]
        elif run and to != at:
            found.append((boxes.box(run), math.dist(run[0], run[-1]) <= STEP))
            run = []
        at = to
    return found


def relative(found):
    """Boxes from the lower left of all of them; an empty list stays one."""
    x, y = boxes.union(found)[:2] if found else (0.0, 0.0)
    return [(b[0] - x, b[1] - y, b[2] - x, b[3] - y) for b in found]


def within(inner, outer):
    return all(i >= o for i, o in zip(inner[:2], outer[:2])) and all(i <= o for i, o in zip(inner[2:], outer[2:]))


def planned(kernel, work):
    """The cuts of the job of all loaded elements."""
    program = os.path.join(work, "job.gcode")
    kernel.console(f'plan0 clear copy preprocess validate blob preopt optimize save_job "{program}"\n')
    done = cuts(program)
    os.remove(program)
    return done


def meerk40t(file, kernel, work):
    """The faults of the job of `file`, and the number of contours that it cuts."""
    kernel.console("element* delete\n")
    kernel.console(f'load "{file}"\n')
    right = relative(wanted(os.path.splitext(file)[0] + ".dxf"))
    off = lambda a, b: max(abs(p - q) for p, q in zip(a, b))
    problems = []
    # By default it burns inner contours first, and by default another option, "Keep effect lines together", overrules that.
    for together in (True, False):
        kernel.planner.opt_effect_combine = together
        found = planned(kernel, work)
        problems += [f"contour {k + 1} does not come back to its start" for k, (_, closed) in enumerate(found) if not closed]
        done = relative([box for box, _ in found])
        problems += [f"is not cut: {b}" for b in right if not any(off(b, d) <= STEP for d in done)]
        if len(done) != len(right):
            problems.append(f"{len(done)} contours are cut, {len(right)} should be")
    for k, outer in enumerate(done):
        problems += [f"cut after what it lies in: {inner}" for inner in done[k + 1 :] if within(inner, outer)]
    return [f"{file}: MeerK40t: {problem}" for problem in problems], len(done)


def started(work):
    """MeerK40t without windows, settings or plugins, with a GRBL laser."""
    os.environ["HOME"] = work
    from meerk40t.internal_plugins import plugin
    from meerk40t.kernel import Kernel
    from meerk40t.main import APPLICATION_NAME, APPLICATION_VERSION, parser

    kernel = Kernel(APPLICATION_NAME, APPLICATION_VERSION, APPLICATION_NAME, ansi=False, ignore_settings=True)
    kernel.args = parser.parse_args(["--no-gui", "--nuke-settings", "--no-plugins"])
    kernel.add_plugin(plugin)
    kernel(partial=True)
    kernel.console("service device start -i grbl\n")
    # A drawing that is wider than the bed would be scaled down to it.
    kernel.device.bedwidth = kernel.device.bedheight = "3000mm"
    kernel.device.realize()
    return kernel


def k40_whisperer(svg):
    """Layers by the operation that they would get."""
    done = {"cut": [], "engrave": [], "raster": []}
    shapes = ("path", "circle", "rect", "ellipse", "line", "polyline", "polygon")

    def visit(node, layer, stroke, fill):
        stroke, fill = node.get("stroke", stroke), node.get("fill", fill)
        layer = node.get("id", layer)
        if node.tag.split("}")[-1] in shapes:
            by_line = {"#ff0000": "cut", "#0000ff": "engrave"}.get(stroke, "raster")
            done[by_line if fill == "none" else "raster"].append(layer)
        for child in node:
            visit(child, layer, stroke, fill)

    visit(ElementTree.parse(svg).getroot(), None, "none", "#000000")
    problems = [f"a shape of {layer} goes to the raster" for layer in done["raster"]]
    problems += [f"a shape of {layer} is engraved" for layer in done["engrave"] if layer != "label"]
    problems += [f"a shape of {layer} is cut" for layer in done["cut"] if layer == "label"]
    right = len(wanted(os.path.splitext(svg)[0] + ".dxf"))
    if len(done["cut"]) != right:
        problems.append(f"{len(done['cut'])} contours are cut, {right} should be")
    return [f"{svg}: K40 Whisperer: {problem}" for problem in problems]


def main():
    problems, files, contours = [], 0, 0
    kinds = [f"{subject}-{form}" for subject in ("outline", "mask", "frame") for form in ("svg", "dxf")]
    with tempfile.TemporaryDirectory() as work:
        kernel = started(work)
        for folder in map(os.path.abspath, sys.argv[1:]):
            manifest = json.load(open(os.path.join(folder, "manifest.json"), encoding="utf-8"))
            for entry in manifest["files"]:
                if entry["kind"] not in kinds:
                    continue
                file = os.path.join(folder, entry["path"])
                found, count = meerk40t(file, kernel, work)
                problems += found + (k40_whisperer(file) if file.endswith(".svg") else [])
                files, contours = files + 1, contours + count
        kernel.console("quit\n")
    if problems or contours == 0:
        sys.exit("\n".join(problems or ["nothing was cut"]))
    print(f"MeerK40t and K40 Whisperer's rules: {files} files, all of their {contours} contours cut")


main()
