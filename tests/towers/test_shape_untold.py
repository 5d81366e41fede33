"""Shells of which a part is seen: there an oval looks like a circle that is elsewhere."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from midrib import tower_axis
from midrib.towers.gate import lure_of_an_oval
from midrib.towers.simulate import Scan, Tower
from midrib.types import Floats
from tests.towers.scans import offsets


def seen_over(arc: float, oval: float) -> Scan:
    tower = Tower(height=40.0, base_radius=3.0, top_radius=2.0, lean=0.1, oval=oval, twist=20.0)
    return Scan(tower, count=80_000, noise=(0.002, 0.004), seed=9001, arc=(0.0, arc))


@pytest.mark.parametrize("arc", [220.0, 260.0])
def test_an_oval_seen_in_part_has_flags_and_an_honest_sigma(arc: float) -> None:
    scan = seen_over(arc, 0.01)
    levels = (axis := tower_axis(scan.points())).levels
    away = offsets(axis, scan)
    assert np.nanmax(away) > 5e-3  # the oval does draw the centre aside
    assert not (away[levels["flag"] == ""] > 5e-3).any()
    off = np.column_stack([levels["x"], levels["y"]]) - scan.axis(levels["z"])
    half = 1.96 * np.column_stack([levels["sigma_x"], levels["sigma_y"]])
    assert np.mean(np.abs(off) <= half) > 0.9


def test_a_round_tower_seen_in_part_is_useful_and_says_why_it_is_flagged() -> None:
    scan = seen_over(220.0, 0.0)
    axis = tower_axis(scan.points())
    flags = axis.levels["flag"][axis.is_answered]
    assert axis.is_answered.mean() > 0.95
    assert np.nanmax(offsets(axis, scan)) < 1e-3
    assert (np.char.count(flags, "shape not verified: 2") == 1).all()
    assert np.nanmax(axis.levels["sigma"]) < 0.02


def circle_of(oval: Floats, angle: Floats) -> Floats:
    """Centre of the circle nearest to points at distances 1 + ``oval``, not linearised."""
    points = (1.0 + oval)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    found = least_squares(lambda c: np.hypot(*(points - c[:2]).T) - c[2], [0.0, 0.0, 1.0])
    return np.asarray(found.x[:2])


@pytest.mark.parametrize("arc", [120, 220, 280, 360])
def test_lure_is_what_circle_fits_to_ovals_do(arc: int) -> None:
    angle = np.radians(np.arange(0.0, arc, 5.0))
    turns = np.radians(np.arange(0.0, 180.0, 10.0))
    moved = [circle_of(1e-4 * np.cos(2.0 * (angle - turn)), angle) / 1e-4 for turn in turns]
    assert lure_of_an_oval(angle) == pytest.approx(np.std(moved, axis=0), abs=0.02)


def test_low_towers_seen_all_round_are_verified() -> None:
    scan = Scan(Tower(height=8.0, base_radius=1.0, top_radius=0.8), count=60_000, seed=3)
    axis = tower_axis(scan.points())
    assert axis.shape.name == "round"
    assert (axis.levels["flag"] == "").all()
