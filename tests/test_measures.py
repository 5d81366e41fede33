"""Length and width: closed forms, an oracle, and what must hold for every line and area."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString, MultiLineString, MultiPolygon, Point, Polygon, box
from shapely.affinity import scale, translate

import midrib
from midrib import add_widths, measures, profile
from midrib.errors import GeometryTypeError, ParameterError
from midrib.geodesy import degree_lengths
from midrib.measures.widths import places_along

RECTANGLE = box(0, 0, 10, 2)
WITH_HOLE = Polygon(RECTANGLE.exterior.coords, [[(4, 0.5), (6, 0.5), (6, 1.0), (4, 1.0)]])
TWO_PARTS = MultiPolygon([RECTANGLE, box(20, 0, 30, 4)])
AREAS = [RECTANGLE, WITH_HOLE, TWO_PARTS]
MIDDLE = LineString([(0, 1), (1, 1), (9, 1), (10, 1)])

coordinates = st.floats(-20.0, 40.0)
lines = st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=6, unique=True).map(
    LineString
)


def test_measures_need_no_import_of_their_own() -> None:
    # Another test's import has put it there; ask as a fresh process would.
    assert midrib.__getattr__("measures") is measures


def test_width_of_a_rectangle_is_its_width() -> None:
    assert measures.width(MIDDLE, RECTANGLE).tolist() == [0.0, 2.0, 2.0, 0.0]


def test_mean_width_counts_stretches_by_their_length() -> None:
    # Trapezia: 0 to 2 along 1, 2 along 8, 2 to 0 along 1.
    assert measures.mean_width(MIDDLE, RECTANGLE) == pytest.approx((1 + 16 + 1) / 10)


def test_largest_width_sees_holes() -> None:
    across = LineString([(5, 1), (5, 2)])
    assert measures.largest_width(across, WITH_HOLE) == 1.0
    assert measures.largest_width(across, RECTANGLE) == 2.0


@pytest.mark.parametrize("unit", [1.0, 1e-5])
def test_width_is_that_along_a_line_whatever_its_vertices(unit: float) -> None:
    area = scale(box(0, 0, 100, 2).union(box(48, -1, 52, 3)), unit, unit, origin=(0, 0))
    ends = np.array([(0, 1), (100, 1)]) * unit
    straight, dense = LineString(ends), LineString(np.linspace(ends[0], ends[1], 10_001))
    for geographic in (False, True):
        for measure, within in ((measures.mean_width, 0.01), (measures.largest_width, 0.25)):
            expected = measure(dense, area, geographic=geographic)
            found = measure(straight, area, geographic=geographic)
            assert found == pytest.approx(expected, rel=within)
    assert measures.largest_width(straight, area) > 3.0 * unit


def test_places_along_lines_are_bounded_in_number() -> None:
    line = LineString([(0, 0.5), (1e9, 0.5)])
    flat = Polygon([(0, 0.5), (1e9, 0.5), (5, 0.5)])  # invalid: without an inside
    for area in (box(0, 0, 1e9, 1), flat):
        places = places_along(np.array([line]), np.array([area]), geographic=False)
        assert 10_000 <= len(places.points) <= 10_002


@given(line=lines, area=st.sampled_from(AREAS))
def test_width_agrees_with_shapely_distance(line: LineString, area: Polygon) -> None:
    points = shapely.points(shapely.get_coordinates(line))
    expected = 2.0 * shapely.distance(points, area.boundary)
    assert measures.width(line, area) == pytest.approx(expected)


def test_many_segments_agree_with_shapely_distance() -> None:
    area = Point(0, 0).buffer(10, quad_segs=500).difference(Point(3, 1).buffer(2, quad_segs=300))
    line = LineString(np.column_stack([np.linspace(-12, 12, 400), np.sin(np.arange(400.0))]))
    points = shapely.points(shapely.get_coordinates(line))
    expected = 2.0 * shapely.distance(points, area.boundary)
    assert measures.width(line, area) == pytest.approx(expected)


@given(line=lines, power=st.integers(-100, 100))
def test_doubling_is_exact(line: LineString, power: int) -> None:
    factor = 2.0**power
    larger = [scale(g, factor, factor, origin=(0, 0)) for g in (line, WITH_HOLE)]
    assert measures.length(larger[0]) == factor * measures.length(line)
    for measure in (measures.mean_width, measures.largest_width):
        assert measure(*larger) == factor * measure(line, WITH_HOLE)


@given(several=st.lists(st.tuples(lines, st.sampled_from(AREAS)), min_size=1, max_size=4))
def test_batch_is_bit_equal_to_each_alone(several: list[tuple[LineString, Polygon]]) -> None:
    chains, areas = zip(*several, strict=True)
    assert measures.length(chains).tolist() == [measures.length(chain) for chain in chains]
    for measure in (measures.mean_width, measures.largest_width):
        assert measure(chains, areas).tolist() == [measure(*pair) for pair in several]


def test_far_origin_changes_widths_little() -> None:
    far = [translate(g, 5e5, 5e6) for g in (MIDDLE, WITH_HOLE)]
    assert measures.mean_width(*far) == pytest.approx(
        measures.mean_width(MIDDLE, WITH_HOLE), abs=1e-8
    )


def test_parts_of_a_multilinestring_are_not_joined() -> None:
    parts = MultiLineString([[(1, 1), (2, 1)], [(8, 1), (9, 1)]])
    assert measures.length(parts) == 2.0
    assert measures.mean_width(parts, RECTANGLE) == 2.0


@pytest.mark.parametrize("missing", [None, LineString(), MultiLineString()])
def test_missing_and_empty_lines_give_nan(missing: Any) -> None:
    assert np.isnan(measures.length(missing))
    assert np.isnan(measures.mean_width(missing, RECTANGLE))
    assert np.isnan(measures.largest_width(missing, RECTANGLE))
    assert measures.width(missing, RECTANGLE).size == 0


@pytest.mark.parametrize("missing", [None, Polygon(), MultiPolygon()])
def test_missing_and_empty_areas_give_nan(missing: Any) -> None:
    assert np.isnan(measures.mean_width(MIDDLE, missing))
    assert np.isnan(measures.largest_width([MIDDLE, MIDDLE], [RECTANGLE, missing])).tolist() == [
        False,
        True,
    ]
    assert measures.width(MIDDLE, missing).size == 0


def test_arrays_keep_their_shape_and_broadcast() -> None:
    grid = np.array([[MIDDLE, None], [None, MIDDLE]], dtype=object)
    assert measures.length(grid).shape == (2, 2)
    assert measures.mean_width(grid, RECTANGLE).shape == (2, 2)
    assert measures.mean_width([], []).shape == (0,)


def test_shapes_that_do_not_go_together_are_named() -> None:
    with pytest.raises(ParameterError, match=r"shapes \(2,\) and \(3,\) do not broadcast"):
        measures.mean_width([MIDDLE] * 2, [RECTANGLE] * 3)


@pytest.mark.parametrize("geographic", ["yes", 1, None])
def test_geographic_is_true_or_false(geographic: Any) -> None:
    for call in (
        lambda: measures.length(MIDDLE, geographic=geographic),
        lambda: measures.width(MIDDLE, RECTANGLE, geographic=geographic),
        lambda: measures.deviation(MIDDLE, MIDDLE, geographic=geographic),
        lambda: add_widths(MIDDLE, RECTANGLE, geographic=geographic),
        lambda: profile(MIDDLE, RECTANGLE, geographic=geographic),
    ):
        with pytest.raises(ParameterError, match=r"geographic is .*, expected True or False"):
            call()


def test_wrong_kinds_are_named_with_their_position() -> None:
    with pytest.raises(GeometryTypeError, match=r"lines\[1\] is a Point, expected LineString"):
        measures.length([MIDDLE, Point(0, 0)])
    with pytest.raises(GeometryTypeError, match="area is a LineString, expected Polygon"):
        measures.width(MIDDLE, MIDDLE)


@pytest.mark.parametrize("latitude", [0.0, 52.0, -80.0])
def test_geographic_lengths_are_metres(latitude: float) -> None:
    area = box(5.0, latitude, 5.1, latitude + 0.001)
    line = LineString(
        [(5.0, latitude + 0.0005), (5.05, latitude + 0.0005), (5.1, latitude + 0.0005)]
    )
    across, along = degree_lengths(np.array(area.bounds))
    assert measures.length(line, geographic=True) == pytest.approx(0.1 * across)
    assert measures.largest_width(line, area, geographic=True) == pytest.approx(0.001 * along)


def test_geographic_length_does_not_depend_on_how_a_meridian_is_cut() -> None:
    points = [(5.0, y) for y in np.linspace(0.0, 60.0, 601)]
    whole = measures.length(LineString(points), geographic=True)
    pieces = [measures.length(LineString(pair), geographic=True) for pair in pairwise(points)]
    assert whole == pytest.approx(sum(pieces))
    assert whole == pytest.approx(6_654_072.8, abs=1.0)  # arc of the meridian to 60 degrees
