"""Walls of a section, each followed along itself, however it bends.

cell      square of half an interval with points in it
wall      cells that hang together: each is within LINK intervals of another
guide     a smooth line along a wall, on the longest way through its cells
s, d      coordinates of a point of a wall: along the guide, and off it

              s -->          A wall's points are nearly straight in s and d, so they are thinned
        . : . . : . : .      there: bends of more than half a turn are bends like others.
    ----------------------
        : .  . : .  . :      d
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import KDTree
from shapely import LineString

from midrib.towers.thinning import Thinning, thinned_wall

if TYPE_CHECKING:
    from midrib.types import Bools, Floats, Ints

__all__ = ["follow_walls"]

CELL, LINK = 0.5, 1.5  # intervals
LEAST_CELLS = 8  # of a wall
COARSER = (1.0, 2.0, 4.0)  # cells are tried, where points are few
FAR = 6.0  # times the spread
MISSED = 10.0  # points in a row
SHORTER = 0.25  # of the cells of the one wall: fewer make no other
PIECE = 4  # cells of what may be a piece of a wall beyond a gap
SPARSE, AROUND = 0.15, 4.0  # share of the usual points of a cell; intervals around it
LONG = 2.0  # intervals: how much longer than the other one a wall may be at an end,
SKEW = 0.5  # and widths
SMOOTH = 2  # vertices of a guide on either side that it is the mean of


class Guide(NamedTuple):
    """A line along a wall."""

    line: LineString
    tangents: "Floats"  # (m, 2) at its vertices
    stations: "Floats"  # (m,) of its vertices


def follow_walls(
    points: "Floats", thinning: Thinning, interval: float, radius: float
) -> "list[Floats] | None":
    """Curves (m, 2) through the two walls of a section, in the same direction, main's first.

    Main has the other one on the side of greater u where the object runs along v. None where there
    are no two walls, each in one piece: where they hang together, or one has a gap. What hangs
    together with neither is left out. O(n log n).

    Parameters
    ----------
    points : (n, 2) u and v
    thinning, interval, radius : see ``thinned_wall``
    """
    for coarse in COARSER:
        walls = walls_in_cells(points, coarse * interval, interval)
        if walls is None:
            continue
        thin = [thinned_wall(straight, thinning, interval, radius) for _, straight in walls]
        if min(map(len, thin)) > 1:
            return in_order([bent(guide, t) for (guide, _), t in zip(walls, thin, strict=True)])
    return None


def walls_in_cells(
    points: "Floats", size: float, interval: float
) -> "list[tuple[Guide, Floats]] | None":
    """Guides of both walls, and d and s of their points, with cells of half this size."""
    cells, cell_of, count = cells_of(points, CELL * size)
    dense = is_dense(cells, count, AROUND * size)
    links = links_of(cells, LINK * size)
    links.data[~(dense[links.row] & dense[links.col])] = 0.0
    links.eliminate_zeros()
    n, wall_of = connected_components(links, directed=False)
    sizes = np.bincount(wall_of, minlength=2)
    first, second = np.argsort(-sizes, kind="stable")[:2]
    if n < 2 or sizes[second] < max(LEAST_CELLS, SHORTER * sizes[first]):
        return None
    guides = [guide_of(cells, links, wall_of == wall, size) for wall in (first, second)]
    others = [k for k in range(n) if k not in (first, second) and sizes[k] >= PIECE]
    if any(goes_on(guides, cells[wall_of == k].mean(axis=0)) for k in others):
        return None
    one, other = guides
    if not (do_face(one, other, interval) and do_face(other, one, interval)):
        return None
    walls = [
        (guide, beside(straightened(guide, points[wall_of[cell_of] == wall]), CELL * size))
        for wall, guide in zip((first, second), guides, strict=True)
    ]
    return None if any(has_gap(straight[:, 1], interval) for _, straight in walls) else walls


def beside(straight: "Floats", least: float) -> "Floats":
    """Points no farther off the guide than usual ones, or than this: others lean on the wall."""
    off = np.abs(straight[:, 0] - np.median(straight[:, 0]))
    near: Floats = straight[off <= max(FAR * 1.4826 * float(np.median(off)), least)]
    return near


def has_gap(s: "Floats", interval: float) -> bool:
    """Whether points along a wall are missing over more than may be, and than chance explains."""
    gap = float(np.diff(np.sort(s)).max(initial=0.0))
    return gap > max(LONG * interval, MISSED * float(np.ptp(s)) / s.size)


def cells_of(points: "Floats", size: float) -> "tuple[Floats, Ints, Ints]":
    """Means (k, 2) of the points of cells, the cell (n,) of each point, and how many each has."""
    squares = np.floor((points - points.min(axis=0)) / size).astype(np.int64)
    _, cell_of = np.unique(
        squares[:, 0] * (squares[:, 1].max() + 1) + squares[:, 1], return_inverse=True
    )
    count = np.bincount(cell_of)
    sums = np.column_stack([np.bincount(cell_of, points[:, k]) for k in range(2)])
    return sums / count[:, None], cell_of, count


def is_dense(cells: "Floats", count: "Ints", reach: float) -> "Bools":
    """Which cells have no fewer points than a sparse part of a wall nearby.

    As many as usual is what a point nearby sees in its cell, on average: most see a wall's.
    """
    near = links_of(cells, reach).astype(np.bool_).astype(np.float64)
    near = near + near.T
    usual = (near @ count**2.0 + count**2.0) / (near @ count + count)
    dense: Bools = count >= SPARSE * usual
    return dense


def links_of(cells: "Floats", reach: float) -> coo_array:
    """Lengths of the ways between cells that are so near."""
    pairs = KDTree(cells).query_pairs(reach, output_type="ndarray")
    away = np.linalg.norm(cells[pairs[:, 0]] - cells[pairs[:, 1]], axis=1)
    return coo_array((away, (pairs[:, 0], pairs[:, 1])), shape=(len(cells), len(cells)))


def guide_of(cells: "Floats", links: coo_array, is_wall: "Bools", interval: float) -> Guide:
    """Smooth line along the longest way through a wall's cells, longer than it at both ends."""
    graph, start = links.tocsr(), int(np.argmax(is_wall))
    away = dijkstra(graph, directed=False, indices=start)
    start = int(np.argmax(np.where(np.isfinite(away), away, -1.0)))
    away, before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)
    at = int(np.argmax(np.where(np.isfinite(away), away, -1.0)))
    way = [at]
    while at != start:
        at = int(before[at])
        way.append(at)
    path = LineString(cells[way])
    steps = max(round(path.length / interval), 2)
    even = shapely.get_coordinates(
        shapely.line_interpolate_point(path, np.linspace(0.0, path.length, steps + 1))
    )
    padded = np.pad(even, ((SMOOTH, SMOOTH), (0, 0)), mode="reflect", reflect_type="odd")
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * SMOOTH + 1, axis=0)
    smooth = windows.mean(axis=-1)
    ends = 2.0 * smooth[[0, -1]] - smooth[[1, -2]]
    vertices = np.vstack([ends[:1], smooth, ends[1:]])
    tangents = np.gradient(vertices, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    spans = np.linalg.norm(np.diff(vertices, axis=0), axis=1)
    return Guide(LineString(vertices), tangents, np.concatenate([[0.0], np.cumsum(spans)]))


def goes_on(guides: list[Guide], point: "Floats") -> bool:
    """Whether a point lies beyond an end of the guide that is nearer to it."""
    where = shapely.Point(point)
    near = min(guides, key=lambda guide: float(guide.line.distance(where)))
    return not 0.0 < near.line.project(where) < near.line.length


def do_face(guide: Guide, other: Guide, interval: float) -> bool:
    """Whether a wall has the other one beside it, but for skew ends."""
    vertices = shapely.points(guide.line.coords)
    s = shapely.line_locate_point(other.line, vertices)
    away = shapely.distance(other.line, vertices)
    is_alone = (s <= 0.0) | (s >= other.line.length)
    alone = float(np.gradient(guide.stations)[is_alone].sum())
    return alone <= 2.0 * (LONG * interval + SKEW * float(np.median(away)))


def straightened(guide: Guide, points: "Floats") -> "Floats":
    """Return d and s (n, 2) of points of a wall."""
    where = shapely.points(points)
    s = shapely.line_locate_point(guide.line, where)
    off = points - shapely.get_coordinates(shapely.line_interpolate_point(guide.line, s))
    along = tangents_at(guide, s)
    side = np.sign(along[:, 1] * off[:, 0] - along[:, 0] * off[:, 1])
    return np.column_stack([side * np.linalg.norm(off, axis=1), s])


def bent(guide: Guide, straight: "Floats") -> "Floats":
    """Return the points (n, 2) that have such d and s."""
    foot = shapely.get_coordinates(shapely.line_interpolate_point(guide.line, straight[:, 1]))
    along = tangents_at(guide, straight[:, 1])
    points: Floats = foot + straight[:, :1] * np.column_stack([along[:, 1], -along[:, 0]])
    return points


def tangents_at(guide: Guide, s: "Floats") -> "Floats":
    """Return unit vectors (n, 2) along a guide."""
    found = np.column_stack(
        [np.interp(s, guide.stations, guide.tangents[:, axis]) for axis in range(2)]
    )
    unit: Floats = found / np.linalg.norm(found, axis=1)[:, None]
    return unit


def in_order(curves: "list[Floats]") -> "list[Floats]":
    """Both curves from the end with the lesser v on, main's first."""
    one, other = curves
    straight = np.linalg.norm(one[0] - other[0]) + np.linalg.norm(one[-1] - other[-1])
    crossed = np.linalg.norm(one[0] - other[-1]) + np.linalg.norm(one[-1] - other[0])
    if crossed < straight:
        other = other[::-1]
    if one[0, 1] + other[0, 1] > one[-1, 1] + other[-1, 1]:
        one, other = one[::-1], other[::-1]
    ring = np.vstack([one, other[::-1]])
    x, y = ring.T
    turns_left = float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) > 0.0
    return [other, one] if turns_left else [one, other]
