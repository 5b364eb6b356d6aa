"""Cost of the package beside the computation: `python overhead.py` prints docs/python.md's table. It is no test: times vary.

Single calls with and without Python alternate, and the shortest of each kind counts, because other programs on the machine disturb
it least. `_native.repeat` is the computation alone.
"""

from __future__ import annotations

import time
from pathlib import Path

import stargrip_cam as sg
from stargrip_cam import _native

DESIGNS = Path(__file__).resolve().parents[2] / "designs"
SPEC = sg.Spec.from_toml(DESIGNS / "paper-five-points.toml")
# With a pressure, so that every row is computed by `section`.
GRIPPER = sg.Spec.from_toml(DESIGNS / "paper-gripper.toml")
ROUNDS = 5000


def main() -> None:
    """Measures and prints."""
    said = sg.predict(SPEC, model="ring")
    calls = {
        "alone": lambda: _native.repeat(SPEC, "ring", 1),
        "call": lambda: sg.predict(SPEC, model="ring"),
        "first": lambda: sg.predict(SPEC, model="ring").final_radius_mm,
        "other": lambda: said.final_radius_mm,
        "dict": said.to_dict,
    }
    us = dict.fromkeys(calls, float("inf"))
    for _ in range(ROUNDS):
        for name, call in calls.items():
            began = time.perf_counter_ns()
            call()
            us[name] = min(us[name], 1e-3 * (time.perf_counter_ns() - began))
    print("| what | time |\n|---|---|")
    print(f"| `predict(spec, model=\"ring\")`, the computation alone | {us['alone']:.0f} us |")
    print(f"| the call, and its first attribute read | {us['first']:.0f} us |")
    print(f"| what the call adds | {us['call'] - us['alone']:.1f} us |")
    print(f"| what the first attribute adds | {us['first'] - us['call']:.1f} us |")
    print(f"| every other attribute | {us['other']:.1f} us |")
    print(f"| `to_dict()` | {us['dict']:.1f} us |")
    began = time.process_time(), time.perf_counter()
    columns = sg.sweep(GRIPPER, {"star.tube_width": "10 mm..40 mm/1000", "star.tip_angle": "10 deg..60 deg/1000"})
    took = time.process_time() - began[0], time.perf_counter() - began[1]
    size = f"{len(columns['row']):,} designs into {len(columns)} arrays"
    print(f"| `sweep` of {size}, on the clock | {took[1]:.1f} s |")
    print(f"| the same, of all threads together | {took[0]:.1f} s |")


if __name__ == "__main__":
    main()
