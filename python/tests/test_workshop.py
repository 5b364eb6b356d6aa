"""From an object to a spec, and what is made beside a build."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import stargrip_cam as sg


def test_a_gripper_for_an_object() -> None:
    spec = sg.Spec.for_object("75 mm", "200 g", name="cup", friction=0.5, shape="cylinder", height="100 mm")
    assert spec.name == "cup" and spec.settings()["load.object_diameter"] == "75 mm"
    said = sg.predict(spec)
    assert isinstance(said, sg.Prediction) and said.verdict["holds"] == "yes"
    with pytest.raises(sg.UsageError) as caught:
        sg.Spec.for_object("75", "much", friction=-1.0)
    assert all(word in str(caught.value) for word in ("object: ", "mass: ", "friction: "))
    with pytest.raises(sg.DesignError, match="a request farther away that can be met: a mass of ") as refused:
        sg.Spec.for_object("30 mm", "10 kg")
    assert "--" not in str(refused.value)
    wrong: Any = sg.Spec
    with pytest.raises(TypeError, match="Did you mean 'height'"):
        wrong.for_object("75 mm", "200 g", heigth="3 mm")


def test_coupons_have_their_programs_and_their_table(gripper: sg.Spec) -> None:
    files = sg.coupon(gripper, only=["strips"], speeds=["0.1 mm/s", "0.2 mm/s"], repeats=2)
    assert any(name.endswith(".gcode") for name in files) and any(name.endswith(".csv") for name in files)
    with pytest.raises(sg.UsageError, match="repeats"):
        sg.coupon(gripper, repeats=99)
    with pytest.raises(sg.UsageError) as caught:
        sg.coupon(gripper, only=["disc"], repeats=2)
    assert "--" not in str(caught.value) and "repeats is for strips" in str(caught.value)


def test_a_feed_check_and_the_machines(gripper: sg.Spec) -> None:
    files = sg.feed_check(gripper)
    assert len(files) == 2 and any(name.startswith("feedcheck.") for name in files)
    machines = sg.machines()
    assert "generic" in machines and all(description for description in machines.values())
    for name in machines:
        laser = {"seal.power": "8 %", "seal.tip": "0.5 mm"} if "laser" in name else {}
        assert gripper.replace({"machine.profile": name, **laser}).settings()["machine.profile"] == name


def test_programs_follow_a_sheet_that_was_moved(gripper: sg.Spec, tmp_path: Path) -> None:
    build = sg.build(gripper.replace({"machine.marks": "pause"}), only=["seal-gcode", "trace-gcode"])
    build.write(tmp_path / "job")
    lines = build.files["star-1-trace.gcode"].decode().splitlines()
    marks = [dict(word.split("=") for word in line.split() if "=" in word) for line in lines if line.startswith("; mark: ")]
    moved = [f"{float(mark['x_mm']) + 1.5}, {float(mark['y_mm']) - 0.5}" for mark in marks]
    aligned = sg.align(build, *moved)
    assert isinstance(aligned, sg.Aligned) and aligned.sheet == 1
    assert (*aligned.shift_mm, aligned.turn_deg, aligned.stretch_mm) == pytest.approx((1.5, -0.5, 0.0, 0.0), abs=1e-3)
    same = sg.align(tmp_path / "job", *moved)
    assert aligned.files == same.files and aligned == same and hash(aligned) == hash(same)
    assert aligned != sg.align(build, *(f"{mark['x_mm']}, {mark['y_mm']}" for mark in marks))
    assert all(name.endswith((".gcode", ".toml", ".json")) for name in aligned.files)
    assert aligned.files["star-1-seal.gcode"] != build.files["star-1-seal.gcode"]
    aligned.write(tmp_path / "aligned")
    assert sg.verify(tmp_path / "aligned")
    with pytest.raises(sg.UsageError, match="mark1: found \"here\"; allowed are two coordinates in mm"):
        sg.align(build, "here", moved[1])
    with pytest.raises(sg.Error, match="the marks are .* mm apart"):
        sg.align(build, "0, 0", "1, 1")
    with pytest.raises(TypeError, match="Did you mean 'sheet'"):
        sg.align(build, *moved, shet=1)  # type: ignore[call-arg]


def test_an_interrupted_job_is_resumed(gripper: sg.Spec) -> None:
    files = sg.build(gripper, only=["seal-gcode"]).files
    job = next(content for name, content in files.items() if name.endswith(".gcode"))
    rest = sg.resume(job, gripper, at="37%")
    assert rest.done == pytest.approx(0.37, abs=0.01) and rest.line > 1 and rest.overlap_mm > 0 < rest.remaining_s
    assert len(rest.program) < len(job) and "resume" in rest.program
    assert sg.resume(job, line=rest.line).program
    with pytest.raises(sg.UsageError) as caught:
        sg.resume(job)
    assert "--" not in str(caught.value) and "near" in str(caught.value)
    with pytest.raises(sg.Error):
        sg.resume("G0 X0\n", at="37%")
