"""Drawings as files: SVG written here, in all its equivalent forms, and DXF by ezdxf. Chosen by a seeded `rng`."""
import cmath
import math

import ezdxf

from drawn_loops import Arc, Bezier, Line

PER_UNIT = {"mm": 1.0, "cm": 10.0, "in": 25.4}
INSUNITS = {"mm": 4, "cm": 5, "in": 1}


def number(x):
    return f"{x:.9f}".rstrip("0").rstrip(".") or "0"


def pair(p):
    return f"{number(p.real)},{number(p.imag)}"


def path_data(loop, closed, relative):
    """A loop as commands, absolute or relative. Coordinates are written to 1e-9, so relative ones do not drift."""
    at, out = loop[0].a, ["M" + pair(loop[0].a)]
    # An arc is written by its ends and its radius. Of half a circle they leave the centre open by the root of their rounding: 0.002 mm.
    for segment in (part for whole in loop for part in (whole.halves() if isinstance(whole, Arc) and abs(whole.sweep) > 2.5 else [whole])):
        base = at if relative else 0
        case = str.lower if relative else str.upper
        if isinstance(segment, Line):
            out.append(case("l") + pair(segment.b - base))
        elif isinstance(segment, Arc):
            r, large, turn = number(segment.r), int(abs(segment.sweep) > math.pi), int(segment.sweep > 0)
            out.append(f"{case('a')}{r} {r} 0 {large} {turn} {pair(segment.b - base)}")
        else:
            out.append(case("c") + " ".join(pair(p - base) for p in (segment.p, segment.q, segment.b)))
        at = segment.b
    return " ".join(out) + (" Z" if closed else "")


def element(rng, name, loop, closed):
    corners = [segment.a for segment in loop] + ([] if closed else [loop[-1].b])
    if all(isinstance(segment, Line) for segment in loop) and rng.random() < 0.4:
        points = " ".join(map(pair, corners))
        return f'<{"polygon" if closed else "polyline"} id="{name}" points="{points}" fill="none" stroke="black"/>'
    if closed and all(isinstance(segment, Arc) and segment.c == loop[0].c for segment in loop) and rng.random() < 0.5:
        c = loop[0].c
        return f'<circle id="{name}" cx="{number(c.real)}" cy="{number(c.imag)}" r="{number(loop[0].r)}"/>'
    return f'<path id="{name}" d="{path_data(loop, closed, rng.random() < 0.5)}"/>'


def svg(rng, curves, ports, size):
    """The text of an SVG of `curves` (layer, name, loop, closed) and `ports` (name, a, b) on a page of `size` mm."""
    unit = rng.choice(list(PER_UNIT))
    per = PER_UNIT[unit] * rng.choice([1.0, 25.4 / 96, 0.5])
    width, height = size
    layers = {}
    lines = [("port", name, [Line(a, b)], False) for name, a, b in ports]
    for layer, name, loop, closed in [*curves, *lines]:
        # Down the page, and back through a turn, a scale and a shift of the group.
        turn, scale, by = rng.choice([0, rng.uniform(-3, 3)]), rng.choice([1, rng.uniform(0.2, 3)]), complex(rng.randrange(-9, 9), 3)
        local = [mirrored(segment, height, per, turn, scale, by) for segment in loop]
        degrees = number(math.degrees(turn))
        how = f"translate({pair(by)}) rotate({degrees}) scale({number(scale)})"
        if rng.random() < 0.3:
            a = scale * cmath.exp(1j * turn)
            how = "matrix({!r} {!r} {!r} {!r} {!r} {!r})".format(a.real, a.imag, -a.imag, a.real, by.real, by.imag)
        text = f'<g transform="{how}">{element(rng, name, local, closed)}</g>'
        if rng.random() < 0.15:
            text = f'<defs><g id="{name}-kept">{text}</g></defs><use href="#{name}-kept"/>'
        layers.setdefault(layer, []).append(text)
    groups = "\n".join(f'<g id="{layer}">\n' + "\n".join(texts) + "\n</g>" for layer, texts in layers.items())
    box = f"0 0 {number(width / per)} {number(height / per)}"
    sides = [f"{number(side / PER_UNIT[unit])}{unit}" for side in size]
    return f'<svg xmlns="http://www.w3.org/2000/svg" width="{sides[0]}" height="{sides[1]}" viewBox="{box}">\n{groups}\n</svg>\n'


