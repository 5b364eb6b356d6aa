"""Exact extents of lines and arcs of a DXF: ezdxf's own boxes are those of chords, or of curves' control points."""
import math

import ezdxf


def arc_extremes(arc):
    """The ends of an arc and the points of its circle farthest left, right, up, down, as far as it has them."""
    center, radius = arc.dxf.center, arc.dxf.radius
    start, sweep = arc.dxf.start_angle, (arc.dxf.end_angle - arc.dxf.start_angle) % 360.0
    angles = [start, start + sweep] + [a for a in (0, 90, 180, 270) if (a - start) % 360.0 <= sweep]
    return [(center.x + radius * math.cos(math.radians(a)), center.y + radius * math.sin(math.radians(a))) for a in angles]


def extremes(shape):
    """Points of a shape with the same box as all of it."""
    kind = shape.dxftype()
    if kind == "LWPOLYLINE":
        return [p for part in shape.virtual_entities() for p in extremes(part)]
    if kind == "ARC":
        return arc_extremes(shape)
    if kind == "CIRCLE":
        (x, y, _), r = shape.dxf.center, shape.dxf.radius
        return [(x - r, y), (x + r, y), (x, y - r), (x, y + r)]
    return [(p.x, p.y) for p in (shape.dxf.start, shape.dxf.end)]


def box(points):
    """(left, bottom, right, top) of points."""
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return (min(xs), min(ys), max(xs), max(ys))


def shapes(dxf):
    """(layer, box) of every shape, mm."""
    return [(shape.dxf.layer, box(extremes(shape))) for shape in ezdxf.readfile(dxf).modelspace()]


def union(boxes):
    """The box around boxes."""
    return box([corner for b in boxes for corner in (b[:2], b[2:])])
