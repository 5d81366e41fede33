"""The mean of two sides whose kinks are paired."""

from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Polygon, box

from midrib import Strip, collapse, minimal_radii
from midrib.curves.kinks import best_chain, kink_pairs, kinks_of
from tests.shapes import NAMED, annulus_sector
from tests.strategies import areas, divided


def frame(*points: tuple[float, float], width: float = 2.0) -> Polygon:
    """A frame of even width along a chain, mitred at its corners."""
    middle = LineString(points)
    return middle.buffer(width / 2.0, cap_style="flat", join_style="mitre", mitre_limit=99.0)


def kinked(area: Any, **options: Any) -> Any:
    """Mean curve with paired kinks."""
    return collapse(area, "mean-curve", mean="kinks", **options)


def same_way(line: LineString, wanted: LineString) -> float:
    """How far two lines are apart, and their vertices too."""
    corners = shapely.get_coordinates(wanted)
    found = shapely.get_coordinates(line.simplify(1e-9))
    if len(found) != len(corners):
        return np.inf
    return float(min(np.abs(found - corners).max(), np.abs(found[::-1] - corners).max()))


@pytest.mark.parametrize(
    "points",
    [
        [(0, 0), (10, 0), (10, 8)],
        [(0, 0), (10, 0), (14, 8)],
        [(0, 0), (12, 0), (12, 9), (0, 9)],
        [(0, 0), (9, 6), (18, 0), (27, 6), (36, 0)],
        [(0, 0), (20, 0), (23, 12), (45, 12), (45, -9), (30, -9)],
    ],
)
def test_frames_are_collapsed_to_their_middle(points: list[tuple[float, float]]) -> None:
    assert same_way(kinked(frame(*points)), LineString(points)) < 1e-9


def test_proportional_pairs_alone_miss_the_corners() -> None:
    points = [(0, 0), (20, 0), (23, 12), (45, 12), (45, -9), (30, -9)]
    area, middle = frame(*points), LineString(points)
    plain = shapely.hausdorff_distance(collapse(area, "mean-curve"), middle)
    assert shapely.hausdorff_distance(kinked(area), middle) < 0.01 * plain


def test_a_kink_of_one_side_alone_is_not_paired() -> None:
    """A bite of a triangle out of the lower side."""
    area = Polygon([(0, 0), (9, 0), (10, 1), (11, 0), (20, 0), (20, 4), (0, 4)])
    line = kinked(area)
    assert area.covers(line)
    assert line.is_simple
    assert abs(shapely.get_coordinates(line)[:, 1] - 2.0).max() <= 0.5 + 1e-9


def test_kinks_that_turn_apart_are_not_paired() -> None:
    """An hourglass: where one side turns to the left the other turns to the right."""
    lower = [(0, 0), (9, 0), (10, 1.5), (11, 0), (20, 0)]
    strip = Strip(LineString(lower), LineString([(x, 4 - y) for x, y in lower]))
    at, beside = kink_pairs(strip.layout)
    sides = [
        {float(chain.arc[k]): turn for k, turn in zip(*kinks_of(strip.layout, chain), strict=True)}
        for chain in (strip.layout.main, strip.layout.auxiliary)
    ]
    for one, other in zip(at[1:-1], beside[1:-1], strict=True):
        assert sides[0][one] * sides[1][other] > 0.0


def test_unlike_counts_are_paired_where_they_fit() -> None:
    """One side has two small kinks more, in a bay before the corner."""
    area = Polygon(
        [(0, -1), (5, -1), (5.5, -1.6), (6, -1), (21, -1), (21, 20), (19, 20), (19, 1), (0, 1)]
    )
    corner = shapely.Point(20, 0)
    assert corner.distance(shapely.MultiPoint(kinked(area).coords)) < 1e-9


def test_a_smooth_bend_is_proportional() -> None:
    line = kinked(annulus_sector(8.0, 10.0, 2.0, 40))
    radius = np.hypot(*shapely.get_coordinates(line).T)
    assert radius == pytest.approx(9.0, abs=0.01)


@given(area=areas)
@settings(max_examples=100)
def test_lines_are_inside_and_simple(area: Polygon) -> None:
    line = kinked(area)
    assert area.covers(line)
    assert line.is_simple


@given(strip=divided())
@settings(max_examples=60)
def test_any_division_has_its_mean(strip: Strip) -> None:
    curve = minimal_radii(strip, centring="symmetric", mean="kinks", ends="caps")
    assert strip.area is not None
    assert strip.area.covers(curve.line)
    other = Strip._of_layout(strip.layout.swapped(), strip.area)
    turned = minimal_radii(other, centring="symmetric", mean="kinks", ends="caps")
    assert shapely.hausdorff_distance(curve.line, turned.line) < 1e-6


def test_heights_are_carried_along() -> None:
    area = shapely.transform(
        shapely.force_3d(NAMED["L"]),
        lambda p: np.column_stack([p[:, :2], 2.0 * p[:, 0] + p[:, 1]]),
        include_z=True,
    )
    points = shapely.get_coordinates(kinked(area), include_z=True)
    np.testing.assert_allclose(points[:, 2], 2.0 * points[:, 0] + points[:, 1], atol=1e-9)


def test_it_goes_with_symmetric_lines_only() -> None:
    with pytest.raises(ValueError, match="mean goes with centring='symmetric'"):
        collapse(box(0, 0, 9, 2), mean="kinks")
    assert collapse(NAMED["L"], centring="symmetric", mean="kinks").equals(kinked(NAMED["L"]))


pairs = st.lists(
    st.tuples(st.integers(0, 5), st.integers(0, 5), st.integers(0, 9)), max_size=9, unique=True
)


@given(pairs)
def test_the_best_chain_is_the_best_of_all(rows: list[tuple[int, int, int]]) -> None:
    one, other, worth = np.array(rows, dtype=np.intp).reshape(-1, 3).T
    found = best_chain(one, other, worth.astype(float))
    assert (np.diff(one[found]) > 0).all()
    assert (np.diff(other[found]) > 0).all()
    best = 0
    for n in range(1, len(rows) + 1):
        for some in combinations(sorted(rows), n):
            rises = all(a[0] < b[0] and a[1] < b[1] for a, b in pairwise(some))
            best = max(best, sum(row[2] for row in some) if rises else 0)
    assert worth[found].sum() == best
