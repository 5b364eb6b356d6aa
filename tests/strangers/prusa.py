"""PrusaSlicer reads every printed mask: one part, manifold, nothing repaired, and slices it on a bed that it fits on.

Usage: prusa.py BED DIRECTORY..., BED the side of a square bed in mm.
"""
import json
import os
import re
import subprocess
import sys
import tempfile


def slicer(*arguments):
    return subprocess.run(["prusa-slicer", "--loglevel", "1", *arguments], capture_output=True, text=True, check=False)


def wrong(stl, bed, work):
    told = dict(re.findall(r"^(\w+) = +(\S+)", slicer("--info", stl).stdout, re.M))
    if told.get("manifold") != "yes" or told.get("number_of_parts") != "1":
        yield f"manifold {told.get('manifold')}, parts {told.get('number_of_parts')}"
    # It reports repairs only: facets_added, edges_fixed, backwards_edges ...
    mended = {key: value for key, value in told.items() if re.search("fixed|removed|reversed|added|backwards|degenerate", key)}
    if mended:
        yield f"repaired {mended}"
    sides = f"0x0,{bed}x0,{bed}x{bed},0x{bed}"
    ran = slicer("--export-gcode", "--bed-shape", sides, "--output", os.path.join(work, "x.gcode"), stl)
    if ran.returncode != 0:
        yield f"does not fit a bed of {bed} mm: {(ran.stdout + ran.stderr).strip().splitlines()[-1:]}"
    print(f"{stl}: {told.get('size_x')} x {told.get('size_y')} mm, {told.get('volume')} mm3, sliced on {bed} mm")


def main():
    bed, problems, count = sys.argv[1], [], 0
    with tempfile.TemporaryDirectory() as work:
        for folder in sys.argv[2:]:
            manifest = json.load(open(os.path.join(folder, "manifest.json"), encoding="utf-8"))
            for entry in manifest["files"]:
                if entry["path"].endswith(".stl"):
                    stl = os.path.join(folder, entry["path"])
                    problems += [f"{stl}: PrusaSlicer: {problem}" for problem in wrong(stl, bed, work)]
                    count += 1
    if problems or count == 0:
        sys.exit("\n".join(problems or ["no solid to look at"]))


main()
