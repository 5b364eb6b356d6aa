"""Results travel between processes: a task of Dask or joblib can return any of them."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest

import stargrip_cam as sg

V = {"tube_width": "20 mm", "radius": "2 mm", "arm_length": "80 mm", "angle": "60 deg", "pressure": "20 kPa"}


def again(of: Any) -> Any:
    """The object after a round trip through every current pickle protocol, which must equal it, as must its copies."""
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        back = pickle.loads(pickle.dumps(of, protocol))
        assert type(back) is type(of) and repr(back) == repr(of) and back == of
        try:
            hashed = hash(of)
        except TypeError:  # lines and arcs have no hash
            continue
        assert hash(back) == hashed
    assert copy.deepcopy(of) == copy.copy(of) == of
    return back


def same(one: Any, two: Any) -> bool:
    return one.dtype == two.dtype and one.shape == two.shape and one.tobytes() == two.tobytes()


@pytest.mark.parametrize("model", ["section", "ring", "shell"])
def test_a_prediction(gripper: sg.Spec, model: Any) -> None:
    said = sg.predict(gripper, model=model, fineness="coarse" if model == "shell" else None)
    back = again(again(said))
    assert back.to_dict() == said.to_dict() and str(back) == str(said) and back._repr_html_() == said._repr_html_()
    assert back.final_radius_mm == said.final_radius_mm and back.verdict == said.verdict
    back.to_dict()["model"] = "mine"
    assert back.model == model
    assert (said.mesh is None) == (back.mesh is None) == (model != "shell")


def test_an_actuator_and_its_mesh() -> None:
    said = sg.actuator(**V, model="shell", fineness="coarse")
    back = again(said)
    assert back.to_dict() == said.to_dict() and str(back) == str(said)
    assert said.mesh is not None and back.mesh.vtu() == said.mesh.vtu()
    names = [name for name in dir(sg.Mesh) if isinstance(getattr(said.mesh, name), np.ndarray)]
    assert len(names) == 7 and all(same(getattr(said.mesh, name), getattr(back.mesh, name)) for name in names)
    restored, (nodes, triangles, *others) = said.mesh.__reduce__()
    with pytest.raises(sg.UsageError):
        restored(nodes, [[0, 1, 10**6], *triangles[1:]], *others)


def test_a_design_with_its_stars_and_contours(gripper: sg.Spec) -> None:
    design = sg.design(gripper)
    assert [repr(star) for star in again(design).stars] == [repr(star) for star in design.stars]
    stars = again(design.stars)
    for star, back in zip(design.stars, stars):
        assert back.seams == star.seams and back.outline == star.outline and back.windows == star.windows
        assert same(back.placement, star.placement) and same(back.arms_mm, star.arms_mm)
    contour = design.stars[0].seams[0]
    assert again(contour) == contour and again(contour.segments) == contour.segments
    assert {type(piece) for piece in contour.segments} == {sg.Line, sg.Arc}
    assert all(eval(repr(piece), {"Line": sg.Line, "Arc": sg.Arc}) == piece for piece in contour.segments)  # noqa: S307


def test_a_build_is_built_again(gripper: sg.Spec) -> None:
    build = sg.build(gripper, only=["seal-gcode"], with_=["preview-png"])
    data = pickle.dumps(build)
    back = pickle.loads(data)
    assert back.files == build.files and back.manifest == build.manifest and len(data) < 20_000
    with pytest.raises(sg.Error, match="0.0.0.*build it again"):
        pickle.loads(data.replace(sg.__version__.encode(), b"0.0.0"))
    burst = gripper.replace({"load.object_radius": "5 mm"})
    anyway = sg.build(burst, anyway=True, only=["seal-gcode"])
    assert pickle.loads(pickle.dumps(anyway)).files == anyway.files


def test_an_optimum() -> None:
    found = sg.optimize(sg.Spec.starter("x").replace({"load.pressure": "37 kPa"}), goal="fabric", points=(4, 5))
    back = again(found)
    assert back.spec == found.spec and back.computed == found.computed and back.short == found.short
    for name, column in found.best.items():
        assert same(column, back.best[name]) and same(found.front[name], back.front[name])


def test_a_proof_and_functions(gripper: sg.Spec, tmp_path: Any) -> None:
    sg.build(gripper, only=["seal-gcode"]).write(tmp_path / "out")
    proof = sg.verify(tmp_path / "out")
    assert again(proof) == proof
    for name in ("predict", "build", "design", "optimize", "actuator", "sweep", "verify"):
        assert pickle.loads(pickle.dumps(getattr(sg, name))) is getattr(sg, name)
