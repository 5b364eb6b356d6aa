"""The code in docs/python.md and in the package's docstring runs unchanged, from top to bottom."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

import stargrip_cam as sg


def test_the_tour_runs(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "designs").symlink_to(root / "designs")
    blocks = re.findall(r"```python\n(.*?)```", (root / "docs" / "python.md").read_text(), re.DOTALL)
    assert len(blocks) >= 8
    names: dict[str, object] = {}
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), names)  # noqa: S102
    assert (tmp_path / "out" / "my-gripper" / "manifest.json").is_file()


def test_the_example_of_the_package_says_what_it_says() -> None:
    tried = doctest.testmod(sg)
    assert tried.attempted >= 3 and tried.failed == 0
