"""Label lines and control points."""

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, MultiPolygon, Point, Polygon, affinity, box

import midrib
from midrib import control_points, label_line
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError
from tests.shapes import NAMED, annulus_sector, wavy_ribbon
from tests.strategies import areas

RIVER = NAMED["river_with_island"]


def check(area: Polygon, **options: Any) -> midrib.Labels:
    """Hold a label against its area: the band around it is inside, and it can be read."""
    found = label_line(area, **options)
    assert isinstance(found, midrib.Labels)
    line, height = found.lines, found.heights
    assert area.covers(line)
    assert line.is_simple
    assert 0.0 < height <= 2.0 * line.distance(area.boundary) * (1.0 + 1e-9)
    first, last = np.array(line.coords)[[0, -1]]
    east, north = last - first
    assert north > 0.0 if abs(north) > np.tan(np.radians(70.0)) * abs(east) else east > 0.0
    return found


# -- label lines -----------------------------------------------------------------------------------


def test_a_rectangle_has_its_name_in_the_middle() -> None:
    found = check(box(0, 0, 30, 4))
    assert found.heights == pytest.approx(4.0)
    assert found.lines.length == pytest.approx(24.0)
    assert shapely.get_coordinates(found.lines)[:, 1] == pytest.approx(2.0)
    assert len(found.lines.coords) == 2
    for x, y in ((0, 0), (10, 3), (1000, 500)):
        ends = shapely.get_coordinates(check(box(x, y, x + 30, y + 4), length=12.0).lines)
        assert ends[:, 0] - x == pytest.approx([9.0, 21.0], abs=1e-3)


def test_one_of_length_and_height_makes_the_other_as_large_as_it_can_be() -> None:
    area = Polygon([(0, 0), (40, 0), (40, 8), (20, 8), (20, 2), (0, 2)])
    assert check(area, length=10).heights == pytest.approx(8.0, rel=0.1)
    assert check(area, length=10).lines.length == pytest.approx(10.0)
    assert check(area, height=1.5).lines.length > 20.0
    both = check(area, length=8, height=2)
    assert both.heights == 2.0
    assert both.lines.centroid.x > 22.0  # where there is most room


@pytest.mark.parametrize("how", [{}, {"length": 8.0}, {"height": 2.5}])
def test_a_lake_beside_its_river_has_its_name_in_the_lake(how: dict[str, float]) -> None:
    lake = Point(0, 9).buffer(8)
    found = check(shapely.union_all([lake, box(-60, -1, 60, 1), box(-2, 0, 2, 4)]), **how)
    assert lake.covers(found.lines)
    assert found.lines.length > 7.0


@pytest.mark.parametrize("area", [box(0, 0, 9, 9), Point(5, 5).buffer(5), box(0, 0, 9, 9.5)])
def test_the_name_of_a_square_is_level(area: Polygon) -> None:
    (_, one), (_, other) = check(area).lines.coords
    assert one == pytest.approx(other, abs=0.01)


@pytest.mark.parametrize("foot", [6.0, 12.0, 20.0])
@pytest.mark.parametrize("flip", [1.0, -1.0])
def test_no_part_of_a_name_is_upside_down_or_falls_steeply(foot: float, flip: float) -> None:
    area = LineString([(0, 40), (0, 0), (foot, -0.2 * foot)]).buffer(2.0, cap_style="flat")
    for length in (8.0, 20.0, 30.0):
        line = check(affinity.scale(area, flip, 1.0), length=length).lines
        east, north = np.diff(shapely.get_coordinates(line), axis=0).T
        length_of = np.hypot(east, north)
        assert length_of[(east < -0.35 * length_of) | (north < -0.95 * length_of)].sum() < 2.0


def test_a_bent_strip_has_a_bent_name() -> None:
    """Where that is level in its middle, and so no part of the name falls steeply."""
    found = check(affinity.rotate(annulus_sector(18.0, 22.0, 1.2, 60), 55, origin=(0, 0)))
    radius = np.hypot(*shapely.get_coordinates(found.lines).T)
    assert radius == pytest.approx(20.0, abs=0.6)
    assert found.heights > 2.5


def test_a_name_has_one_bend_at_most_in_a_bay_and_two_in_a_wave() -> None:
    found = check(wavy_ribbon(60, 0.8), length=5.0)
    step = np.diff(shapely.get_coordinates(found.lines), axis=0)
    turn = np.sign(step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0])
    assert np.count_nonzero(np.diff(turn[turn != 0])) <= 1


