"""Every seal program of a directory as OctoPrint's analysis sees it: time within 1 %, extents within 0.1 mm.

Usage: octoprint.py OCTOPRINT DIRECTORY. The analysis is one module of it, and is loaded alone.
"""

import importlib.util
import re
import sys
from pathlib import Path

LIMIT_TIME = 0.01
LIMIT_MM = 0.1


def analysis(octoprint):
    path = Path(octoprint) / "octoprint" / "util" / "gcodeInterpreter.py"
    spec = importlib.util.spec_from_file_location("gcodeInterpreter", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def extents(text):
    """Largest X and Y of all moves, arcs by the quadrants that they pass: read here, not by OctoPrint."""
    import math

    x = y = 0.0
    most = [0.0, 0.0]
    for line in text.splitlines():
        words = dict(re.findall(r"([GXYZIJ])(-?[0-9.]+)", line.split(";")[0]))
        if words.get("G") not in ("0", "1", "2", "3"):
            continue
        to = float(words.get("X", x)), float(words.get("Y", y))
        points = [to]
        if words["G"] in "23":
            cx, cy = x + float(words.get("I", 0)), y + float(words.get("J", 0))
            radius = math.hypot(x - cx, y - cy)
            start, end = math.atan2(y - cy, x - cx), math.atan2(to[1] - cy, to[0] - cx)
            if words["G"] == "2":
                start, end = end, start
            sweep = (end - start) % math.tau
            for quadrant in range(4):
                if (quadrant * math.pi / 2 - start) % math.tau <= sweep:
                    angle = quadrant * math.pi / 2
                    points.append((cx + radius * math.cos(angle), cy + radius * math.sin(angle)))
        for p in points:
            most = [max(most[0], p[0]), max(most[1], p[1])]
        x, y = to
    return most


def main():
    module = analysis(sys.argv[1])
    failed = 0
    for path in sorted(Path(sys.argv[2]).glob("*-seal.*")):
        if path.suffix == ".svg":
            continue
        text = path.read_text()
        truth = float(re.search(r"total: .*time_s=(\d+)", text)[1])
        seen = module.gcode()
        seen.load(str(path))
        time = 60.0 * seen.totalMoveTimeMinute
        area, most = seen.travel_area, extents(text)
        off = max(abs(area["maxX"] - most[0]), abs(area["maxY"] - most[1]), abs(area["minX"]), abs(area["minY"]))
        share = time / truth - 1.0
        right = abs(share) <= LIMIT_TIME and off <= LIMIT_MM
        failed += not right
        print(f"{path}: {time:.0f} s of {truth:.0f} ({100 * share:+.2f} %), extents within {off:.3f} mm{'' if right else ' FAILED'}")
    sys.exit(failed > 0)


main()
