"""Points on a curve at stations, the curve's own vertices among them or not."""

import numpy as np

from midrib.kernels.jit import njit
from midrib.types import Floats, Ints

__all__ = ["default_count", "even_stations", "place_stations"]

LEAST_COUNT = 2
# Intervals by default in an area that is very thin for its number of vertices.
MOST_BY_WIDTH, MOST_BY_VERTEX = 256, 4


@njit(entry=True)
def default_count(length: float, mean_width: float, n_vertices: int) -> int:
    """Return the number of intervals of a curve: the smallest that makes them a mean width or less.

    But at least two, and no more than 256 and four for each vertex of both curves.
    """
    at_most = max(mean_width, length / (MOST_BY_WIDTH + MOST_BY_VERTEX * n_vertices))
    return max(int(np.ceil(length / at_most)), LEAST_COUNT)


@njit()
def even_stations(length: float, count: int) -> Floats:
    """Return the stations 0 to ``length`` of so many intervals."""
    stations = np.empty(count + 1)
    for i in range(count + 1):
        # i (L / n) rather than i d: commensurate stations stay so when the curve is reversed.
        stations[i] = i * (length / count)
    return stations


@njit()
def merge(own: Floats, arc: Floats, tolerance: float) -> Floats:
    """Merge ascending stations with the vertices' arc lengths.

    A station nearer to a vertex than ``tolerance`` is that vertex.
    """
    stations = np.empty(own.size + arc.size)
    count, i = 0, 0
    for k in range(arc.size):
        while i < own.size and own[i] < arc[k] + tolerance:
            is_new = own[i] < arc[k] - tolerance and (k == 0 or own[i] > arc[k - 1] + tolerance)
            if is_new and (count == 0 or own[i] > stations[count - 1]):
                stations[count] = own[i]
                count += 1
            i += 1
        stations[count] = arc[k]
        count += 1
    return stations[:count]


@njit(entry=True)
def place_stations(
    own: Floats,
    with_vertices: bool,
    tolerance: float,
    arc: Floats,
    vertex: Ints,
    x: Floats,
    y: Floats,
) -> tuple[Floats, Floats, Ints, Ints]:
    """Stations on a curve and their points.

    Parameters
    ----------
    own : (n,) stations, ascending, from 0 to the last arc length
    with_vertices : whether the curve's vertices are stations too
    tolerance : a station nearer to a vertex than this is that vertex
    arc, vertex : (m + 1,) the curve's arc lengths and mesh vertices
    x, y : coordinates of mesh vertices

    Returns
    -------
    stations, points, segment, at_vertex
        (k,) stations; (k, 2) points; the segment of each; the mesh vertex it is, or -1.
    """
    stations = merge(own, arc, tolerance) if with_vertices else own.copy()
    n = stations.size
    points, segment, at_vertex = np.empty((n, 2)), np.empty(n, np.intp), np.empty(n, np.intp)
    k = 0
    for i in range(n):
        while k + 2 < arc.size and stations[i] >= arc[k + 1]:
            k += 1
        a, b = vertex[k], vertex[k + 1]
        share = (stations[i] - arc[k]) / (arc[k + 1] - arc[k])
        points[i, 0], points[i, 1] = x[a] + share * (x[b] - x[a]), y[a] + share * (y[b] - y[a])
        segment[i], at_vertex[i] = k, -1
        if share == 0.0:
            at_vertex[i] = a
        elif share == 1.0:
            at_vertex[i], points[i, 0], points[i, 1] = b, x[b], y[b]
    return stations, points, segment, at_vertex
