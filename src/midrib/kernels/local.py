r"""Local width of a slope: twice the distance from its middle line to the farther of both edges.

A stroke that runs down a bay of the toe is long, but the slope is no wider there: the middle line
passes the mouth of the bay, and both edges are as near to it as beside the bay.

top   ------------------------
               |  local width / 2
line  ---------o--------------       the chord through o may be far longer
             /
toe   ------+       +---------
            |  bay  |
"""

import numpy as np

from midrib.kernels.chain import Chain
from midrib.kernels.chords import ON_TOE, ON_TOP, Chord
from midrib.kernels.jit import njit
from midrib.kernels.mesh import Mesh
from midrib.kernels.visibility import squared_distance_to_side
from midrib.types import Floats

__all__ = ["local_width"]

WINDOW = (
    2.0  # distances from the chord's end, along the edge, where the nearest point is looked for
)


@njit(borrows=True)
def nearest_beside(
    mesh: Mesh, chain: Chain, station: float, reach: float, is_closed: bool, x: float, y: float
) -> tuple[float, float]:
    """Distance from a point to what lies within ``reach`` of a station of an edge, and where."""
    arc, vertex = chain.arc, chain.vertex
    m = arc.size - 1
    start, laps = max(station - reach, 0.0), 0
    if is_closed:
        start = (station - reach) % arc[m]
        reach = min(reach, arc[m] / 2.0)
    k = min(max(int(np.searchsorted(arc, start, side="right")) - 1, 0), m - 1)
    stop = start + 2.0 * reach if is_closed else station + reach
    best, nearest = np.inf, k
    while True:
        a, b = vertex[k], vertex[k + 1]
        ax, ay, bx, by = mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b]
        squared = squared_distance_to_side(x, y, ax, ay, bx, by, 1.0, 1.0)
        if squared < best:
            best, nearest = squared, k
        k += 1
        if k == m:
            if not is_closed or laps > 0:
                break
            k, laps = 0, 1
        if arc[k] + laps * arc[m] >= stop:
            break
    a, b, step = vertex[nearest], vertex[nearest + 1], arc[nearest + 1] - arc[nearest]
    dx, dy = mesh.x[b] - mesh.x[a], mesh.y[b] - mesh.y[a]
    along = ((x - mesh.x[a]) * dx + (y - mesh.y[a]) * dy) / step
    return np.sqrt(best), arc[nearest] + min(max(along, 0.0), step)


@njit(borrows=True)
def look(
    mesh: Mesh, chain: Chain, near: Floats, at: float, reach: float, is_closed: bool,
    x: float, y: float,
) -> float:  # fmt: skip
    """Distance to an edge, looked for beside a station of it, and where it was nearest before.

    ``near`` is that station and the distance then; both are brought up to date. NaN is no station.
    """
    distance, station = np.inf, near[0]
    if not np.isnan(at):
        distance, station = nearest_beside(mesh, chain, at, reach, is_closed, x, y)
    if near[1] > 0.0 and not abs(at - near[0]) <= reach:
        before, there = nearest_beside(mesh, chain, near[0], WINDOW * near[1], is_closed, x, y)
        if before < distance:
            distance, station = before, there
    if distance < np.inf:
        near[0], near[1] = station, distance
    return distance


@njit(borrows=True)
def local_width(
    mesh: Mesh, top: Chain, toe: Chain, near: Floats, chord: Chord, x: float, y: float,
    is_closed: bool,
) -> float:  # fmt: skip
    """Local width at a point of the middle line with a chord through it.

    ``near`` (2, 2) has the station and the distance of what was nearest on top and toe at the point
    before, zeros at first; it is brought up to date. At a corner the chord may run along the slope
    and end far away, or on the wrong edge. O(k) for k vertices of the edges beside the chord.
    """
    s = chord.s if chord.top_on == ON_TOP else np.nan
    t = chord.t if chord.toe_on == ON_TOE else np.nan
    off = 0.0
    if not np.isnan(s):
        off = np.hypot(chord.top_x - x, chord.top_y - y)
    if not np.isnan(t):
        off = max(off, np.hypot(chord.toe_x - x, chord.toe_y - y))
    high = look(mesh, top, near[0], s, WINDOW * off, is_closed, x, y)
    low = look(mesh, toe, near[1], t, WINDOW * off, is_closed, x, y)
    if max(high, low) == np.inf:
        return chord.width
    return min(2.0 * max(high, low), chord.width)