def rounded_svg(curves, ports, size, decimals, all_cubic):
    """The text of an SVG in mm whose numbers have so many `decimals`: of Beziers alone, or of lines, quarters of circles and Beziers."""
    def rounded(p):
        return f"{p.real:.{decimals}f} {size[1] - p.imag:.{decimals}f}"

    def command(segment):
        if isinstance(segment, Line):
            return "L" + rounded(segment.b)
        if isinstance(segment, Arc):
            return f"A {segment.r:.{decimals}f} {segment.r:.{decimals}f} 0 0 {int(segment.sweep < 0)} {rounded(segment.b)}"
        return "C" + " ".join(map(rounded, (segment.p, segment.q, segment.b)))

    def parts(segment):
        if all_cubic:
            return segment.cubics()
        return segment.parts(1.6) if isinstance(segment, Arc) else [segment]

    texts = {}
    for layer, name, loop, closed in [*curves, *(("port", name, [Line(a, b)], False) for name, a, b in ports)]:
        data = "M" + rounded(loop[0].a) + "".join(command(part) for segment in loop for part in parts(segment))
        texts.setdefault(layer, []).append(f'<path id="{name}" d="{data}{"Z" if closed else ""}"/>')
    groups = "".join(f'<g id="{layer}" fill="none" stroke="black">{"".join(paths)}</g>' for layer, paths in texts.items())
    return f'<svg xmlns="http://www.w3.org/2000/svg" width="{size[0]}mm" height="{size[1]}mm" viewBox="0 0 {size[0]} {size[1]}">{groups}</svg>\n'


def mirrored(segment, height, per, turn, scale, by):
    """A segment as it has to be written: Y down, before the group's transform."""
    def f(p):
        return ((complex(p.real, height - p.imag) / per) - by) * cmath.exp(-1j * turn) / scale
    if isinstance(segment, Arc):
        return Arc(f(segment.c), f(segment.a), -segment.sweep)
    return segment.moved(f)


def dxf(rng, curves, ports, path):
    """Writes a DXF of `curves` and `ports` at `path`, and returns its version: R12 has polylines and arcs only, and no unit."""
    old = rng.random() < 0.25 and not any(isinstance(s, Bezier) for _, _, loop, _ in curves for s in loop)
    unit = "mm" if old else rng.choice(list(INSUNITS))
    version = "R12" if old else rng.choice(["R2000", "R2010", "R2018"])
    doc = ezdxf.new(version)
    if not old:
        doc.header["$INSUNITS"] = INSUNITS[unit]
    page = doc.modelspace()
    for k, (layer, _, loop, closed) in enumerate(curves):
        turn, scale, by = (rng.uniform(-3, 3), rng.uniform(0.3, 3), complex(7, -5)) if rng.random() < 0.25 else (0, 1, 0)
        local = [s.moved(lambda p: (p / PER_UNIT[unit] - by) * cmath.exp(-1j * turn) / scale) for s in loop]
        room = page
        if (turn, scale, by) != (0, 1, 0):
            room = doc.blocks.new(f"part{k}")
            page.add_blockref(
                f"part{k}", (by.real, by.imag), {"layer": layer, "xscale": scale, "yscale": scale, "zscale": scale, "rotation": math.degrees(turn)}
            )
        entities(rng, room, local, closed, {"layer": layer})
    for _, a, b in ports:
        a, b = a / PER_UNIT[unit], b / PER_UNIT[unit]
        if rng.random() < 0.3:
            page.add_point(((a + b).real / 2, (a + b).imag / 2), {"layer": "port"})
        else:
            page.add_line((a.real, a.imag), (b.real, b.imag), {"layer": "port"})
    doc.saveas(path)
    return version


def entities(rng, room, loop, closed, attribs):
    if not any(isinstance(s, Bezier) for s in loop) and rng.random() < 0.6:
        corners = [(s.a.real, s.a.imag, math.tan(s.sweep / 4) if isinstance(s, Arc) else 0.0) for s in loop]
        if not closed:
            corners.append((loop[-1].b.real, loop[-1].b.imag, 0.0))
        if room.doc.dxfversion == "AC1009":
            room.add_polyline2d(corners, format="xyb", close=closed, dxfattribs=attribs)
            return
        if rng.random() < 0.3:
            # Seen from below: mirrored in its own frame.
            back = [(-x, y, -bulge) for x, y, bulge in corners]
            room.add_lwpolyline(back, format="xyb", close=closed, dxfattribs={**attribs, "extrusion": (0, 0, -1)})
        else:
            room.add_lwpolyline(corners, format="xyb", close=closed, dxfattribs=attribs)
        return
    for segment in rng.sample(loop, len(loop)):
        if rng.random() < 0.5:
            segment = segment.backwards()
        a, b = segment.a, segment.b
        if isinstance(segment, Line):
            room.add_line((a.real, a.imag), (b.real, b.imag), attribs)
        elif isinstance(segment, Arc):
            arc(rng, room, segment, attribs)
        else:
            control = [(p.real, p.imag, 0) for p in (a, segment.p, segment.q, b)]
            room.add_open_spline(control, 3, dxfattribs=attribs)


def arc(rng, room, segment, attribs):
    first, last = (segment.a, segment.b) if segment.sweep > 0 else (segment.b, segment.a)
    c = (segment.c.real, segment.c.imag)
    angles = [cmath.phase(p - segment.c) for p in (first, last)]
    if room.doc.dxfversion != "AC1009" and rng.random() < 0.3:
        # A circle is an ellipse, too.
        room.add_ellipse(c, (segment.r, 0, 0), 1.0, *angles, dxfattribs=attribs)
    else:
        room.add_arc(c, segment.r, *map(math.degrees, angles), dxfattribs=attribs)
