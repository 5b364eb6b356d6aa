"""The exact geometry, and the polygons made of it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import stargrip_cam as sg


def area(points: "np.ndarray[tuple[int, int], np.dtype[np.float64]]") -> float:
    x, y = points.T
    return float(0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def test_the_papers_star_has_the_papers_arms(gripper: sg.Spec) -> None:
    design = sg.design(gripper)
    assert [star.index for star in design.stars] == [1, 2, 3]
    star = design.stars[0]
    assert star.points == 5 and star.corner_angle_deg == pytest.approx(30.0 + 72.0)
    assert star.arm_length_mm == pytest.approx(69.72, abs=0.005)
    arms = star.arms_mm
    assert arms.shape == (10, 4, 2)
    assert np.linalg.norm(arms[:, 1] - arms[:, 0], axis=1) == pytest.approx(star.arm_length_mm)
    assert np.linalg.norm(arms[:, 3] - arms[:, 0], axis=1) == pytest.approx(star.tube_width_mm)
    # Corner 1 lies on +X; its arc's centre is rho_0 + W + R_e away.
    assert star.corner_centers_mm[0] == pytest.approx([80.0, 0.0])
    assert np.hypot(*star.corner_centers_mm.T) == pytest.approx(80.0)


@settings(max_examples=20, deadline=None)
@given(points=st.integers(3, 5), radius=st.floats(0.5, 6.0), tolerance=st.floats(1e-4, 0.5))
def test_polygons_stay_within_their_tolerance(points: int, radius: float, tolerance: float) -> None:
    values = {"star.points": points, "star.tip_radius": f"{radius!r} mm", "star.corner_radius": f"{radius!r} mm"}
    star = sg.design(sg.Spec.starter("x").replace({**values, "inlet.none": True})).stars[0]
    for contour in (*star.outline, *star.seams):
        exact = contour.area_mm2
        assert contour.closed and exact is not None
        lost = abs(area(contour.points(tolerance)) - exact)
        assert lost <= tolerance * contour.length_mm
        # Losses of convex and concave arcs may cancel, so only the bound falls with the tolerance.
        fine = abs(area(contour.points(tolerance / 100)) - exact)
        assert fine <= tolerance / 100 * contour.length_mm + 1e-9 * exact


def test_exact_pieces_meet_and_measure_what_the_contour_says(gripper: sg.Spec) -> None:
    contour = sg.design(gripper).stars[0].seams[0]
    ends = zip(contour.segments, contour.segments[1:] + contour.segments[:1])
    assert all(math.dist(one.end, two.start) < 1e-9 for one, two in ends)
    lengths = [
        math.radians(abs(one.sweep_deg)) * one.radius_mm if isinstance(one, sg.Arc) else math.dist(one.start, one.end)
        for one in contour.segments
    ]
    assert sum(lengths) == pytest.approx(contour.length_mm, rel=1e-12)


def test_polygons_are_geojson(gripper: sg.Spec) -> None:
    star = sg.design(gripper).stars[0]
    edge, hole = star.__geo_interface__["coordinates"]
    assert star.__geo_interface__["type"] == "Polygon"
    assert edge[0] == edge[-1] and hole[0] == hole[-1]
    assert area(np.array(edge[:-1])) > 0 > area(np.array(hole[:-1]))
    sheets = area(np.array(edge[:-1])) + area(np.array(hole[:-1]))
    assert 2.0 * sheets == pytest.approx(star.fabric_mm2, rel=1e-3)
    outer = star.edges[1]
    assert not outer.closed and outer.area_mm2 is None, "open at the inlet"
    assert outer.__geo_interface__["type"] == "LineString"


def test_stars_lie_on_their_sheet(gripper: sg.Spec) -> None:
    design = sg.design(gripper)
    for star in design.stars:
        sheet = design.sheets[star.sheet - 1]
        edge = star.outline[0].points() @ star.placement[:, :2].T + star.placement[:, 2]
        assert edge.min() > 0 and edge[:, 0].max() < sheet["width_mm"] and edge[:, 1].max() < sheet["height_mm"]
    one = sg.Spec.starter("x")
    assert repr(design).endswith(": 3 stars, 1 sheet>") and repr(sg.design(one)) == '<Design "x": 1 star, 1 sheet>'
    assert (design._repr_svg_() or "").startswith("<?xml") or "<svg" in (design._repr_svg_() or "")