@given(area=areas, how=st.sampled_from([{}, {"aspect": 2.0}]))
@settings(max_examples=25)
def test_bands_are_inside(area: Polygon, how: dict[str, Any]) -> None:
    found, problems = label_line(area, on_error="report", **how)
    if found.lines is None:
        assert "no place" in problems[0].reason or "one point" in problems[0].reason
    else:
        check(area, **how)


def test_a_name_does_not_cut_across_a_bend() -> None:
    """A straight line would find more room outside."""
    area = LineString([(0, 30), (0, 0), (30, 0), (30, 30)]).buffer(1.5, cap_style="flat")
    found = check(area, length=20)
    assert found.heights == pytest.approx(3.0, rel=0.1)


def test_more_room_has_larger_names() -> None:
    small, large = box(0, 0, 30, 4), box(-3, -1, 33, 6)
    assert check(large).heights > check(small).heights
    assert check(large, length=12).heights >= check(small, length=12).heights


def test_labels_grow_with_their_area() -> None:
    found, larger = check(RIVER), check(affinity.scale(RIVER, 8, 8, origin=(0, 0)))
    assert larger.heights == pytest.approx(8 * found.heights)
    assert (
        shapely.hausdorff_distance(larger.lines, affinity.scale(found.lines, 8, 8, origin=(0, 0)))
        < 1e-9
    )


def test_degrees_are_lengths_of_a_plane() -> None:
    area = affinity.translate(affinity.scale(RIVER, 2e-3, 1e-3, origin=(0, 0)), 18, 60)
    found = label_line(area, geographic=True)
    assert area.covers(found.lines)
    assert 100.0 < found.heights < 500.0


def test_arrays_and_series_of_labels() -> None:
    geopandas = pytest.importorskip("geopandas")
    both = MultiPolygon([box(0, 0, 3, 1), box(10, 0, 40, 5)])
    series = geopandas.GeoSeries([both, None, box(0, 0, 3, 1)], index=["a", "b", "c"])
    found, problems = label_line(series, height=2.0, on_error="report")
    assert list(found.lines.index) == ["a", "b", "c"]
    assert found.lines["a"].bounds[0] > 10
    assert found.lines["b"] is None
    assert found.lines["c"] is None
    assert np.isnan(found.heights[1:]).all()
    reasons = {(p.index, p.part): p.reason for p in problems}
    assert reasons["c", 0] == "there is no place for a name 2 high"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"length": 0}, "length is 0, expected a number above 0"),
        ({"height": "2m"}, "height is '2m', expected a number above 0"),
        ({"aspect": -1}, "aspect is -1, expected a number above 0"),
        ({"aspect": 4, "length": 3}, "aspect is given beside length, expected one or the other"),
        (
            {"aspect": 4, "length": 3, "height": 1},
            "aspect is given beside length and height, expected one or the other",
        ),
    ],
)
def test_wrong_options_of_labels_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        label_line(box(0, 0, 9, 2), **options)


def test_a_name_without_room_is_refused() -> None:
    with pytest.raises(InvalidAreaError, match="no place for a name 20 long and 1 high"):
        label_line(box(0, 0, 9, 2), length=20, height=1)
    with pytest.raises(GeometryTypeError, match=r"areas\[0\]: is a Point"):
        label_line(Point(0, 0))


# -- control points --------------------------------------------------------------------------------

chains = st.lists(
    st.tuples(st.integers(-20, 20), st.integers(-20, 20)), min_size=2, max_size=20, unique=True
).map(lambda points: LineString(sorted(points)))


def off(line: LineString, found: midrib.ControlPoints) -> float:
    """Greatest distance of a vertex of a line from the segment that stands for its run."""
    points, most = shapely.get_coordinates(line), 0.0
    for a, b in zip(found.rows[:-1], found.rows[1:], strict=True):
        run = shapely.points(points[a : b + 1])
        most = max(most, float(shapely.distance(LineString(points[[a, b]]), run).max()))
    return most


@given(line=chains, tolerance=st.sampled_from([0.0, 0.5, 2.0, 7.0, 100.0]))
def test_the_whole_line_is_within_the_tolerance(line: LineString, tolerance: float) -> None:
    found = control_points(line, tolerance=tolerance)
    assert off(line, found) <= tolerance * (1.0 + 1e-12)
    assert found.line.is_simple
    assert (found.rows[0], found.rows[-1]) == (0, len(line.coords) - 1)
    assert np.isinf(found.importance[[0, -1]]).all()


