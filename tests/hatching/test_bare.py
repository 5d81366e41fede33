"""Stretches of an edge that have no stroke are told."""

import sys
from pathlib import Path

import numpy as np
import pytest
import shapely
from shapely import LineString, Polygon

from midrib import Strip, hatch
from midrib.hatching.bare import bare_stretches
from midrib.hatching.measures import measure, untold
from tests.hatching.slopes import annulus, bend, rectangle, trapezium

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

from hatching_bare import bare_runs


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
    ends, gap = (found.on_top[kept], found.on_toe[kept]), found.rule.gaps(np.array([10.0]))[0]
    feet = np.column_stack(
        [
            shapely.line_locate_point(LineString(edge.points), shapely.points(points))
            for edge, points in zip(edges, ends, strict=True)
        ]
    )
    stretches = bare_stretches(edges, found.rule, feet, np.full(len(feet), gap), 0.1, 20.0)
    assert [stretch.edge for stretch in stretches] == ["top", "toe"]
    for stretch in stretches:
        assert stretch.length == pytest.approx(40.0 - 2.0 * 1.75 * gap, abs=2.0 * gap)
        assert stretch.where.x == pytest.approx(50.0, abs=gap)


def mouth(length: float, half: float, depth: float, width: float = 5.0) -> Strip:
    """A slope with a bay in the middle of its toe."""
    x = length / 2.0
    bay = [(x - half, 0), (x - half, -depth), (x + half, -depth), (x + half, 0)]
    return Strip(LineString([(0, width), (length, width)]), LineString([(0, 0), *bay, (length, 0)]))


BAYS = [
    (20.0, 1.0, 3.0), (20.0, 1.0, 8.0), (20.0, 1.0, 10.0), (20.0, 2.0, 3.0), (20.0, 2.0, 5.0),
    (20.0, 2.0, 15.0), (20.0, 3.0, 8.0), (40.0, 2.0, 30.0), (60.0, 2.0, 30.0),
]  # fmt: skip


@pytest.mark.parametrize(("length", "half", "depth"), BAYS)
def test_a_deep_bay_leaves_nothing_bare_and_its_walls_are_told(
    length: float, half: float, depth: float
) -> None:
    """By ways along the edges to the nearest stroke, which the engine has no part in."""
    found = hatch(mouth(length, half, depth))
    assert len(found.strokes) >= 0.6 * (length / 2.5 - 1.0)
    assert bare_runs(found) == []
    assert not untold(found, measure(found))
    assert found.problems or depth < 2.0 * half or depth < 5.0
    off = found.on_toe - found.on_top
    assert np.degrees(abs(np.arctan2(off[:, 0], -off[:, 1]))).max() <= 26.0


@pytest.mark.parametrize(("length", "half", "depth"), BAYS)
def test_a_symmetric_bay_is_drawn_symmetrically(length: float, half: float, depth: float) -> None:
    x = np.sort(hatch(mouth(length, half, depth)).on_top[:, 0])
    assert x + x[::-1] == pytest.approx(np.full(x.size, length), abs=0.5)


@pytest.mark.parametrize("width", [3.0, 5.0, 9.0])
def test_a_stroke_down_a_bay_asks_for_no_wider_gaps_than_beside_it(width: float) -> None:
    deep = [hatch(mouth(60.0, 2.0, depth, width), min_spacing=0.1) for depth in (20.0, 40.0, 80.0)]
    counts = [len(found.strokes) for found in deep]
    assert max(counts) - min(counts) <= 1
    assert min(counts) >= 0.8 * (60.0 / (width / 2.0) - 1.0)


def test_no_stroke_is_missed_where_there_is_no_room() -> None:
    tip = Strip(LineString([(0, 0), (100, 0)]), LineString([(0, 0), (100, -0.02)]))
    assert all("has no stroke" not in problem.reason for problem in hatch(tip).problems)
    assert shapely.length(hatch(tip).strokes).size == 0
