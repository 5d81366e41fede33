"""Where an axis is broken: at levels without a centre, and at offsets."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely
from matplotlib.figure import Figure

from midrib import tower_axis
from midrib.figures.tower_plots import plot_deviation, plot_plan
from midrib.towers.kinks import Offset
from midrib.towers.records import TowerAxis
from tests.towers.scans import CONE

HIDDEN = 12.0, 25.0  # metres: nothing of the shell is seen between
STEP = 0.5


@pytest.fixture(scope="module")
def hidden() -> TowerAxis:
    """Axis of a tower whose middle is hidden."""
    points = CONE.points()
    low, high = HIDDEN
    return tower_axis(points[(points[:, 2] < low) | (points[:, 2] > high)], step=STEP)


def test_no_part_bridges_what_is_hidden(hidden: TowerAxis) -> None:
    below, above = shapely.get_parts(hidden.line)
    assert hidden.line.has_z
    assert shapely.get_coordinates(hidden.line, include_z=True) == pytest.approx(hidden.points)
    assert shapely.get_coordinates(below, include_z=True)[:, 2].max() < HIDDEN[0] + STEP
    assert shapely.get_coordinates(above, include_z=True)[:, 2].min() > HIDDEN[1] - STEP


@pytest.mark.parametrize("above", [0.0, 0.1, 0.25])
def test_parts_end_below_an_offset_and_begin_above_it(hidden: TowerAxis, above: float) -> None:
    """One that is at a level is above it, as where the joint fit's axis leaps."""
    axis = replace(hidden, offsets=[Offset(z, 0.02, 0.0, 0.001) for z in (30.0 + above, 5.0)])
    ends = [shapely.get_coordinates(part, include_z=True)[:, 2] for part in axis.line.geoms]
    assert len(ends) == 4
    for one, other, z in ((ends[0], ends[1], 5.0), (ends[2], ends[3], 30.0 + above)):
        assert one[-1] <= z < other[0]
        assert other[0] - one[-1] == pytest.approx(STEP)


def test_a_level_between_two_breaks_is_in_no_part(hidden: TowerAxis) -> None:
    levels = hidden.levels.copy()
    levels["x"][[3, 5]] = np.nan
    axis = replace(hidden, levels=levels)
    assert len(axis.line.geoms) == 3
    assert len(shapely.get_coordinates(axis.line)) == len(axis.points) - 1


@pytest.mark.parametrize("plot", [lambda a, t: plot_deviation(a, t, "x", None),
                                  lambda a, t: plot_plan(a, t, None)])  # fmt: skip
def test_figures_break_the_axis_where_the_line_is_broken(hidden: TowerAxis, plot: Any) -> None:
    axis = replace(hidden, offsets=[Offset(30.0, 0.02, 0.0, 0.001)])
    axes = Figure().subplots()
    plot(axes, axis)
    drawn = np.column_stack(axes.lines[0].get_data())
    known = np.isfinite(drawn).all(axis=1)
    assert known.sum() == len(axis.points)
    assert (~known).sum() == len(axis.line.geoms) - 1 == 2
