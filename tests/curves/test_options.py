"""Every option in every form, and every refusal with its message."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, MultiPolygon, Point, Polygon, box

from midrib import (
    Curve,
    Strip,
    collapse,
    label_line,
    methods,
    minimal_radii,
    network,
    partial_collapse,
    skeleton,
    split,
)
from midrib.errors import (
    GeometryTypeError,
    InvalidAreaError,
    ParameterError,
    RepairedAreaWarning,
)
from tests.shapes import NAMED, NOT_FINITE, rectangle

STRIP = Strip(LineString([(0, 0), (10, 0)]), LineString([(0, 2), (10, 2)]))
BOW_TIE = Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
FLAT = Polygon([(0, 0), (1, 1), (2, 2)])
TINY_CURL = Polygon(
    [(0, 0), (10, 0), (10, 2), (5, 2), (5.001, 2.001), (5.001, 2), (5, 2.001), (0, 2)]
)


def curve_of(**options: Any) -> Curve:
    """The curve of a strip 10 long and 2 wide."""
    return minimal_radii(STRIP, **{"count": 10, "ends": None, **options})


# -- stations --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"spacing": 3.0}, [0, 3, 6, 9, 10]),
        ({"spacing": 3.0, "vertices": False}, [0, 3, 6, 9]),
        ({"spacing": 20.0, "vertices": False}, [0]),
        ({"spacing": np.float64(5.0)}, [0, 5, 10]),
        ({"count": 4}, [0, 2.5, 5, 7.5, 10]),
        ({"count": np.int64(2)}, [0, 5, 10]),
        ({"count": 4.0}, [0, 2.5, 5, 7.5, 10]),
        ({"percent": 40.0}, [0, 4, 8, 10]),
        ({"percent": 40.0, "vertices": False}, [0, 4, 8]),
        ({"percent": 100}, [0, 10]),
        ({"stations": [7.0, 1.0, 7.0]}, [0, 1, 7, 10]),
        ({"stations": [7.0, 1.0], "vertices": False}, [1, 7]),
        ({"stations": 4.0, "vertices": False}, [4]),
        ({"stations": [1.0], "spacing": 5.0}, [0, 1, 5, 10]),
        ({"stations": np.array([0.0, 10.0]), "vertices": False}, [0, 10]),
        ({}, [0, 2, 4, 6, 8, 10]),
    ],
)
def test_stations_are_where_the_rule_says(options: dict[str, Any], expected: list[float]) -> None:
    curve = minimal_radii(STRIP, **options)
    assert curve.stations.tolist() == expected


def test_nearly_equal_stations_are_one() -> None:
    """Thirds of a curve that has vertices there."""
    strip = Strip(
        LineString([(0, 0), (1 / 3, 0), (2 / 3, 0), (1, 0)]), LineString([(0, 1), (1, 1)])
    )
    assert minimal_radii(strip, count=3, ends=None).stations.size == 4


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"spacing": 1.0, "count": 3}, "spacing and count exclude each other"),
        ({"count": 3, "percent": 5}, "count and percent exclude each other"),
        ({"spacing": 1.0, "count": 3, "percent": 5}, "spacing and count and percent exclude"),
        ({"spacing": 10**400}, "spacing is 1000"),
        ({"spacing": 0.0}, "spacing is 0.0, expected a positive number"),
        ({"spacing": -1.0}, "spacing is -1.0, expected a positive number"),
        ({"spacing": np.nan}, "spacing is nan, expected a positive number"),
        ({"spacing": np.inf}, "spacing is inf, expected a positive number"),
        ({"spacing": "1 m"}, "spacing is '1 m', expected a positive number"),
        ({"count": 0}, "count is 0, expected a positive number"),
        ({"count": 2.5}, "count is 2.5, expected a whole number"),
        ({"percent": 101}, "percent is 101, expected at most 100"),
        ({"percent": -3}, "percent is -3, expected a positive number"),
        ({"stations": [np.nan]}, "stations have a value that is not finite"),
        ({"stations": [11.0]}, "station 11 is not on the main curve, expected 0 to 10"),
        ({"stations": [-0.5]}, "station -0.5 is not on the main curve"),
        ({"stations": [], "vertices": False}, "no station is left on the main curve"),
        ({"spacing": 1e-12}, "an interval of 1e-12 asks for 1e\\+13 stations, expected fewer"),
        ({"count": 3, "skip": slice(None)}, "no station is left on the main curve"),
        ({"spacing": True}, "spacing is True, expected a positive number"),
        ({"count": True}, "count is True, expected a positive number"),
        (
            {"percent": np.array([1, 2])},
            r"percent is array\(\[1, 2\]\), expected a positive number",
        ),
        ({"stations": "abc"}, "stations is 'abc', expected arc lengths"),
        ({"stations": ["1", "2"]}, "stations is .*, expected arc lengths"),
        ({"stations": [True]}, "stations is .*, expected arc lengths"),
        ({"stations": [[1.0], [1.0, 2.0]]}, "stations is .*, expected arc lengths"),
        ({"stations": [1j]}, "stations is .*, expected arc lengths"),
        ({"vertices": "no"}, "vertices is 'no', expected True or False"),
    ],
)
def test_rules_that_make_no_sense_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        minimal_radii(STRIP, **options)
    with pytest.raises(ParameterError, match=message):
        collapse(rectangle(10.0, 2.0), **options)


# -- skip ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("skip", "dropped"),
    [
        (0, [0]),
        (-1, [10]),
        (np.int64(4), [4]),
        (slice(0, 3), [0, 1, 2]),
        (slice(-2, None), [9, 10]),
        (slice(None, None, 2), [0, 2, 4, 6, 8, 10]),
        (slice(2.5, 5.0), [3, 4, 5]),
        (slice(None, 1.0), [0, 1]),
        (slice(8.5, None), [9, 10]),
        (box(3.5, -1, 6.5, 1), [4, 5, 6]),
        (box(3.0, 0, 4.0, 1), [3, 4]),
        (MultiPolygon([box(0.5, -1, 1.5, 1), box(7.5, -1, 8.5, 1)]), [1, 8]),
        (lambda s, _: s > 7.0, [8, 9, 10]),
        (lambda _, p: p[:, 0] == 2.0, [2]),
        ([0, -1, slice(4, 6), lambda s, _: s == 2.0], [0, 2, 4, 5, 10]),
        ((0, 3), [0, 3]),
        ([], []),
        (None, []),
        ("bays", []),
        (["bays", 5], [5]),
    ],
)
def test_skip_drops_stations(skip: Any, dropped: list[int]) -> None:
    left = [float(s) for s in range(11) if s not in dropped]
    assert curve_of(skip=skip).stations.tolist() == left


@pytest.mark.parametrize(
    ("skip", "message"),
    [
        (11, "skip names station 11, expected an index below 11"),
        (-12, "skip names station -12, expected an index below 11"),
        ("hills", "skip is 'hills', expected 'bays'"),
        (3.5, "skip is 3.5, expected"),
        ([Point(0, 0)], "skip is <POINT \\(0 0\\)>, expected"),
        (True, "skip is True, expected 'bays', an index"),
        (slice("a", "b"), "skip is slice\\('a', 'b', None\\), expected a slice of indices"),
        (slice(np.nan, 3.0), "skip is slice\\(nan, 3.0, None\\), expected a slice of indices"),
        (slice(0.0, 3.0, 2), "skip is slice\\(0.0, 3.0, 2\\), expected a slice of indices"),
        (slice(None, None, 0), "skip is slice\\(None, None, 0\\), expected a slice"),
        (lambda *_: np.array([True]), "skip returned \\(1,\\) values, expected \\(11,\\)"),
    ],
)
def test_skips_that_make_no_sense_are_refused(skip: Any, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        curve_of(skip=skip)


def test_skipped_stations_are_not_gaps() -> None:
    assert curve_of(skip=slice(3, 6)).gaps.shape == (0, 2)


def test_bays_are_left_out_and_listed() -> None:
    """A side arm of the main curve, three times as deep as the strip is wide."""
    main = LineString([(0, 0), (9, 0), (9, -6), (11, -6), (11, 0), (20, 0)])
    strip = Strip(main, LineString([(0, 2), (20, 2)]))
    every, without = (
        minimal_radii(strip, spacing=0.5, ends=None, skip=skip) for skip in (None, "bays")
    )
    assert every.bays.size == 0
    assert every.points[:, 1].min() < -1.0
    assert without.points[:, 1].min() >= 0.0
    assert without.bays.size > 0
    assert set(without.bays) | set(without.stations) == set(every.stations)
    assert all(main.interpolate(s).y < 0.0 for s in without.bays)


@pytest.mark.parametrize("power", [-60, 5])
def test_bays_do_not_depend_on_the_scale(power: int) -> None:
    factor = 2.0**power
    main = np.array([(0, 0), (9, 0), (9, -6), (11, -6), (11, 0), (20, 0)])
    auxiliary = np.array([(0, 2), (20, 2)])
    curves = [
        minimal_radii(Strip(LineString(f * main), LineString(f * auxiliary)), count=64, skip="bays")
        for f in (1.0, factor)
    ]
    assert curves[0].bays.size > 0
    assert np.array_equal(curves[1].bays, curves[0].bays * factor)


@pytest.mark.parametrize("centring", ["none", "symmetric"])
def test_reports_say_how_many_stations_in_bays_were_left_out(centring: str) -> None:
    area = Polygon([(0, 0), (9, 0), (9, -6), (11, -6), (11, 0), (20, 0), (20, 2), (0, 2)])
    options: dict[str, Any] = {"centring": centring, "on_error": "report", "ends": "caps"}
    _, problems = collapse([rectangle(20, 2), area], skip="bays", **options)
    (row,) = [p for p in problems if p.status == "bays left out"]
    curve = minimal_radii(split(area), ends="caps", skip="bays")
    assert row.index == 1
    assert row.reason == f"{curve.bays.size} of {curve.bays.size + curve.stations.size} stations"
    _, problems = collapse([rectangle(20, 2), area], skip=None, **options)
    assert not [p for p in problems if p.status == "bays left out"]


# -- ends ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ends", "first", "last"),
    [
        ("main", (0, 0), (10, 0)),
        ("caps", (0, 1), (10, 1)),
        ("radii", (0, 1), (10, 1)),
        (((0, 0.5), (10, 1.5)), (0, 0.5), (10, 1.5)),
        ([Point(0, 2), Point(10, 2)], (0, 2), (10, 2)),
        ((np.array([1, 0.5]), (10, 1)), (1, 0.5), (10, 1)),
        (np.array([(1, 0.5), (10, 1)]), (1, 0.5), (10, 1)),
        (None, (0, 1), (10, 1)),
    ],
)
def test_the_line_ends_by_the_rule(ends: Any, first: Any, last: Any) -> None:
    line = curve_of(ends=ends).line
    assert line.coords[0] == first
    assert line.coords[-1] == last


def test_radii_at_the_ends_pass_over_the_segment_that_touches() -> None:
    """Rule 3 in a wedge: the auxiliary segment at the shared corner does not count."""
    strip = Strip(LineString([(0, 0), (10, 0)]), LineString([(0, 0), (0, 3), (10, 3)]))
    line = minimal_radii(strip, ends="radii", count=10).line
    assert line.coords[0] == (0.0, 1.5)
    assert line.coords[-1] == (10.0, 1.5)


@pytest.mark.parametrize(
    ("ends", "message"),
    [
        ("tips", "ends is 'tips', expected 'main', 'caps', 'radii', a pair of points or None"),
        (3, "ends is 3, expected"),
        (((0, 0),), "ends is .*, expected"),
        (((0, 0), (1, 1), (2, 2)), "ends is .*, expected"),
        (((0, 5), (10, 1)), "the first of ends, \\(0, 5\\), lies outside the area"),
        (((0, 1), (10, 7)), "the second of ends, \\(10, 7\\), lies outside the area"),
        (((0, 1), (np.nan, 1)), "ends has .*, expected a Point or two finite numbers"),
        (((0, 1), "east"), "ends has 'east', expected a Point or two finite numbers"),
        ((Point(), (1, 1)), "ends has .*, expected a Point or two finite numbers"),
        ((("0", "1"), (1, 1)), "ends has .*, expected a Point or two finite numbers"),
        (np.zeros((3, 2)), "ends is array[^\n]*, expected 'main'"),
    ],
)
def test_ends_that_make_no_sense_are_refused(ends: Any, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        curve_of(ends=ends)


@pytest.mark.parametrize(
    "clearance",
    ["proportion", -1.0, np.nan, np.inf, True, [1.0], (), "Station", np.array([1, 2])],
)
def test_clearances_that_make_no_sense_are_refused(clearance: Any) -> None:
    with pytest.raises(ParameterError, match=r"end_clearance is .*, expected 'station'"):
        curve_of(end_clearance=clearance)


@pytest.mark.parametrize(
    "clearance",
    [None, "station", "proportional", 0, 0.0, 3, np.float64(2.0), np.int64(3), np.float32(3)],
)
def test_clearance_does_nothing_where_no_end_is_shared(clearance: Any) -> None:
    assert curve_of(end_clearance=clearance).line.equals(curve_of(end_clearance=None).line)


def test_a_clearance_is_the_same_in_every_type_of_number() -> None:
    strip = split(NAMED["kite"])
    kinds: list[Any] = [int, float, np.int64, np.float32]
    lines = [minimal_radii(strip, end_clearance=kind(1), ends=None).line for kind in kinds]
    assert all(line.equals(lines[0]) for line in lines)


def test_a_single_middle_without_ends_is_refused_with_a_reason() -> None:
    """One station and ends=None: a line needs two points."""
    with pytest.raises(InvalidAreaError, match=r"the curve is one point, .*a line needs two"):
        _ = minimal_radii(STRIP, stations=[5.0], vertices=False, ends=None).line


def test_a_strip_that_sees_nothing_is_refused() -> None:
    """Everything within the clearance of the shared ends, and so everything, is hidden."""
    strip = split(NAMED["L"], along=LineString([(0, 0), (10, 0)]))
    assert strip.main.length == 10.0
    with pytest.raises(InvalidAreaError, match="no station of the main curve sees anything"):
        minimal_radii(strip, end_clearance=30.0)


@pytest.mark.parametrize("strip", [NAMED["L"], None, "strip", LineString([(0, 0), (1, 1)])])
def test_what_is_no_strip_is_refused(strip: Any) -> None:
    with pytest.raises(GeometryTypeError, match=r"expected a Strip; midrib\.split makes one"):
        minimal_radii(strip)


def test_curve_shows_what_there_is_of_it() -> None:
    assert repr(curve_of()) == "<Curve: 11 radii, 0 gaps, 0 jumps, 0 loops cut>"
    assert repr(STRIP) == "<Strip: main 2 vertices, auxiliary 2, 0 holes>"


# -- collapse --------------------------------------------------------------------------------------


def test_methods_are_listed() -> None:
    (method,) = [m for m in methods() if m.name == "minimal-radii"]
    assert method.supports_holes
    assert "Buczek" in method.source


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"method": "skeleton"}, "method is 'skeleton', expected .*'minimal-radii'"),
        ({"on_error": "ignore"}, "on_error is 'ignore', expected 'raise' or 'report'"),
        ({"method": [1]}, "method is \\[1\\], expected .*'minimal-radii'"),
        ({"on_error": np.array([1, 2])}, "on_error is .*, expected 'raise' or 'report'"),
        ({"geographic": "yes"}, "geographic is 'yes', expected True or False"),
        ({"centring": np.array([1, 2])}, "centring is .*, expected 'none', 'symmetric'"),
        ({"centring": "symmetric", "mean": np.array([0, 0])}, "mean is .*, expected"),
        ({"tolerance": True}, "tolerance is True, expected a length of 0 or more"),
        ({"colour": "red"}, "method 'minimal-radii' has no option 'colour'"),
        ({"along": [None, None]}, "along has 2 lines for 1 areas, expected one each"),
    ],
)
def test_options_that_do_not_exist_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        collapse([rectangle(9, 2)], **options)


WRONG_WHATEVER_THE_AREA: list[dict[str, Any]] = [
    {"skip": "bay"},
    {"skip": 3.5},
    {"count": 10**9},
    {"percent": 1e-9},
    {"spacing": 1e-9},
    {"ends": ((0, 1), (np.nan, 1))},
    {"ends": ((0, 1), "east")},
]


@pytest.mark.parametrize("options", WRONG_WHATEVER_THE_AREA)
def test_wrong_options_are_not_the_areas_fault(options: dict[str, Any]) -> None:
    with pytest.raises(ParameterError):
        collapse([rectangle(9, 2), BOW_TIE], on_error="report", **options)
    if "spacing" not in options:  # no area is needed to tell
        with pytest.raises(ParameterError):
            collapse([], **options)


def test_pairs_of_ends_may_be_an_array() -> None:
    area, ends = rectangle(80.0, 10.0), [(1, 5), (79, 5)]
    assert collapse(area, ends=np.array(ends)).equals(collapse(area, ends=ends))


def test_numbers_of_numpy_are_numbers() -> None:
    area = rectangle(80.0, 10.0)
    assert collapse(area, tolerance=np.float32(0.5)).equals(collapse(area, tolerance=0.5))
    lines = [collapse(area, centring="symmetric", mean=mean) for mean in ((1, 0), np.array([1, 0]))]
    assert lines[0].equals(lines[1])


def test_missing_and_empty_stay_what_they_are() -> None:
    assert collapse(None) is None
    assert collapse(Polygon()).equals(LineString())
    lines = collapse([None, Polygon(), MultiPolygon(), rectangle(9, 2)])
    assert lines[0] is None
    assert [line.is_empty for line in lines[1:]] == [True, True, False]
    assert collapse([]).shape == (0,)


BAD = [
    (BOW_TIE, InvalidAreaError, "can be read in more than one way: Self-intersection at"),
    (NOT_FINITE, InvalidAreaError, "vertex 2 is \\(1, nan\\), expected finite coordinates"),
    (FLAT, InvalidAreaError, "the area is nothing"),
    (Point(1, 1), GeometryTypeError, "is a Point, expected a Polygon or MultiPolygon"),
    (LineString([(0, 0), (1, 1)]), GeometryTypeError, "is a LineString, expected a Polygon"),
    ("POLYGON", GeometryTypeError, "is a str, expected a Polygon or MultiPolygon"),
    (3.0, GeometryTypeError, "is a float, expected a Polygon or MultiPolygon"),
]


@pytest.mark.parametrize(("area", "error", "message"), BAD)
def test_bad_areas_raise_with_their_position(
    area: Any, error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=f"areas\\[1\\]: .*{message}"):
        collapse([rectangle(9, 2), area])


@given(order=st.permutations(range(11)))
@settings(max_examples=30)
def test_a_report_never_loses_the_others(order: list[int]) -> None:
    good = rectangle(9.0, 2.0)
    mixed = [*(area for area, _, _ in BAD), None, Polygon(), TINY_CURL, good]
    lines, problems = collapse([mixed[i] for i in order], on_error="report")
    refused = {p.index for p in problems if p.status == "refused"}
    repaired = {p.index for p in problems if p.status == "repaired"}
    assert refused == {k for k, i in enumerate(order) if i < len(BAD)}
    assert repaired == {order.index(len(BAD) + 2)}
    assert all(lines[k] is None for k in refused)
    assert lines[order.index(len(BAD))] is None
    assert lines[order.index(len(BAD) + 1)].is_empty
    assert lines[order.index(len(BAD) + 3)].equals(collapse(good))
    assert all(p.reason for p in problems)


def test_a_repaired_area_warns_and_has_its_line() -> None:
    with pytest.warns(RepairedAreaWarning, match="areas\\[0\\]: repaired: Self-intersection at"):
        line = collapse(TINY_CURL)
    assert line.hausdorff_distance(LineString([(0, 1), (10, 1)])) < 0.01


@pytest.mark.parametrize(
    "function",
    [collapse, network, skeleton, label_line, partial(partial_collapse, narrower_than=1.0)],
)
def test_a_warning_of_a_repair_names_the_line_that_called(function: Callable[..., Any]) -> None:
    with pytest.warns(RepairedAreaWarning) as record:
        function(TINY_CURL)
    assert [warning.filename for warning in record] == [__file__]


def test_a_refused_part_is_named_and_left_out() -> None:
    parts = MultiPolygon([rectangle(9.0, 2.0), shapely.affinity.translate(BOW_TIE, 20.0)])
    line, problems = collapse(parts, on_error="report")
    assert [(p.index, p.part, p.status) for p in problems] == [(0, 1, "refused")]
    assert len(line.geoms) == 1
    with pytest.raises(InvalidAreaError, match="areas\\[0\\] part 1: "):
        collapse(parts)


def right_of(x: float) -> Polygon:
    """A strip 9 long and 2 wide that begins at x."""
    return shapely.affinity.translate(rectangle(9.0, 2.0), x)


@pytest.mark.parametrize("again", [right_of(0.0), right_of(0.0).reverse(), right_of(1e-6)])
def test_a_part_that_is_there_twice_has_one_line(again: Polygon) -> None:
    parts = MultiPolygon([rectangle(9.0, 2.0), again, right_of(20.0)])
    line, problems = collapse(parts, on_error="report")
    assert len(line.geoms) == 2
    assert line.geoms[0].equals(collapse(rectangle(9.0, 2.0)))
    assert [(p.part, p.status, p.reason) for p in problems] == [
        (1, "repaired", "the same as part 0, left out")
    ]


@pytest.mark.parametrize(
    ("other", "place"),
    [(right_of(5.0), "\\(7, 1\\)"), (box(1, 0.5, 8, 1.5), "\\(4.5, 1\\)")],
)
def test_parts_that_overlap_are_refused(other: Polygon, place: str) -> None:
    parts = MultiPolygon([BOW_TIE, right_of(0.0), other, right_of(20.0)])
    line, problems = collapse(parts, on_error="report")
    assert len(line.geoms) == 1
    assert {p.part: p.status for p in problems} == dict.fromkeys([0, 1, 2], "refused")
    assert "overlaps part 2 at" in problems[1].reason
    with pytest.raises(InvalidAreaError, match=f"areas\\[0\\]: overlaps part 1 at {place}, which"):
        collapse(MultiPolygon([right_of(0.0), other]))


def test_parts_that_overlap_by_next_to_nothing_stay() -> None:
    parts = MultiPolygon([right_of(0.0), right_of(8.999)])
    line, (problem,) = collapse(parts, on_error="report")
    assert len(line.geoms) == 2
    assert problem.status == "repaired"
    assert problem.reason == "overlaps part 0 at (8.9995, 1) by 0.00011 of the smaller one"


def test_parts_side_by_side_are_no_problem() -> None:
    slanted = shapely.affinity.rotate(MultiPolygon([right_of(0.0), right_of(9.0)]), 17.0)
    line, problems = collapse(slanted, on_error="report")
    assert len(line.geoms) == 2
    assert problems == []


def test_a_directional_polyline_for_each_area_or_for_all() -> None:
    area, top = rectangle(10.0, 2.0), LineString([(10, 2), (0, 2)])
    lines = collapse([area, area], along=[top, None])
    assert lines[0].coords[0][0] == 10.0
    assert lines[1].equals(collapse(area))
    assert all(line.coords[0][0] == 10.0 for line in collapse([area, area], along=top))
    _, problems = collapse([area, area], along=[Point(0, 0), None], on_error="report")
    assert [(p.index, p.reason) for p in problems] == [
        (0, "along is a Point, expected a LineString")
    ]


def test_what_is_no_collection_is_refused() -> None:
    with pytest.raises(GeometryTypeError, match="areas is a int, expected areas"):
        collapse(5)


def test_degrees_beyond_a_pole_are_refused() -> None:
    with pytest.raises(InvalidAreaError, match="latitude 100 is beyond a pole"):
        collapse(shapely.affinity.translate(rectangle(9, 2), 0.0, 98.0), geographic=True)


def test_z_is_carried_along() -> None:
    area = Polygon([(0, 0, 10), (10, 0, 20), (10, 2, 20), (0, 2, 10)])
    line = collapse(area, count=2)
    assert [tuple(p) for p in line.coords] == [(0, 1, 10), (5, 1, 15), (10, 1, 20)]
    lines = collapse([area, rectangle(9, 2)])
    assert [line.has_z for line in lines] == [True, False]


def test_many_sizes_of_batch_give_the_same() -> None:
    some = list(NAMED.values())
    together = collapse(some)
    for i, area in enumerate(some):
        assert np.array_equal(
            shapely.get_coordinates(together[i]), shapely.get_coordinates(collapse([area])[0])
        )


README_AREA = Polygon([(0, 0), (40, 2), (80, 0), (80, 9), (40, 12), (0, 10)])


@pytest.mark.parametrize("centring", ["none", "symmetric", "centred"])
@pytest.mark.parametrize("ends", [((1, 5), (79, 5)), ((79, 5), (1, 5)), ((20, 5), (60, 6))])
def test_a_curve_between_points_of_the_users_does_not_turn_back(
    centring: Any, ends: tuple[tuple[float, float], tuple[float, float]]
) -> None:
    line = minimal_radii(split(README_AREA), ends=ends, centring=centring).line
    x = shapely.get_coordinates(line)[:, 0]
    assert (np.diff(x) > 0.0).all() or (np.diff(x) < 0.0).all()
    assert {line.coords[0], line.coords[-1]} == {tuple(map(float, end)) for end in ends}


@pytest.mark.parametrize("power", [600, 1000, -600, -1000])
def test_sizes_beyond_exact_arithmetic_are_refused(power: int) -> None:
    large = shapely.affinity.scale(README_AREA, 2.0**power, 2.0**power, origin=(0, 0))
    with pytest.raises(InvalidAreaError, match=r"largest coordinate|extent is"):
        collapse(large)
