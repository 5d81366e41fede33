"""Where areas begin and end: what a person would say."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Point, Polygon
from shapely.affinity import rotate

from midrib import collapse, split
from tests.shapes import NAMED, annulus_sector, rectangle, stadium, wavy_ribbon

Pair = tuple[float, float]


def ends_of(area: Polygon) -> list[tuple[Pair, Pair]]:
    """For both ends, where the main and the auxiliary curve end."""
    strip = split(area)
    main, auxiliary = np.round(strip.main.coords, 9), np.round(strip.auxiliary.coords, 9)
    return sorted(tuple(sorted((tuple(main[i]), tuple(auxiliary[i])))) for i in (0, -1))  # type: ignore[misc]


def line_ends(area: Polygon) -> list[Pair]:
    """The two ends of the area's line, from left to right."""
    coordinates = np.round(collapse(area).coords, 9)
    return sorted(tuple(point) for point in coordinates[[0, -1]])


@pytest.mark.parametrize(("length", "width"), [(10, 2), (3, 2), (2, 10), (1e5, 1), (1, 0.99)])
def test_a_rectangle_has_caps(length: float, width: float) -> None:
    first, second = ends_of(rectangle(length, width))
    if length > width:
        assert first == ((0, 0), (0, width))
        assert second == ((length, 0), (length, width))
    else:
        assert first == ((0, 0), (length, 0))
        assert second == ((0, width), (length, width))


@pytest.mark.parametrize("degrees", [0.0, 33.0, 90.0, 155.0])
def test_a_triangle_has_a_tip_and_a_cap(degrees: float) -> None:
    area = rotate(Polygon([(0, 0), (20, -1), (20, 1)]), degrees, origin=(0, 0))
    tip, (a, b) = sorted(ends_of(area), key=lambda end: Point(end[0]).distance(Point(end[1])))
    assert tip == ((0, 0), (0, 0))
    assert Point(a).distance(Point(b)) == pytest.approx(2.0)


def test_a_kite_has_two_tips() -> None:
    assert ends_of(NAMED["kite"]) == [((0, 0), (0, 0)), ((12, 0), (12, 0))]


@pytest.mark.parametrize("degrees", [0.0, 20.0, 90.0])
def test_a_stadium_ends_in_the_middle_of_its_round_ends(degrees: float) -> None:
    area = rotate(stadium(20.0, 1.0), degrees, origin=(10, 0))
    expected = rotate(LineString([(-1, 0), (21, 0)]), degrees, origin=(10, 0))
    found = LineString([ends[0] for ends in ends_of(area)])
    assert all(a == b for a, b in ends_of(area))
    assert found.hausdorff_distance(expected) <= 0.05


def test_an_l_ends_in_the_caps_of_both_arms() -> None:
    assert ends_of(NAMED["L"]) == [((0, 10), (2, 10)), ((10, 0), (10, 2))]


def test_a_u_ends_in_the_caps_of_both_arms() -> None:
    assert ends_of(NAMED["U"]) == [((0, 9), (2, 9)), ((6, 9), (8, 9))]


def test_a_hook_ends_in_its_caps() -> None:
    assert ends_of(NAMED["hook"]) == [((0, 0), (0, 1)), ((1, 2.5), (2, 2.5))]


@pytest.mark.parametrize("angle", [1.0, 3.0, 5.5])
def test_a_bent_strip_ends_in_its_caps(angle: float) -> None:
    area = annulus_sector(9.0, 10.0, angle, 100)
    c, s = np.round((np.cos(angle), np.sin(angle)), 12)
    far = tuple(sorted([(round(9 * c, 6), round(9 * s, 6)), (round(10 * c, 6), round(10 * s, 6))]))
    found = [tuple((round(x, 6), round(y, 6)) for x, y in end) for end in ends_of(area)]
    assert ((9.0, 0.0), (10.0, 0.0)) in found
    assert far in [tuple(sorted(end)) for end in found]


def test_a_wavy_ribbon_ends_in_its_caps() -> None:
    area = wavy_ribbon(100, 0.5)
    left, right = line_ends(area)
    assert left == pytest.approx((0.0, 0.0), abs=1e-9)
    assert right == pytest.approx((2.0 * np.pi, 0.0), abs=1e-9)


