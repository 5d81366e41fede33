"""The cube of counts against NumPy, point by point."""

from typing import Any

import numpy as np
import pytest

from midrib.kernels.cube import MOMENTS, count_points
from midrib.types import Floats

LEVELS, SECTORS, BINS = 10, 12, 41
NO_FACES = np.zeros((0, 2))
SQUARE = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])


def counted(points: Floats, faces: Floats) -> tuple[int, Floats, Floats, Floats]:
    """Cube of points around an upright cone: 10 high, radius 2 to 1."""
    s = np.arange(-1.0, 12.0, 0.5)
    table = np.column_stack([0.1 + 0.0 * s, -0.2 + 0.0 * s, 2.0 - 0.1 * s, 0.0 * s, 0.0 * s])
    grid = np.array([-1.0, 0.5, 0.0, 1.0, -0.5 * BINS * 0.01, 0.01])
    cube: Any = np.zeros((2, LEVELS, SECTORS, BINS), dtype=np.float32)
    counts, sums = cube
    moments = np.zeros((LEVELS, SECTORS, MOMENTS))
    origin, turn = np.array([5.0, 6.0, 7.0]), np.eye(3)
    total = count_points(points, origin, turn, table, faces, grid, counts, sums, moments)
    return total, counts, sums, moments


@pytest.mark.parametrize("faces", [NO_FACES, SQUARE])
def test_counts_are_those_of_numpy(faces: Floats) -> None:
    random = np.random.default_rng(1)
    points = random.uniform([2.5, 3.5, 6.0], [7.5, 8.5, 18.0], (20_000, 3))
    total, counts, sums, moments = counted(points, faces)
    q = points - [5.1, 5.8, 7.0]
    away = (q[:, :2] @ faces.T).max(axis=1) if len(faces) else np.hypot(q[:, 0], q[:, 1])
    d = away - (2.0 - 0.1 * q[:, 2])
    azimuth = np.arctan2(q[:, 1], q[:, 0]) % (2.0 * np.pi)
    place = np.column_stack([q[:, 2], azimuth / (2.0 * np.pi) * SECTORS, d / 0.01 + 0.5 * BINS])
    cell = np.floor(place).astype(int)
    inside = ((cell >= 0) & (cell < [LEVELS, SECTORS, BINS])).all(axis=1)
    expected = np.zeros((LEVELS, SECTORS, BINS))
    np.add.at(expected, tuple(cell[inside].T), 1.0)
    assert total == inside.sum()
    assert np.array_equal(counts, expected)
    assert moments[..., 2].sum() == total
    assert moments[..., 1].sum() == pytest.approx(q[inside, 2].sum())
    middle = 0.01 * (np.arange(BINS) - BINS // 2)
    assert (counts * middle).sum() + sums.sum() == pytest.approx(d[inside].sum(), abs=1e-3)


def test_foot_is_perpendicular_to_a_leaning_axis() -> None:
    slope, radius = 0.1, 1.5
    s = np.arange(-1.0, 12.0, 0.5)
    table = np.column_stack([slope * s, 0.0 * s, radius + 0.0 * s, slope + 0.0 * s, 0.0 * s])
    t = np.array([slope, 0.0, 1.0]) / np.hypot(slope, 1.0)
    across = np.array([t[2], 0.0, -t[0]])
    angle, at = np.random.default_rng(2).uniform([[0.0], [2.0]], [[6.28], [8.0]], (2, 500))
    ring = np.cos(angle)[:, None] * across + np.sin(angle)[:, None] * [0.0, 1.0, 0.0]
    points = at[:, None] * [slope, 0.0, 1.0] + radius * ring
    grid = np.array([-1.0, 0.5, 0.0, 1.0, -0.5 * BINS * 1e-6, 1e-6])
    cube: Any = np.zeros((2, LEVELS, SECTORS, BINS), dtype=np.float32)
    counts, sums = cube
    moments = np.zeros((LEVELS, SECTORS, MOMENTS))
    count_points(points, np.zeros(3), np.eye(3), table, NO_FACES, grid, counts, sums, moments)
    assert counts[..., BINS // 2].sum() == 500
    assert moments[..., 1].sum() == pytest.approx(at.sum())
