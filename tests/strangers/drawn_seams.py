"""Seams of a build beside those that shapely expects: the boundary of the air, widened by half a band."""
import cmath
import math
import os

import ezdxf
import numpy as np
import shapely

from drawn_loops import CHORD

BAND = 2.0  # mm, the default of [seal]
TOLERANCE = 0.0015 + 1e-4  # mm: the default of [accuracy] path, half of it for curves as they are read, and the sampling here
AT_PORT = 20.0  # mm: so far from a port a seam leads along its channel
NEAR_PORT = 8.0  # mm: so far from a port the edge may be missing
STEP = 1.0  # mm between the places that are compared


def expected(air):
    """The seams of an air side without ports, as lines."""
    return air.buffer(BAND / 2, quad_segs=100).boundary


def along(a, b):
    n = max(1, math.ceil(abs(b - a) / STEP))
    return [a + (b - a) * k / n for k in range(n + 1)]


def around(center, a, sweep):
    n = max(2, math.ceil(abs(sweep) * math.sqrt(abs(a - center) / (8 * CHORD))))
    return [center + (a - center) * cmath.exp(1j * sweep * k / n) for k in range(n + 1)]


def runs_of_dxf(path):
    """Every segment of the layer `seal` as sampled points."""
    shapes = []
    for entity in ezdxf.readfile(path).modelspace().query('*[layer=="seal"]'):
        shapes += entity.virtual_entities() if entity.dxftype() == "LWPOLYLINE" else [entity]
    for shape in shapes:
        if shape.dxftype() == "LINE":
            yield along(complex(*shape.dxf.start.vec2), complex(*shape.dxf.end.vec2))
        elif shape.dxftype() == "CIRCLE":
            center = complex(*shape.dxf.center.vec2)
            yield around(center, center + shape.dxf.radius, 2 * math.pi)
        else:
            start, end = math.radians(shape.dxf.start_angle), math.radians(shape.dxf.end_angle)
            center = complex(*shape.dxf.center.vec2)
            yield around(center, center + shape.dxf.radius * cmath.exp(1j * start), (end - start) % (2 * math.pi))


def runs_of_svg(path):
    """The same of the SVG, by svgelements; Y up."""
    import svgelements as se

    drawing = se.SVG.parse(path, ppi=25.4)
    up = lambda p: complex(p.x, drawing.height - p.y)
    for shape in drawing.elements(lambda e: isinstance(e, se.Path) and e.stroke.hex == "#0000ff"):
        for segment in shape:
            if isinstance(segment, (se.Line, se.Close)):
                yield along(up(segment.start), up(segment.end))
            elif isinstance(segment, se.Arc):
                yield around(up(segment.center), up(segment.start), -segment.sweep)


def off(runs, want, ports):
    """The distance of the seams from the expected ones, both ways, mm. A build moves its piece, so the boxes are aligned at their corners."""
    runs = [np.array(run) for run in runs]
    got = np.concatenate(runs)
    left, low, right, high = want.bounds
    best = math.inf
    for shift in (
        complex(x, y)
        for x in (left - got.real.min(), right - got.real.max())
        for y in (low - got.imag.min(), high - got.imag.max())
    ):
        best = min(best, off_by(runs, want, ports, shift, best))
    return best


def off_by(runs, want, ports, shift, best):
    got = np.concatenate(runs) + shift
    ports = np.array(ports)

    def far(points, reach):
        return points[np.abs(points[:, None] - ports[None, :]).min(axis=1) > reach] if len(ports) else points

    def distance(points, lines):
        tree = shapely.STRtree(lines)
        _, found = tree.query_nearest(shapely.points(points.real, points.imag), return_distance=True, all_matches=False)
        return found.max() if len(found) else math.inf

    pieces = pairs([np.array([complex(*p) for p in part.coords]) for part in parts(want)])
    probes = far(got, AT_PORT)
    # A few places decide whether the shift is the right one.
    if distance(probes[:: max(1, len(probes) // 50)], pieces) >= max(best, 1.0):
        return math.inf
    there = distance(probes, pieces)
    back = np.concatenate([spread(part) for part in parts(want)])
    return max(there, distance(far(back, NEAR_PORT), pairs([run + shift for run in runs])))


def spread(line):
    """Places along a line: its corners, and more where they are far apart."""
    corners = shapely.get_coordinates(shapely.segmentize(line, STEP))
    return corners[:, 0] + 1j * corners[:, 1]


def parts(lines):
    return lines.geoms if hasattr(lines, "geoms") else [lines]


def pairs(runs):
    ends = np.concatenate([np.stack([run[:-1], run[1:]], axis=1) for run in runs])
    return shapely.linestrings(np.stack([ends.real, ends.imag], axis=2))


def worst(directory, air, ports, more=()):
    """The same of both files of a build; `more` are welds and walls, drawn as they are sealed."""
    want = shapely.union_all([expected(air), *more])
    dxf, svg = (os.path.join(directory, f"sheet-1-seal.{ending}") for ending in ("dxf", "svg"))
    return max(off(runs_of_dxf(dxf), want, ports), off(runs_of_svg(svg), want, ports))
