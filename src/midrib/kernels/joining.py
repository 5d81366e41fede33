"""A curve from its parts: ends and middles of radii, joined inside the area, without loops."""

from typing import NamedTuple

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.loops import cut_loops
from midrib.kernels.mesh import Mesh
from midrib.kernels.paths import Beads, join_points
from midrib.types import Floats, Ints

__all__ = ["Joined", "cut_all_loops", "join_beads", "join_middles", "string_beads"]

LOOP_ROUNDS = 8


class Joined(NamedTuple):
    """A path inside the area."""

    points: Floats  # (m, 2)
    source: Ints  # (m,) bead that each one is, one past the beads at a crossing; -1 - v at vertex v
    loops: int  # how many were cut
    beads: Floats  # (n, 2) the points that were joined


@njit(entry=True)
def join_middles(
    mesh: Mesh,
    points: Floats,
    at: Ints,
    end: Floats,
    end_origin: Floats,
    end_at: Ints,
    scale_x: float,
    scale_y: float,
) -> Joined:
    """Join the ends and the middles of radii by shortest paths inside the area; cut loops.

    Parameters
    ----------
    mesh : the area
    points, at : the radii, as ``draw_radii`` returns them
    end, end_origin : (0 or 2, 2) end points, and points of the boundary that see them
    end_at : (0 or 2, 2) the boundary side and the mesh vertex (or -1) that each origin is on
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    Joined
        Beads count from the first end, or from the first middle if there are no ends.
    """
    beads = string_beads(points, at, end, end_origin, end_at)
    return join_beads(mesh, beads, scale_x, scale_y)


@njit(entry=True)
def join_beads(mesh: Mesh, beads: Beads, scale_x: float, scale_y: float) -> Joined:
    """Join points by shortest paths inside the area; cut loops."""
    path, source = join_points(mesh, beads, scale_x, scale_y)
    return cut_all_loops(mesh, beads, path, source, scale_x, scale_y)


@njit()
def cut_all_loops(
    mesh: Mesh, beads: Beads, path: Floats, source: Ints, scale_x: float, scale_y: float
) -> Joined:
    """Return a path without loops.

    A path that has been cut is joined again, which proves it: a cut may have moved it.
    """
    loops = 0
    for _ in range(LOOP_ROUNDS):
        cut, row, found = cut_loops(path)
        if found == 0:
            break
        loops += found
        path, source = join_again(mesh, beads, cut, row, source, scale_x, scale_y)
    return Joined(path, source, loops, beads.point)


@njit()
def string_beads(points: Floats, at: Ints, end: Floats, end_origin: Floats, end_at: Ints) -> Beads:
    """Return the middles of the radii between the end points."""
    k, first = points.shape[0], end.shape[0] // 2
    n = k + end.shape[0]
    point, origin = np.empty((n, 2)), np.empty((n, 2))
    side, vertex = np.empty(n, np.intp), np.empty(n, np.intp)
    for i in range(k):
        row = first + i
        origin[row, 0], origin[row, 1] = points[i, 0], points[i, 1]
        point[row, 0] = (points[i, 0] + points[i, 2]) / 2.0
        point[row, 1] = (points[i, 1] + points[i, 3]) / 2.0
        side[row], vertex[row] = at[i, 1], at[i, 2]
    for i in range(end.shape[0]):
        row = i * (n - 1)
        point[row, 0], point[row, 1] = end[i, 0], end[i, 1]
        origin[row, 0], origin[row, 1] = end_origin[i, 0], end_origin[i, 1]
        side[row], vertex[row] = end_at[i, 0], end_at[i, 1]
    return Beads(point, origin, side, vertex)


@njit()
def join_again(
    mesh: Mesh, beads: Beads, cut: Floats, row: Ints, source: Ints, scale_x: float, scale_y: float
) -> tuple[Floats, Ints]:
    """Join a path again after its loops have been cut; the search begins from the bead before."""
    n, new = cut.shape[0], beads.side.size
    came_from = np.empty(n, np.intp)
    origin, side, vertex = np.empty((n, 2)), np.empty(n, np.intp), np.empty(n, np.intp)
    before = 0
    for i in range(n):
        came_from[i] = new if row[i] < 0 else source[row[i]]
        if 0 <= came_from[i] < new:
            before = came_from[i]
        origin[i, 0], origin[i, 1] = beads.origin[before, 0], beads.origin[before, 1]
        side[i], vertex[i] = beads.side[before], beads.vertex[before]
    path, place = join_points(mesh, Beads(cut, origin, side, vertex), scale_x, scale_y)
    for i in range(place.size):
        if place[i] >= 0:
            place[i] = came_from[place[i]]
    return path, place
