"""The wheel's command behaves like the program that cargo builds."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import stargrip_cam as sg

COMMAND = Path(sys.executable).with_name("stargrip-cam")


def run(*args: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([COMMAND, *args], capture_output=True, text=True, timeout=120)


def test_it_is_this_version() -> None:
    assert run("--version").stdout == f"stargrip-cam {sg.__version__}\n"


def test_the_package_and_the_crate_have_one_version(root: Path) -> None:
    manifests = [(root / where / "Cargo.toml").read_text().splitlines() for where in (".", "python")]
    assert f'version = "{sg.__version__}"' in manifests[0]
    assert all("version.workspace = true" in manifest for manifest in manifests)


def test_exit_codes_say_how_it_went(root: Path, tmp_path: Path) -> None:
    design = str(root / "designs" / "paper-five-points.toml")
    assert run("check", design, "-q").returncode == 0
    (tmp_path / "bad.toml").write_text("schema = 1\n")
    refused = run("check", str(tmp_path / "bad.toml"))
    assert refused.returncode == 1 and "missing-key" in refused.stderr and refused.stdout == ""
    for wrong in (["chekc"], ["check"], []):
        misused = run(*wrong)
        assert misused.returncode == 2 and misused.stdout == "" and "Usage" in misused.stderr
    assert run("--help").returncode == 0 and run("build", "--help").stdout.startswith("Build everything")


def test_a_build_by_the_command_is_that_of_the_package(root: Path, tmp_path: Path) -> None:
    design = root / "designs" / "round-hinges.toml"
    assert run("build", str(design), "-o", str(tmp_path / "out"), "-q").returncode == 0
    files = {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()}
    assert files == sg.build(sg.Spec.from_toml(design)).files


def test_a_reader_that_leaves_ends_it_quietly(root: Path) -> None:
    sweep = [COMMAND, "sweep", str(root / "designs" / "paper-gripper.toml"), "--vary", "star.tube_width=10 mm..40 mm/200000"]
    with subprocess.Popen(sweep, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None and process.stderr is not None
        assert process.stdout.readline().startswith(b"row,")
        process.stdout.close()
        assert process.wait(timeout=60) == 0 and process.stderr.read() == b""


def test_ctrl_c_kills_it_as_it_kills_the_program(root: Path, tmp_path: Path) -> None:
    watch = [COMMAND, "build", str(root / "designs" / "paper-five-points.toml"), "--watch", "-o", str(tmp_path / "x")]
    process = subprocess.Popen(watch, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while not (tmp_path / "x").exists():
        assert process.poll() is None
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=30) == -signal.SIGINT
