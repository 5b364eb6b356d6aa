"""The line of `progress=True`, which shows the progress of a call."""

from __future__ import annotations

import sys
import time


class Line:
    """A line on standard error, which a notebook shows below its cell; every call overwrites it, the last one clears it."""

    def __init__(self) -> None:
        self._began = time.monotonic()

    def __call__(self, part: float, what: str) -> None:
        if part >= 1.0:
            text = ""
        elif part > 0.0:
            left = (time.monotonic() - self._began) * (1.0 - part) / part
            text = f"{part:4.0%}  {what}, about {left:.0f} s left"
        else:
            text = what
        print(f"\r{text:<60.60}", end="\r" if part >= 1.0 else "", file=sys.stderr, flush=True)
