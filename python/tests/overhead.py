"""What the package costs beside the computation: `python overhead.py` prints docs/python.md's table. No test: times vary.

Times are the processor's, so that other programs on the machine count little; calls with and without Python alternate, and of each
the least mean holds. `_native.repeat` is the computation alone.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Callable

import stargrip_cam as sg
from stargrip_cam import _native

SPEC = sg.Spec.from_toml(Path(__file__).resolve().parents[2] / "designs" / "paper-gripper.toml")
CALLS, ROUNDS = 200, 30


def spent(call: Callable[[], object]) -> float:
    """Seconds of the processor for `call`."""
    began = time.thread_time()
    call()
    return time.thread_time() - began


def mean(call: Callable[[], object]) -> Callable[[], float]:
    """What measures one of many calls of `call`."""

    def many() -> None:
        for _ in range(CALLS):
            call()

    return lambda: spent(many) / CALLS


def main() -> None:
    """Measures and prints."""
    said = sg.predict(SPEC, model="ring")
    measured = {
        "alone": lambda: spent(lambda: _native.repeat(SPEC, "ring", CALLS)) / CALLS,
        "call": mean(lambda: sg.predict(SPEC, model="ring")),
        "first": mean(lambda: sg.predict(SPEC, model="ring").final_radius_mm),
        "other": mean(lambda: said.final_radius_mm),
        "dict": mean(said.to_dict),
    }
    least = dict.fromkeys(measured, float("inf"))
    for _ in range(ROUNDS):
        for name, measure in measured.items():
            least[name] = min(least[name], measure())
    us = {name: 1e6 * seconds for name, seconds in least.items()}
    print("| what | processor time |\n|---|---|")
    print(f"| `predict(spec, model=\"ring\")`, the computation alone | {us['alone']:.0f} us |")
    print(f"| what the call adds to it | {us['call'] - us['alone']:.1f} us |")
    print(f"| its first attribute | {us['first'] - us['call']:.1f} us |")
    print(f"| every other attribute | {us['other']:.2f} us |")
    print(f"| `to_dict()` | {us['dict']:.1f} us |")
    began = time.process_time(), time.perf_counter()
    columns = sg.sweep(SPEC, {"star.tube_width": "10 mm..40 mm/1000", "star.tip_angle": "10 deg..60 deg/1000"})
    took = time.process_time() - began[0], time.perf_counter() - began[1]
    size = f"{len(columns['row']):,} designs into {len(columns)} arrays"
    print(f"| `sweep` of {size}, all threads together | {took[0]:.1f} s ({took[1]:.1f} s on the clock) |")


if __name__ == "__main__":
    main()
