"""Strips: how a boundary is divided, and what is refused."""

import re

import numpy as np
import pytest
import shapely
from hypothesis import given, note, settings
from hypothesis import strategies as st
from shapely import LineString, Point, Polygon, box

from midrib import Strip, minimal_radii, split
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError
from tests.shapes import NAMED, NOT_FINITE, NOT_FINITE_LINE, VALID, rectangle
from tests.strategies import simple_areas


def line(text: str) -> LineString:
    """A chain from its numbers."""
    return shapely.from_wkt(f"LINESTRING ({text})")


def check_division(strip: Strip) -> None:
    """The curves and two straight caps are the outer boundary, each part of it once."""
    main, auxiliary, shell = strip.main, strip.auxiliary, strip.area.exterior
    caps = [
        LineString([a, b])
        for a, b in ((main.coords[0], auxiliary.coords[0]), (main.coords[-1], auxiliary.coords[-1]))
    ]
    near = 1e-12 * shell.length
    for chain in (main, auxiliary, *(cap for cap in caps if cap.length > 0.0)):
        places = shapely.points(shapely.get_coordinates(chain.segmentize(shell.length / 99)))
        assert shapely.distance(places, shell).max() <= near
    total = sum(chain.length for chain in (main, auxiliary, *caps))
    assert total == pytest.approx(shell.length, rel=1e-12)
    assert main.intersection(auxiliary).length <= near


@pytest.mark.parametrize("name", sorted({*VALID} - {"necklace"}))
def test_proposed_curves_divide_the_boundary(name: str) -> None:
    check_division(split(VALID[name]))


def test_curves_of_a_ring_closed_by_a_touch_divide_the_boundary_of_its_inside() -> None:
    """A chain of two holes hangs on the shell: it is a part of what the area runs round."""
    area = VALID["necklace"]
    strip = split(area)
    both = shapely.union_all([strip.main, strip.auxiliary])
    assert strip.main.length + strip.auxiliary.length == pytest.approx(area.boundary.length)
    assert both.symmetric_difference(area.boundary).length == pytest.approx(0, abs=1e-9)


@given(area=simple_areas)
@settings(max_examples=200)
def test_proposed_curves_divide_any_boundary(area: Polygon) -> None:
    note(area.wkt)
    check_division(split(area))


@given(area=simple_areas, shares=st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)))
@settings(max_examples=200)
def test_curves_divide_the_boundary_at_given_points(
    area: Polygon, shares: tuple[float, float]
) -> None:
    note(area.wkt)
    start, end = (area.exterior.interpolate(share, normalized=True) for share in shares)
    if start.distance(end) < 1e-6:
        return
    strip = split(area, start=start, end=end)
    check_division(strip)
    near = 1e-9 * area.length
    for chain in (strip.main, strip.auxiliary):
        assert Point(chain.coords[0]).distance(start) <= near
        assert Point(chain.coords[-1]).distance(end) <= near


def test_a_tip_is_shared_and_a_flat_end_is_a_cap() -> None:
    strip = split(Polygon([(0, 0), (20, -1), (20, 1)]))
    ends = {strip.main.coords[0], strip.main.coords[-1]}
    others = {strip.auxiliary.coords[0], strip.auxiliary.coords[-1]}
    assert ends & others == {(0.0, 0.0)}
    assert ends ^ others == {(20.0, -1.0), (20.0, 1.0)}


@pytest.mark.parametrize("name", ["triangle", "L", "river_with_island"])
def test_one_given_end_is_kept_and_the_other_is_far_from_it(name: str) -> None:
    area = VALID[name]
    corner = Point(area.exterior.coords[0])
    from_start, from_end = split(area, start=corner), split(area, end=corner)
    assert from_start.main.coords[0] == corner.coords[0]
    assert from_end.main.coords[-1] == corner.coords[0]
    other = Point(from_start.main.coords[-1])
    assert other.distance(corner) > 0.5 * corner.hausdorff_distance(area)


def test_a_directional_polyline_names_the_main_curve_and_its_direction() -> None:
    area = rectangle(10.0, 2.0)
    for text in ("0 2, 10 2", "10 2, 0 2", "0 0, 10 0", "10 0, 0 0"):
        assert split(area, along=line(text)).main.equals_exact(line(text))
    near = split(area, along=line("0.1 2.3, 5 2.2, 9.7 2.1"))
    assert near.main.distance(Point(5, 2)) == 0.0
    assert near.main.coords[0] == pytest.approx((0.1, 2.0))
    assert near.main.coords[-1] == pytest.approx((9.7, 2.0))


def test_a_part_of_the_boundary_may_be_most_of_it() -> None:
    strip = split(rectangle(10.0, 2.0), along=line("1 0, 0 0, 0 2, 10 2, 10 0, 9 0"))
    assert strip.main.length == 16.0
    assert strip.auxiliary.equals_exact(line("1 0, 9 0"))


