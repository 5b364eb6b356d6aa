"""Random drawings near the limits of what can be sealed: the program's answer must be the one that shapely gives.

Bands of all sizes, islands and slits near the edge, chambers side by side, walls, and welds of short steps that cross or end on an edge, written with two to
eight decimals: as lines, arcs and Beziers, as Beziers alone, or as short steps. Shapely decides whether tubes and fabric are wide enough,
with a margin on either side in which a drawing is not judged.

Usage: drawn_random.py TOOL DIRECTORY [FIRST LAST [EVERY]]

Drawings FIRST to LAST are checked, and each EVERYth right one is built, verified, and compared with the seams that shapely expects.
Every drawing is made from its number; a complaint names it, so that it can be made again.
"""
import cmath
import math
import os
import random
import re
import subprocess
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor

import ezdxf
import numpy as np
import shapely
import drawn_files
import drawn_loops
import drawn_seams
from drawn_limits import BAND, air_of, path, sealable
from drawn_loops import Arc, Bezier, Line, motion, moved, polygon, polygonal

SIZES = [0.1, 0.3, 1.0, 1.0, 1.0, 3.0, 12.0]  # of all lengths, the band too
HOSE = 4.0  # mm, half the length of a port's line
FAULTS = ["no-port", "port-off-edge", "bow-tie", "crossing-island", "wide-gap"]


