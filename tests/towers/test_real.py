"""Real clouds: a steel tank by total station, a pine stem by laser scanner."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from midrib import tower_axis
from midrib.errors import ParameterError
from midrib.formats.clouds import open_cloud
from midrib.types import Floats

DATA = Path(__file__).parents[3] / "shared" / "data"
TANK, STEM = "pc_steel_tank_total_station.csv", "pc_pine_stem_tls.laz"
pytestmark = [
    pytest.mark.shared,
    pytest.mark.skipif(not DATA.is_dir(), reason="no shared test data beside the project"),
]


def points_of(name: str) -> Floats:
    """Points of a file."""
    return np.concatenate(list(open_cloud(DATA / name).chunks()))


@pytest.mark.parametrize(("name", "most"), [(TANK, 0.005), (STEM, 0.010)])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_axis_stays_when_half_of_the_points_are_dropped(name: str, most: float, seed: int) -> None:
    points = points_of(name)
    whole = tower_axis(points, step=1.0).levels
    kept = points[np.random.default_rng(seed).random(len(points)) < 0.5]
    half = tower_axis(kept, step=1.0).levels
    z, one, other = np.intersect1d(whole["z"], half["z"], return_indices=True)
    off = np.hypot(whole["x"][one] - half["x"][other], whole["y"][one] - half["y"][other])
    known = np.isfinite(off)
    assert known.sum() >= 10
    assert z.size >= 10
    assert np.sqrt(np.mean(off[known] ** 2)) < most


def test_control_points_do_not_count() -> None:
    points = points_of(TANK)
    near = np.hypot(points[:, 0] - 37.34, points[:, 1] - 25.70) < 7.8
    one, other = tower_axis(points, step=1.0), tower_axis(points[near], step=1.0)
    z, i, j = np.intersect1d(one.levels["z"], other.levels["z"], return_indices=True)
    off = np.hypot(
        one.levels["x"][i] - other.levels["x"][j], one.levels["y"][i] - other.levels["y"][j]
    )
    assert z.size >= 10
    assert np.nanmax(off) < 0.003
    assert np.nanmedian(one.levels["radius"]) == pytest.approx(7.585, abs=0.005)


@pytest.mark.parametrize("name", ["pc_street_poles.ply"])
def test_a_street_is_no_tower(name: Any) -> None:
    with pytest.raises(ParameterError, match="no tower was found"):
        tower_axis(DATA / name)
