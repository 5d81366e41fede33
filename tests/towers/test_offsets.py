"""Steps of an axis, as between two casting lifts: told, followed, and kept apart from kinks."""

from dataclasses import replace

import numpy as np
import pytest

from midrib import tower_axis
from midrib.towers.simulate import Scan, Tower
from tests.towers.scans import offsets

STEP = 0.008
TOWER = Tower(40.0, 2.5, 1.5, lean=0.1, offset=STEP, offset_height=22.2, seed=5)


def scan_of(tower: Tower) -> Scan:
    return Scan(tower, count=100_000, noise=(0.002, 0.004), outliers=0.01, seed=5)


@pytest.mark.parametrize(
    "tower",
    [TOWER, replace(TOWER, form_error=0.003), replace(TOWER, faces=4), replace(TOWER, oval=0.01)],
    ids=["round", "rough", "square", "oval"],
)
def test_an_offset_is_told_and_followed(tower: Tower) -> None:
    scan = scan_of(tower)
    axis = tower_axis(scan.points())
    (found,) = axis.offsets
    assert found.z == pytest.approx(tower.offset_height, abs=0.5)
    assert found.size == pytest.approx(STEP, abs=max(3.0 * found.sigma, 3e-4))
    assert (found.azimuth + 180.0) % 360.0 == pytest.approx(180.0, abs=10.0)  # across the lean
    assert axis.kinks == []
    near = np.abs(axis.levels["z"] - found.z) <= 0.5
    is_told = np.char.find(axis.levels["flag"], "offset of ") >= 0
    assert near.any()
    assert np.array_equal(is_told, near & axis.is_answered)
    assert np.nanmax(offsets(axis, scan)[~near]) < 1e-3


def test_lengths_of_an_offset_are_in_coordinate_units() -> None:
    points = scan_of(TOWER).points()
    (metres,) = tower_axis(points).offsets
    (feet,) = tower_axis(points / 0.3048, unit=1.0 / 0.3048).offsets
    assert feet.z * 0.3048 == pytest.approx(metres.z, abs=0.3)
    assert feet.size * 0.3048 == pytest.approx(metres.size, rel=0.05)
    assert feet.sigma * 0.3048 == pytest.approx(metres.sigma, rel=0.3)


def test_a_kink_is_no_offset_and_smooth_axes_have_neither() -> None:
    kinked = Tower(40.0, 2.5, 1.5, kink=4.0, kink_spacing=20.0, seed=5)
    axis = tower_axis(scan_of(kinked).points())
    assert [kink.z for kink in axis.kinks] == pytest.approx([20.0], abs=1.0)
    assert axis.offsets == []
    smooth = tower_axis(scan_of(replace(TOWER, offset=0.0, bend=0.02)).points())
    assert not smooth.offsets
    assert not smooth.kinks


def test_an_offset_hides_no_kink_that_is_far_from_it() -> None:
    """Smoothed, it counts as an error of the wall; so kinks are sought beside it once more."""
    tower = Tower(60.0, 2.5, 1.5, kink=4.0, kink_spacing=15.0, seed=5)
    scan = Scan(
        replace(tower, offset=0.02, offset_height=31.2), count=120_000, noise=(0.002, 0.004), seed=5
    )
    axis = tower_axis(scan.points())
    assert [offset.z for offset in axis.offsets] == pytest.approx([31.2], abs=0.5)
    turn = 1e3 * np.hypot(*tower.kinks[1][0])
    lowest = axis.kinks[0]
    assert lowest.z == pytest.approx(15.0, abs=1.0)
    assert lowest.turn == pytest.approx(turn, rel=0.1)


def test_the_fan_follows_an_offset_of_its_own() -> None:
    scan = scan_of(TOWER)
    axis = tower_axis(scan.points(), "fan")
    assert len(axis.offsets) == 1
    near = np.abs(axis.levels["z"] - TOWER.offset_height) <= 1.0
    assert np.nanmax(offsets(axis, scan)[~near]) < 2e-3


@pytest.mark.parametrize("height", [2.0, 3.0, 8.0])
@pytest.mark.parametrize("size", [0.02, 0.1])
def test_a_lift_set_aside_is_not_passed_by_in_silence(height: float, size: float) -> None:
    """The smooth axis misses a short one, but its levels have sections of their own."""
    scan = scan_of(replace(TOWER, offset=0.0))
    points = scan.points()
    points[:, 1] += np.where((points[:, 2] > 20.0) & (points[:, 2] < 20.0 + height), size, 0.0)
    levels = tower_axis(points).levels
    x, y = scan.axis(levels["z"]).T
    is_aside = (levels["z"] > 20.0) & (levels["z"] < 20.0 + height)
    off = np.hypot(levels["x"] - x, levels["y"] - y - np.where(is_aside, size, 0.0))
    is_cut = np.abs(levels["z"][:, None] - [20.0, 20.0 + height]).min(axis=1) <= 0.25
    is_silent = (levels["flag"] == "") & (off > 0.005)
    assert not levels["z"][is_silent & ~is_cut].size  # those that are cut are half here, half there
    assert np.count_nonzero(levels["flag"] == "") > 0.7 * len(levels)


@pytest.mark.parametrize("size", [0.02, 0.3])
@pytest.mark.parametrize(
    "gaps",
    [
        [],
        [(22.2, 22.7)],
        [(21.7, 22.2)],
        [(22.2, 23.7)],
        [(20.7, 22.2)],
        [(21.4, 23.0)],
        [(14.0, 15.0), (22.2, 23.2), (30.0, 31.0)],
    ],
    ids=["none", "above", "below", "three above", "three below", "around", "three gaps"],
)
def test_an_offset_beside_missing_levels_is_one(
    gaps: list[tuple[float, float]], size: float
) -> None:
    scan = scan_of(replace(TOWER, offset=size))
    points = scan.points()
    for low, high in gaps:
        points = points[(points[:, 2] < low) | (points[:, 2] > high)]
    axis = tower_axis(points)
    (found,) = axis.offsets
    assert axis.kinks == []
    assert axis.radius_steps == []
    assert found.size == pytest.approx(size, abs=2e-3)
    # It may be anywhere in the gap, whose edges may be in the same levels as the wall.
    ends = [TOWER.offset_height, *(end for gap in gaps for end in gap if abs(end - 22.2) < 3.0)]
    assert min(ends) - 1.0 <= found.z <= max(ends) + 1.0
    away, levels = offsets(axis, scan), axis.levels
    assert not levels["z"][(levels["flag"] == "") & (away > 1e-3)].size
    near = (levels["z"] >= min(ends) - 2.5) & (levels["z"] <= max(ends) + 2.5)
    assert np.nanmax(away[~near]) < 1e-3


def test_a_tower_with_an_offset_has_its_points_on_its_axis() -> None:
    tower = Tower(10.0, 1.0, 1.0, offset=0.5, offset_height=5.0)
    s = np.array([4.999, 5.001])
    assert tower.axis(s) == pytest.approx(np.array([[0.0, 0.0], [0.0, 0.5]]))
    turn = np.linspace(0.0, 2.0 * np.pi, 8, endpoint=False)
    ring = tower.points(np.full(8, 5.001), turn)
    assert ring.mean(axis=0) == pytest.approx([0.0, 0.5, 5.001])
    assert np.hypot(ring[:, 0], ring[:, 1] - 0.5) == pytest.approx(1.0)