class Drawing:
    """Chambers and slits (loops), welds (runs), ports (a, b), all at size 1."""

    def __init__(self, number):
        self.rng = rng = random.Random(number)
        self.loops, self.slits, self.welds, self.walls, self.ports, self.slots, self.fault = [], [], [], [], [], False, None
        # Most drawings have room everywhere; the others come near a limit, or have a fault.
        self.narrow = rng.random() < 0.25
        rng.choice([self.single, self.single, self.row, self.slotted])()
        for _ in range(rng.randrange(4)):
            rng.choice([self.island, self.spot, self.slit, self.weld, self.weld, self.cross, self.tee])()
        if rng.random() < 0.12:
            self.fault = rng.choice(FAULTS)
            getattr(self, self.fault.replace("-", "_"))()

    def width(self, least):
        """A distance above a least one, or about it in a narrow drawing."""
        return least * (self.rng.uniform(0.3, 2) if self.narrow else self.rng.uniform(1.2, 4))

    # What the drawing is made of.

    def single(self):
        loop = moved(drawn_loops.outer(self.rng), motion(self.rng.uniform(0, 7), 0))
        self.loops.append(loop)
        self.port(loop)

    def row(self):
        """Chambers side by side, with fabric or one wall between them."""
        rng, x, height, walls = self.rng, 0.0, self.rng.uniform(40, 90), wall_shape(self.rng)
        gap = 0.0 if rng.random() < 0.4 else self.width(2 * BAND)
        for _ in range(rng.randrange(2, 5)):
            wide = rng.uniform(30, 60)
            left, right = walls(x, height), walls(x + wide, height)
            bottom, top = Line(x + 0j, x + wide + 0j), Line(x + wide + 1j * height, x + 1j * height)
            self.loops.append([bottom, *right, top, *(s.backwards() for s in reversed(left))])
            self.walls += [path(left)] if gap == 0 and x > 0 else []
            middle = x + wide * rng.uniform(0.45, 0.55) + 1j * height
            self.ports.append((middle - 1j * HOSE, middle + 1j * HOSE))
            x += wide + gap

    def slotted(self):
        """A rectangle with slots that open to one side."""
        rng, height, deep, x = self.rng, self.rng.uniform(50, 90), self.rng.uniform(15, 35), 0.0
        corners = [0]
        for _ in range(rng.randrange(1, 4)):
            x += rng.uniform(15, 40)
            wide = self.width(2 * BAND)
            # Shapely knows no rounding, by which a slot may be one band wide.
            wide = BAND if rng.random() < 0.3 or abs(wide - BAND) < 0.2 * BAND else wide
            self.slots = self.slots or wide == BAND
            corners += [x, x + 1j * deep, x + wide + 1j * deep, x + wide]
            x += wide
        x += rng.uniform(15, 40)
        loop = polygonal([complex(p) for p in [*corners, x, x + 1j * height, 1j * height]])
        self.loops.append(loop)
        middle = 0.47 * x + 1j * height
        self.ports.append((middle - 1j * HOSE, middle + 1j * HOSE))

    def port(self, loop):
        at, way = drawn_loops.middle(loop)
        out = -1j * way / abs(way)
        self.ports.append((at - HOSE * out, at + HOSE * out))

    def place(self, region, room):
        """A motion that brings a region into the air, at least so far from all that is there."""
        air, there = air_of(self), self.lines()
        left, low, right, high = air.bounds
        for _ in range(60):
            turn, at = self.rng.choice([0, self.rng.uniform(0, 7)]), complex(self.rng.uniform(left, right), self.rng.uniform(low, high))
            move = motion(turn, at)
            shape = shapely.transform(region, lambda p: np.column_stack([(q := move(p[:, 0] + 1j * p[:, 1])).real, q.imag]))
            if air.contains(shape) and shapely.distance(there, shape) > room:
                return move
        return None

    def add_island(self, loop, room):
        if move := self.place(polygon(loop), room):
            self.loops.append(moved(loop, move))

    def island(self):
        self.add_island(drawn_loops.island(self.rng), self.width(2 * BAND))

    def spot(self):
        self.add_island(drawn_loops.circle(self.rng.uniform(0.6, 3)), self.width(2 * BAND))

    def slit(self):
        """An island exactly one band wide."""
        long = self.rng.uniform(10, 30)
        loop = drawn_loops.rounded(long, BAND, 0.999999 * BAND / 2) if self.rng.random() < 0.5 else polygonal([0j, long + 0j, long + BAND * 1j, BAND * 1j])
        if move := self.place(polygon(loop), self.width(2 * BAND)):
            self.slits.append(moved(loop, move))

    def weld(self):
        rng, long = self.rng, self.rng.uniform(8, 30)
        a, b = 0j, complex(long)
        bend = long * complex(0.3, rng.uniform(-0.4, 0.4))
        run = rng.choice([
            [Line(a, b)],
            [Bezier(a, bend, b - bend.conjugate(), b)],
            [Arc(long / 2 - 1j * long, a, -2 * math.atan(0.5))],
            [Line(a, 0.5 * b + 4j), Line(0.5 * b + 4j, b)],
        ])
        self.add_weld([run])

    def cross(self):
        long, turn = self.rng.uniform(12, 25), cmath.exp(1j * self.rng.uniform(1, 2.1))
        self.add_weld([[Line(complex(-long), complex(long))], [Line(-long * turn, long * turn)]])

    def tee(self):
        """A weld that ends on the edge of the air, square to it."""
        segment = self.rng.choice(self.rng.choice(self.loops))
        if not isinstance(segment, Line):
            return  # short steps miss the end on a curve
        at, way = (segment.a + segment.b) / 2, segment.b - segment.a
        inwards = 1j * way / abs(way)
        if not air_of(self).contains(shapely.points((at + 0.5 * inwards).real, (at + 0.5 * inwards).imag)):
            inwards = -inwards
        self.welds.append([Line(at, at + self.rng.uniform(6, 20) * inwards)])

    def add_weld(self, runs):
        if move := self.place(shapely.union_all([path(run) for run in runs]).buffer(BAND / 2), self.width(2 * BAND)):
            self.welds += [moved(run, move) for run in runs]

    # Faults that must be refused whatever the rest is.

    def no_port(self):
        self.ports.pop(self.rng.randrange(len(self.ports)))

    def port_off_edge(self):
        self.ports.append((-400j - 1, -400j + 1))

    def bow_tie(self):
        right = air_of(self).bounds[2] + 60
        self.loops.append(polygonal([complex(right), right + 50 + 40j, right + 50 + 0j, right + 40j]))

    def crossing_island(self):
        a, b = self.ports[0]
        self.loops.append(moved(drawn_loops.circle(12), motion(0, (a + b) / 2 + 3)))

    def wide_gap(self):
        """One loop loses a part far from its hose."""
        a, b = self.ports[0]
        loop = polygonal([p + (a + b) / 2 + 300 for p in (0j, 60 + 0j, 60 + 40j, 40j)])
        end = loop[-1].a + 0.8 * (loop[-1].b - loop[-1].a)
        self.loops.append([*loop[:-1], Line(loop[-1].a, end)])
        self.ports.append((loop[1].a + 20j - HOSE, loop[1].a + 20j + HOSE))

    def lines(self):
        return shapely.union_all([polygon(loop).boundary for loop in self.loops + self.slits] + [path(run) for run in self.welds])


