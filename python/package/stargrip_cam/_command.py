"""The command `stargrip-cam`: the same code as the program that cargo builds, in this process."""

from __future__ import annotations

import signal
import sys

from stargrip_cam import _native


def main() -> int:
    """Runs the command with this process's arguments and returns its exit code."""
    # Python would only record a Ctrl-C and continue. The command itself ends, or catches it during a long computation.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.run(["stargrip-cam", *sys.argv[1:]], _native.__file__ or "")
