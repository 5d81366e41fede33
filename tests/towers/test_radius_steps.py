"""Steps of the radius: told, and no matter to the axis, which is known where they are not."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from midrib import tower_axis
from midrib.towers.simulate import Scan, Tower
from midrib.types import Floats
from tests.towers.scans import offsets

NEAR = 2.5  # metres: levels so near to a step may be flagged
TWO = {"azimuths": (0.0, 120.0)}
HALF = {"azimuths": (0.0, 70.0, 140.0), "arc": (-20.0, 160.0)}


@dataclass(frozen=True)
class Stepped(Tower):
    """A tower whose radius steps by so much at heights."""

    steps: tuple[tuple[float, float], ...] = ()

    def radius(self, s: Floats) -> Floats:
        return super().radius(s) + sum(size * (s > at) for at, size in self.steps)


PLAIN = Stepped(40.0, 2.5, 1.5, bend=0.02)
STEP = replace(PLAIN, steps=((20.0, -0.03),))


def scan_of(tower: Tower, **changes: Any) -> Scan:
    usual: dict[str, Any] = {"count": 150_000, "noise": (0.002, 0.004), "seed": 31}
    return Scan(tower, **(usual | changes))


def is_near(levels: Any, tower: Stepped) -> Any:
    """Which levels are near a step, or an offset if there is one."""
    at = [at for at, _ in tower.steps] + [tower.offset_height] * (tower.offset != 0.0)
    return np.abs(levels["z"][:, None] - at).min(axis=1) <= NEAR


@pytest.mark.parametrize(
    "tower",
    [
        STEP,
        replace(STEP, bend=0.0),
        replace(PLAIN, steps=((20.2, 0.03),)),
        replace(PLAIN, steps=((20.0, -0.1),)),
        replace(PLAIN, steps=((20.0, 0.008),)),
        replace(PLAIN, steps=((3.0, -0.03),)),
        replace(PLAIN, steps=((38.0, -0.03),)),
        replace(PLAIN, steps=((13.0, -0.03), (27.0, -0.03))),
        replace(PLAIN, steps=((18.0, -0.03), (22.0, 0.03))),
        replace(STEP, form_error=0.003),
        replace(STEP, oval=0.01),
        replace(STEP, faces=4),
        replace(STEP, faces=8),
    ],
    ids=["bent", "straight", "wider", "large", "small", "plinth", "top", "two", "zone", "rough",
         "oval", "square", "octagon"],
)  # fmt: skip
def test_a_step_of_the_radius_is_told_and_leaves_the_axis_alone(tower: Stepped) -> None:
    scan = scan_of(tower)
    axis = tower_axis(scan.points())
    assert axis.offsets == []
    assert axis.kinks == []
    assert len(axis.radius_steps) == len(tower.steps)
    for found, (at, size) in zip(axis.radius_steps, tower.steps, strict=True):
        assert found.z == pytest.approx(at, abs=0.5)
        assert found.size == pytest.approx(size, abs=max(4.0 * found.sigma, 0.01 * abs(size)))
    near = is_near(axis.levels, tower)
    assert np.nanmax(offsets(axis, scan)) < 1e-3
    assert not np.any(axis.levels["flag"][~near])
    radii = tower.radius(axis.levels["z"][~near])
    assert axis.levels["radius"][~near] == pytest.approx(radii, abs=1e-3)


@pytest.mark.parametrize("size", [-0.03, 0.008])
@pytest.mark.parametrize(
    ("view", "bend"),
    [(TWO, 0.0), (TWO, 0.02), (HALF, 0.02)],
    ids=["two stations, straight", "two stations", "half"],
)
def test_a_step_that_is_seen_in_part_is_no_offset(
    view: dict[str, Any], size: float, bend: float
) -> None:
    tower = replace(PLAIN, steps=((20.0, size),), bend=bend)
    scan = scan_of(tower, **view)
    axis = tower_axis(scan.points())
    assert axis.offsets == []
    (found,) = axis.radius_steps
    assert found.z == pytest.approx(20.0, abs=0.3)  # at the level that is cut, not beside it
    assert found.size == pytest.approx(size, abs=5e-4)
    assert np.nanmax(offsets(axis, scan)) < 1e-3


@pytest.mark.parametrize("view", [{}, TWO], ids=["all round", "two stations"])
def test_an_offset_is_no_step_of_the_radius(view: dict[str, Any]) -> None:
    tower = replace(PLAIN, offset=0.02, offset_height=20.0)
    axis = tower_axis(scan_of(tower, **view).points())
    assert axis.radius_steps == []
    (found,) = axis.offsets
    assert found.size == pytest.approx(0.02, abs=1e-3)


@pytest.mark.parametrize("height", [20.0, 28.0])
def test_a_step_and_an_offset_are_both_told(height: float) -> None:
    tower = replace(STEP, offset=0.02, offset_height=height)
    scan = scan_of(tower)
    axis = tower_axis(scan.points())
    (step,), (offset,) = axis.radius_steps, axis.offsets
    assert step.z == pytest.approx(20.0, abs=0.5)
    assert step.size == pytest.approx(-0.03, abs=5e-4)
    assert offset.z == pytest.approx(height, abs=0.5)
    assert offset.size == pytest.approx(0.02, abs=5e-4)
    near = is_near(axis.levels, tower)
    assert np.nanmax(offsets(axis, scan)[~near]) < 1e-3
    assert not np.any(axis.levels["flag"][~near])


def test_a_step_hides_no_kink() -> None:
    tower = replace(STEP, bend=0.0, kink=4.0, kink_spacing=20.0, seed=5)
    axis = tower_axis(scan_of(tower).points())
    (kink,) = axis.kinks
    assert kink.z == pytest.approx(20.0, abs=0.5)
    assert kink.turn == pytest.approx(1e3 * np.hypot(*tower.kinks[1][0]), rel=0.1)
    assert len(axis.radius_steps) == 1


@pytest.mark.parametrize("high", [0.5, 1.0, 2.0, 3.0])
def test_a_flange_is_no_offset(high: float) -> None:
    steps = ((20.0 - high / 2.0, 0.02), (20.0 + high / 2.0, -0.02))
    tower = replace(PLAIN, steps=steps)
    scan = scan_of(tower)
    axis = tower_axis(scan.points())
    assert axis.offsets == []
    assert axis.kinks == []
    assert np.nanmax(offsets(axis, scan)) < 1e-3
    assert not np.any(axis.levels["flag"][~is_near(axis.levels, tower)])
    # What juts out goes back.
    assert sum(step.size for step in axis.radius_steps) == pytest.approx(0.0, abs=1e-3)


def test_lifts_of_other_radii_are_told_one_by_one() -> None:
    steps = tuple((5.0 * k, 0.008 * (-1.0) ** k) for k in range(1, 8))
    axis = tower_axis(scan_of(replace(PLAIN, steps=steps)).points())
    found = np.array([(step.z, step.size) for step in axis.radius_steps])
    assert found[:, 0] == pytest.approx(np.array(steps)[:, 0], abs=0.5)
    assert found[:, 1] == pytest.approx(np.array(steps)[:, 1], abs=5e-4)


def test_lengths_of_a_step_are_in_coordinate_units() -> None:
    points = scan_of(STEP).points()
    (metres,) = tower_axis(points).radius_steps
    (feet,) = tower_axis(points / 0.3048, unit=1.0 / 0.3048).radius_steps
    assert feet.z * 0.3048 == pytest.approx(metres.z, abs=0.5)
    assert feet.size * 0.3048 == pytest.approx(metres.size, rel=0.02)
    assert feet.sigma * 0.3048 == pytest.approx(metres.sigma, rel=0.3)


def test_levels_beside_a_step_say_so() -> None:
    axis = tower_axis(scan_of(STEP).points())
    near = np.abs(axis.levels["z"] - axis.radius_steps[0].z) <= 0.5
    is_told = np.char.find(axis.levels["flag"], "step of the radius by -30.") >= 0
    assert near.any()
    assert np.array_equal(is_told, near)