def wall_shape(rng):
    """A function of x and height that makes walls of one shape, from below to above."""
    kind, sway, turns = rng.randrange(4), rng.uniform(-8, 8), rng.randrange(2, 5)

    def wall(x, height):
        a, b = complex(x), complex(x, height)
        if kind == 0:
            return [Line(a, b)]
        if kind == 1:
            return [Bezier(a, a + sway + 0.3j * height, b + sway - 0.3j * height, b)]
        if kind == 2:
            corners = [a + (sway if k % 2 else 0) + 1j * height * k / (2 * turns) for k in range(2 * turns + 1)]
            return [Line(p, q) for p, q in zip(corners, corners[1:])]
        return Arc(a + height * (0.5j + 1), a, -2 * math.atan(0.5)).halves() if abs(a + height * (0.5j + 1) - b) > 0 else []

    return wall


# The files.

def steps(segment, step, limit):
    """A segment as lines of about a step each."""
    points = segment.points()
    lengths = np.cumsum([0.0] + [abs(q - p) for p, q in zip(points, points[1:])])
    count = max(1, min(limit, round(lengths[-1] / step)))
    places = [complex(np.interp(s, lengths, np.real(points)), np.interp(s, lengths, np.imag(points))) for s in np.linspace(0, lengths[-1], count + 1)]
    places[0], places[-1] = segment.a, segment.b
    return [Line(p, q) for p, q in zip(places, places[1:])]


def formed(run, form, step):
    if form == "cubic":
        return [cubic for segment in run for cubic in segment.cubics()]
    if form == "steps":
        return [line for segment in run for line in steps(segment, step, 400)]
    return [part for segment in run for part in (segment.parts(1.6) if isinstance(segment, Arc) else [segment])]


def rounded(segment, decimals):
    """A segment whose ends, and the middle or handles of a curve, have so many decimals."""
    def f(p):
        return complex(round(p.real, decimals), round(p.imag, decimals))
    if not isinstance(segment, Arc):
        return segment.moved(f)
    # By ends and the rounded radius, as an SVG has arcs.
    a, b, r = f(segment.a), f(segment.b), round(segment.r, decimals)
    half = abs(b - a) / 2
    if half < 1e-9:
        return Line(a, b)
    high = math.sqrt(max(r * r - half * half, 0.0)) * (1 if segment.sweep > 0 else -1)
    return Arc((a + b) / 2 + high * 1j * (b - a) / abs(b - a), a, math.copysign(2 * math.asin(min(1.0, half / r)), segment.sweep))


