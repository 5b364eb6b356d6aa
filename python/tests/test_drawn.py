"""Drawings: chambers with attributes, pieces and seams with their geometry, closed bodies."""

from __future__ import annotations

import copy
import pickle
from collections import Counter
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

import stargrip_cam as sg
from stargrip_cam import _words

V = {"tube_width": "20 mm", "radius": "2 mm", "arm_length": "80 mm", "angle": "60 deg", "pressure": "20 kPa"}


@pytest.fixture(scope="module")
def pillow(root: Path) -> sg.Spec:
    return sg.Spec.from_toml(root / "designs/drawings/pillow.toml").replace({"load.pressure": "5 kPa"})


def volume(body: sg.Body) -> float:
    """The volume inside, mm^3; every edge lies between two triangles of opposite directions."""
    nodes, triangles = body.nodes_mm, body.triangles
    edges = Counter((int(one[k]), int(one[k - 2])) for one in triangles for k in range(3))
    assert set(edges.values()) == {1} and all((to, start) in edges for start, to in edges), "not closed"
    a, b, c = (nodes[triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def test_a_drawing_is_predicted_by_its_chambers(pillow: sg.Spec) -> None:
    said = sg.predict(pillow)
    assert isinstance(said, sg.DrawnPrediction) and not hasattr(said, "final_radius_mm")
    assert repr(said) == '<DrawnPrediction "pillow" by shell: 1 chamber>'
    everything = said.to_dict()
    assert {name: getattr(said, name) for name in everything if name != "chambers"} == {
        name: value for name, value in everything.items() if name != "chambers"
    }
    [chamber] = said.chambers
    assert chamber.to_dict() == everything["chambers"][0] and chamber.height_mm is not None
    assert chamber.height_mm["value"] > 5 and chamber.seams is not None
    attributes = {name for name, value in vars(sg.Chamber).items() if isinstance(value, property)}
    assert set(chamber.to_dict()) <= attributes
    for of in (said, chamber):
        back = pickle.loads(pickle.dumps(of))
        assert back.to_dict() == of.to_dict() and repr(back) == repr(copy.deepcopy(of)) == repr(of)
        assert back == copy.deepcopy(of) == of and hash(back) == hash(of)
    assert said != chamber
    built = sg.build(pillow, only=["prediction"]).prediction
    assert isinstance(built, sg.DrawnPrediction) and built.chambers[0].width_mm == chamber.width_mm


def test_a_drawn_body_is_closed_and_its_seams_have_names(pillow: sg.Spec) -> None:
    said = sg.predict(pillow)
    assert isinstance(said, sg.DrawnPrediction) and said.mesh is not None and said.volume_mm3 is not None
    body = said.mesh.whole()
    assert volume(body) == pytest.approx(said.volume_mm3["value"], rel=0.02)
    names = {seam.name for piece in sg.design(pillow).pieces for seam in piece.seams}
    assert set(body.seams) <= {name or "seam" for name in names} and body.seams
    for nodes in body.seams.values():
        assert np.all(body.nodes_mm[nodes][:, 2] == 0.0)
    assert body.images.max() == len(said.mesh.triangles) - 1
    back = pickle.loads(pickle.dumps(body))
    assert repr(back) == repr(body) and np.array_equal(back.triangles, body.triangles)
    assert len(body.stl()) == 84 + 50 * len(body.triangles) and back.stl() == body.stl()
    groups = {line[7:] for line in body.obj().splitlines() if line.startswith("g seam-")}
    assert groups == set(body.seams) and back.obj() == body.obj()


def test_the_bodies_of_a_star_and_of_an_actuator_are_closed(gripper: sg.Spec) -> None:
    star = sg.predict(gripper, model="shell", fineness="coarse")
    assert isinstance(star, sg.Prediction) and star.mesh is not None and star.volume_mm3 is not None
    body = star.mesh.whole()
    assert volume(body) == pytest.approx(star.volume_mm3, rel=0.02)
    assert set(body.seams) == {seam.name for seam in sg.design(gripper).pieces[0].seams}
    assert len(body.triangles) == 20 * len(star.mesh.triangles)
    hinge = sg.actuator(**V, model="shell", fineness="coarse")  # type: ignore[arg-type]
    assert hinge.mesh is not None and hinge.volume_mm3 is not None
    assert volume(pickle.loads(pickle.dumps(hinge.mesh)).whole()) == pytest.approx(hinge.volume_mm3, rel=0.02)


def test_pieces_are_geojson(root: Path, gripper: sg.Spec) -> None:
    for path in sorted((root / "designs/drawings").glob("*.toml")):
        design = sg.design(sg.Spec.from_toml(path))
        assert not design.stars and f"{len(design.pieces)} piece" in repr(design)
        for piece in design.pieces:
            polygon = piece.__geo_interface__
            assert polygon["type"] == "Polygon" and len(polygon["coordinates"]) == len(piece.outline)
            assert piece.outline[0].closed and piece.fabric_mm2 > 0 and len(piece.ports_mm) > 0
            for seam in piece.seams:
                line = seam.__geo_interface__
                assert line["type"] == "LineString" and seam.band_mm > 0
                assert (line["coordinates"][0] == line["coordinates"][-1]) == seam.center_line.closed
                assert pickle.loads(pickle.dumps(seam)) == seam
            assert repr(pickle.loads(pickle.dumps(piece))) == repr(piece)
    star, [piece, *_] = sg.design(gripper).stars[0], sg.design(gripper).pieces
    assert tuple(piece.outline) == star.outline and piece.fabric_mm2 == star.fabric_mm2 and piece.name == "star 1"


def test_the_words_of_the_types_are_those_that_are_taken(gripper: sg.Spec) -> None:
    wrong: Any = "no such word"
    for words, call in (
        (_words.FileKind, lambda: sg.build(gripper, only=[wrong])),
        (_words.Model, lambda: sg.predict(gripper, model=wrong)),
        (_words.Fineness, lambda: sg.predict(gripper, fineness=wrong)),
        (_words.CouponKind, lambda: sg.coupon(gripper, only=[wrong])),
    ):
        with pytest.raises(sg.UsageError) as caught:
            call()
        assert all(word in str(caught.value) for word in get_args(words)), str(caught.value)


def test_a_large_shell_is_refused_with_its_way_out(tmp_path: Path) -> None:
    circles = "".join(
        f'<circle cx="{42 + 24 * (k // 6)}" cy="{42 + 24 * (k % 6)}" r="4"/>' for k in range(36)
    )
    (tmp_path / "islands.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="300mm" height="300mm" viewBox="0 0 300 300">'
        '<g id="air" fill="none" stroke="black"><rect x="20" y="20" width="168" height="168"/>' + circles + "</g>"
        '<g id="port" stroke="red"><path d="M16 50h8"/></g></svg>'
    )
    spec = tmp_path / "spec.toml"
    spec.write_text(
        'schema = 1\nname = "islands"\n[drawing]\nfile = "islands.svg"\n[drawing.layers]\nair = ["air"]\n'
        'port = ["port"]\n[load]\npressure = "10 kPa"\n[accuracy]\nmodel = "shell"\n'
    )
    large = sg.Spec.from_toml(spec)
    with pytest.raises(sg.PredictionError, match="fineness=.coarse.") as refused:
        sg.predict(large)
    assert refused.value.faults[0].code == "large-shell"
    with pytest.raises(sg.DesignError, match="anyway=True") as refused:
        sg.build(large)
    assert refused.value.faults[0].code == "large-shell"
