"""The rest of an interrupted job."""

from __future__ import annotations

from dataclasses import dataclass

from stargrip_cam import _native


@dataclass(frozen=True)
class Resumed:
    """A program for the rest of an interrupted job."""

    program: str
    """The program. Same sheet, same zero, and the iron above the fabric when it starts."""
    line: int
    """Line of the old program in which the iron comes into contact again, from 1."""
    done: float
    """Part of the whole job's time that was over at the stop, 0 to 1."""
    overlap_mm: float
    """Length that is sealed twice, mm."""
    remaining_s: float
    """Time of the program, without heating and pauses, s."""


def resume(
    program: str | bytes,
    spec: _native.Spec | None = None,
    *,
    line: int | None = None,
    at: str | None = None,
    near: str | None = None,
    overlap: str | None = None,
) -> Resumed:
    """The rest of the interrupted sealing program with the text `program`. Give one place: `line`, `at` or `near`.

    spec: the spec of the job, whose clamps the rest must not meet; without it they are unknown.
    line: the line that was running, from 1.
    at: the elapsed part of the whole job's time, as the program shows it: "37%"; or the time since the program
        began: "1 h 20 min".
    near: a point near which the iron stopped, from the sheet's lower left corner: "120.5 mm,80 mm".
    overlap: length to seal again before the stop, "5 mm"; default: the overlap of the closures.

    Raises Error if the text is no sealing program of this package, or was changed; UsageError for wrong arguments.
    """
    text = program.decode() if isinstance(program, bytes) else program
    return Resumed(*_native.rest(text, spec, line=line, at=at, near=near, overlap=overlap))
