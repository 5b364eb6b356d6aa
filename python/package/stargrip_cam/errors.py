"""Exceptions of this package. Each is an `Error` with code, key, line, the found value and the allowed values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

__all__ = ["DesignError", "Error", "Fault", "PredictionError", "ProofError", "PublishError", "SpecError", "UsageError"]


@dataclass(frozen=True)
class Fault:
    """One fault at one place."""

    code: str
    """A word for scripts, such as "out-of-range"; `stargrip-cam explain CODE` prints its meaning."""
    found: str
    """The found value, as a sentence."""
    key: str | None = None
    """The key to change, "star.points"; the section of a missing key; None without a key."""
    line: int | None = None
    """Line of the text or the file, from 1; None without a line."""
    file: str | None = None
    """The file, or the name of the text."""
    allowed: str | None = None
    """The allowed values."""
    help: str | None = None
    """The remedy."""


class Error(Exception):
    """A refusal by this package. Its own attributes are those of the first of its `faults`; its text contains all of them."""

    faults: tuple[Fault, ...]
    """All faults, in the order of the text."""

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
        """Code of the first fault, for scripts."""
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
        """The found value of the first fault."""
        return self._first.found if self._first else None

    @property
    def allowed(self) -> str | None:
        """The allowed values of the first fault."""
        return self._first.allowed if self._first else None


class SpecError(Error):
    """An invalid spec or machine profile: all of its faults at once."""


class DesignError(Error):
    """A valid spec without a possible gripper, or a gripper that does not meet its own `[load]`."""


class PredictionError(Error):
    """A model that has no answer for this gripper."""


class ProofError(Error):
    """Files that disagree with the design. The faults are findings, with file and line."""


class PublishError(Error):
    """A directory that could not be written; it is unchanged."""


class UsageError(Error, ValueError):
    """Wrong arguments, or arguments that exclude each other."""
