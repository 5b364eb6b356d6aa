"""Whether a drawing can be sealed, by shapely: discs that must go through its tubes, and through its fabric. Lengths are those of a band of 2 mm."""
import math

import shapely
from shapely.geometry import LineString, Point, Polygon

from drawn_loops import polygon

BAND = 2.0  # mm
ROOMY, NARROW = 1.12, 0.9  # of the least width: wider passes, narrower is refused, between them nothing is judged
DEPTH = 1.7  # of half the least width: so deep reaches a corner of 45 degrees out of the room for a disc of that width
CHANNEL = 9.5  # mm, half the width of the room that a port needs: half the flat hose, two bands, and the rounding of its corners
REACH = 45.0  # mm of that room outside of the edge, and 12 inside


def sealable(drawing):
    """Whether it can be: `None` where it comes near a limit."""
    if drawing.fault:
        return False
    if not all(polygon(loop).is_valid for loop in drawing.loops):
        return None
    air = air_of(drawing)
    welds = [*map(path, drawing.welds), *drawing.walls]
    tubes = apart(air.difference(shapely.union_all([weld.buffer(BAND / 2) for weld in welds] + [polygon(slit) for slit in drawing.slits])))
    left, low, right, high = air.bounds
    walled = air.union(shapely.union_all([wall.buffer(1e-3) for wall in drawing.walls]))
    outside = shapely.box(left - 99, low - 99, right + 99, high + 99).difference(walled)
    fabric = [rest for part in apart(outside) if not is_spot(part) for rest in without_slots(part)]
    if any(max(sides(part)) < 1.2 * BAND for part in fabric):
        return None
    if not all(is_roomy(part, ROOMY * BAND) for part in [*tubes, *fabric]):
        return False if any(is_narrow(part, NARROW * BAND) for part in [*tubes, *fabric]) else None
    has_room = all(has_channel(port, tubes, air) for port in drawing.ports)
    return True if has_room and welds_end_well(drawing, air) else None


def air_of(drawing):
    regions = [polygon(loop) for loop in drawing.loops]
    outer = [region for k, region in enumerate(regions) if not any(o.contains(region) for j, o in enumerate(regions) if j != k)]
    inner = [region for region in regions if region not in outer]
    return shapely.union_all(outer).difference(shapely.union_all(inner))


def has_channel(port, tubes, air):
    a, b = port
    at, out = (a + b) / 2, (b - a) / abs(b - a)
    if air.contains(Point((at + out).real, (at + out).imag)):
        out = -out
    inside, outside = (strip(at, out, *reach) for reach in ((-12, -1), (1, REACH)))
    return any(tube.contains(inside) for tube in tubes) and not air.intersects(outside)


def strip(at, out, first, last):
    side = 1j * out * CHANNEL
    corners = [at + first * out - side, at + first * out + side, at + last * out + side, at + last * out - side]
    return Polygon([(p.real, p.imag) for p in corners])


def welds_end_well(drawing, air):
    """Whether no weld leaves the air, and each comes to other curves steeply or not at all, and goes on beyond or ends there."""
    welds = [path(run) for run in drawing.welds]
    edges = [polygon(loop).boundary for loop in drawing.loops + drawing.slits] + drawing.walls
    for k, weld in enumerate(welds):
        others = shapely.union_all(edges + welds[:k] + welds[k + 1 :])
        ends = [Point(weld.coords[0]), Point(weld.coords[-1])]
        touches = shapely.union_all([weld.intersection(others), *(end for end in ends if end.distance(others) < 1e-6)])
        far = weld.difference(touches.buffer(4 * BAND))
        is_stub = any(1e-6 < end.distance(touches) < 3 * BAND for end in ends)
        is_near = not far.is_empty and far.distance(others) < (2 * ROOMY + 0.5) * BAND
        if is_stub or is_near or not air.buffer(1e-6).contains(weld):
            return False
    return True


def is_spot(part):
    """Around a round island that is narrower than two bands, but not than one, bands may overlap."""
    long = max(sides(part))
    return not part.interiors and 0.98 < part.area / (math.pi * long**2 / 4) < 1.02 and long > 1.2 * BAND


def without_slots(part):
    """The parts of fabric without slots of exactly one band, which are sealed once."""
    thin = part.difference(part.buffer(-0.51 * BAND).buffer(0.52 * BAND))
    slots = [piece for piece in apart(thin) if piece.area > BAND * BAND / 2 and abs(min(sides(piece)) - BAND) < 1e-6]
    rest = part.difference(shapely.union_all([slot.buffer(1e-6) for slot in slots])) if slots else part
    return [piece for piece in apart(rest) if not slots or piece.area > BAND * BAND / 2]


def is_roomy(part, radius):
    """Whether a disc of this radius can go everywhere but into corners, and no way is cut off for it."""
    if part.area < 1e-6:
        return True
    core = part.buffer(-radius, quad_segs=32)
    return is_whole(core, part) and part.difference(core.buffer((1 + DEPTH) * radius, quad_segs=32)).area < 1e-6


def is_narrow(part, radius):
    """Whether the way of a disc of this radius is cut off somewhere, or more than a corner is out of its reach."""
    if part.area < radius * radius:
        return False
    core = part.buffer(-radius, quad_segs=32)
    if not is_whole(core, part):
        return True
    return any(rest.area > 4 * radius * radius for rest in apart(part.difference(core.buffer(radius, quad_segs=32))))


def is_whole(core, part):
    return core.geom_type == "Polygon" and not core.is_empty and len(core.interiors) == len(part.interiors)


def sides(part):
    corners = part.minimum_rotated_rectangle.exterior.coords
    return math.dist(corners[0], corners[1]), math.dist(corners[1], corners[2])


def path(run):
    return LineString([(p.real, p.imag) for segment in run for p in segment.points()])


def apart(region):
    return [part for part in getattr(region, "geoms", [region]) if part.geom_type == "Polygon"]
