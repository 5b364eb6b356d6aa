"""The examples give the documented results, also when a worker is killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import stargrip_cam as sg

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
VARY = {"star.points": "3,4,5,6", "star.tube_width": "10 mm..40 mm/101", "star.tip_angle": "10 deg..60 deg/101"}

distributed = pytest.importorskip("distributed")


def same(one: "dict[str, np.ndarray]", two: "dict[str, np.ndarray]") -> bool:
    assert list(one) == list(two)
    numbers = [name for name, column in one.items() if column.dtype != object]
    assert all(one[name].tobytes() == two[name].tobytes() for name in numbers)
    return all(list(one[name]) == list(two[name]) for name in one if name not in numbers)


@pytest.fixture
def dask_study(monkeypatch: pytest.MonkeyPatch):  # type: ignore[no-untyped-def]
    monkeypatch.syspath_prepend(str(EXAMPLES))
    # Workers import the example by its name, too.
    monkeypatch.setenv("PYTHONPATH", str(EXAMPLES))
    import dask_study

    return dask_study


def test_a_study_is_the_same_however_it_is_split_and_after_a_worker_was_killed(dask_study, gripper: sg.Spec) -> None:  # type: ignore[no-untyped-def]
    def slow_rows(spec: sg.Spec, vary: "dict[str, str]", part: int, parts: int) -> "dict[str, np.ndarray]":
        """The rows of one part, late enough that a worker can be killed in the middle."""
        found = sg.sweep(spec, dict(vary), part=(part, parts), threads=1)
        time.sleep(0.3)
        return found

    whole = sg.sweep(gripper, dict(VARY))
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            for parts in (1, 7):
                assert same(whole, dask_study.study(client, gripper, VARY, parts))
            tasks = [client.submit(slow_rows, gripper, VARY, part, 12, pure=False) for part in range(1, 13)]
            pids = list(client.run(os.getpid).values())
            while sum(task.done() for task in tasks) < 2:
                time.sleep(0.05)
            assert not all(task.done() for task in tasks), "nothing is left to be lost"
            os.kill(pids[0], signal.SIGKILL)
            pieces = client.gather(tasks)
    assert same(whole, {name: np.concatenate([piece[name] for piece in pieces]) for name in whole})


def test_a_task_returns_results(gripper: sg.Spec) -> None:
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            said, design = client.gather([client.submit(sg.predict, gripper), client.submit(sg.design, gripper)])
    assert said.to_dict() == sg.predict(gripper).to_dict() and str(said) == str(sg.predict(gripper))
    assert [star.seams for star in design.stars] == [star.seams for star in sg.design(gripper).stars]


def test_the_study_runs_as_a_program(tmp_path: Path, root: Path) -> None:
    output = tmp_path / "study.npz"
    program = [sys.executable, str(EXAMPLES / "dask_study.py"), str(root / "designs" / "paper-gripper.toml")]
    program += ["--vary", "star.points=4,5", "--vary", "star.tip_angle=20 deg..60 deg/50", "--workers", "1", "--parts", "3"]
    done = subprocess.run([*program, "--output", str(output)], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0 and done.stdout == f"100 rows in {output}\n", done.stderr
    with np.load(output) as saved:
        assert len(saved["final_radius_mm"]) == 100 and saved["refused"].dtype.kind == "U"


def test_a_slurm_task_writes_its_part_once(tmp_path: Path, root: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    slurm = EXAMPLES / "slurm"
    for part in ("1", "2", "1"):
        program = [sys.executable, str(slurm / "study_part.py"), str(root / "designs" / "paper-gripper.toml")]
        program += [str(slurm / "study.toml"), str(tmp_path / "parts"), part, "2"]
        done = subprocess.run(program, capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in (tmp_path / "parts").iterdir()) == ["part-1-of-2.parquet", "part-2-of-2.parquet"]
    assert parquet.read_table(tmp_path / "parts").num_rows == 4 * 100 * 100


def test_the_notebook_runs_and_is_committed_without_outputs() -> None:
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    notebook = nbformat.read(EXAMPLES / "paper.ipynb", as_version=4)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(cell.outputs == [] and cell.execution_count is None for cell in code)
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(EXAMPLES)}}).execute()
    pictures = [out for cell in code for out in cell.outputs if "image/png" in out.get("data", {})]
    assert len(pictures) >= 6
