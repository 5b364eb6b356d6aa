"""Loops of lines, arcs and Beziers in mm, and a random air side made of them. Seeded: one number, one drawing."""
import cmath
import math

import numpy as np
import shapely
from shapely.geometry import Polygon

CHORD = 5e-5  # mm: how far a sampled chord may be from its curve


class Line:
    """From a to b, complex numbers in mm."""

    def __init__(self, a, b):
        self.a, self.b = a, b

    def points(self):
        return [self.a, self.b]

    def moved(self, f):
        return Line(f(self.a), f(self.b))

    def backwards(self):
        return Line(self.b, self.a)

    def cubics(self):
        return [Bezier(self.a, (2 * self.a + self.b) / 3, (self.a + 2 * self.b) / 3, self.b)]


class Arc:
    """Around c from a to b, by `sweep` rad, counterclockwise if positive; below a whole turn."""

    def __init__(self, c, a, sweep):
        self.c, self.a, self.sweep = c, a, sweep
        self.b = c + (a - c) * cmath.exp(1j * sweep)
        self.r = abs(a - c)

    def points(self):
        n = max(4, math.ceil(abs(self.sweep) * math.sqrt(self.r / (8 * CHORD))))
        turns = np.exp(1j * self.sweep * np.arange(n + 1) / n)
        return list(self.c + (self.a - self.c) * turns)

    def moved(self, f):
        return Arc(f(self.c), f(self.a), self.sweep)

    def backwards(self):
        return Arc(self.c, self.b, -self.sweep)

    def parts(self, most):
        """Arcs that turn by `most` rad each, or less."""
        count = math.ceil(abs(self.sweep) / most)
        turn = self.sweep / count
        return [Arc(self.c, self.c + (self.a - self.c) * cmath.exp(1j * turn * k), turn) for k in range(count)]

    def cubics(self):
        """Beziers of a fifth of a radian, whose distance from the arc is below a nanometre."""
        def cubic(arc):
            reach = 4j / 3 * math.tan(arc.sweep / 4)
            return Bezier(arc.a, arc.a + reach * (arc.a - arc.c), arc.b - reach * (arc.b - arc.c), arc.b)
        return [cubic(part) for part in self.parts(0.2)]

    def halves(self):
        first = Arc(self.c, self.a, self.sweep / 2)
        return [first, Arc(self.c, first.b, self.sweep / 2)]


class Bezier:
    """A cubic from a by p and q to b."""

    def __init__(self, a, p, q, b):
        self.a, self.p, self.q, self.b = a, p, q, b

    def points(self):
        bend = max(abs(self.a - 2 * self.p + self.q), abs(self.p - 2 * self.q + self.b))
        n = max(4, math.ceil(math.sqrt(6 * bend / (8 * CHORD))))
        t = np.arange(n + 1) / n
        u = 1 - t
        return list(self.a * u**3 + 3 * self.p * u * u * t + 3 * self.q * u * t * t + self.b * t**3)

    def moved(self, f):
        return Bezier(f(self.a), f(self.p), f(self.q), f(self.b))

    def backwards(self):
        return Bezier(self.b, self.q, self.p, self.a)

    def cubics(self):
        return [self]


def polygon(loop):
    """The region inside a loop of segments, densely sampled."""
    corners = [p for segment in loop for p in segment.points()[:-1]]
    return Polygon([(p.real, p.imag) for p in corners])


def polygonal(corners):
    return [Line(a, b) for a, b in zip(corners, corners[1:] + corners[:1])]


def circle(r):
    return [Arc(0, r, math.pi), Arc(0, -r, math.pi)]


def rounded(w, h, r):
    """A rectangle of w by h around 0 with round corners."""
    loop, x, y = [], w / 2 - r, h / 2 - r
    for k, c in enumerate([complex(x, -y), complex(x, y), complex(-x, y), complex(-x, -y)]):
        arc = Arc(c, c + r * 1j ** (k + 3), math.pi / 2)
        if loop:
            loop.append(Line(loop[-1].b, arc.a))
        loop.append(arc)
    return [*loop, Line(loop[-1].b, loop[0].a)]


def blob(rng, r, count):
    """A smooth closed curve of `count` cubics."""
    at = [r * rng.uniform(0.8, 1.2) * cmath.exp(2j * math.pi * k / count) for k in range(count)]
    way = [(at[(k + 1) % count] - at[k - 1]) / 6 for k in range(count)]
    ring = [(k, (k + 1) % count) for k in range(count)]
    return [Bezier(at[k], at[k] + way[k], at[n] - way[n], at[n]) for k, n in ring]


def toothed(rng, r, count):
    """A star polygon: corners that turn both ways."""
    return polygonal([r * (1 if k % 2 else rng.uniform(0.6, 0.85)) * cmath.exp(1j * math.pi * k / count) for k in range(2 * count)])


def cornered(w, h):
    """An L."""
    return polygonal([0, w, w + 0.45j * h, 0.5 * w + 0.45j * h, 0.5 * w + 1j * h, 1j * h])


def outer(rng):
    size = rng.uniform(50, 110)
    kind = rng.randrange(6)
    if kind == 0:
        return rounded(2 * size, size * rng.uniform(1, 2), rng.uniform(2, 20))
    if kind == 1:
        return circle(size)
    if kind == 2:
        return blob(rng, size, rng.randrange(5, 12))
    if kind == 3:
        return toothed(rng, 1.2 * size, rng.randrange(4, 8))
    if kind == 4:
        return cornered(2.2 * size, 2 * size)
    count = rng.randrange(3, 10)
    return polygonal([size * cmath.exp(2j * math.pi * k / count) for k in range(count)])


def island(rng):
    size = rng.uniform(4, 12)
    kind = rng.randrange(4)
    if kind == 0:
        return circle(size)
    if kind == 1:
        return rounded(2 * size, 1.5 * size, 0.4 * size)
    if kind == 2:
        return blob(rng, size, rng.randrange(4, 7))
    return polygonal([size * cmath.exp(2j * math.pi * k / 3) for k in range(3)])


def motion(turn, by):
    return lambda p: p * cmath.exp(1j * turn) + by


def moved(loop, f):
    return [segment.moved(f) for segment in loop]


def air(rng, islands):
    """Loops of an air side: the outer one, then islands with room for bands and for tubes of 8 mm."""
    rim = moved(outer(rng), motion(rng.uniform(0, 7), 0))
    loops, inside = [rim], polygon(rim)
    for _ in range(40):
        if len(loops) > islands:
            break
        left, low, right, high = inside.bounds
        at = complex(rng.uniform(left, right), rng.uniform(low, high))
        loop = moved(island(rng), motion(rng.uniform(0, 7), at))
        region = polygon(loop)
        if inside.contains(region) and shapely.distance(inside.boundary, region) > 12:
            loops.append(loop)
            inside = inside.difference(region)
    return loops, inside


def middle(loop):
    """A place on the longest segment, no round part along it, and the way along."""
    segment = max(loop, key=lambda s: sum(abs(b - a) for a, b in zip(s.points(), s.points()[1:])))
    points = segment.points()
    if len(points) == 2:
        return points[0] + 0.47 * (points[1] - points[0]), points[1] - points[0]
    k = round(0.47 * len(points))
    return points[k], points[k + 1] - points[k - 1]
