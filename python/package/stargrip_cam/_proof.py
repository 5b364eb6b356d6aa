"""Proofs of published directories."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Callable

from stargrip_cam import _native
from stargrip_cam.errors import Fault


@dataclass(frozen=True)
class Proof:
    """What reading a directory back has come to. It is true if nothing was found wrong."""

    findings: tuple[Fault, ...]
    """Everything that is not as the directory's own spec asks for, with file and line."""
    deviation_mm: dict[str, float | None]
    """Of every file how far it is from the exact design at most, mm; None where nothing was measured."""
    proven: dict[str, str]
    """Of every file by what it was proven: "bytes", "reading" or "hash"."""

    def __bool__(self) -> bool:
        return not self.findings


def verify(path: str | os.PathLike[str], *, progress: bool | Callable[[float, str], object] | None = None) -> Proof:
    """Proves the build in the directory `path` from its own spec and machine profile, as the command `verify` does.

    Raises OSError if there is no such directory, Error if it cannot be read. What is wrong in it is a finding, not an exception.
    """
    # Python's own exception, as for a spec's file that does not exist.
    os.stat(path)
    said: dict[str, Any] = _native.prove(os.fspath(path), progress)
    return Proof(
        findings=tuple(Fault(**finding) for finding in said["findings"]),
        deviation_mm=dict(said["deviation_mm"]),
        proven={one["path"]: one["by"] for one in said["proven"]},
    )
