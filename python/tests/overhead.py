"""What the package costs beside the computation: `python overhead.py` prints docs/python.md's table. No test: times vary.

The computation alone is timed in the same process; calls with and without Python alternate, and the least difference of their means counts,
which other programs on the machine disturb least.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Callable

import stargrip_cam as sg
from stargrip_cam import _native

SPEC = sg.Spec.from_toml(Path(__file__).resolve().parents[2] / "designs" / "paper-gripper.toml")
CALLS, ROUNDS = 500, 20


def mean(call: Callable[[], object]) -> float:
    """Seconds of `call`."""
    began = time.perf_counter()
    for _ in range(CALLS):
        call()
    return (time.perf_counter() - began) / CALLS


def main() -> None:
    """Measures and prints."""
    ask = lambda: sg.predict(SPEC, model="ring")  # noqa: E731
    rounds = [(_native.seconds_alone(SPEC, "ring", CALLS), mean(ask)) for _ in range(ROUNDS)]
    alone = min(alone for alone, _ in rounds)
    whole = min(whole for _, whole in rounds)
    said = ask()
    attribute, everything = (min(mean(of) for _ in range(ROUNDS)) for of in (lambda: said.final_radius_mm, said.to_dict))
    first = min(mean(lambda: ask().final_radius_mm) for _ in range(ROUNDS)) - whole
    print(f"| `predict(spec, model=\"ring\")`, the computation alone | {1e6 * alone:.1f} us |")
    print(f"| what the call adds to it | {1e6 * (whole - alone):.1f} us |")
    print(f"| the first attribute of a prediction | {1e6 * first:.1f} us |")
    print(f"| every other attribute | {1e6 * attribute:.2f} us |")
    print(f"| `to_dict()` | {1e6 * everything:.1f} us |")
    began = time.perf_counter()
    columns = sg.sweep(SPEC, {"star.tube_width": "10 mm..40 mm/1000", "star.tip_angle": "10 deg..60 deg/1000"})
    spent = time.perf_counter() - began
    print(f"| `sweep` of {len(columns['row']):,} designs into {len(columns)} arrays, all cores | {spent:.1f} s |")


if __name__ == "__main__":
    main()
