"""Long calls let other threads run, and end at Ctrl-C."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time

import pytest

import stargrip_cam as sg

SLOW = """
import sys, time
import stargrip_cam as sg
spec = sg.Spec.starter("x").replace({"load.pressure": "37 kPa"})
print("ready", flush=True)
began = time.monotonic()
try:
    CALL
except KeyboardInterrupt:
    print("stopped", flush=True)
    sys.exit(7)
"""
CALLS = {
    "shell": 'sg.predict(spec, model="shell", fineness="fine")',
    "sweep": 'sg.sweep(spec, {"star.tube_width": "10 mm..40 mm/10000", "star.tip_angle": "10 deg..60 deg/10000"})',
}


def test_another_thread_goes_on_during_a_long_call(gripper: sg.Spec) -> None:
    ticks, stop = [0], threading.Event()

    def tick() -> None:
        while not stop.wait(0.001):
            ticks[0] += 1

    other = threading.Thread(target=tick)
    other.start()
    began = time.monotonic()
    sg.predict(gripper, model="shell", fineness="coarse")
    spent = time.monotonic() - began
    counted = ticks[0]
    stop.set()
    other.join()
    # A held GIL would leave the other thread no time at all.
    assert spent > 0.2 and counted > 20 * spent


def test_short_calls_give_the_same_in_many_threads(gripper: sg.Spec) -> None:
    expected = sg.predict(gripper).to_dict()
    found: list[object] = []

    def ask() -> None:
        for _ in range(20):
            found.append(sg.predict(gripper).to_dict())

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 80 and all(one == expected for one in found)


@pytest.mark.parametrize("call", CALLS)
def test_ctrl_c_ends_a_long_call_soon(call: str) -> None:
    process = subprocess.Popen([sys.executable, "-c", SLOW.replace("CALL", CALLS[call])], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "ready\n"
    time.sleep(1.0)
    assert process.poll() is None, "it is not long"
    pressed = time.monotonic()
    process.send_signal(signal.SIGINT)
    rest, _ = process.communicate(timeout=60)
    assert (process.returncode, rest) == (7, "stopped\n")
    assert time.monotonic() - pressed < 5.0


def test_what_progress_raises_ends_the_call(gripper: sg.Spec) -> None:
    def enough(part: float, what: str) -> None:
        raise LookupError(what)

    with pytest.raises(LookupError):
        sg.predict(gripper, model="shell", fineness="coarse", progress=enough)
    with pytest.raises(TypeError):
        sg.predict(gripper, model="shell", fineness="coarse", progress=3)  # type: ignore[arg-type]


def test_the_line_of_progress_is_cleared(gripper: sg.Spec, capsys: pytest.CaptureFixture[str]) -> None:
    sg.build(gripper, only=["seal-gcode"], progress=True)
    said = capsys.readouterr().err
    assert "design" in said and said.endswith("\r" + " " * 60 + "\r")
