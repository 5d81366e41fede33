"""Scans without noise: the axis of a cone is exact, and moves along with its points."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from midrib import tower_axis
from midrib.towers.simulate import Scan, Tower
from tests.towers.scans import CONE, offsets

EXACT = 1e-6  # metres


@pytest.mark.parametrize("mode", ["joint", "fan", "paper"])
@pytest.mark.parametrize("azimuth", [0.0, 70.0])
def test_axis_of_a_leaning_cone_is_exact(mode: Any, azimuth: float) -> None:
    scan = replace(CONE, tower=replace(CONE.tower, lean_azimuth=azimuth))
    axis = tower_axis(scan.points(), mode)
    away = offsets(axis, scan)
    assert np.isfinite(away).sum() >= 35
    assert np.nanmax(away) < EXACT
    assert axis.shape.text == "round"
    assert axis.kinks == []


@pytest.mark.parametrize("mode", ["fan", "paper"])
@pytest.mark.parametrize(
    "scan",
    [
        Scan(Tower(60.0, 3.0, 1.6, lean=0.08), count=200_000, seed=1),
        Scan(Tower(lean=0.16), count=300_000, seed=3),
    ],
)
def test_ends_of_a_leaning_cone_are_exact_or_have_no_answer(mode: Any, scan: Scan) -> None:
    """Near the top the nearest point of the other wall is its end."""
    axis = tower_axis(scan.points(), mode)
    assert axis.is_answered.sum() >= len(axis.levels) - 2
    assert np.nanmax(offsets(axis, scan)) < EXACT
    missing = axis.levels["flag"][~axis.is_answered]
    assert (missing != "").all()


def test_radius_of_a_cone_is_exact() -> None:
    axis = tower_axis(CONE.points())
    # The radius is that of the section through the centre, at its arc length along the axis.
    expected = CONE.tower.radius(axis.levels["z"])
    assert axis.levels["radius"] == pytest.approx(expected, abs=1e-5)


def test_curve_from_one_wall_is_off_by_the_squared_sine_of_the_taper() -> None:
    tower = Tower(height=40.0, base_radius=4.0, top_radius=2.0)
    axis = tower_axis(Scan(tower, count=60_000, seed=3).points(), "paper")
    squared_sine = np.sin(np.arctan(2.0 / 40.0)) ** 2
    for plane in axis.steps["planes"]:
        for curve, sign in ((plane.from_main, -1.0), (plane.from_auxiliary, 1.0)):
            u, s = curve[10:-10].T
            radius = axis.cells.reference.at(s)[:, 2]
            centre = np.interp(s, plane.same_height[:, 1], plane.same_height[:, 0])
            # r is the radius where the middle is; the wall is met a little higher or lower.
            assert (u - centre) / (radius * squared_sine) == pytest.approx(sign, abs=0.01)


def test_axis_moves_along_with_the_points() -> None:
    points = CONE.points()
    shift = np.array([6_482_000.0, 5_617_000.0, 150.0])
    usual, moved = tower_axis(points), tower_axis(points + shift)
    assert len(usual.levels) == len(moved.levels)
    for name, by in zip("xyz", shift, strict=True):
        assert moved.levels[name] - by == pytest.approx(usual.levels[name], abs=1e-6)


def test_axis_turns_along_with_the_points() -> None:
    points, angle = CONE.points(), np.radians(37.0)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    turned = points.copy()
    turned[:, :2] = points[:, :2] @ turn.T
    one, other = tower_axis(points), tower_axis(turned)
    assert other.points[:, :2] == pytest.approx(one.points[:, :2] @ turn.T, abs=1e-6)
    assert (one.summary.azimuth - other.summary.azimuth) % 360.0 == pytest.approx(37.0, abs=1e-3)


def test_feet_give_the_same_axis_as_metres() -> None:
    points, feet = CONE.points(), 1.0 / 0.3048
    metres, other = tower_axis(points), tower_axis(feet * points, unit=feet)
    assert other.points == pytest.approx(feet * metres.points, abs=1e-5)
    assert other.summary.slope == pytest.approx(metres.summary.slope, abs=1e-4)


def test_bend_and_kinks_are_followed() -> None:
    tower = Tower(height=40.0, base_radius=2.5, top_radius=1.5, bend=0.02, kink=2.0)
    scan = Scan(tower, count=100_000, seed=3)
    axis = tower_axis(scan.points())
    assert np.nanmax(offsets(axis, scan)) < 1e-3
    sharp = tower.kinks[0][np.hypot(*tower.kinks[1].T) > 1.2e-3]
    found = np.array([kink.z for kink in axis.kinks])
    assert all(np.abs(found - z).min() <= 1.5 for z in sharp)
    assert axis.offsets == []
