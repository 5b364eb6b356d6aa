#!/usr/bin/env python3
"""Runs the models of star grippers in MuJoCo, and compares them with the predictions.

Each model is read without a warning and comes to rest. On its object every star presses with a force in its predicted range, and without it
closes to a radius in its predicted range. Prints both, and forces on objects of other radii, which need not be in their ranges.

Usage: mujoco_star.py TOOL DIRECTORY. Needs mujoco and NumPy.
"""

import json
import subprocess
import sys
import warnings
from pathlib import Path

import mujoco
import numpy as np

warnings.simplefilter("error")
tool, out = sys.argv[1], Path(sys.argv[2])
out.mkdir(parents=True, exist_ok=True)
LOAD = '\n[load]\npressure = "{}"\nobject_radius = "36 mm"\nobject_height = "150 mm"\nobject_shape = "cylinder"\nfriction = 0.5\n'
BALL = '\n[stack]\ncount = 3\npitch = "25 mm"\n[load]\npressure = "37 kPa"\nobject_radius = "40 mm"\n'
CASES = {
    "paper-gripper": ("paper-gripper", ""),
    "paper-five-points": ("paper-five-points", LOAD.format("37 kPa")),
    "paper-four-points": ("paper-four-points", LOAD.format("20 kPa")),
    "paper-six-points": ("paper-six-points", LOAD.format("37 kPa")),
    "round-hinges": ("round-hinges", LOAD.format("37 kPa")),
    "ball": ("paper-five-points", BALL),
}
SECONDS = 3.0


def rest(model, radius):
    """The state after some seconds around an object of this radius, m, or without one."""
    body = model.geom("object")
    body.contype[0] = body.conaffinity[0] = radius is not None
    if radius is not None:
        body.size[0] = radius
    data = mujoco.MjData(model)
    for _ in range(round(SECONDS / model.opt.timestep)):
        mujoco.mj_step(model, data)
    assert not any(warning.number for warning in data.warning), "MuJoCo warns"
    assert np.abs(data.qvel).max() < 1e-3, "it does not come to rest"
    return data


def corners(model, data, star):
    """Distances of the corners of a star from their middle, less their own radius, mm."""
    geoms = [i for i in range(model.ngeom) if model.geom(i).name.startswith(f"star-{star}-corner-")]
    places = data.geom_xpos[geoms, :2]
    return 1e3 * (np.linalg.norm(places - places.mean(axis=0), axis=1) - model.geom_size[geoms, 0])


def force(model, data, star):
    """The force of a star on the object along radii, N."""
    total, wrench = 0.0, np.zeros(6)
    for index in range(data.ncon):
        contact = data.contact[index]
        names = [model.geom(i).name for i in contact.geom]
        assert "object" in names, names
        if any(name.startswith(f"star-{star}-") for name in names):
            mujoco.mj_contactForce(model, data, index, wrench)
            total += wrench[0] * np.linalg.norm(contact.frame[:2])
    return total


def inside(value, interval):
    return interval[0] <= value <= interval[1]


for name, (design, sections) in CASES.items():
    spec, folder = out / f"{name}.toml", out / name
    spec.write_text(Path(f"designs/{design}.toml").read_text() + sections)
    subprocess.run([tool, "build", spec, "-o", folder, "--only", "prediction", "--with", "mjcf"], check=True, capture_output=True)
    subprocess.run([tool, "verify", folder], check=True, capture_output=True)
    predicted = json.loads((folder / "prediction.json").read_text())
    model = mujoco.MjModel.from_xml_path(str(folder / "mjcf.xml"))
    on_object, closed = rest(model, model.geom("object").size[0]), rest(model, None)
    for number, star in enumerate(predicted["stars"], 1):
        pressed, radii = force(model, on_object, number), corners(model, closed, number)
        ranges = star["ranges"]
        print(f"{name}, star {number}: {pressed:.2f} N (predicted {star['object_force_N']:.2f}, {ranges['object_force_N'][0]:.2f} to "
              f"{ranges['object_force_N'][1]:.2f}), closed {radii.mean():.3f} mm (predicted {star['final_radius_mm']:.3f})")
        assert inside(pressed, ranges["object_force_N"]) and abs(pressed / star["object_force_N"] - 1) < 0.02, pressed
        assert all(inside(radius, ranges["final_radius_mm"]) for radius in radii) and np.ptp(radii) < 0.1, radii
