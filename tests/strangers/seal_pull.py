"""The pull on the seal of a computed sheet, from the file that `predict --model shell --vtu FILE` writes.

Usage: python3 tests/strangers/seal_pull.py FILE.vtu BAND_MM PRESSURE_KPA [THICKNESS_MM YOUNG_MPA POISSON]. Needs NumPy.

Each triangle's membrane force and pressure are put on its corners; what is left over across the plane at the rim is what the seal holds.
Bending is left out: it carries a part of the force near the rim, so `seal_pull_N_per_mm` of `predict --model shell` is larger. The pull is
the mean over a piece of rim as long as the band is wide.
"""
import base64
import re
import struct
import sys

import numpy as np


def arrays(path):
    found = {}
    pattern = r'<DataArray type="(\w+)" Name="([^"]+)" NumberOfComponents="(\d)" format="binary">\s*([^<]+)</DataArray>'
    for kind, name, count, text in re.findall(pattern, open(path).read()):
        text = text.strip()
        whole = base64.b64decode(text)
        (length,) = struct.unpack("<Q", whole[:8])
        # The length may be encoded by itself.
        data = whole[8:] if len(whole) == 8 + length else base64.b64decode(text[12:])
        values = np.frombuffer(data, {"Float64": "<f8", "Int64": "<i8", "UInt8": "u1"}[kind])
        found[name] = values.reshape(-1, int(count)) if int(count) > 1 else values
    return found


def main():
    path, band, pressure = sys.argv[1], 1e-3 * float(sys.argv[2]), 1e3 * float(sys.argv[3])
    t, young, nu = [float(x) for x in sys.argv[4:7]] or [0.3, 128.0, 0.39]
    stretch = 1e3 * t * young
    data = arrays(path)
    flat, at = 1e-3 * data["flat, mm"][:, :2], 1e-3 * data["Points"]
    forces, edges = np.zeros_like(at), {}
    for corners in data["connectivity"].reshape(-1, 3):
        a, b, c = flat[corners]
        twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        slopes = np.array([[p[1] - q[1], q[0] - p[0]] for p, q in ((b, c), (c, a), (a, b))]) / twice
        x = at[corners]
        gradient = x.T @ slopes
        strain = (gradient.T @ gradient - np.eye(2)) / 2
        stress = stretch / (1 - nu**2) * ((1 - nu) * strain + nu * np.trace(strain) * np.eye(2))
        ground = 0.5 * ((x[1] - x[0])[0] * (x[2] - x[0])[1] - (x[2] - x[0])[0] * (x[1] - x[0])[1])
        for i in range(3):
            # The pressure force across the plane at a corner is that on a third of the triangle's area on the ground.
            forces[corners[i]] += 0.5 * twice * gradient @ stress @ slopes[i]
            forces[corners[i], 2] -= pressure * ground / 3
            edge = tuple(sorted((corners[i - 1], corners[i - 2])))
            edges[edge] = edges.get(edge, 0) + 1
    length = {}
    for (one, other), count in edges.items():
        if count == 1 and max(abs(at[one, 2]), abs(at[other, 2])) < 1e-12:
            for end in (one, other):
                length[end] = length.get(end, 0.0) + np.linalg.norm(flat[one] - flat[other]) / 2
    rim = np.array(sorted(length))
    lengths, pulls = np.array([length[end] for end in rim]), -forces[rim, 2]
    near = np.linalg.norm(flat[rim][:, None] - flat[rim][None], axis=2) <= band / 2 + 1e-12
    means = (near @ pulls) / (near @ lengths)
    for name, values in (("mean over the band's width", means), ("at the worst point", pulls / lengths)):
        place = values.argmax()
        x, y = 1e3 * flat[rim[place]]
        print(f"{name}: {1e-3 * values[place]:.3f} N/mm at {x:.1f}, {y:.1f} mm")


if __name__ == "__main__":
    main()
