"""Polygons as arrays."""

import numpy as np
import pytest
import shapely
from shapely import Polygon, box

from midrib.ragged import pack_areas, pack_rings

SQUARE = ((0.0, 0.0), (0.0, 9.0), (9.0, 9.0), (9.0, 0.0))
HOLES = (((1.0, 1.0), (2.0, 1.0), (2.0, 2.0)), ((0.0, 0.0), (5.0, 1.0), (5.0, 2.0)))


def repeated(ring: tuple[tuple[float, float], ...], times: int) -> list[tuple[float, float]]:
    """Ring with every point so many times."""
    return [point for point in ring for _ in range(times)]


@pytest.mark.parametrize("times", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("holes", [(), HOLES[:1], HOLES])
def test_rings_of_one_are_those_of_an_array(
    times: int, holes: tuple[tuple[tuple[float, float], ...], ...]
) -> None:
    # The second hole begins where the shell does.
    area = Polygon(repeated(SQUARE, times), [repeated(ring, times) for ring in holes])
    assert area.is_valid
    found, expected = pack_rings(area), pack_areas(np.array([area], dtype=object)).rings(0)
    assert np.array_equal(found[0], expected[0])
    assert np.array_equal(found[1], expected[1])


def test_rings_of_random_areas_are_those_of_an_array() -> None:
    rng = np.random.default_rng(11)
    for _ in range(50):
        at = rng.uniform(1.0, 98.0, (30, 2))
        area = box(0, 0, 100, 100) - shapely.union_all(shapely.buffer(shapely.points(at), 2.0))
        found, expected = pack_rings(area), pack_areas(np.array([area], dtype=object)).rings(0)
        assert np.array_equal(found[0], expected[0])
        assert np.array_equal(found[1], expected[1])
