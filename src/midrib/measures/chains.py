"""What measures share: geometries checked and broadcast, their vertices in rows, distances.

lines       0           1                       chains: the parts of lines, or the rings of
vertices    o--o--o     o--o   o--o--o          areas, one after the other
owner       0  0  0     1  1   1  1  1
goes on     x  x     .  x    . x  x             whether a chain goes on to the next vertex
"""

from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, MultiLineString, MultiPolygon, Polygon

from midrib.checks import check_flag
from midrib.errors import GeometryTypeError, ParameterError
from midrib.geodesy import lengths_at
from midrib.kernels.clearance import clearances

if TYPE_CHECKING:
    from midrib.types import Bools, Floats, Ints

__all__ = [
    "Chains",
    "Geometries",
    "areas_of",
    "distances",
    "flat_together",
    "is_there",
    "lines_of",
    "one",
    "rings",
    "shaped",
    "step_vectors",
    "subdivided",
    "unit_lengths",
    "vertices",
]

Geometries: TypeAlias = NDArray[np.object_]


class Chains(NamedTuple):
    """Vertices in rows; several chains may belong to one geometry."""

    points: "Floats"  # (n, 2)
    owner: "Ints"  # (n,) position of the geometry
    goes_on: "Bools"  # (n - 1,) whether a segment leads to the next vertex


def lines_of(geometries: Any, name: str) -> Geometries:
    """Lines as an object array, some perhaps missing."""
    return checked(geometries, (LineString, MultiLineString), name)


def areas_of(geometries: Any, name: str) -> Geometries:
    """Areas as an object array, some perhaps missing."""
    return checked(geometries, (Polygon, MultiPolygon), name)


def checked(geometries: Any, kinds: tuple[type, ...], name: str) -> Geometries:
    """Geometries as an object array, all of the right kind or missing."""
    array = np.asarray(geometries, dtype=object)
    for i, geometry in enumerate(array.ravel()):
        if geometry is not None and not isinstance(geometry, kinds):
            found = getattr(geometry, "geom_type", type(geometry).__name__)
            wanted = " or ".join(kind.__name__ for kind in kinds)
            msg = f"{name}{f'[{i}]' if array.ndim else ''} is a {found}, expected {wanted}"
            raise GeometryTypeError(msg)
    return array


def one(array: Geometries, name: str) -> Geometries:
    """Return an array of one, or refuse an array of more."""
    if array.ndim:
        msg = f"{name} is an array, expected one geometry"
        raise GeometryTypeError(msg)
    return array.reshape(1)


def flat_together(first: Geometries, second: Geometries) -> tuple[Geometries, Geometries, Any]:
    """Two arrays, flat and as long, and an array of the shape they have together.

    Raises
    ------
    ParameterError
        If their shapes do not go together.
    """
    try:
        both = np.broadcast_arrays(first, second)
    except ValueError:
        msg = (
            f"arrays of shapes {first.shape} and {second.shape} do not broadcast, expected as many"
        )
        raise ParameterError(msg) from None
    return both[0].ravel(), both[1].ravel(), both[0]


def is_there(geometries: Geometries) -> "Bools":
    """Which geometries are neither missing nor empty."""
    there: Bools = ~(shapely.is_missing(geometries) | shapely.is_empty(geometries))
    return there


def shaped(numbers: "Floats", like: Geometries) -> Any:
    """Numbers in the shape of an array, a float where that has no axis."""
    return numbers.reshape(like.shape) if like.ndim else float(numbers[0])


def vertices(lines: Geometries) -> Chains:
    """Vertices of lines."""
    parts, line_of_part = shapely.get_parts(lines, return_index=True)
    points, part = shapely.get_coordinates(parts, return_index=True)
    return Chains(points, line_of_part[part], part[:-1] == part[1:])


def rings(areas: Geometries) -> Chains:
    """Vertices of the boundaries of areas."""
    parts, area_of_part = shapely.get_parts(areas, return_index=True)
    closed, part_of_ring = shapely.get_rings(parts, return_index=True)
    points, ring = shapely.get_coordinates(closed, return_index=True)
    return Chains(points, area_of_part[part_of_ring[ring]], ring[:-1] == ring[1:])


def unit_lengths(geometries: Geometries, geographic: bool) -> "Floats":
    """(n, 2) metres in a unit of x and of y at the middle latitude of each geometry, or ones."""
    check_flag(geographic, "geographic")
    if not geographic:
        return np.ones((geometries.size, 2))
    bounds = shapely.bounds(geometries)
    return np.column_stack(lengths_at((bounds[:, 1] + bounds[:, 3]) / 2.0))


def step_vectors(points: "Floats", geographic: bool) -> "Floats":
    """Vectors from each point to the next, in metres if ``geographic``."""
    check_flag(geographic, "geographic")
    steps = np.diff(points, axis=0)
    if geographic:
        middle = (points[:-1, 1] + points[1:, 1]) / 2.0
        steps = steps * np.column_stack(lengths_at(middle))
    return steps


def subdivided(chains: Chains, longest: "Floats", geographic: bool) -> Chains:
    """Chains with points put in evenly, so that no segment is longer than told for its owner."""
    length = np.hypot(*step_vectors(chains.points, geographic).T)
    with np.errstate(invalid="ignore", divide="ignore"):
        count = np.ceil(length / longest[chains.owner[:-1]])
    # NaN, without an area or a finite place, is one piece as it stands.
    is_cut = chains.goes_on & (count > 1.0) & np.isfinite(count)
    pieces = np.append(np.where(is_cut, count, 1.0), 1.0)[: len(chains.points)].astype(np.intp)
    step = np.zeros_like(chains.points)
    step[:-1][is_cut] = np.diff(chains.points, axis=0)[is_cut] / count[is_cut, None]
    first = np.cumsum(pieces) - pieces
    number = np.arange(pieces.sum()) - np.repeat(first, pieces)
    points = np.repeat(chains.points, pieces, axis=0)
    points += number[:, None] * np.repeat(step, pieces, axis=0)
    goes_on = np.ones(max(number.size - 1, 0), dtype=np.bool_)
    goes_on[first[1:] - 1] = chains.goes_on
    return Chains(points, np.repeat(chains.owner, pieces), goes_on)


def distances(points: "Floats", owner: "Ints", chains: Chains, unit: "Floats") -> "Floats":
    """Distance of each point to the chains of its owner, NaN where it has none.

    ``unit`` is as from ``unit_lengths``, one row for each owner; owners are in order.
    """
    first = np.arange(len(unit) + 1)
    distance = clearances(
        *columns(points * unit[owner]),
        np.searchsorted(owner, first),
        *columns(chains.points * unit[chains.owner]),
        np.append(chains.goes_on, np.False_),
        np.searchsorted(chains.owner, first),
    )
    return np.where(np.isfinite(distance), distance, np.nan)


def columns(points: "Floats") -> tuple["Floats", "Floats"]:
    """X and y of points, each in one piece of memory."""
    return points[:, 0].copy(), points[:, 1].copy()
