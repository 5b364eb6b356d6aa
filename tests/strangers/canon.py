"""Adds up LinuxCNC's canonical moves in contact and compares the sum with the manifest's seam length."""
import json
import math
import re
import sys

canon, program, manifest_path = sys.argv[1:4]
manifest = json.load(open(manifest_path, encoding="utf-8"))
entry = next(f for f in manifest["files"] if program.endswith("/" + f["path"]))
stars = [s for s in manifest["stars"] if s["index"] == entry.get("star", s["index"]) and s["sheet"] == entry["sheet"]]
expected = sum(s["seam_mm"] for s in stars) if entry["kind"] == "seal-gcode" else 0.0

at = (0.0, 0.0, 0.0)
length = 0.0
call = re.compile(r"(STRAIGHT_TRAVERSE|STRAIGHT_FEED|ARC_FEED)\(([^)]*)\)")
for line in open(canon, encoding="utf-8"):
    match = call.search(line)
    if not match:
        continue
    name, words = match.group(1), [float(w) for w in match.group(2).split(",")]
    if name == "ARC_FEED":
        # first_end, second_end, first_axis, second_axis, rotation, axis_end_point
        x, y, cx, cy, turns, z = words[:6]
        start, end = math.atan2(at[1] - cy, at[0] - cx), math.atan2(y - cy, x - cx)
        sweep = (end - start) % (2 * math.pi) if turns > 0 else -((start - end) % (2 * math.pi))
        flat = abs(sweep) * math.hypot(at[0] - cx, at[1] - cy)
    else:
        x, y, z = words[:3]
        flat = math.hypot(x - at[0], y - at[1])
    if name != "STRAIGHT_TRAVERSE" and at[2] <= 0 and z <= 0:
        length += flat
    at = (x, y, z)
if abs(length - expected) > 1e-3 * max(expected, 1.0):
    sys.exit(f"{program}: LinuxCNC travels {length:.3f} mm in contact, the manifest says {expected:.3f} mm")
