"""Stretches of an edge that have no stroke are told."""

import numpy as np
import pytest
import shapely
from shapely import LineString, Polygon

from midrib import Strip, hatch
from midrib.hatching.bare import bare_stretches
from tests.hatching.slopes import annulus, bend, rectangle, trapezium


@pytest.mark.parametrize("strip", [rectangle(), bend(), trapezium(), annulus()])
def test_good_hatchings_have_no_bare_stretch(strip: Strip) -> None:
    found = hatch(strip)
    assert found.problems == []


def test_a_lobe_without_strokes_is_told() -> None:
    """The top is only part of the upper edge: a lobe beyond its end gets no stroke."""
    area = Polygon([(0, 0), (20, 0), (20, 10), (60, 10), (60, 40), (18, 40), (18, 3), (0, 3)])
    top = LineString([(18, 3), (0, 3)])
    toe = LineString([(18, 3), (18, 40), (60, 40), (60, 10), (20, 10), (20, 0), (0, 0), (0, 3)])
    found = hatch(Strip(top, toe, area))
    assert any("the toe has no stroke for" in problem.reason for problem in found.problems)


def test_stretches_are_as_long_as_strokes_are_missing() -> None:
    strip = rectangle()
    found = hatch(strip)
    x = found.on_top[:, 0]
    kept = (x < 30.0) | (x > 70.0)
    assert found.ground is not None
    edges = found.ground.curves[1:]
    ends = found.on_top[kept], found.on_toe[kept]
    feet = np.column_stack(
        [
            shapely.line_locate_point(LineString(edge.points), shapely.points(points))
            for edge, points in zip(edges, ends, strict=True)
        ]
    )
    stretches = bare_stretches(edges, found.rule, *ends, feet, 0.1)
    assert [stretch.edge for stretch in stretches] == ["top", "toe"]
    gap = found.rule.gaps(np.array([10.0]))[0]
    for stretch in stretches:
        assert stretch.length == pytest.approx(40.0 - 2.0 * 2.5 * gap, abs=2.0 * gap)
        assert stretch.where.x == pytest.approx(50.0, abs=gap)


def test_no_stroke_is_missed_where_there_is_no_room() -> None:
    tip = Strip(LineString([(0, 0), (100, 0)]), LineString([(0, 0), (100, -0.02)]))
    assert all("has no stroke" not in problem.reason for problem in hatch(tip).problems)
    assert shapely.length(hatch(tip).strokes).size == 0
