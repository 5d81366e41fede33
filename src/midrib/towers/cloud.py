"""A cloud: points in chunks, so that its size does not matter."""

from typing import TYPE_CHECKING, Protocol

import numpy as np

from midrib.checks import shown
from midrib.errors import GeometryTypeError, ParameterError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from midrib.types import Bools, Floats

__all__ = [
    "CHUNK",
    "DOUBLES",
    "ArrayCloud",
    "Cloud",
    "InOrder",
    "Tally",
    "check_spacing",
    "sample_of",
    "spots_in",
]

CHUNK = 500_000  # points
PIECE = 100  # points read at one place for a sample, where places are free to choose
LEAST = 100  # points of a cloud that can tell an axis
DOUBLES = ("f8", "f8", "f8")
COARSEST = 1e-3  # metres: steps between numbers that a scan's own noise hides


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
    def types(self) -> tuple[str, ...]:
        """NumPy's names of the types of number in which x, y and z are stored."""

    @property
    def name(self) -> str:
        """What to call it in messages."""

    @property
    def has_stations(self) -> bool:
        """Whether it says which points are from which station."""

    def chunks(self, *, with_stations: bool = False) -> "Iterator[Floats]":
        """Points (n, 3), or (n, 4) with the number of the station, a chunk at a time.

        Every call begins anew.
        """

    def some(self, most: int, /) -> "Iterator[Floats]":
        """Points from all over the cloud, not many fewer than ``most``; as wide as it can."""


class InOrder:
    """What a cloud that can only be read from its beginning does."""

    has_stations: bool = False
    types: tuple[str, ...] = DOUBLES

    def chunks(self, *, with_stations: bool = False) -> "Iterator[Floats]":
        """Points, a chunk at a time."""
        raise NotImplementedError

    def some(self, _: int) -> "Iterator[Floats]":
        """All points: a sample as wide as it can be."""
        return self.chunks(with_stations=self.has_stations)


def spots_in(count: int, most: int, piece: int = PIECE) -> "list[tuple[int, int]]":
    """Where pieces (first, number) of a sample begin, evenly over so many points.

    Scanners write column by column: points at even steps may lie on one line, so each piece is
    somewhere at random in its part.
    """
    parts = max(1, most // piece)
    if count <= max(most, parts * piece):
        return [(0, count)]
    starts = np.linspace(0, count, parts + 1)[:-1]
    room = count / parts - piece
    random = np.random.default_rng(0).uniform(0.0, max(room, 0.0), parts)
    return [(int(start), min(piece, count - int(start))) for start in starts + random]


class ArrayCloud:
    """An array of points.

    Parameters
    ----------
    points : array_like, shape (n, 3)
    stations : array_like of int, shape (n,), optional
        Which points are from which station.

    Raises
    ------
    GeometryTypeError
        If the points are no table of three columns of numbers, or stations no column beside it.
    """

    metres: float | None = None
    crs: str | None = None
    name = "source"

    def __init__(self, points: object, stations: object = None) -> None:
        try:
            stored = np.asarray(points)
            table = np.asarray(stored, dtype=np.float64)
        except (TypeError, ValueError) as error:
            msg = f"source is {shown(points)}, expected a path or an array (n, 3) of numbers"
            raise GeometryTypeError(msg) from error
        if table.ndim != 2 or table.shape[1] != 3:
            msg = f"source has the shape {table.shape}, expected (n, 3): x, y, z"
            raise GeometryTypeError(msg)
        self.points = table
        self.types: tuple[str, ...] = (stored.dtype.str,) * 3
        self.stations = None if stations is None else np.asarray(stations)
        if self.stations is not None and (
            self.stations.shape != (len(table),) or self.stations.dtype.kind not in "iu"
        ):
            found = f"the shape {self.stations.shape} and the type {self.stations.dtype}"
            msg = f"stations has {found}, expected whole numbers ({len(table)},)"
            raise GeometryTypeError(msg)

    @property
    def has_stations(self) -> bool:
        """Whether it says which points are from which station."""
        return self.stations is not None

    @property
    def count(self) -> int:
        """Number of points."""
        return len(self.points)

    def chunks(self, *, with_stations: bool = False) -> "Iterator[Floats]":
        """Points (n, 3), or (n, 4) with stations, a chunk at a time."""
        for first in range(0, len(self.points), CHUNK):
            yield self.piece(first, CHUNK, with_stations=with_stations)

    def some(self, most: int) -> "Iterator[Floats]":
        """Points from all over the cloud."""
        for first, count in spots_in(self.count, most):
            yield self.piece(first, count, with_stations=self.has_stations)

    def piece(self, first: int, count: int, *, with_stations: bool) -> "Floats":
        """Read some points."""
        rows = slice(first, first + count)
        if self.stations is None or not with_stations:
            return self.points[rows]
        return np.column_stack([self.points[rows], self.stations[rows]])


class Tally:
    """Count, in passing, of points that lack a coordinate."""

    unusable = 0

    def over(self, chunks: "Iterable[Floats]") -> "Iterator[Floats]":
        """Points, a chunk at a time, those with all coordinates."""
        for chunk in chunks:
            known: Bools = np.asarray(np.isfinite(chunk).all(axis=1))
            self.unusable += len(known) - int(known.sum())
            yield chunk if known.all() else chunk[known]


def sample_of(chunks: "Iterable[Floats]", most: int, name: str) -> "tuple[Floats, int]":
    """Points (at most about twice ``most``, 3 or 4) of all chunks, finite ones; how many came.

    Raises
    ------
    ParameterError
        If there are too few points.
    """
    kept: list[Floats] = []
    came, total, share = 0, 0, 1.0
    random = np.random.default_rng(0)
    for chunk in chunks:
        came += len(chunk)
        chosen = chunk if share == 1.0 else chunk[random.random(len(chunk)) < share]
        kept.append(chosen[np.isfinite(chosen).all(axis=1)])
        total += len(kept[-1])
        if total > 2 * most:
            together = np.concatenate(kept)
            kept = [together[random.random(total) < most / total]]
            share, total = share * most / total, len(kept[0])
    points = np.concatenate(kept) if kept else np.zeros((0, 3))
    if len(points) < LEAST:
        msg = f"{name} has {len(points)} points, expected at least {LEAST}"
        raise ParameterError(msg)
    return points, came


def check_spacing(sample: "Floats", types: tuple[str, ...], unit: float, name: str) -> None:
    """Refuse coordinates that are too large for the type of number in which they are stored.

    A float32 has 24 bits: at 6,000,000 m in a map grid these are half a metre apart.

    Parameters
    ----------
    sample : ndarray, shape (n, 3)
    types : tuple of str
        Types in which x, y and z are stored.
    unit : float
        Coordinate units in a metre.
    name : str
        What to call the cloud.

    Raises
    ------
    ParameterError
        If numbers as large as the coordinates are more than a millimetre apart.
    """
    # Half of the points are as far out: some strays would not matter.
    usual = np.median(np.abs(sample), axis=0)
    apart = [
        float(np.spacing(value.astype(kind))) / unit if np.dtype(kind).kind == "f" else 0.0
        for value, kind in zip(usual, types, strict=True)
    ]
    worst = int(np.argmax(apart))
    if apart[worst] > COARSEST:
        kind = np.dtype(types[worst]).name
        msg = (
            f"{name} has {'xyz'[worst]} of about {usual[worst]:,.0f} stored as {kind}, whose "
            f"numbers there are {1000.0 * apart[worst]:.3g} mm apart, expected at most "
            f"{1000.0 * COARSEST:g} mm; subtract an offset before storing, or store float64"
        )
        raise ParameterError(msg)
