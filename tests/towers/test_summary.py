"""The axis as a whole: best line, straightness, kinks."""

from dataclasses import replace

import numpy as np
import pytest

from midrib.towers.cloud import ArrayCloud
from midrib.towers.pipeline import Options, axis_of
from midrib.towers.records import TowerAxis
from midrib.towers.simulate import Scan, Tower

KINKED = Tower(height=60.0, base_radius=2.5, top_radius=1.5, kink=8.0, kink_spacing=20.0, seed=2)
USUAL = Scan(KINKED, count=150_000, noise=(0.002, 0.004), seed=7)


def axis_from(tower: Tower, **options: float) -> TowerAxis:
    """Axis of a scan of a tower."""
    return axis_of(ArrayCloud(replace(USUAL, tower=tower).points()), Options(**options))  # type: ignore[arg-type]


def test_summary_and_kinks_do_not_depend_on_what_moves_all_levels_together() -> None:
    plain = axis_from(KINKED)
    told = axis_from(KINKED, registration=0.003, levelling=0.1)
    assert plain.kinks
    assert told.kinks == plain.kinks
    assert told.summary == plain.summary
    assert (told.levels["sigma"] > 0.0025).all()
    assert plain.levels["sigma_inner"] == pytest.approx(plain.levels["sigma"], rel=1e-12)


@pytest.mark.parametrize("bend", [0.0, 0.02])
def test_a_small_kink_is_found_under_noise_beside_a_bend(bend: float) -> None:
    """A millimetre a metre, noise of 4 mm: two straight lines would tell it to 0.05 mm/m."""
    unit = Tower(60.0, 2.5, 1.5, lean=0.1, bend=bend, kink=1.0, kink_spacing=30.0, seed=5)
    tower = replace(unit, kink=1e-3 / float(np.hypot(*unit.kinks[1][0])))
    axis = axis_from(tower)
    (kink,) = axis.kinks
    assert kink.z == pytest.approx(30.0, abs=1.0)
    assert kink.turn == pytest.approx(1.0, abs=0.2)
    assert 0.0 < kink.sigma < 0.1
    x, y = tower.kinks[1][0]
    assert kink.azimuth == pytest.approx(np.degrees(np.arctan2(x, y)) % 360.0, abs=10.0)
    assert axis_from(replace(tower, kink=0.0)).kinks == []


@pytest.mark.parametrize("bend", [0.1, 0.3, 0.6])
def test_a_smooth_bend_has_no_kinks(bend: float) -> None:
    assert axis_from(Tower(height=100.0, bend=bend)).kinks == []


def test_kinks_stay_and_are_where_they_are() -> None:
    tower = Tower(height=100.0, kink=6.0, kink_spacing=20.0, bend=0.03, seed=1)
    at, turns = tower.kinks
    kinks = axis_from(tower).kinks
    assert [kink.z for kink in kinks] == pytest.approx(at, abs=1.0)
    size = 1e3 * np.hypot(*turns.T)
    assert [kink.turn for kink in kinks] == pytest.approx(size, rel=0.15)
