"""Parquet files open in Arrow, and equal the CSV, cell by cell."""

from __future__ import annotations

import csv
import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import stargrip_cam as sg
from stargrip_cam import _parquet

pq = pytest.importorskip("pyarrow.parquet")

COMMAND = Path(sys.executable).with_name("stargrip-cam")

# Its 216 rows include refusals, words, whole numbers and unknown values.
STUDY = """
schema = 1
spec = "spec.toml"
[rows]
star.points = [4, 5, 9]
star.tip_angle = ["40 deg", "30 deg", "20 deg"]
[vary]
mask.mirror = [true, false]
star.tube_width = "10 mm..40 mm/12"
load.pressure = ["0.001 kPa", "20 kPa", "37 kPa"]
"""


@pytest.fixture(scope="module")
def study(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("study")
    shutil.copy(root / "designs" / "paper-gripper.toml", folder / "spec.toml")
    (folder / "study.toml").write_text(STUDY)
    subprocess.run([COMMAND, "sweep", "study.toml", "-o", "whole.csv"], cwd=folder, check=True, timeout=120)
    spec = sg.Spec.from_toml(folder / "spec.toml")
    sg.sweep_to_parquet(folder / "whole.parquet", spec, study=STUDY)
    for k in range(1, 6):
        sg.sweep_to_parquet(folder / f"part-{k}.parquet", spec, study=STUDY, part=(k, 5))
    return folder


def test_every_cell_is_that_of_the_csv(study: Path) -> None:
    table = pq.read_table(study / "whole.parquet")
    with (study / "whole.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    assert table.column_names == header and table.num_rows == len(rows) == 216
    kinds = set()
    for name, column in zip(header, zip(*rows)):
        for found, said in zip(table[name].to_pylist(), column):
            kinds.add(type(found))
            if found is None or isinstance(found, str):
                assert (found or "") == said, name
            elif isinstance(found, int):
                assert str(found) == said, name
            else:
                # A CSV has nine digits.
                assert float(said) == pytest.approx(found, rel=1e-8, abs=1e-300), name
    assert kinds == {type(None), str, int, float}


def test_a_column_says_its_unit_and_its_meaning(study: Path) -> None:
    schema = pq.read_schema(study / "whole.parquet")
    about = {column["name"]: column for column in json.loads(schema.metadata[b"stargrip-cam.columns"])}
    assert list(about) == schema.names
    assert about["final_radius_mm"]["unit"] == "mm" and "closed" in about["final_radius_mm"]["about"]


def test_parts_are_one_table(study: Path) -> None:
    whole = pq.read_table(study / "whole.parquet")
    parts = sorted(study.glob("part-*.parquet"))
    assert len(parts) == 5 and pq.read_table(parts).equals(whole)


def test_pieces_are_one_table(study: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_parquet, "PIECE", 50)
    told: list[float] = []
    path = study / "pieces.parquet"
    sg.sweep_to_parquet(path, sg.Spec.from_toml(study / "spec.toml"), study=STUDY, progress=lambda part, what: told.append(part))
    assert pq.read_table(path).equals(pq.read_table(study / "whole.parquet"))
    assert told == sorted(told)


def test_the_command_names_this_function(study: Path) -> None:
    ran = subprocess.run([COMMAND, "sweep", "study.toml", "-o", "x.parquet"], cwd=study, capture_output=True, text=True, timeout=120)
    assert ran.returncode == 1 and "stargrip_cam.sweep_to_parquet(" in ran.stderr


def test_a_fault_leaves_no_file(study: Path) -> None:
    with pytest.raises(sg.Error):
        sg.sweep_to_parquet(study / "never.parquet", sg.Spec.from_toml(study / "spec.toml"), {"star.points": ["5 mm"]})
    assert not list(study.glob("never*"))
