"""Proofs of published directories."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Callable

from stargrip_cam import _native
from stargrip_cam.errors import Fault


@dataclass(frozen=True)
class Proof:
    """Result of reading a directory back.

    It is true if there is no finding and this version wrote the directory. A directory of another version is read back, but not
    compared with that version's output, so the proof is weaker: `not proof.findings` accepts it, as `verify --read-back` does.
    """

    findings: tuple[Fault, ...]
    """All differences from the directory's own spec, with file and line."""
    deviation_mm: dict[str, float | None]
    """Largest deviation of each file from the exact design, mm; None if it was not measured."""
    proven: dict[str, str]
    """Method of proof of each file: "bytes", "reading" or "hash"."""
    written_by: str | None = None
    """The version that wrote the directory, if it is not this one; else None."""
    unproven: tuple[str, ...] = ()
    """Files and figures of another version's directory that differ from this version's and that no reader judges as a whole."""

    def __bool__(self) -> bool:
        return not self.findings and self.written_by is None


def verify(path: str | os.PathLike[str], *, progress: bool | Callable[[float, str], object] | None = None) -> Proof:
    """Proves the build in the directory `path` from its own spec and machine profile, as the command `verify` does.

    Raises OSError if there is no such directory, Error if it cannot be read. A fault in it is a finding, not an exception.
    """
    # Python's own exceptions, as for a missing spec file; to `stat` a number would be an open file.
    directory = os.fspath(path)
    os.stat(directory)
    said: dict[str, Any] = _native.prove(directory, progress)
    return Proof(
        findings=tuple(Fault(**finding) for finding in said["findings"]),
        deviation_mm=dict(said["deviation_mm"]),
        proven={one["path"]: one["by"] for one in said["proven"]},
        written_by=said["written_by"],
        unproven=tuple(said["unproven"]),
    )
