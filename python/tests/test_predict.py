"""Predictions: the output of the command as attributes."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import stargrip_cam as sg

COMMAND = [sys.executable, "-c", "import sys; from stargrip_cam._command import main; sys.exit(main())"]


def as_json(said: "dict[str, object]") -> object:
    """The same after a round trip through JSON, which has no tuples."""
    return json.loads(json.dumps(said))


V = {"tube_width": "20 mm", "radius": "2 mm", "arm_length": "80 mm", "angle": "60 deg", "pressure": "20 kPa"}


def printed(*args: str) -> object:
    done = subprocess.run([*COMMAND, *args], capture_output=True, check=True, timeout=300)
    return json.loads(done.stdout)


@pytest.mark.parametrize("model", ["fit", "ring", "bvp", "section", "auto"])
def test_a_prediction_is_what_the_command_prints(root: Path, gripper: sg.Spec, model: str) -> None:
    path = root / "designs" / "paper-gripper.toml"
    said = sg.predict(gripper, model=model, radii="20 mm..40 mm/3")  # type: ignore[arg-type]
    assert as_json(said.to_dict()) == printed("predict", str(path), "--json", "--model", model, "--radii", "20 mm..40 mm/3")


def test_attributes_are_the_keys(gripper: sg.Spec) -> None:
    said = sg.predict(gripper)
    everything = said.to_dict()
    assert {name: getattr(said, name) for name in everything} == everything
    assert {*everything, "mesh", "to_dict"} <= set(dir(said))
    everything["model"] = "mine"
    assert said.model == "section" and said.mesh is None
    assert said.volume_mm3 is None, "a key of another model"
    with pytest.raises(AttributeError, match="final_raduis"):
        said.final_raduis
    assert "payload of the whole stack" in str(said)


def test_every_key_of_every_model_is_an_attribute_and_every_attribute_a_key(gripper: sg.Spec) -> None:
    bare = gripper.replace({"load.pressure": None})
    models = [sg.predict(gripper, model="shell", fineness="coarse"), sg.predict(bare)]
    models += [sg.predict(gripper, model=model, radii="30 mm") for model in ("ring", "section")]  # type: ignore[arg-type]
    angles = "20 deg..60 deg/3"
    actuators = [sg.actuator(**V, angles=angles), sg.actuator(**V, angles=angles, model="shell", fineness="coarse")]
    for of_class, answers in ((sg.Prediction, models), (sg.ActuatorPrediction, actuators)):
        attributes = {name for name, value in vars(of_class).items() if isinstance(value, property)}
        assert attributes == set().union(*(answer.to_dict() for answer in answers))  # type: ignore[attr-defined]


def test_a_notebook_shows_numbers_with_ranges(gripper: sg.Spec) -> None:
    said = sg.predict(gripper)
    page = said._repr_html_()
    low, high = said.ranges["final_radius_mm"]
    assert "final_radius_mm" in page and f"{low:.5g} to {high:.5g}" in page
    wide = sg.predict(gripper.replace({"load.object_diameter": "130 mm"}))
    assert ">yes<" in page and ">no<" in wide._repr_html_() and "does not enter" in wide._repr_html_()


def test_answers_are_equal_if_their_contents_are(gripper: sg.Spec) -> None:
    other = gripper.replace({"load.pressure": "36 kPa"})
    starter = sg.Spec.starter("x").replace({"load.pressure": "37 kPa"})
    answers: list[tuple[Callable[[Any], Any], Any, Any]] = [
        (sg.predict, gripper, other),
        (lambda pressure: sg.actuator(**{**V, "pressure": pressure}), "20 kPa", "21 kPa"),
        (lambda pressure: sg.actuator(**{**V, "pressure": pressure}, model="shell", fineness="coarse").mesh, "20 kPa", "21 kPa"),
        (sg.design, gripper, other),
        (lambda spec: sg.design(spec).stars[0], gripper, other),
        (lambda index: sg.design(gripper).stars[index], 0, 1),
        (lambda index: sg.design(gripper).pieces[index], 0, 1),
        (lambda spec: sg.build(spec, only=["seal-gcode"]), gripper, other),
        (lambda goal: sg.optimize(starter, goal=goal, points=(4, 5)), "fabric", "stiffness"),
    ]
    for answer, argument, changed in answers:
        first, second = answer(argument), answer(argument)
        assert first is not second and first == second and hash(first) == hash(second), first
        assert first != answer(changed) and first != repr(first), first


def test_an_actuator_is_what_the_command_prints() -> None:
    options = [f"--{name.replace('_', '-')}={value}" for name, value in V.items()]
    said = sg.actuator(**V, angles="20 deg..60 deg/3", poisson_ratio=0.3)
    assert as_json(said.to_dict()) == printed("actuator", *options, "--angles=20 deg..60 deg/3", "--poisson-ratio=0.3", "--json")
    with pytest.raises(sg.UsageError, match="'3' for tube_width: .*mm, cm"):
        sg.actuator(**{**V, "tube_width": "3"})


def test_a_shell_has_a_mesh_in_equilibrium_with_itself() -> None:
    told: list[tuple[float, str]] = []
    said = sg.actuator(**V, model="shell", fineness="coarse", progress=lambda part, what: told.append((part, what)))
    mesh = said.mesh
    assert mesh is not None
    nodes, flat, triangles = mesh.nodes_mm, mesh.flat_mm, mesh.triangles
    assert nodes.shape == (len(flat), 3) and flat.shape == (len(nodes), 2) and triangles.shape[1] == 3
    assert triangles.dtype == np.int64 and triangles.min() == 0 and triangles.max() == len(nodes) - 1
    assert mesh.tension_N_per_mm.shape == mesh.stretch.shape == mesh.curvature_per_mm.shape == (len(triangles), 2)
    # The modelled quarter of the flat tube: half of both arms with their hinge, one sheet.
    a, b, c = (flat[triangles[:, k]] for k in range(3))
    area = 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum()
    hinge = 0.5 * np.deg2rad(180 - 60) * (22.0**2 - 2.0**2)
    assert 2 * area == pytest.approx(2 * 80 * 20 + hinge, rel=0.01)
    # It is inflated: the volume is that below the sheet.
    assert np.ptp(nodes[:, 2]) > 5.0 and said.volume_mm3 is not None and said.volume_mm3 > 0
    assert mesh.vtu().startswith("<?xml") or "<VTKFile" in mesh.vtu()
    assert told[-1] == (1.0, "done") and len(told) > 1


def test_an_optimum_meets_its_constraints() -> None:
    spec = sg.Spec.starter("x").replace({"load.pressure": "37 kPa", "load.object_radius": "30 mm", "load.object_height": "400 mm", "load.object_shape": "cylinder", "load.friction": 0.5})
    found = sg.optimize(spec, goal="fabric", points=(4, 5), count=(1, 4), payload=0.3)
    assert found.spec is not None and found.computed > 1000
    assert set(found.best["points"]) == {4.0, 5.0} and found.best["violation"][0] == 0.0
    assert np.all(np.diff(found.front["contraction"]) <= 0)
    payload = sg.predict(found.spec).payload_kg
    assert payload is not None and payload >= 0.3
    assert sg.build(found.spec, only=["seal-gcode"]).files
