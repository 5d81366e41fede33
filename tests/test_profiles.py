"""Profiles and M values: closed forms, and how they move with the area."""

from typing import Any

import geopandas as gpd
import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString, MultiLineString, Point, Polygon, box
from shapely.affinity import affine_transform, rotate, scale, translate

from midrib import Strip, add_widths, collapse, measures, minimal_radii, profile, split
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError
from midrib.geodesy import degree_lengths
from tests.shapes import NAMED, VALID, wavy_ribbon

RECTANGLE = box(0, 0, 10, 4)
LOW = LineString([(1, 1), (5, 1), (9, 1)])  # runs along x: left is up
WITH_HOLE = Polygon(RECTANGLE.exterior.coords, [[(4, 1.5), (6, 1.5), (6, 2), (4, 2)]])


def test_left_and_right_are_the_travellers() -> None:
    there, back = profile(LOW, RECTANGLE), profile(shapely.reverse(LOW), RECTANGLE)
    assert there.to_left.tolist() == back.to_right.tolist() == [3.0, 3.0, 3.0]
    assert there.to_right.tolist() == back.to_left.tolist() == [1.0, 1.0, 1.0]
    assert there.width.tolist() == [2.0, 2.0, 2.0]
    assert there.stations.tolist() == [0.0, 4.0, 8.0]


@pytest.mark.parametrize("name", sorted({*VALID} - {"necklace"}))
def test_sides_do_not_depend_on_which_curve_is_main(name: str) -> None:
    area = VALID[name]
    line = collapse(area)
    strip = split(area)
    swapped = type(strip)(strip.auxiliary, strip.main, area)
    one, other = profile(line, strip), profile(line, swapped)
    assert one.to_left == pytest.approx(other.to_left, abs=1e-12)
    assert one.to_right == pytest.approx(other.to_right, abs=1e-12)


@pytest.mark.parametrize("name", NAMED)
def test_reflection_swaps_the_sides(name: str) -> None:
    strip, flip = split(NAMED[name]), [-1.0, 0.0, 0.0, 1.0, 0.0, 0.0]
    line = minimal_radii(strip).line
    mirrored = type(strip)(
        *(affine_transform(g, flip) for g in (strip.main, strip.auxiliary, strip.area))
    )
    one, other = profile(line, strip), profile(affine_transform(line, flip), mirrored)
    assert one.to_left.tolist() == other.to_right.tolist()
    assert one.to_right.tolist() == other.to_left.tolist()
    assert one.width.tolist() == other.width.tolist()


def test_holes_and_caps_count_for_the_width_only() -> None:
    rows = profile(LineString([(0, 1), (5, 1), (10, 1)]), WITH_HOLE)
    assert rows.width.tolist() == [0.0, 1.0, 0.0]
    assert rows.to_left.tolist() == [3.0, 3.0, 3.0]
    assert rows.to_right.tolist() == [1.0, 1.0, 1.0]


@pytest.mark.parametrize("name", VALID)
def test_no_bank_is_nearer_than_the_boundary(name: str) -> None:
    rows = profile(collapse(VALID[name]), VALID[name])
    nearer = np.minimum(rows.to_left, rows.to_right)
    assert (2.0 * nearer >= rows.width * (1.0 - 1e-12)).all()


@pytest.mark.parametrize("spacing", [0.5, 1.0, 3.0, 7.9, 8.0, 100.0])
def test_equal_spacing_ends_with_the_line(spacing: float) -> None:
    rows = profile(LOW, RECTANGLE, spacing=spacing)
    assert rows.stations[:-1].tolist() == [i * spacing for i in range(len(rows.stations) - 1)]
    assert rows.stations[-1] == 8.0
    assert 0.0 < rows.stations[-1] - rows.stations[-2] <= spacing
    assert rows.points[:, 0] == pytest.approx(1.0 + rows.stations)


def test_rounding_adds_no_station() -> None:
    assert 2.1 / 0.3 > 7.0
    line = LineString([(0.0, 1.0), (2.1, 1.0)])
    assert len(profile(line, RECTANGLE, spacing=0.3).stations) == 8


def test_vertices_are_the_stations_of_their_own() -> None:
    line = collapse(wavy_ribbon(60, 0.5))
    rows = profile(line, wavy_ribbon(60, 0.5))
    assert rows.points.tolist() == shapely.get_coordinates(line).tolist()
    assert rows.width.tolist() == measures.width(line, wavy_ribbon(60, 0.5)).tolist()


def test_heights_are_carried_along() -> None:
    line = LineString([(1, 1, 0), (9, 1, 16)])
    assert profile(line, RECTANGLE, spacing=2).points[:, 2].tolist() == [0.0, 4.0, 8.0, 12.0, 16.0]


