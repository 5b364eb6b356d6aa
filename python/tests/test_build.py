"""Builds: the same bytes as the command, written completely or not at all."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import pytest

import stargrip_cam as sg


def test_the_bytes_are_those_of_the_golden_files(shipped: Path, root: Path) -> None:
    files = sg.build(sg.Spec.from_toml(shipped), anyway=True).files
    whole, digest = root / "snapshots" / shipped.stem, root / "snapshots" / f"{shipped.stem}.digest.snap"
    if whole.is_dir():
        kept = {path.name: path.read_bytes() for path in whole.iterdir()}
    else:
        lines = [line.split() for line in digest.read_text().splitlines()[4:]]
        kept = {line[0]: line[-1].encode() for line in lines if line}
        files = {name: hashlib.sha256(content).hexdigest().encode() for name, content in files.items()}
    assert len(kept) > 10
    assert {name: content == files.get(name) for name, content in kept.items()} == dict.fromkeys(kept, True)


def test_what_is_written_is_proven_and_one_byte_less_is_found(gripper: sg.Spec, tmp_path: Path) -> None:
    build = sg.build(gripper)
    target = tmp_path / "a" / "build"
    assert build.write(target) == ""
    assert {path.name: path.read_bytes() for path in target.iterdir()} == build.files
    assert json.loads(build.files["manifest.json"]) == json.loads(json.dumps(build.manifest))
    proof = sg.verify(target)
    assert proof and proof.findings == () and set(proof.proven.values()) <= {"bytes", "reading", "hash"}
    assert max(deviation for deviation in proof.deviation_mm.values() if deviation is not None) < 0.05
    program = target / "star-1-seal.gcode"
    program.write_bytes(program.read_bytes().replace(b"X", b"Y", 1))
    proof = sg.verify(target)
    assert not proof and {finding.file for finding in proof.findings} == {"star-1-seal.gcode"}


def test_a_directory_of_another_version_is_read_back_and_not_taken_for_proven(gripper: sg.Spec, tmp_path: Path) -> None:
    sg.build(gripper, only=["seal-gcode"]).write(tmp_path / "out")
    assert sg.verify(tmp_path / "out").written_by is None
    manifest = tmp_path / "out" / "manifest.json"
    manifest.write_text(manifest.read_text().replace(sg.__version__, "0.0.9", 1))
    proof = sg.verify(tmp_path / "out")
    assert proof.findings == () and proof.written_by == "0.0.9" and not proof
    program = tmp_path / "out" / "star-1-seal.gcode"
    program.write_bytes(program.read_bytes().replace(b"X", b"Y", 1))
    assert {finding.file for finding in sg.verify(tmp_path / "out").findings} == {"star-1-seal.gcode"}


def test_what_is_not_ours_is_not_replaced(gripper: sg.Spec, tmp_path: Path) -> None:
    (tmp_path / "diary.txt").write_text("mine")
    build = sg.build(gripper, only=["seal-gcode"])
    with pytest.raises(sg.PublishError) as caught:
        build.write(tmp_path)
    assert "diary.txt" in str(caught.value) and [path.name for path in tmp_path.iterdir()] == ["diary.txt"]


def test_kinds_are_asked_for(gripper: sg.Spec) -> None:
    build = sg.build(gripper, only=["seal-gcode"], with_=["preview-png"])
    kinds = {file["kind"] for file in build.manifest["files"]}
    assert kinds == {"spec", "machine", "seal-gcode", "preview-png"}
    assert build._repr_svg_() is None and "<table>" in build._repr_html_()


def test_a_notebook_shows_preview_and_files(gripper: sg.Spec) -> None:
    build = sg.build(gripper)
    assert build._repr_svg_() == build.files["sheet-1-preview.svg"].decode()
    assert "star-3-seal.gcode" in build._repr_html_() and "<svg" in build._repr_html_()
    assert build.prediction is not None and build.prediction.to_dict() == sg.predict(gripper).to_dict()