def written(number, folder):
    """A drawing by its number, its spec as a file, and its curves (layer, loop, closed) as they are written, with the decimals."""
    made = Drawing(number)
    rng = random.Random(-number - 1)
    size, form = rng.choice(SIZES), rng.choice(["exact", "exact", "cubic", "steps"])
    decimals = rng.randrange(2 if size >= 1 else 3 if size > 0.2 else 4, 9)
    step = max(rng.uniform(0.05, 0.6) * size, 4 * 10.0**-decimals)
    name, ending = f"random-{number}", rng.choice(["svg", "dxf"])
    curves = []
    for layer, runs, closed in (("air", made.loops + made.slits, True), ("seam", made.welds, False)):
        for run in runs:
            exact = moved(run, lambda p: p * size)
            open_gap = made.fault == "wide-gap" and layer == "air" and abs(run[-1].b - run[0].a) > 1
            curves.append((layer, [rounded(s, decimals) for s in formed(exact, form, step)], closed and not open_gap))
    ports = [(a * size, b * size) for a, b in made.ports]
    file = os.path.join(folder, f"{name}.{ending}")
    (as_svg if ending == "svg" else as_dxf)(file, curves, ports, decimals, rng)
    layers = [f'{role} = ["{role}"]' for role in ("air", "port", "seam") if role == "air" or (ports if role == "port" else made.welds)]
    with open(spec := os.path.join(folder, f"{name}.toml"), "w", encoding="utf-8") as text:
        text.write(f'schema = 1\nname = "{name}"\n[drawing]\nfile = "{name}.{ending}"\njoin = "{0.02 * min(size, 1):g} mm"\nlayers = {{ {", ".join(layers)} }}\n')
        text.write(f'[inlet]\ntube_diameter = "{4 * size:g} mm"\n[seal]\nspeed = "1 mm/s"\nband = "{BAND * size:g} mm"\nallowance = "{8 * size:g} mm"\noverlap = "{2 * size:g} mm"\nheight = "{-0.2 * min(size, 1):g} mm"\n')
        text.write(f'[sheet]\nhole_diameter = "0 mm"\n')
    return made, spec, curves, size, decimals, form, step


def as_svg(file, curves, ports, decimals, rng):
    places = [p for _, run, _ in curves for s in run for p in (s.a, s.b)]
    left, high = min(p.real for p in places) - 60, max(p.imag for p in places) + 60
    size = (max(p.real for p in places) - left + 60, high - min(p.imag for p in places) + 60)
    shift = complex(round(left), round(high))

    def pair(p):
        return f"{p.real - shift.real:.{decimals}f},{shift.imag - p.imag:.{decimals}f}"

    def command(s):
        if isinstance(s, Line):
            return "L" + pair(s.b)
        if isinstance(s, Arc):
            return f"A{s.r:.{decimals}f} {s.r:.{decimals}f} 0 {int(abs(s.sweep) > math.pi)} {int(s.sweep < 0)} {pair(s.b)}"
        return "C" + " ".join(map(pair, (s.p, s.q, s.b)))

    texts = {"air": [], "seam": [], "port": [f'<path d="M{pair(a)}L{pair(b)}"/>' for a, b in ports]}
    for k, (layer, run, closed) in enumerate(curves):
        last = run[:-1] if closed and isinstance(run[-1], Line) and rng.random() < 0.5 else run
        texts[layer].append(f'<path id="c{k}" d="M{pair(run[0].a)}{"".join(map(command, last))}{"Z" if closed else ""}"/>')
    groups = "\n".join(f'<g id="{layer}" fill="none" stroke="black">{"".join(paths)}</g>' for layer, paths in texts.items())
    with open(file, "w", encoding="utf-8") as text:
        text.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{size[0]:.0f}mm" height="{size[1]:.0f}mm" viewBox="0 0 {size[0]:.0f} {size[1]:.0f}">\n{groups}\n</svg>\n')


def as_dxf(file, curves, ports, decimals, rng):
    doc = ezdxf.new("R2000")
    doc.header["$INSUNITS"] = 4
    for layer, run, closed in curves:
        drawn_files.entities(rng, doc.modelspace(), run, closed, {"layer": layer})
    for a, b in ports:
        doc.modelspace().add_line((a.real, a.imag), (b.real, b.imag), {"layer": "port"})
    doc.saveas(file)