@given(power=st.integers(min_value=-200, max_value=200), spacing=st.sampled_from([None, 0.3, 2.0]))
def test_doubling_is_exact(power: int, spacing: float | None) -> None:
    factor = 2.0**power
    line, area = (scale(g, factor, factor, origin=(0, 0)) for g in (LOW, WITH_HOLE))
    rows = profile(line, area, spacing=None if spacing is None else factor * spacing)
    for found, expected in zip(rows, profile(LOW, WITH_HOLE, spacing=spacing), strict=True):
        assert (found == factor * expected).all()


@pytest.mark.parametrize(
    "move", [lambda g: rotate(g, 33.0, origin=(0, 0)), lambda g: translate(g, 5e5, 5e6)]
)
def test_rigid_motion_keeps_the_numbers(move: Any) -> None:
    expected = profile(LOW, WITH_HOLE, spacing=1.0)
    rows = profile(move(LOW), move(WITH_HOLE), spacing=1.0)
    for name in ("stations", "width", "to_left", "to_right"):
        assert getattr(rows, name) == pytest.approx(getattr(expected, name), abs=1e-8)


def test_geographic_profiles_are_in_metres() -> None:
    area = box(5.0, 52.0, 5.1, 52.001)
    across, along = degree_lengths(np.array(area.bounds))
    rows = profile(LineString([(5.01, 52.00025), (5.09, 52.00025)]), area, geographic=True)
    assert rows.stations[-1] == pytest.approx(0.08 * across, rel=1e-5)
    assert rows.to_left == pytest.approx([0.00075 * along] * 2)
    assert rows.to_right == pytest.approx([0.00025 * along] * 2)


def test_what_has_no_profile_is_refused() -> None:
    with pytest.raises(GeometryTypeError, match="line is a Polygon, expected a LineString"):
        profile(RECTANGLE, RECTANGLE)
    with pytest.raises(GeometryTypeError, match="area is a Point, expected a Polygon"):
        profile(LOW, Point(0, 0))
    with pytest.raises(InvalidAreaError, match="line is empty"):
        profile(LineString(), RECTANGLE)
    for spacing in (0.0, -1.0, np.nan, "wide", True):
        with pytest.raises(ParameterError, match=r"spacing is .*, expected a positive number"):
            profile(LOW, RECTANGLE, spacing=spacing)  # type: ignore[arg-type]


@pytest.mark.parametrize("has_z", [False, True])
@pytest.mark.parametrize("parts", [1, 2])
def test_m_is_the_width_at_each_vertex(has_z: bool, parts: int) -> None:
    points = [[(1, 1, 7), (5, 2, 8), (9, 1, 9)], [(2, 3, 1), (8, 3, 2)]][:parts]
    lines = MultiLineString(points) if parts == 2 else LineString(points[0])
    lines = lines if has_z else shapely.force_2d(lines)
    measured = add_widths(lines, RECTANGLE)
    assert shapely.has_m(measured)
    assert shapely.has_z(measured) == has_z
    assert shapely.equals_exact(shapely.force_2d(measured), shapely.force_2d(lines))
    rows = shapely.get_coordinates(measured, include_z=True, include_m=True)
    assert rows[:, 3].tolist() == measures.width(lines, RECTANGLE).tolist()
    if has_z:
        assert rows[:, 2].tolist() == shapely.get_coordinates(lines, include_z=True)[:, 2].tolist()
    assert shapely.equals_exact(add_widths(measured, RECTANGLE), measured)


def test_m_of_arrays_and_of_what_is_missing() -> None:
    lines = np.array([[LOW, None], [LineString(), LOW]], dtype=object)
    measured = add_widths(lines, np.array([RECTANGLE, None], dtype=object))
    assert measured.shape == (2, 2)
    assert shapely.has_m(measured).tolist() == [[True, False], [False, False]]
    assert measured[1, 1] is LOW
    assert measured[1, 0].is_empty
    assert add_widths(None, RECTANGLE) is None


def test_m_keeps_index_and_crs() -> None:
    series = gpd.GeoSeries([RECTANGLE, RECTANGLE], index=["a", "b"], crs=28992)
    measured = add_widths(collapse(series), series)
    assert list(measured.index) == ["a", "b"]
    assert measured.crs == series.crs
    assert shapely.has_m(measured.to_numpy()).all()


def test_sides_are_told_where_both_ends_are_beside_one_vertex_of_a_curve() -> None:
    """Round the inner corner of an L both ends have the same nearest point of the inner bank."""
    area = Polygon([(0, 0), (10, 0), (10, 10), (8, 10), (8, 2), (0, 2)])
    inner, outer = LineString([(0, 2), (8, 2), (8, 10)]), LineString([(0, 0), (10, 0), (10, 10)])
    line = LineString([(8.2, 0.9), (9, 1.1), (9.2, 1.8)])
    strip = Strip(inner, outer, area)
    there, back = profile(line, strip), profile(shapely.reverse(line), strip)
    assert there.to_left.tolist() == back.to_right.tolist()[::-1]
    assert there.to_left == pytest.approx(
        [inner.distance(p) for p in shapely.points(shapely.get_coordinates(line))]
    )
