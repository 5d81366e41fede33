"""Validity of areas with many holes: as GEOS has it."""

from collections.abc import Callable

import numpy as np
import pytest
import shapely
from shapely import Polygon, box

from midrib import validity
from midrib.kernels.sweep import enclosed
from midrib.validity import has_rings_apart, is_valid, is_valid_one

Ring = list[tuple[float, float]]


def square(x: float, y: float, size: float = 2.0) -> Ring:
    """Ring of a square."""
    return [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]


GRID = [square(4.0 * i + 1.0, 4.0 * j + 1.0) for i in range(11) for j in range(11)]
SHELL = square(0.0, 0.0, 44.0)
DEFECTS: dict[str, Callable[[], Polygon]] = {
    "outside": lambda: Polygon(SHELL, [*GRID, square(50.0, 1.0)]),
    "on the level of others, left": lambda: Polygon(SHELL, [*GRID, square(-9.0, 1.0)]),
    "within another": lambda: Polygon(SHELL, [*GRID, square(1.5, 1.5, 1.0)]),
    "around another": lambda: Polygon(SHELL, [*GRID, square(0.5, 0.5, 3.0)]),
    "twice": lambda: Polygon(SHELL, [*GRID, GRID[5]]),
    "across another": lambda: Polygon(SHELL, [*GRID, square(2.0, 2.0)]),
    "across the shell": lambda: Polygon(SHELL, [*GRID, square(43.5, 20.0)]),
    "along another": lambda: Polygon(SHELL, [*GRID, square(3.0, 1.0, 1.0)]),
    "a bow-tie": lambda: Polygon(SHELL, [*GRID, [(3.2, 3.2), (3.8, 3.8), (3.8, 3.2), (3.2, 3.8)]]),
    "in a shell that crosses itself": lambda: Polygon(
        [*SHELL[:3], (50.0, 20.0), (43.9, 20.0), (43.9, 44.0)], GRID
    ),
    "around the shell": lambda: Polygon(square(1.0, 1.0, 1.0), [square(0.0, 0.0, 9.0)] * 101),
}


def test_rings_apart_are_valid_without_geos(monkeypatch: pytest.MonkeyPatch) -> None:
    area = Polygon(SHELL, GRID)
    assert shapely.is_valid(area)
    assert has_rings_apart(area)
    monkeypatch.setattr(validity, "has_rings_apart", lambda _: True)
    assert is_valid_one(Polygon(SHELL, [*GRID, GRID[0]]))  # GEOS is not asked any more


@pytest.mark.parametrize("name", DEFECTS)
def test_defects_are_seen(name: str) -> None:
    area = DEFECTS[name]()
    assert not shapely.is_valid(area)
    assert not is_valid_one(area)
    assert is_valid(np.array([area, Polygon(SHELL, GRID), None])).tolist() == [False, True, False]


def test_holes_that_touch_are_valid() -> None:
    area = Polygon(SHELL, [*GRID, [(3.0, 3.0), (3.8, 3.2), (3.8, 3.8)]])
    assert not has_rings_apart(area)
    assert is_valid_one(area)


def test_points_in_a_ring_are_those_that_it_covers() -> None:
    rng = np.random.default_rng(3)
    for _ in range(40):
        angle = np.sort(rng.uniform(0.0, 2.0 * np.pi, 30))
        radius = rng.integers(2, 9, 30)
        # Whole numbers: rays pass through vertices and along edges.
        star = Polygon(np.round(np.column_stack([np.cos(angle), np.sin(angle)]) * radius[:, None]))
        points = rng.integers(-9, 10, (200, 2)).astype(float)
        if not star.is_valid:
            continue
        apart = shapely.distance(star.exterior, shapely.points(points)) > 0.0
        found = enclosed(shapely.get_coordinates(star.exterior), points[apart])
        assert np.array_equal(found, shapely.contains(star, shapely.points(points[apart])))


def test_no_points_are_in_no_ring() -> None:
    assert enclosed(shapely.get_coordinates(box(0, 0, 1, 1)), np.empty((0, 2))).size == 0