def complaint(tool, folder, number, every):
    """The kind of a drawing, and the fault of the answer to it, or None."""
    made, spec, curves, size, decimals, form, step = written(number, folder)
    want = sealable(made)
    # Rounding turns short steps, and their parallels by as much of half a band; beside slots it has to stay well below `join`.
    if want and form == "steps" and (made.slits or made.slots) and 10.0**-decimals / step * BAND * size > 0.01 * min(size, 1):
        want = None
    kind = f"{'right' if want else 'undecided' if want is None else made.fault or 'narrow'}"
    try:
        run = subprocess.run(["nice", tool, "check", spec, "-q"], capture_output=True, text=True, timeout=60)
    except subprocess.TimeoutExpired:
        return kind, f"{spec}: more than 60 s"
    codes = sorted(set(re.findall(r"error\[([a-z-]+)\]", run.stderr)))
    if "fault of this program" in run.stderr or run.returncode not in (0, 1):
        return kind, f"{spec}: {form} {decimals} x{size} fault of the program: {run.stderr[:400]}"
    if want and run.returncode != 0:
        return kind, f"{spec}: {form} {decimals} x{size} right, refused for {codes}: {run.stderr[:300]}"
    if want is False and run.returncode == 0:
        return kind, f"{spec}: {form} {decimals} x{size} taken in spite of {kind}"
    if want and every and number % every == 0:
        return kind + " built", built(tool, spec, made, curves, size, decimals)
    return kind, None


def built(tool, spec, made, curves, size, decimals):
    """The fault of a build of a right drawing, or None."""
    directory = spec.removesuffix(".toml")
    for arguments in (["build", spec, "-q", "-o", directory], ["verify", directory, "-q"]):
        run = subprocess.run(["nice", tool, *arguments], capture_output=True, text=True, timeout=120)
        if run.returncode != 0:
            return f"{spec}: {arguments[0]} fails: {run.stderr[:400]}"
    regions = [polygon(run) for layer, run, _ in curves if layer == "air"]
    air = regions[0]
    for region in regions[1:]:
        if not air.contains(region):
            return None  # several chambers may be several pieces, which are moved apart
        air = air.difference(region)
    if made.slits or made.slots:
        return None  # sealed once, along their middle
    drawn_seams.AT_PORT, drawn_seams.NEAR_PORT, drawn_seams.STEP = 20 * size + 5, 8 * size, size
    want = shapely.union_all([air.buffer(BAND * size / 2, quad_segs=400).boundary, *(path(run) for layer, run, _ in curves if layer == "seam")])
    # Arcs of some metres in an SVG are too much for svgelements.
    far = drawn_seams.off(drawn_seams.runs_of_dxf(os.path.join(directory, "sheet-1-seal.dxf")), want, [(a + b) / 2 * size for a, b in made.ports])
    bound = drawn_seams.TOLERANCE + 5 * 10.0**-decimals
    return None if far <= bound else f"{spec}: a seam is {far:.6f} mm beside the one expected, {bound} mm are allowed"


def main():
    tool, folder = sys.argv[1:3]
    first, last, every = map(int, [*sys.argv[3:], *("0", "100", "10")[len(sys.argv) - 3:]])
    os.makedirs(folder, exist_ok=True)
    numbers = range(first, last)
    with ProcessPoolExecutor(int(os.environ.get("PROCESSES", "2"))) as pool:
        answers = list(pool.map(complaint, [tool] * len(numbers), [folder] * len(numbers), numbers, [every] * len(numbers), chunksize=4))
    complaints = [text for _, text in answers if text]
    print(f"random drawings: {dict(Counter(kind for kind, _ in answers))}")
    if complaints:
        sys.exit("\n".join(complaints))


if __name__ == "__main__":
    main()
