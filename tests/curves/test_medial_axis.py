"""The medial axis: closed forms, radii, tips and cycles."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from shapely import Polygon, box
from shapely.affinity import rotate, translate

from midrib import Skeleton, skeleton
from tests.shapes import NAMED, VALID
from tests.strategies import simple_areas


def checked(area: Polygon) -> Skeleton:
    """Medial axis of an area whose radii are distances and whose tips are convex vertices."""
    found = skeleton(area, "medial-axis")
    size = np.hypot(area.bounds[2] - area.bounds[0], area.bounds[3] - area.bounds[1])
    distance = shapely.distance(shapely.points(found.points), area.boundary)
    assert found.radius == pytest.approx(distance, abs=1e-9 * size)
    degree = np.bincount(found.edges.ravel(), minlength=len(found.points))
    assert np.array_equal(degree == 1, found.radius == 0.0)
    return found


@pytest.mark.parametrize("name", sorted(VALID))
def test_radii_are_distances(name: str) -> None:
    checked(VALID[name])


@pytest.mark.parametrize("name", sorted(NAMED))
def test_every_hole_is_gone_round_once(name: str) -> None:
    found = checked(NAMED[name])
    assert len(found.edges) - len(found.points) + 1 == len(NAMED[name].interiors)


@given(area=simple_areas)
@settings(max_examples=80)
def test_areas_without_holes_have_trees(area: Polygon) -> None:
    found = checked(area)
    assert len(found.edges) == len(found.points) - 1


def test_a_rectangle_has_a_middle_and_four_bisectors() -> None:
    lines = checked(box(0, 0, 9, 2)).lines
    middle = shapely.from_wkt("LINESTRING (1 1, 8 1)")
    corners = ["(0 0, 1 1)", "(0 2, 1 1)", "(9 0, 8 1)", "(9 2, 8 1)"]
    wanted = shapely.union_all([middle, *(shapely.from_wkt(f"LINESTRING {c}") for c in corners)])
    assert lines.hausdorff_distance(wanted) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("n", [3, 4, 5, 6, 7, 12, 64])
def test_a_regular_polygon_has_spokes(n: int) -> None:
    turn = 2.0 * np.pi * np.arange(n) / n
    found = checked(Polygon(np.column_stack([np.cos(turn), np.sin(turn)])))
    assert len(found.branches) == n
    assert found.lines.length == pytest.approx(n)
    assert found.radius.max() == pytest.approx(np.cos(np.pi / n))


def test_an_arc_is_as_near_as_stated() -> None:
    area = NAMED["L"]
    fine = skeleton(area, "medial-axis", tolerance=1e-6).lines
    coarse = skeleton(area, "medial-axis", tolerance=1e-2).lines
    assert len(shapely.get_coordinates(coarse)) < len(shapely.get_coordinates(fine))
    assert coarse.hausdorff_distance(fine) <= 1e-2 + 1e-6


@pytest.mark.parametrize("name", ["L", "comb", "river_with_island", "ring_road"])
def test_the_axis_moves_with_its_area(name: str) -> None:
    one = checked(NAMED[name]).lines
    moved = checked(translate(rotate(NAMED[name], 33.0, origin=(0, 0)), 5e5, 5e6)).lines
    there = translate(rotate(one, 33.0, origin=(0, 0)), 5e5, 5e6)
    assert moved.hausdorff_distance(there) < 1e-3
    assert moved.length == pytest.approx(one.length, abs=1e-3)
