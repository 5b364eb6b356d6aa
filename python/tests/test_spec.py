"""Specs: reading, changing, writing, and the text that must stay unchanged."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import stargrip_cam as sg

STARTER = sg.Spec.starter("x")


def test_a_spec_is_read_from_text_path_and_dict(shipped: Path) -> None:
    by_path, by_name = sg.Spec.from_toml(shipped), sg.Spec.from_toml(str(shipped))
    by_text = sg.Spec.from_toml(shipped.read_text())
    assert by_path == by_name == by_text and len({by_path, by_name, by_text}) == 1
    assert by_path.to_toml() == shipped.read_text()
    by_dict = sg.Spec.from_dict(by_path.to_dict())
    assert by_dict.to_dict() == by_path.to_dict()
    assert by_dict.settings() == by_path.settings()


def test_specs_travel_between_processes(gripper: sg.Spec) -> None:
    for copied in (pickle.loads(pickle.dumps(gripper)), copy.deepcopy(gripper)):
        assert copied == gripper and copied.name == gripper.name


def test_a_profile_named_by_path_is_found_beside_its_spec(tmp_path: Path, root: Path) -> None:
    (tmp_path / "own.toml").write_text((root / "crates" / "spec" / "templates" / "machines" / "grbl.toml").read_text())
    sections = STARTER.to_dict()
    sections["machine"] = {"profile": "own.toml"}
    with pytest.raises(sg.SpecError) as caught:
        sg.Spec.from_dict(sections)
    assert (caught.value.code, caught.value.key) == ("unknown-machine", "machine.profile")
    (tmp_path / "star.toml").write_text(STARTER.replace({"machine.profile": "generic"}).to_toml().replace("generic", "own.toml"))
    spec = sg.Spec.from_toml(tmp_path / "star.toml")
    assert pickle.loads(pickle.dumps(spec.replace({"star.points": 6}))).settings()["machine.profile"] == "own.toml"


def test_values_are_judged_together_and_none_is_the_default() -> None:
    both = STARTER.replace({"inlet.tip": 5})
    with pytest.raises(sg.SpecError):
        both.replace({"star.points": 4})
    four = both.replace({"star.points": 4}, **{"inlet.tip": None})
    assert four.settings()["star.points"] == "4" and "tip" not in four.to_dict().get("inlet", {})
    assert both.settings()["star.points"] == "5", "a spec never changes"


def test_numbers_of_numpy_are_numbers() -> None:
    spec = STARTER.replace({"star.points": np.int64(6), "load.friction": np.float64(0.5)})
    assert spec.to_dict()["star"]["points"] == 6 and spec.to_dict()["load"]["friction"] == 0.5


@settings(max_examples=50, deadline=None)
@given(
    points=st.integers(3, 12),
    width=st.floats(5.0, 80.0),
    angle=st.floats(5.0, 170.0),
    mirror=st.booleans(),
)
def test_what_is_replaced_is_what_is_read(points: int, width: float, angle: float, mirror: bool) -> None:
    values = {"star.points": points, "star.tube_width": f"{width!r} mm", "star.tip_angle": f"{angle!r} deg"}
    spec = STARTER.replace(values, **{"mask.mirror": mirror, "inlet.none": True})
    back = sg.Spec.from_toml(spec.to_toml())
    assert back == spec
    star = back.to_dict()["star"]
    assert (star["points"], star["tube_width"], star["tip_angle"]) == tuple(values.values())
    assert back.to_dict()["mask"]["mirror"] is mirror
    assert back.replace({"star.points": 5}).replace({"star.points": points}) == spec
