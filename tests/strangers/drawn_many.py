"""Large drawings for docs/benchmarks.md: `drawn_many.py KIND COUNT NAME` writes NAME.svg and NAME.toml.

Kinds: `outline`, one edge of COUNT short lines; `ring`, the same on a ring of 60 mm; `chambers`, COUNT of them side by side, each with a port; `islands`, COUNT in one cushion.
"""
import math
import sys


def ring(count):
    return around(count, 30)


def outline(count):
    return around(count, max(150, count / (2 * math.pi)))


def around(count, r):
    turns = [2 * math.pi * i / count for i in range(count)]
    points = [(1.2 * r + r * (1 + 0.1 * math.sin(5 * a)) * math.cos(a), 1.2 * r + r * (1 + 0.1 * math.sin(5 * a)) * math.sin(a)) for a in turns]
    data = " ".join(f"{x:.6f},{y:.6f}" for x, y in points)
    x, y = points[0]
    return 2.4 * r, 2.4 * r, f'<path id="rim" d="M{data}z"/>', f'<path id="hose" d="M{x - 4},{y} H{x + 4}"/>'


def chambers(count):
    cells, ports = [], []
    for i in range(count // 2):
        y = 10 + 30 * i
        cells += [f'<rect id="left-{i}" x="10" y="{y}" width="40" height="30"/>', f'<rect id="right-{i}" x="50" y="{y}" width="40" height="30"/>']
        ports += [f'<path id="hose-{i}-{x}" d="M{x},{y + 15} H{x + 8}"/>' for x in (6, 86)]
    return 100, 15 * count + 20, "".join(cells), "".join(ports)


def islands(count):
    side = math.ceil(math.sqrt(count))
    size, found = 40 * side + 40, [f'<rect id="rim" x="10" y="10" width="{40 * side + 20}" height="{40 * side + 20}"/>']
    for i in range(count):
        x, y = 40 + 40 * (i % side), 40 + 40 * (i // side)
        corners = [(x + 5 * math.cos(j * math.pi / 4 + 0.1), y + 5 * math.sin(j * math.pi / 4 + 0.1)) for j in range(8)]
        found.append(f'<polygon id="island-{i}" points="{" ".join(f"{a:.4f},{b:.4f}" for a, b in corners)}"/>')
    return size, size, "".join(found), f'<path id="hose" d="M6,{size / 2} H14"/>'


kind, count, name = sys.argv[1:]
width, height, air, port = {"outline": outline, "ring": ring, "chambers": chambers, "islands": islands}[kind](int(count))
with open(f"{name}.svg", "w", encoding="utf-8") as file:
    file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}">')
    file.write(f'<g id="air">{air}</g><g id="port">{port}</g></svg>\n')
with open(f"{name}.toml", "w", encoding="utf-8") as file:
    file.write(f'schema = 1\nname = "{name}"\n[drawing]\nfile = "{name}.svg"\nlayers = {{ air = ["air"], port = ["port"] }}\n[seal]\nspeed = "1 mm/s"\n')