@pytest.mark.parametrize(
    "text",
    [
        "0 0, 0 0.0001",  # next to nothing
        "5 0, 5.3 0",  # a little of one side
        "0 0, 10 0, 10 2, 0 2, 0 0.3",  # nearly all the way round
        "0 -3, 5 -9, 0.3 -3",  # far off, back to where it began
    ],
)
@pytest.mark.parametrize("power", [-30, 0, 30])
def test_a_directional_polyline_without_two_ends_apart_is_refused(text: str, power: int) -> None:
    area, along = (
        shapely.affinity.scale(g, 2.0**power, 2.0**power, origin=(0, 0))
        for g in (rectangle(10.0, 2.0), line(text))
    )
    with pytest.raises(
        InvalidAreaError, match=r"of the mean width apart on the boundary, expected 0"
    ):
        split(area, along=along)


@pytest.mark.parametrize("turn_main", [False, True])
@pytest.mark.parametrize("turn_auxiliary", [False, True])
def test_curves_may_run_either_way(turn_main: bool, turn_auxiliary: bool) -> None:
    main, auxiliary = line("0 0, 5 -1, 9 0"), line("0 2, 9 2")
    strip = Strip(
        main.reverse() if turn_main else main, auxiliary.reverse() if turn_auxiliary else auxiliary
    )
    assert strip.area.equals(Polygon([(0, 0), (5, -1), (9, 0), (9, 2), (0, 2)]))
    expected = auxiliary.reverse() if turn_main else auxiliary
    assert strip.auxiliary.equals_exact(expected)


@pytest.mark.parametrize("turned", [False, True])
def test_the_area_says_which_way_the_auxiliary_curve_runs(turned: bool) -> None:
    """Its ends are nearer to the main curve's the wrong way round."""
    area = Polygon([(3, -3), (0, -3), (0, 2), (1, 2), (1, 0), (2, 0), (2, 1), (3, 1)])
    main, auxiliary = line("3 -3, 0 -3, 0 2, 1 2"), line("3 1, 2 1, 2 0, 1 0")
    strip = Strip(main, auxiliary.reverse() if turned else auxiliary, area)
    assert strip.auxiliary.equals_exact(auxiliary)
    check_division(strip)
    curve = minimal_radii(strip, stations=[0.0], vertices=False, end_clearance=None)
    assert curve.on_auxiliary.tolist() == [[2.0, 0.0]]


def test_curves_may_miss_their_areas_boundary_by_rounding() -> None:
    strip = Strip(line("1e-12 -1e-12, 10 0"), line("-1e-12 2, 10 2"), rectangle(10.0, 2.0))
    made = minimal_radii(strip, ends="caps").line
    assert made.normalize().simplify(1e-9).equals_exact(line("0 1, 10 1"), 1e-9)


def test_an_area_with_holes_is_taken_as_it_is() -> None:
    area = VALID["three_islands"]
    strip = Strip(line("0 0, 20 0"), line("0 4, 20 4"), area)
    assert strip.area.equals(area)
    assert "3 holes" in repr(strip)
    curve = minimal_radii(strip, stations=[4.0], vertices=False)
    assert curve.on_auxiliary[0][1] == 4.0
    assert curve.radii[0] > 4.0


def test_z_is_kept() -> None:
    strip = Strip(LineString([(0, 0, 5), (9, 0, 5)]), LineString([(0, 2, 7), (9, 2, 7)]))
    curve = minimal_radii(strip, ends=None, count=3)
    assert [z for _, _, z in curve.line.coords] == [6.0] * 4


@pytest.mark.parametrize(
    ("main", "auxiliary", "message"),
    [
        ("0 0, 9 0", "0 0, 9 0", "belongs to main and auxiliary both"),
        ("0 0, 9 0, 9 2", "9 2, 9 0, 5 5", "belongs to main and auxiliary both"),
        ("0 0, 9 0, 9 2, 4 -1", "0 3, 9 3", "the main curve crosses itself"),
        ("0 0, 9 0", "0 3, 9 3, 9 4, 8 2", "the auxiliary curve crosses itself"),
        ("0 0, 9 0", "0 2, 4 -1, 9 2", "bound no area"),
        ("0 0, 9 0", "0 0, 4 0, 9 0", "belongs to main and auxiliary both"),
    ],
)
def test_curves_that_bound_no_area_are_refused(main: str, auxiliary: str, message: str) -> None:
    with pytest.raises(InvalidAreaError, match=message):
        Strip(line(main), line(auxiliary))


@pytest.mark.parametrize(
    ("main", "auxiliary", "message"),
    [
        ("0 0, 9 1", "0 2, 9 2", "main leaves the outer boundary of area at"),
        ("0 0, 9 0", "0 2, 5 3, 9 2", "auxiliary leaves the outer boundary of area at"),
        ("0 0, 9 0", "0 2, 9 2", "belongs to neither curve"),
        ("0 0, 10 0", "0 2, 9 2", "belongs to neither curve"),
    ],
)
def test_curves_that_do_not_divide_an_area_are_refused(
    main: str, auxiliary: str, message: str
) -> None:
    with pytest.raises(InvalidAreaError, match=message):
        Strip(line(main), line(auxiliary), rectangle(10.0, 2.0))