@pytest.mark.parametrize("rough", [0.001, 0.02])
def test_roughness_of_the_banks_does_not_move_the_ends(rough: float) -> None:
    x = np.linspace(0.0, 20.0, 101)
    noise = rough * np.sin(37.0 * x)
    low, high = np.column_stack([x, noise]), np.column_stack([x, 2.0 - noise])
    left, right = line_ends(Polygon(np.concatenate([low, high[::-1]])))
    assert left == pytest.approx((0.0, 1.0), abs=0.1)
    assert right == pytest.approx((20.0, 1.0), abs=0.1)


def test_vertices_on_a_flat_end_do_not_matter() -> None:
    area = Polygon([(0, 0), (10, 0), (10, 0.3), (10, 1.1), (10, 2), (0, 2), (0, 1.9), (0, 0.5)])
    assert line_ends(area) == [(0.0, 1.0), (10.0, 1.0)]


@given(length=st.integers(3, 200), width=st.integers(1, 2), power=st.integers(-60, 60))
@settings(max_examples=50)
def test_ends_of_rectangles_of_any_size(length: int, width: int, power: int) -> None:
    area = shapely.transform(rectangle(length, width), lambda xy: xy * 2.0**power)
    line = shapely.transform(collapse(area, count=4), lambda xy: xy / 2.0**power)
    assert line.equals(LineString([(0, width / 2), (length, width / 2)]))


@pytest.mark.parametrize("degrees", [0.0, 40.0, 200.0])
@pytest.mark.parametrize("flip", [1.0, -1.0])
def test_the_flank_of_an_oblique_end_is_no_cap(degrees: float, flip: float) -> None:
    """The line had ended in the middle of one of the sides by the farther tip."""
    tips = [(0, 0), (89, -13)]
    kite = [(0, 0), (66, -27), (89, -13), (41, -6)]
    area, ends = (
        rotate(shapely.transform(shape, lambda xy: xy * [1.0, flip]), degrees, origin=(0, 0))
        for shape in (Polygon(kite), LineString(tips))
    )
    line = collapse(area)
    found = sorted([line.coords[0], line.coords[-1]])
    assert np.allclose(found, sorted(ends.coords))


def test_a_wide_end_with_depth_behind_it_is_a_cap() -> None:
    trumpet = [(0, 2.5), (40, 2.5), (50, 0), (50, 6), (40, 3.5), (0, 3.5)]
    assert line_ends(Polygon(trumpet)) == [(0.0, 3.0), (50.0, 3.0)]


def right_end(area: Polygon) -> tuple[float, float]:
    """The farther end to the right of the line of an area."""
    points = shapely.get_coordinates(collapse(area))
    x, y = points[np.argmax(points[:, 0])]
    return float(x), float(y)


@pytest.mark.parametrize("degrees", range(50, 171, 10))
def test_a_gable_ends_in_its_apex(degrees: int) -> None:
    """Not in the middle of the one facet of two."""
    apex = 20.0 + 1.0 / np.tan(np.radians(degrees) / 2.0)
    area = Polygon([(0, -1), (20, -1), (apex, 0), (20, 1), (0, 1)])
    assert right_end(area) == pytest.approx((apex, 0.0), abs=1e-9)


@pytest.mark.parametrize("facets", range(2, 13))
def test_an_end_of_several_facets_is_on_the_axis(facets: int) -> None:
    angle = np.linspace(-np.pi / 2.0, np.pi / 2.0, facets + 1)
    arc = np.column_stack([20.0 + np.cos(angle), np.sin(angle)])
    assert right_end(Polygon([(0, -1), *arc, (0, 1)]))[1] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("chamfer", np.linspace(0.1, 0.9, 9))
def test_a_chamfered_end_is_on_the_axis(chamfer: float) -> None:
    c = float(chamfer)
    area = Polygon([(0, -1), (20 - c, -1), (20, c - 1), (20, 1 - c), (20 - c, 1), (0, 1)])
    assert right_end(area) == pytest.approx((20.0, 0.0), abs=1e-6)
    single = Polygon([(0, -1), (20 - c, -1), (20, c - 1), (20, 1), (0, 1)])
    assert abs(right_end(single)[1]) <= 0.501 * c
