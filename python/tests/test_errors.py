"""Every refusal has code, key, line, the found value and the allowed values."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import pytest

import stargrip_cam as sg

STARTER = sg.Spec.starter("x")


def refused(values: dict[str, object]) -> sg.SpecError:
    with pytest.raises(sg.SpecError) as caught:
        STARTER.replace(values)
    return caught.value


def test_a_fault_has_a_place_and_a_remedy() -> None:
    fault = refused({"star.tube_width": 30})
    assert (fault.code, fault.key) == ("no-unit", "star.tube_width")
    assert fault.found == "`tube_width` is the bare number 30" and "mm, cm" in (fault.allowed or "")
    lines = STARTER.to_toml().splitlines()
    assert fault.line is not None and lines[fault.line - 1].startswith("tube_width")
    assert isinstance(fault, sg.Error) and "-->" in str(fault)


def test_all_faults_come_at_once() -> None:
    fault = refused({"star.points": 2, "star.tip_angle": "200 deg", "seal.speed": "1 parsec/s"})
    keys = [one.key for one in fault.faults]
    assert keys == sorted(keys, key=lambda key: [one.key for one in fault.faults].index(key))
    assert set(keys) == {"star.points", "star.tip_angle", "seal.speed"}
    assert {one.code for one in fault.faults} == {"out-of-range", "unknown-unit"}


def test_unknown_and_missing_keys_are_named() -> None:
    with pytest.raises(sg.SpecError) as caught:
        sg.Spec.from_dict({"schema": 1, "name": "x", "star": {"points": 5, "tube_widht": "30 mm"}})
    keys = {(fault.code, fault.key) for fault in caught.value.faults}
    assert ("unknown-key", "star.tube_widht") in keys and ("missing-key", "star") in keys


def test_designs_that_cannot_be_are_refused_at_their_key() -> None:
    spec = STARTER.replace({"star.points": 9})
    for call in (sg.design, sg.predict, sg.build):
        with pytest.raises(sg.DesignError) as caught:
            call(spec)
        assert (caught.value.code, caught.value.key) == ("no-arm", "star.points")
        assert caught.value.line is not None


def test_a_gripper_that_does_not_hold_its_object_is_not_built_but_anyway() -> None:
    spec = STARTER.replace({"load.pressure": "37 kPa", "load.object_radius": "5 mm"})
    with pytest.raises(sg.DesignError) as caught:
        sg.build(spec)
    assert (caught.value.code, caught.value.key) == ("object-too-thin", "load.object_radius")
    assert sg.build(spec, anyway=True, only=["seal-gcode"]).manifest["only"] == ["seal-gcode"]


def test_arguments_that_are_wrong_are_told() -> None:
    wrong = [
        (lambda: sg.predict(STARTER, model="guess"), "guess"),  # type: ignore[arg-type]
        (lambda: sg.predict(STARTER, radii="20..40"), "radii"),
        (lambda: sg.build(STARTER, only=["hologram"]), "hologram"),
        (lambda: sg.design(STARTER).stars[0].outline[0].points(0.0), "tolerance_mm"),
        (lambda: sg.optimize(STARTER, tip_angle="3"), "tip_angle"),
        (lambda: sg.sweep(STARTER, {"star.points": ["five"]}), "five"),
        (lambda: sg.sweep(STARTER), "vary"),
        (lambda: sg.sweep(STARTER, {"star.points": [5]}, part=(3, 2)), "(3, 2)"),
        (lambda: sg.sweep(STARTER, {"star.points": []}), "the list of values of `star.points` is empty"),
        (lambda: sg.sweep(STARTER, {"star.points": [5]}, threads=-1), "threads is -1; allowed is a number from 1"),
        (lambda: STARTER.replace({"star.poinst": 5}), "star.points"),
    ]
    for call, word in wrong:
        with pytest.raises(sg.UsageError) as caught:
            call()
        assert word in str(caught.value), str(caught.value)
        assert isinstance(caught.value, ValueError) and caught.value.code == "usage"


def test_types_that_are_wrong_are_told_with_what_is_allowed() -> None:
    hold: Any = sg
    wrong = [
        (lambda: hold.build(STARTER, only="gcode"), ["`only`", "found str", "a list of kinds of file: spec,", "seal-gcode"]),
        (lambda: hold.build(STARTER, with_=["report", 3]), ["`with_`", "a list of kinds of file"]),
        (lambda: hold.predict(STARTER, radii=[30]), ["`radii`", "found list", '"20 mm..40 mm/5"']),
        (lambda: hold.predict(STARTER, model=3), ["`model`", "found int", "section"]),
        (lambda: hold.predict("star.toml"), ["'str'", "'Spec'"]),
        (lambda: hold.sweep(STARTER, {"star.points": 5}), ["`star.points`", "found int", "a list of values"]),
        (lambda: hold.sweep(STARTER, {"star.points": [5]}, outputs="final_radius_mm"), ["`outputs`", "found str"]),
        (lambda: hold.sweep(STARTER, {"star.points": [5]}, part=3), ["`part`", "found int", "(k, n)"]),
        (lambda: hold.optimize(STARTER, goall="fabric"), ["optimize()", "'goall'", "Did you mean 'goal'?", "tube_width, "]),
        (lambda: hold.optimize(STARTER, json=True), ["optimize()", "'json'", "Allowed are goal, "]),
        (lambda: hold.predict(STARTER, modle="ring"), ["predict()", "Did you mean 'model'?"]),
        (lambda: hold.sweep(STARTER, {"star.points": [5]}, thread=1), ["sweep()", "Did you mean 'threads'?"]),
        (lambda: hold.build(STARTER, onyl=[]), ["build()", "Did you mean 'only'?"]),
        (lambda: hold.actuator(tube_widht="3 mm"), ["actuator()", "Did you mean 'tube_width'?"]),
    ]
    for call, words in wrong:
        with pytest.raises(TypeError) as caught:
            call()
        text = str(caught.value)
        assert all(word in text for word in words), text
        assert not any(word in text for word in ("Vec", "PyO3", "`str`", "usize", "i64", "&str")), text


def test_values_that_are_no_toml_are_type_errors() -> None:
    with pytest.raises(TypeError, match="not object"):
        STARTER.replace({"star.points": object()})


def test_files_that_are_not_there_are_pythons_own_errors(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        sg.Spec.from_toml(tmp_path / "none.toml")
    with pytest.raises(FileNotFoundError):
        sg.verify(tmp_path / "none")
    with pytest.raises(sg.Error, match="is not a build"):
        sg.verify(tmp_path)
    with pytest.raises(TypeError, match="not int"):
        sg.verify(3)  # type: ignore[arg-type]


def test_exceptions_travel_between_processes() -> None:
    fault = refused({"star.points": 2})
    back = pickle.loads(pickle.dumps(fault))
    assert (type(back), str(back), back.faults) == (type(fault), str(fault), fault.faults)
