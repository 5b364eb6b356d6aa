"""What this package raises. Every exception is an `Error` and says code, key, line, what was found and what is allowed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

__all__ = ["DesignError", "Error", "Fault", "PredictionError", "ProofError", "PublishError", "SpecError", "UsageError"]


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong, at one place."""

    code: str
    """A word for scripts, such as "out-of-range"; `stargrip-cam explain CODE` says more."""
    found: str
    """What was found."""
    key: str | None = None
    """The key that is best changed, "star.points"; its section where a key is missing; None if it is about none."""
    line: int | None = None
    """Line of the text or the file, from 1; None if it is about none."""
    file: str | None = None
    """The file, or the name of the text."""
    allowed: str | None = None
    """What would be right."""
    help: str | None = None
    """What to do about it."""


class Error(Exception):
    """Anything this package refuses. Its own attributes are those of the first of its `faults`; its text says all of them."""

    faults: tuple[Fault, ...]
    """Everything that is wrong, in the order of the text."""

    def __init__(self, text: str, faults: Sequence[Mapping[str, Any]] = ()) -> None:
        super().__init__(text)
        self.faults = tuple(Fault(**fault) for fault in faults)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self), [vars(fault) for fault in self.faults])

    @property
    def _first(self) -> Fault | None:
        return self.faults[0] if self.faults else None

    @property
    def code(self) -> str | None:
        """Word of the first fault for scripts."""
        return self._first.code if self._first else None

    @property
    def key(self) -> str | None:
        """Key of the spec at which the first fault points."""
        return self._first.key if self._first else None

    @property
    def line(self) -> int | None:
        """Line of the first fault, from 1."""
        return self._first.line if self._first else None

    @property
    def found(self) -> str | None:
        """What was found first."""
        return self._first.found if self._first else None

    @property
    def allowed(self) -> str | None:
        """What would be right there."""
        return self._first.allowed if self._first else None


class SpecError(Error):
    """A spec or a machine profile that is refused: all of its faults at once."""


class DesignError(Error):
    """A valid spec of which there is no gripper, or one that does not do what its own `[load]` asks."""


class PredictionError(Error):
    """A model that has no answer for this gripper."""


class ProofError(Error):
    """Files that do not say what the design says. Its faults are findings, with file and line."""


class PublishError(Error):
    """A directory that could not be written as a whole; it is as it was."""


class UsageError(Error, ValueError):
    """Arguments that are wrong, or do not go together."""