@given(line=chains, counts=st.tuples(st.integers(2, 20), st.integers(2, 20)))
def test_fewer_points_are_among_more(line: LineString, counts: tuple[int, int]) -> None:
    few, many = (control_points(line, count=n) for n in sorted(counts))
    # Lines that go on eastwards do not cross themselves.
    assert len(few.rows) == min(*counts, len(line.coords))
    assert set(few.rows) <= set(many.rows)
    known = dict(zip(many.rows, many.importance, strict=True))
    assert [known[row] for row in few.rows] == few.importance.tolist()
    left_out = set(many.rows) - set(few.rows)
    assert max([known[r] for r in left_out], default=0.0) <= few.importance.min() * (1.0 + 1e-11)


@pytest.mark.parametrize("count", range(2, 8))
def test_ties_are_broken_alike_whichever_way_a_line_runs(count: int) -> None:
    """Symmetric, and each run has one farthest vertex."""
    line = LineString([(0, 0), (1, 2), (2, 1), (3, 5), (4, 1), (5, 2), (6, 0)])
    found, other = (control_points(way, count=count) for way in (line, line.reverse()))
    assert len(found.rows) == count
    assert found.line.equals(other.line)
    assert [6 - row for row in other.rows[::-1]] == found.rows.tolist()
    # (1, 2) is farther off, 1.34, but divides a run that there is only once (2, 1) is kept.
    assert found.rows[:count].tolist() == sorted([0, 6, 3, 2, 4, 1, 5][:count])


@given(area=areas, count=st.integers(2, 9))
@settings(max_examples=60)
def test_points_of_an_area_have_a_line_inside(area: Polygon, count: int) -> None:
    line = midrib.collapse(area, "medial-axis")
    found = control_points(line, count=count, area=area)
    assert area.covers(found.line)
    assert found.line.is_simple
    assert set(found.line.coords) <= set(line.coords)


def test_a_curve_brings_its_area() -> None:
    curve = midrib.minimal_radii(midrib.split(NAMED["U"]), ends="caps")
    found = control_points(curve, count=2)
    assert NAMED["U"].covers(found.line)
    assert len(found.rows) > 2  # two points are outside
    assert control_points(curve.line, count=2).rows.tolist() == [0, len(curve.line.coords) - 1]


def test_importance_is_the_distance_that_a_vertex_is_needed_for() -> None:
    found = control_points(LineString([(0, 0), (2, 1), (4, 0), (8, 5)]))
    assert found.importance == pytest.approx([np.inf, 1.0, 20.0 / 89.0**0.5, np.inf])
    lifted = control_points(LineString([(0, 0, 1), (5, 0, 2), (9, 3, 3)]), tolerance=0.1)
    assert lifted.points.tolist() == [[0, 0, 1], [5, 0, 2], [9, 3, 3]]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"count": 1}, "count is 1, expected a whole number of 2 or more"),
        ({"count": 2.5}, "count is 2.5, expected a whole number"),
        ({"tolerance": -1}, "tolerance is -1, expected a number of 0 or more"),
        ({"count": 2, "tolerance": 1}, "count and tolerance exclude each other"),
        ({"geographic": 1}, "geographic is 1, expected True or False"),
    ],
)
def test_wrong_options_of_points_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        control_points(LineString([(0, 0), (1, 1)]), **options)


def test_lines_that_will_not_do_are_refused() -> None:
    with pytest.raises(InvalidAreaError, match="the line crosses itself"):
        control_points(LineString([(0, 0), (2, 2), (2, 0), (0, 2)]))
    with pytest.raises(InvalidAreaError, match="area does not cover the line"):
        control_points(LineString([(0, 0), (5, 5)]), area=box(0, 0, 4, 4))


def test_rings_keep_three_corners() -> None:
    ring = LineString([(0, 0), (4, 0), (4, 3), (0, 3), (0, 0)])
    found = control_points(ring, count=2)
    assert found.line.is_valid
    assert found.line.is_closed
    assert control_points(ring, tolerance=100.0).line.is_valid


def test_rows_count_repeated_vertices() -> None:
    line = LineString([(0, 0), (1, 0), (1, 0), (3, 1)])
    found = control_points(line)
    assert found.rows.tolist() == [0, 1, 3]
    assert np.array_equal(np.array(line.coords)[found.rows], np.array(found.line.coords))


def test_a_height_that_is_not_known_does_not_matter() -> None:
    area = Polygon([(0, 0, np.nan), (30, 0, 2), (30, 4, 3), (0, 4, np.nan)])
    assert label_line(area).lines.equals(label_line(shapely.force_2d(area)).lines)
