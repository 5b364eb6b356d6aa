"""Fixtures of all tests: the project's designs."""

from __future__ import annotations

from pathlib import Path

import pytest

import stargrip_cam as sg

ROOT = Path(__file__).resolve().parents[2]
DESIGNS = sorted((ROOT / "designs").glob("*.toml"))


@pytest.fixture(scope="session")
def root() -> Path:
    """The project's directory."""
    return ROOT


@pytest.fixture(scope="session")
def gripper() -> sg.Spec:
    """The paper's gripper: three stars, with a load."""
    return sg.Spec.from_toml(ROOT / "designs" / "paper-gripper.toml")


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Every test that takes a `shipped` design is run with each."""
    if "shipped" in metafunc.fixturenames:
        metafunc.parametrize("shipped", DESIGNS, ids=lambda path: path.stem)
