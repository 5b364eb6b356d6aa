"""LinuxCNC's canonical moves in contact against the seal drawing as ezdxf reads it, both ways, and the manifest's figures.

Usage: canon.py CANON PROGRAM MANIFEST [SEAL.dxf]
"""
import json
import math
import os
import re
import sys
import tomllib

import numpy

TOLERANCE = 0.001  # mm, the designs' own

canon, program, manifest_path = sys.argv[1:4]
manifest = json.load(open(manifest_path, encoding="utf-8"))
entry = next(f for f in manifest["files"] if program.endswith("/" + f["path"]))
# Stars, or drawn pieces, which all lie on one sheet here.
pieces = manifest.get("stars") or [{"index": i, "sheet": 1, **piece} for i, piece in enumerate(manifest["pieces"], 1)]
own = entry.get("star") or entry.get("copy")
sealed = [p for p in pieces if p["index"] == (own or p["index"]) and p["sheet"] == entry["sheet"]]
hot = entry["kind"] == "seal-gcode"
expected = sum(seam["length_mm"] for p in sealed for seam in p["seams"]) if hot else 0.0


class Line:
    def __init__(self, a, b):
        self.a, self.b = a, b
        self.length = math.dist(a, b)

    def point(self, t):
        return tuple(p + t * (q - p) for p, q in zip(self.a, self.b))

    def distances(self, points):
        """Distance of each point, a row of an array, from the line."""
        a, d = numpy.array(self.a), numpy.subtract(self.b, self.a)
        square = d @ d
        t = numpy.clip((points - a) @ d / square, 0.0, 1.0) if square else numpy.zeros(len(points))
        return numpy.linalg.norm(points - a - t[:, None] * d, axis=1)


class Arc:
    def __init__(self, center, radius, start, sweep):
        self.center, self.radius, self.start, self.sweep = center, radius, start, sweep
        self.length = radius * abs(sweep)

    def point(self, t):
        angle = self.start + t * self.sweep
        return (self.center[0] + self.radius * math.cos(angle), self.center[1] + self.radius * math.sin(angle))

    def distances(self, points):
        """Distance of each point, a row of an array, from the arc."""
        out = points - numpy.array(self.center)
        angle = numpy.arctan2(out[:, 1], out[:, 0])
        turn = ((angle - self.start) * math.copysign(1.0, self.sweep)) % (2 * math.pi)
        beside = numpy.abs(numpy.linalg.norm(out, axis=1) - self.radius)
        ends = [numpy.linalg.norm(points - numpy.array(self.point(t)), axis=1) for t in (0.0, 1.0)]
        return numpy.where(turn <= abs(self.sweep), beside, numpy.minimum(*ends))


def farthest(probes, targets, step):
    """Largest distance from points on `probes`, `step` mm apart at most, to `targets`."""
    counts = [max(2, math.ceil(probe.length / step)) for probe in probes]
    points = numpy.array([probe.point(i / count) for probe, count in zip(probes, counts) for i in range(count + 1)])
    nearest = numpy.full(len(points), math.inf)
    for target in targets:
        nearest = numpy.minimum(nearest, target.distances(points))
    return nearest.max()


at = (0.0, 0.0, 0.0)
seconds = rests = 0.0
feed = None
fed = []
call = re.compile(r"(STRAIGHT_TRAVERSE|STRAIGHT_FEED|ARC_FEED|SET_FEED_RATE|DWELL)\(([^)]*)\)")
for line in open(canon, encoding="utf-8"):
    match = call.search(line)
    if not match:
        continue
    name, words = match.group(1), [float(w) for w in match.group(2).split(",")]
    if name == "SET_FEED_RATE":
        feed = words[0]
        continue
    if name == "DWELL":
        rests += words[0]
        continue
    start = at[:2]
    if name == "ARC_FEED":
        # first_end, second_end, first_axis, second_axis, rotation, axis_end_point
        x, y, cx, cy, turns, z = words[:6]
        first, last = math.atan2(at[1] - cy, at[0] - cx), math.atan2(y - cy, x - cx)
        sweep = (last - first) % (2 * math.pi) if turns > 0 else -((first - last) % (2 * math.pi))
        piece = Arc((cx, cy), math.dist(start, (cx, cy)), first, sweep)
    else:
        x, y, z = words[:3]
        piece = Line(start, (x, y))
    if name != "STRAIGHT_TRAVERSE":
        seconds += math.hypot(piece.length, z - at[2]) / feed * 60.0
        fed.append((at[2], z, piece))
    at = (x, y, z)

# Contact is the level feed at the lowest height of a process: on the way down and up the iron leaves the drawing at an inlet's mouth.
stated = re.findall(r"^[;(] process: process=\S+ contact_mm=(\S+?)\)?$", open(program, encoding="utf-8").read(), flags=re.M)
lowest = min((max(heights) for *heights, _ in fed), default=0.0)
depths = {float(depth) for depth in stated} or {min(lowest, 0.0)}
contact = [piece for start, end, piece in fed if any(max(abs(start - depth), abs(end - depth)) <= 1e-9 for depth in depths)]
length = sum(piece.length for piece in contact)

problems = []
if abs(length - expected) > 1e-3 * max(expected, 1.0):
    problems.append(f"LinuxCNC travels {length:.3f} mm in contact, the manifest says {expected:.3f} mm")
if hot and rests == 0.0:
    time = sum(seam["time_s"] for p in sealed for seam in p["seams"])
    if abs(seconds - time) > 1e-3 * time:
        problems.append(f"LinuxCNC feeds for {seconds:.1f} s, the manifest says {time:.1f} s")
# Parallel lines of a band lie beside the line of the drawing, the outer ones where the tool touches the edge of the band.
seal = tomllib.load(open(os.path.join(os.path.dirname(program), "spec.toml"), "rb")).get("seal", {})
has_lines = any(seam.get("lines", 1) > 1 for p in sealed for seam in p["seams"])
beside = (float(seal["band"].split()[0]) - float(seal["tip"].split()[0])) / 2 if has_lines else 0.0
# The drawing of the sheet that the program belongs to.
drawing = os.path.join(os.path.dirname(program), f"sheet-{entry['sheet']}-seal.dxf")
if hot and os.path.exists(drawing):
    import ezdxf

    drawn = []
    for shape in ezdxf.readfile(drawing).modelspace().query("LWPOLYLINE"):
        points = list(shape.get_points("xyb"))
        pairs = zip(points, points[1:] + points[:1] if shape.closed else points[1:])
        for (x0, y0, bulge), (x1, y1, _) in pairs:
            if bulge == 0.0:
                drawn.append(Line((x0, y0), (x1, y1)))
                continue
            center, start, _, radius = ezdxf.math.bulge_to_arc((x0, y0), (x1, y1), bulge)
            begin = math.atan2(y0 - center[1], x0 - center[0])
            drawn.append(Arc((center[0], center[1]), radius, begin, 4.0 * math.atan(bulge)))
    off = farthest(contact, drawn, 1.0)
    if abs(off - beside) > TOLERANCE:
        problems.append(f"LinuxCNC is {off:.6f} mm off the drawing, not {beside}")
    # Back from the drawing only where one program seals all of it, and has few enough moves to look at each.
    if len(pieces) == len(sealed) and len(contact) < 2000:
        off = farthest(drawn, contact, 2.0)
        if off > beside + TOLERANCE:
            problems.append(f"the drawing is {off:.6f} mm off what LinuxCNC travels")
if problems:
    sys.exit(f"{program}: " + "; ".join(problems))
