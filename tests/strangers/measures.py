#!/usr/bin/env python3
"""Compares the measures of a drawing with those that an independent reading of its VTU file gives.

Usage: measures.py TOOL DIRECTORY. Needs meshio and NumPy.
"""

import json
import subprocess
import sys
from pathlib import Path

import meshio
import numpy as np

tool, out = sys.argv[1], Path(sys.argv[2])
out.mkdir(parents=True, exist_ok=True)
# Y counts upwards from the bottom of the page of 100 mm.
points = {"a": (45.0, 60.5), "b": (121.25, 38.0), "c": (82.0, 71.5)}
svg = lambda name: "{} {}".format(points[name][0], 100 - points[name][1])
(out / "pouch.svg").write_text(
    f"""<svg xmlns="http://www.w3.org/2000/svg" width="160mm" height="100mm" viewBox="0 0 160 100">
<g id="air"><rect x="30" y="20" width="100" height="60"/></g><g id="port"><path d="M26 50H34"/></g>
<g id="m"><path id="line" d="M {svg('a')} L {svg('b')}"/><path id="corner" d="M {svg('a')} L {svg('c')} L {svg('b')}"/>
<path id="curve" d="M 45 50 Q 80 25 120 55"/><circle id="mark" cx="{points['c'][0]}" cy="{100 - points['c'][1]}" r="1"/></g></svg>"""
)
(out / "pouch.toml").write_text(
    'schema = 1\nname = "pouch"\n[drawing]\nfile = "pouch.svg"\nlayers = { air = ["air"], port = ["port"], measure = ["m"] }\n'
    '[load]\npressure = "1 kPa"\n'
)
sheet = out / "pouch.vtu"
run = [tool, "predict", out / "pouch.toml", "--json", "--no-cache", "--vtu", sheet]
answer = json.loads(subprocess.run(run, check=True, capture_output=True, text=True).stdout)
measures = {one["measure"]: one for one in answer["measures"]}

mesh = meshio.read(sheet)
(cells,) = mesh.cells
flat, inflated = mesh.point_data["flat, mm"][:, :2], mesh.points


def position(place):
    """The inflated place of a flat one, by the triangle that holds it."""
    corners = flat[cells.data]
    edges = (corners[:, 1:] - corners[:, :1]).transpose(0, 2, 1)
    weights = np.linalg.solve(edges, (np.array(place) - corners[:, 0])[:, :, None])[:, :, 0]
    weights = np.column_stack([1 - weights.sum(axis=1), weights])
    triangle = weights.min(axis=1).argmax()
    assert weights[triangle].min() > -1e-9, place
    return weights[triangle] @ inflated[cells.data[triangle]]


def agrees(measure, quantity, wanted):
    finest = measures[measure][quantity]["finest_mesh"]
    assert abs(finest - wanted) < 1e-9 * abs(wanted), (measure, quantity, finest, wanted)


a, b, c = (position(points[name]) for name in "abc")
agrees("line", "distance_mm", np.linalg.norm(b - a))
agrees("line", "direction_deg", np.degrees(np.arctan2(b[1] - a[1], b[0] - a[0])))
to_a, to_b = (a - c)[:2], (b - c)[:2]
cosine = to_a @ to_b / np.linalg.norm(to_a) / np.linalg.norm(to_b)
agrees("corner", "angle_deg", np.degrees(np.arccos(cosine)))
agrees("mark", "x_mm", c[0])
agrees("mark", "y_mm", c[1])
agrees("mark", "height_mm", 2 * c[2])
assert measures["curve"]["radius_mm"]["inflated"]["value"] > 0
