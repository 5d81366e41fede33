"""A cloud: points in chunks, so that its size does not matter."""

from typing import TYPE_CHECKING, Protocol

import numpy as np

from midrib.checks import shown
from midrib.errors import GeometryTypeError, ParameterError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from midrib.types import Floats

__all__ = ["CHUNK", "ArrayCloud", "Cloud", "sample_of"]

CHUNK = 500_000  # points
LEAST = 100  # points of a cloud that can tell an axis


class Cloud(Protocol):
    """What a file of points, or an array of them, can do."""

    @property
    def count(self) -> int | None:
        """Number of points; None if only reading tells."""

    @property
    def metres(self) -> float | None:
        """Length of a coordinate unit in metres; None if nothing tells."""

    @property
    def crs(self) -> str | None:
        """Reference system of the coordinates, as WKT or EPSG code."""

    @property
    def name(self) -> str:
        """What to call it in messages."""

    def chunks(self) -> "Iterator[Floats]":
        """Points (n, 3), a chunk at a time; every call begins anew."""


class ArrayCloud:
    """An array of points.

    Parameters
    ----------
    points : array_like, shape (n, 3)

    Raises
    ------
    GeometryTypeError
        If the points are no table of three columns of numbers.
    """

    metres: float | None = None
    crs: str | None = None
    name = "source"

    def __init__(self, points: object) -> None:
        try:
            table = np.asarray(points, dtype=np.float64)
        except (TypeError, ValueError) as error:
            msg = f"source is {shown(points)}, expected a path or an array (n, 3) of numbers"
            raise GeometryTypeError(msg) from error
        if table.ndim != 2 or table.shape[1] != 3:
            msg = f"source has the shape {table.shape}, expected (n, 3): x, y, z"
            raise GeometryTypeError(msg)
        self.points = table

    @property
    def count(self) -> int:
        """Number of points."""
        return len(self.points)

    def chunks(self) -> "Iterator[Floats]":
        """Points (n, 3), a chunk at a time."""
        for first in range(0, len(self.points), CHUNK):
            yield self.points[first : first + CHUNK]


def sample_of(cloud: Cloud, most: int) -> "Floats":
    """Points (at most about ``most``, 3) spread over the whole cloud.

    Raises
    ------
    ParameterError
        If there are too few points.
    """
    kept: list[Floats] = []
    total, stride = 0, 1 if cloud.count is None else max(1, cloud.count // most)
    random = np.random.default_rng(0)  # scanners write column by column: every n-th point may
    for chunk in cloud.chunks():  # lie on one line, random ones do not
        chosen = chunk
        if stride > 1:
            chosen = chunk[random.random(len(chunk)) < 1.0 / stride]
        kept.append(chosen[np.isfinite(chosen).all(axis=1)])
        total += len(kept[-1])
        if cloud.count is None and total > 2 * most:
            kept = [np.concatenate(kept)[::2]]
            total, stride = len(kept[0]), 2 * stride
    points = np.concatenate([np.zeros((0, 3)), *kept])
    if len(points) < LEAST:
        msg = f"{cloud.name} has {len(points)} points, expected at least {LEAST}"
        raise ParameterError(msg)
    return points
