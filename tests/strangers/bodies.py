#!/usr/bin/env python3
"""Reads inflated bodies, STL and OBJ, with trimesh: closed, wound outwards, of the predicted volume, with groups for sheets and seams.

Usage: bodies.py TOOL DIRECTORY. Needs trimesh and NumPy.
"""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import trimesh

tool, out = sys.argv[1], Path(sys.argv[2])
out.mkdir(parents=True, exist_ok=True)


def load(name, pressure):
    folder = Path(name).parent
    text = Path(f"{name}.toml").read_text()
    for drawing in folder.glob("*.svg"):
        (out / drawing.name).write_bytes(drawing.read_bytes())
    for drawing in folder.glob("*.dxf"):
        (out / drawing.name).write_bytes(drawing.read_bytes())
    spec = out / f"{Path(name).name}.toml"
    spec.write_text(text if "[load]" in text else f'{text}\n[load]\npressure = "{pressure}"\n')
    return [spec]


ACTUATOR = ["--tube-width", "20 mm", "--radius", "2 mm", "--arm-length", "80 mm", "--angle", "60 deg", "--pressure", "14 kPa"]
CASES = {
    "star": ["predict", *load("designs/paper-five-points", "37 kPa"), "--model", "shell", "--fineness", "coarse"],
    "pillow": ["predict", *load("designs/drawings/pillow", "10 kPa")],
    "finger": ["predict", *load("designs/drawings/bending-finger", "10 kPa")],
    "actuator": ["actuator", *ACTUATOR, "--model", "shell", "--fineness", "coarse"],
}
for name, command in CASES.items():
    stl, obj = out / f"{name}.stl", out / f"{name}.obj"
    run = [tool, *command, "--json", "--no-cache", "--stl", stl, "--obj", obj]
    answer = json.loads(subprocess.run(run, check=True, capture_output=True, text=True).stdout)
    volume = answer["volume_mm3"]
    if isinstance(volume, dict):
        volume, error = volume["value"], volume["mesh_error"]
    else:
        error = answer["evidence"]["mesh_errors"]["volume_mm3"]
    text = obj.read_text()
    read = {"STL": trimesh.load_mesh(stl), "OBJ": trimesh.load(obj, force="mesh", process=False)}
    for kind, mesh in read.items():
        assert mesh.is_watertight and mesh.is_winding_consistent, f"{name}: {kind} is not closed"
        assert abs(mesh.volume - volume) < 2 * error + 1e-6 * volume, f"{name}: {kind} has {mesh.volume} mm3, predicted are {volume}, {error}"
    assert abs(read["STL"].volume / read["OBJ"].volume - 1) < 1e-5
    # Every edge between the sheets is a line of one seam, and lies in their plane.
    groups = text.split("\ng ")[1:]
    names = [group.split("\n", 1)[0] for group in groups]
    assert names[:2] == ["upper-sheet", "lower-sheet"] and all(group.startswith("seam-") for group in names[2:]) and names[2:], names
    vertices = np.array([line.split()[1:] for line in text.splitlines() if line.startswith("v ")], dtype=float)
    lines = [tuple(map(int, line.split()[1:])) for line in text.splitlines() if line.startswith("l ")]
    assert len(set(map(frozenset, lines))) == len(lines) and np.abs(vertices[np.array(lines) - 1, 2]).max() == 0.0
    faces = [np.array([line.split()[1:] for line in group.splitlines() if line.startswith("f ")], dtype=int) for group in groups[:2]]
    edges = [{frozenset(edge) for triangle in sheet for edge in zip(triangle, np.roll(triangle, 1))} for sheet in faces]
    assert edges[0] & edges[1] == set(map(frozenset, lines)), name
    print(f"{name}: {len(read['STL'].faces)} triangles, {read['STL'].volume:.0f} mm3, predicted {volume:.0f}, mesh error {error:.0f}; {len(names) - 2} seams")