def test_a_cap_has_to_be_straight() -> None:
    area = Polygon([(0, 0), (10, 0), (12, 1), (10, 2), (0, 2)])
    with pytest.raises(InvalidAreaError, match="\\(12, 1\\) belongs to neither curve"):
        Strip(line("0 0, 10 0"), line("0 2, 10 2"), area)


@pytest.mark.parametrize("name", ["main", "auxiliary"])
@pytest.mark.parametrize(
    ("curve", "error", "message"),
    [
        (Point(0, 0), GeometryTypeError, "is a Point, expected a LineString"),
        (None, GeometryTypeError, "is a NoneType, expected a LineString"),
        (Polygon(), GeometryTypeError, "is a Polygon, expected a LineString"),
        (LineString(), InvalidAreaError, "has fewer than two distinct points"),
        (LineString([(1, 1), (1, 1)]), InvalidAreaError, "has fewer than two distinct points"),
        (NOT_FINITE_LINE, InvalidAreaError, "has a coordinate that is not finite"),
    ],
)
def test_what_is_no_chain_is_refused(
    name: str, curve: object, error: type[Exception], message: str
) -> None:
    curves = {"main": line("0 0, 9 0"), "auxiliary": line("0 2, 9 2"), name: curve}
    with pytest.raises(error, match=f"{name} {message}"):
        Strip(**curves)


@pytest.mark.parametrize(
    ("area", "error", "message"),
    [
        (Point(0, 0), GeometryTypeError, "area is a Point, expected a Polygon"),
        (None, GeometryTypeError, "area is a NoneType, expected a Polygon"),
        (Polygon(), InvalidAreaError, "area is empty"),
        (Polygon([(0, 0), (2, 2), (2, 0), (0, 2)]), InvalidAreaError, "is not valid: Self-inter"),
        (NOT_FINITE, InvalidAreaError, "not finite"),
        (
            shapely.MultiPolygon([rectangle(1, 1), shapely.affinity.translate(rectangle(1, 1), 5)]),
            GeometryTypeError,
            "area is a MultiPolygon of 2 parts, expected a Polygon",
        ),
    ],
)
def test_what_is_no_area_is_refused(area: object, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        split(area)


def test_the_only_part_of_a_multipolygon_is_an_area() -> None:
    assert split(shapely.MultiPolygon([NAMED["L"]])).main.equals(split(NAMED["L"]).main)


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"along": line("0 0, 9 0"), "start": (0, 0)}, ParameterError, "along excludes start"),
        ({"along": line("0 0, 9 0"), "end": (0, 0)}, ParameterError, "along excludes start"),
        ({"along": Point(0, 0)}, GeometryTypeError, "along is a Point, expected a LineString"),
        ({"along": "top"}, GeometryTypeError, "along is a str, expected a LineString"),
        ({"start": "here"}, ParameterError, "start is 'here', expected a Point or a pair"),
        ({"start": (0, 0, 0)}, ParameterError, "start is .*, expected a Point or a pair"),
        ({"start": (0, 0), "end": (np.nan, 0)}, ParameterError, "end is .*, expected a Point"),
        (
            {"start": ("a", "b")},
            ParameterError,
            "start is \\('a', 'b'\\), expected a Point or a pair",
        ),
        ({"start": (True, 0)}, ParameterError, "start is .*, expected a Point or a pair"),
        ({"end": (np.inf, 0)}, ParameterError, "end is .*, expected a Point or a pair"),
        ({"start": Point()}, ParameterError, "start is .*, expected a Point or a pair"),
        ({"start": (0, 0), "end": (0, 0)}, InvalidAreaError, "are the same point"),
        ({"start": (-1, -1), "end": (-2, -3)}, InvalidAreaError, "are the same point"),
        ({"along": line("0 0, 5 0, 5 1, 0 0")}, InvalidAreaError, "along is closed"),
    ],
)
def test_hints_that_make_no_sense_are_refused(
    options: dict[str, object], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        split(rectangle(10.0, 2.0), **options)


@pytest.mark.parametrize("turned", [False, True])
def test_a_closed_top_is_sent_to_strip(turned: bool) -> None:
    area = box(0, 0, 30, 20).difference(box(9, 6, 20, 15))
    top, toe = LineString(area.interiors[0]), LineString(area.exterior)
    with pytest.raises(
        InvalidAreaError, match=r"along is closed.* midrib\.Strip\(top, toe, area\)"
    ):
        split(area, along=toe if turned else top)
    assert Strip(top, toe, area).is_closed


@pytest.mark.parametrize("point", [(0.0, 0.0), (0.0, 4.0), (7.0, 9.0)])
def test_start_and_end_in_one_point_are_refused(point: tuple[float, float]) -> None:
    expected = re.escape(f"same point of the boundary, ({point[0]:g}, {point[1]:g})")
    with pytest.raises(InvalidAreaError, match=expected):
        split(box(0, 0, 30, 9), start=point, end=point)
