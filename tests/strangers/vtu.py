#!/usr/bin/env python3
"""Reads the VTU file of a V-actuator with meshio, and compares it with values known without the file."""

import sys

import meshio
import numpy as np

mesh = meshio.read(sys.argv[1])
width = 20.0  # mm, of the tube
(cells,) = mesh.cells
assert cells.type == "triangle", cells.type
points, flat = mesh.points, mesh.point_data["flat, mm"]
data = {name: values[0].reshape(len(cells.data)) for name, values in mesh.cell_data.items()}
assert sorted(data) == [
    "curvature, 1/m",
    "least stretch",
    "least tension, N/m",
    "other curvature, 1/m",
    "stretch",
    "tension, N/m",
], sorted(data)
for name, values in data.items():
    assert np.isfinite(values).all(), name
assert np.isfinite(points).all() and (points[:, 2] > -0.1).all() and (flat[:, 2] == 0).all()
# An inflated tube: sheet W from rim to rim is some W / pi high, and no flat point is further than its arm from the hinge.
assert 0.9 * width / np.pi < points[:, 2].max() < 1.3 * width / np.pi, points[:, 2].max()


def sides(at):
    corners = at[cells.data]
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)


# Each triangle's sides have grown by between its two principal stretches.
grown = sides(points) / sides(flat)
least = np.minimum(data["stretch"], data["least stretch"])
most = np.maximum(data["stretch"], data["least stretch"])
assert (grown.min(axis=1) > least - 1e-9).all() and (grown.max(axis=1) < most + 1e-9).all()
assert (data["tension, N/m"] >= data["least tension, N/m"]).all()
# A straight tube under p = 14 kPa is pulled by p W / pi across.
arm = flat[cells.data].mean(axis=1)[:, 0] < -1.5 * width
typical = np.median(data["tension, N/m"][arm])
assert 0.7 < typical / (14e3 * 1e-3 * width / np.pi) < 1.5, typical
