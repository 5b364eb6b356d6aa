"""Sweeps: rows do not depend on how they are computed, and equal single predictions."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import stargrip_cam as sg

VARY = {"star.points": [3, 4, 5, 9], "star.tube_width": "20 mm..40 mm/7", "load.pressure": ["20 kPa", "0.4 bar"]}


@pytest.fixture(scope="module")
def whole(gripper: sg.Spec) -> dict[str, np.ndarray]:
    return sg.sweep(gripper, VARY)


def test_columns_are_arrays_of_all_rows(whole: dict[str, np.ndarray]) -> None:
    assert {len(column) for column in whole.values()} == {4 * 7 * 2}
    assert np.array_equal(whole["row"], np.arange(56)) and whole["row"].dtype == np.int64
    assert np.array_equal(whole["load.pressure_kPa"], np.tile([20.0, 40.0], 28))
    assert np.array_equal(np.unique(whole["star.points"]), [3, 4, 5, 9])
    refused = whole["refused"] != None  # noqa: E711
    assert 0 < refused.sum() < 56 and np.array_equal(refused, np.isnan(whole["arm_length_mm"]))
    assert all("star.points" in text or "arms" in text for text in whole["refused"][refused])


def test_a_row_is_what_a_prediction_says(gripper: sg.Spec, whole: dict[str, np.ndarray]) -> None:
    row = 2 * 14 + 3
    values = {"star.points": 5, "star.tube_width": f"{float(whole['star.tube_width_mm'][row])!r} mm",
              "load.pressure": "40 kPa"}
    said = sg.predict(gripper.replace(values))
    for name in ("final_radius_mm", "contraction", "radial_stiffness_N_per_m", "object_force_N", "payload_kg", "bendability"):
        assert whole[name][row] == pytest.approx(getattr(said, name), rel=1e-9), name


@settings(max_examples=10, deadline=None)
@given(parts=st.integers(1, 60), threads=st.integers(1, 3))
def test_parts_join_to_the_whole(parts: int, threads: int) -> None:
    spec = sg.Spec.starter("x").replace({"load.pressure": "37 kPa"})
    whole = sg.sweep(spec, VARY)
    pieces = [sg.sweep(spec, VARY, part=(k, parts), threads=threads) for k in range(1, parts + 1)]
    for name, column in whole.items():
        joined = np.concatenate([piece[name] for piece in pieces if name in piece])
        assert column.dtype == joined.dtype and list(map(repr, column)) == list(map(repr, joined)), name


def test_outputs_are_chosen_and_unknown_ones_refused(gripper: sg.Spec) -> None:
    some = sg.sweep(gripper, {"star.points": [4, 5]}, outputs=["final_radius_mm"])
    assert {"row", "star.points", "final_radius_mm", "refused"} <= set(some) and "contraction" not in some
    with pytest.raises(sg.SpecError):
        sg.sweep(gripper, {"star.points": [4, 5]}, outputs=["final_raduis_mm"])


def test_a_study_file_is_a_sweep(gripper: sg.Spec) -> None:
    text = 'schema = 1\nspec = "x.toml"\n[vary]\nstar.points = [4, 5]\n'
    by_file, by_dict = sg.sweep(gripper, study=text), sg.sweep(gripper, {"star.points": [4, 5]})
    assert list(by_file) == list(by_dict)
    assert all(list(map(repr, by_file[name])) == list(map(repr, by_dict[name])) for name in by_dict)
