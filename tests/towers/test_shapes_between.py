"""Sections that are neither circles nor polygons: told right, or refused with a reason."""

from typing import Any

import numpy as np
import pytest

from midrib import tower_axis
from midrib.errors import ParameterError
from midrib.towers.simulate import Scan, Tower
from midrib.types import Floats
from tests.towers.scans import dirty, offsets


class Turning(Tower):
    """An oval of 10 mm whose longer diameter turns by half a circle from base to top."""

    def shell(self, s: Floats, theta: Floats) -> Floats:
        away: Floats = self.radius(s) + 0.01 * np.cos(2.0 * theta - 2.0 * np.pi * s / self.height)
        return away


def scan_of(tower: Tower, **changes: Any) -> Scan:
    return Scan(tower, count=60_000, noise=(0.002, 0.004), outliers=0.01, seed=6, **changes)


@pytest.mark.parametrize("shape", ["auto", "round", "polygon"])
@pytest.mark.parametrize("oval", [0.12, 0.3, 0.5])
def test_a_large_oval_is_refused_as_what_it_is(oval: float, shape: Any) -> None:
    scan = scan_of(Tower(40.0, 2.5, 1.5, lean=0.1, oval=oval, twist=20.0))
    sentence = (
        rf"oblong: the radius is 2\.\d\d m, give or take {oval:.2f}\d m, expected at most 0\.0"
    )
    with pytest.raises(ParameterError, match=sentence):
        tower_axis(scan.points(), shape=shape)


def test_a_pole_that_is_an_oval_is_refused_by_its_proportions() -> None:
    scan = scan_of(Tower(10.0, 0.2, 0.15, lean=0.01, oval=0.045, twist=20.0))
    with pytest.raises(ParameterError, match=r"give or take 0\.045 m, expected at most 0\.026 m"):
        tower_axis(scan.points())


@pytest.mark.parametrize("unit", [1.0, 1000.0])
def test_an_oval_that_cells_hold_is_answered(unit: float) -> None:
    scan = scan_of(Tower(40.0, 2.5, 1.5, lean=0.1, oval=0.08, twist=20.0))
    axis = tower_axis(unit * scan.points(), unit=unit)
    assert axis.shape.name == "oval"
    found = axis.points / unit
    assert np.abs(found[:, :2] - scan.axis(found[:, 2])).max() < 1e-3


@pytest.mark.parametrize("mode", ["joint", "fan"])
def test_an_oval_that_turns_with_height_is_not_called_round(mode: Any) -> None:
    axis = tower_axis(scan_of(Turning(40.0, 2.5, 1.5, lean=0.1)).points(), mode)
    assert axis.shape.name == "unknown"
    assert "changes with height: harmonic 2, " in axis.shape.problem
    assert float(axis.shape.problem.split()[-2]) == pytest.approx(10.0, abs=1.0)
    assert (axis.levels["flag"] != "").all()


def test_an_oval_that_hardly_turns_is_an_oval() -> None:
    tower = Tower(40.0, 2.5, 1.5, lean=0.1, oval=0.01, twist=20.0, form_error=0.003)
    axis = tower_axis(scan_of(tower).points())
    assert axis.shape.name == "oval"
    assert not axis.shape.problem


class Rectangle(Tower):
    """A tower with flat faces, two of them farther from the axis than the others."""

    longer = 1.0

    def shell(self, s: Floats, theta: Floats) -> Floats:
        half: Floats = self.radius(s)
        along = np.maximum(np.abs(np.cos(theta)), 1e-9)
        across = np.maximum(np.abs(np.sin(theta)), 1e-9)
        return np.minimum(self.longer * half / along, half / across)


@pytest.mark.parametrize("longer", [1.1, 1.3, 2.5])
def test_a_rectangle_is_no_square(longer: float) -> None:
    """Three of its faces are a square's."""
    tower = type("Longer", (Rectangle,), {"longer": longer})(40.0, 2.5, 1.5, lean=0.1)
    with pytest.raises(ParameterError, match=r"oblong|nor on the faces of a regular polygon"):
        tower_axis(scan_of(tower).points())


class Lifts(Tower):
    """A tower whose lifts of 4 m stand 18 mm aside by turns."""

    def axis(self, s: Floats | list[float]) -> Floats:
        s = np.asarray(s, dtype=np.float64)
        aside: Floats = 0.018 * (np.floor(s / 4.0) % 2.0)
        return self.unbroken(s) + np.column_stack([0.0 * s, aside])


def test_lifts_closer_than_offsets_are_told_are_not_passed_by_in_silence() -> None:
    scan = dirty(Lifts(40.0, 2.5, 1.5, lean=0.1))
    axis = tower_axis(scan.points())
    away = offsets(axis, scan)
    assert np.nanmax(away) > 0.008  # the axis is smooth, the tower is not
    assert not (away[axis.levels["flag"] == ""] > 0.005).any()
    assert np.mean(axis.levels["flag"] == "") > 0.4
