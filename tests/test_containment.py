"""The line lies in its area and does not meet itself, whatever the area looks like."""

import numpy as np
import pytest
import shapely
from hypothesis import given, note, settings
from hypothesis import strategies as st
from shapely import LineString, Polygon
from shapely.affinity import rotate, scale, translate

from midrib import Strip, collapse, minimal_radii, split
from midrib.errors import InvalidAreaError, ParameterError
from tests.shapes import VALID
from tests.strategies import areas, divided, polyominoes, with_holes


def note_strip(strip: Strip) -> None:
    """Show a strip if the test fails."""
    note(f"{strip.area.wkt}\nmain {strip.main.wkt}\nauxiliary {strip.auxiliary.wkt}")


def check_line(line: LineString, area: Polygon) -> None:
    """Covered by the area under exact predicates, simple, without repeated points."""
    assert isinstance(line, LineString)
    points = shapely.get_coordinates(line)
    assert np.isfinite(points).all()
    assert line.length > 0.0
    assert area.covers(line), f"{line.difference(area).wkt} is outside"
    assert line.is_simple, line.wkt
    assert (points[1:] != points[:-1]).any(axis=1).all()


@pytest.mark.parametrize("name", VALID)
def test_named_areas_hold_their_line(name: str) -> None:
    assert VALID[name].is_valid
    check_line(collapse(VALID[name]), VALID[name])


@pytest.mark.parametrize("name", VALID)
@pytest.mark.parametrize("degrees", [17.0, 45.0, 90.0, 211.3])
def test_turned_areas_hold_their_line(name: str, degrees: float) -> None:
    area = rotate(VALID[name], degrees)
    if area.is_valid:  # rounding can part rings that touched, or make them cross
        check_line(collapse(area), area)


@pytest.mark.parametrize("name", VALID)
def test_areas_far_from_the_origin_hold_their_line(name: str) -> None:
    area = translate(VALID[name], 5e5, 5e6)
    if area.is_valid:
        check_line(collapse(area), area)


@given(area=areas, clearance=st.sampled_from([None, "station", "proportional"]))
@settings(max_examples=400)
def test_areas_hold_their_line(area: Polygon, clearance: object) -> None:
    note(area.wkt)
    check_line(collapse(area, end_clearance=clearance), area)


@given(area=with_holes(), count=st.integers(1, 40))
@settings(max_examples=300)
def test_areas_with_holes_hold_their_line(area: Polygon, count: int) -> None:
    note(area.wkt)
    check_line(collapse(area, count=count), area)


@given(area=polyominoes(), ends=st.sampled_from(["main", "caps", None]))
@settings(max_examples=200)
def test_squared_paper_holds_its_line(area: Polygon, ends: str | None) -> None:
    check_line(collapse(area, ends=ends), area)


@given(
    area=areas,
    degrees=st.floats(0.0, 360.0),
    x=st.sampled_from([0.0, 5e5]),
    y=st.sampled_from([0.0, 5e6]),
)
@settings(max_examples=300)
def test_areas_in_any_place_hold_their_line(
    area: Polygon, degrees: float, x: float, y: float
) -> None:
    moved = translate(rotate(area, degrees), x, y)
    if moved.is_valid and moved.area > 0.0:
        check_line(collapse(moved), moved)


@given(area=areas, power=st.integers(-200, 200))
@settings(max_examples=100)
def test_areas_of_any_size_hold_their_line(area: Polygon, power: int) -> None:
    """Powers of two change no sign, so the test itself is made at the old size."""
    factor = 2.0**power
    line = collapse(scale(area, factor, factor, origin=(0, 0)))
    check_line(scale(line, 1.0 / factor, 1.0 / factor, origin=(0, 0)), area)


@given(strip=divided(), count=st.integers(1, 30), ends=st.sampled_from(["main", "caps", None]))
@settings(max_examples=300)
def test_strips_hold_their_curve(strip: Strip, count: int, ends: str | None) -> None:
    note_strip(strip)
    try:
        curve = minimal_radii(strip, count=count, ends=ends)  # type: ignore[arg-type]
    except InvalidAreaError as error:
        assert "sees" in str(error)  # noqa: PT017
        return
    if curve.line.length > 0.0:
        check_line(curve.line, strip.area)


@given(strip=divided(), count=st.integers(1, 30))
@settings(max_examples=150)
def test_strips_hold_their_curve_between_radii_at_the_ends(strip: Strip, count: int) -> None:
    note_strip(strip)
    try:
        line = minimal_radii(strip, count=count, ends="radii").line
    except (InvalidAreaError, ParameterError):  # nothing is seen, or all middles are one point
        return
    check_line(line, strip.area)


@given(strip=divided(), x=st.floats(0.01, 0.99), y=st.floats(0.01, 0.99))
@settings(max_examples=100)
def test_strips_hold_their_curve_between_points_of_the_users(
    strip: Strip, x: float, y: float
) -> None:
    inside = [strip.area.boundary.interpolate(share, normalized=True) for share in (x, y)]
    inside = [point for point in inside if strip.area.covers(point)]
    if len(inside) < 2 or inside[0] == inside[1]:
        return
    note_strip(strip)
    try:
        curve = minimal_radii(strip, ends=(inside[0], inside[1]))
    except InvalidAreaError as error:
        assert "sees" in str(error)  # noqa: PT017
        return
    check_line(curve.line, strip.area)


@given(area=areas, seed=st.integers(0, 2**32 - 1))
@settings(max_examples=100)
def test_nearly_repeated_vertices_are_no_obstacle(area: Polygon, seed: int) -> None:
    """Every vertex comes twice, the second time some units in the last place away."""
    rng = np.random.default_rng(seed)
    ring = np.array(area.exterior.coords)[:-1]
    twice = np.repeat(ring, 2, axis=0)
    twice[1::2] += rng.integers(-3, 4, ring.shape) * np.spacing(np.abs(ring) + 1.0)
    rough = Polygon(twice, area.interiors)
    if rough.is_valid:
        check_line(collapse(rough), rough)


@pytest.mark.parametrize(
    "wkt",
    [
        "POLYGON ((0 0, 10 0, 10 2, 5 2, 5 5, 5 2, 0 2, 0 0))",  # out and back
        "POLYGON ((0 0, 10 0, 10 2, 5 2, 5 1, 5 2, 0 2, 0 0))",  # in and back
        "POLYGON ((0 0, 10 0, 13 0, 10 0, 10 2, 0 2, 0 0))",
    ],
)
def test_spikes_of_no_width_are_repaired_or_refused(wkt: str) -> None:
    area = shapely.from_wkt(wkt)
    line, problems = collapse(area, on_error="report")
    assert [p.status for p in problems] in (["repaired"], ["refused"])
    if problems[0].status == "repaired":
        check_line(line, area.buffer(0))
    else:
        assert line is None


@pytest.mark.parametrize(
    "wkt",
    [
        "POLYGON ((0 0, 4 0, 8 0, 0 0))",
        "POLYGON ((0 0, 4 4, 0 0, 0 0))",
        "POLYGON ((1 1, 1 1, 1 1, 1 1))",
    ],
)
def test_areas_that_are_nothing_are_refused(wkt: str) -> None:
    with pytest.raises(InvalidAreaError, match="areas\\[0\\]"):
        collapse(shapely.from_wkt(wkt))


@pytest.mark.parametrize("name", VALID)
def test_strips_with_every_end_rule_hold_their_curve(name: str) -> None:
    strip = split(VALID[name])
    for ends in ("main", "caps", None):
        check_line(minimal_radii(strip, ends=ends, count=50).line, strip.area)
