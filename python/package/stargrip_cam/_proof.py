"""Proofs of published directories."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Callable

from stargrip_cam import _native
from stargrip_cam.errors import Fault


@dataclass(frozen=True)
class Proof:
    """What reading a directory back has come to.

    It is true if nothing was found wrong and this version wrote the directory. One of another version is read back, not compared
    with what that version makes, so it proves less: `not proof.findings` accepts it, as `verify --read-back` does.
    """

    findings: tuple[Fault, ...]
    """Everything that is not as the directory's own spec asks for, with file and line."""
    deviation_mm: dict[str, float | None]
    """Of every file how far it is from the exact design at most, mm; None where nothing was measured."""
    proven: dict[str, str]
    """Of every file by what it was proven: "bytes", "reading" or "hash"."""
    written_by: str | None = None
    """The version that wrote the directory, if it is not this one; else None."""
    unproven: tuple[str, ...] = ()
    """Files and figures of another version's directory that differ from this version's and that no reader judges as a whole."""

    def __bool__(self) -> bool:
        return not self.findings and self.written_by is None


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
        written_by=said["written_by"],
        unproven=tuple(said["unproven"]),
    )
