"""Batters that are no cone: as well answered as by a circle at each level."""

import numpy as np
import pytest

from midrib import tower_axis
from midrib.towers.simulate import Scan, Tower
from midrib.types import Floats
from tests.towers.scans import offsets


class Parabolic(Tower):
    """A tower whose batter is a parabola that ends upright."""

    def radius(self, s: Floats) -> Floats:
        share = 1.0 - np.asarray(s) / self.height
        radii: Floats = self.top_radius + (self.base_radius - self.top_radius) * share**2
        return radii


class Broken(Tower):
    """A tower whose batter breaks half way up."""

    def radius(self, s: Floats) -> Floats:
        heights = [0.0, self.height / 2.0, self.height]
        radii: Floats = np.interp(s, heights, [self.base_radius, 2.3, self.top_radius])
        return radii


@pytest.mark.parametrize(
    "tower", [Parabolic(50.0, 4.0, 2.0, lean=0.1), Broken(50.0, 3.1, 2.0, lean=0.1)]
)
def test_a_batter_that_is_no_cone_has_its_axis_at_every_level(tower: Tower) -> None:
    scan = Scan(tower, count=70_000, noise=(0.002, 0.004), seed=9100)
    axis = tower_axis(scan.points())
    away = offsets(axis, scan)
    assert axis.is_answered[2:-2].all()
    assert np.sqrt(np.nanmean(away**2)) < 4e-4
    assert np.nanmax(axis.levels["sigma"]) < 1e-3
    flags = axis.levels["flag"][2:-2]
    assert set(flags) <= {"", "rough"}  # at the break itself the taper is not smooth
    assert (flags != "").sum() <= 3
    assert axis.radius_steps == []  # which a bend of the batter looks like near by


def test_a_turn_of_the_batter_is_no_step_of_the_radius() -> None:
    tower = Broken(60.0, 3.1, 2.0, lean=0.1, seed=3002)
    axis = tower_axis(Scan(tower, count=300_000, noise=(0.002, 0.004), seed=3002).points())
    assert axis.radius_steps == []
