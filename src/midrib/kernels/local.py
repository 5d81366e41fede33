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
def distance_beside(
    mesh: Mesh, chain: Chain, station: float, reach: float, is_closed: bool, x: float, y: float
) -> float:
    """Distance from a point to what lies within ``reach`` of a station along an edge."""
    arc, vertex = chain.arc, chain.vertex
    m = arc.size - 1
    start, laps = max(station - reach, 0.0), 0
    if is_closed:
        start = (station - reach) % arc[m]
        reach = min(reach, arc[m] / 2.0)
    k = min(max(int(np.searchsorted(arc, start, side="right")) - 1, 0), m - 1)
    stop = start + 2.0 * reach if is_closed else station + reach
    best = np.inf
    while True:
        a, b = vertex[k], vertex[k + 1]
        ax, ay, bx, by = mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b]
        best = min(best, squared_distance_to_side(x, y, ax, ay, bx, by, 1.0, 1.0))
        k += 1
        if k == m:
            if not is_closed or laps > 0:
                break
            k, laps = 0, 1
        if arc[k] + laps * arc[m] >= stop:
            break
    return np.sqrt(best)


@njit(borrows=True)
def local_width(
    mesh: Mesh, top: Chain, toe: Chain, near: Floats, chord: Chord, x: float, y: float,
    is_closed: bool,
) -> float:  # fmt: skip
    """Local width at a point of the middle line with a chord through it.

    ``near`` has the stations on both edges that the chord before had; it is brought up to date.
    O(k) for k vertices of the edges beside the chord.
    """
    off = 0.0
    if chord.top_on == ON_TOP:
        near[0] = chord.s
        off = np.hypot(chord.top_x - x, chord.top_y - y)
    if chord.toe_on == ON_TOE:
        near[1] = chord.t
        off = max(off, np.hypot(chord.toe_x - x, chord.toe_y - y))
    if off == 0.0:
        return chord.width
    high = distance_beside(mesh, top, near[0], WINDOW * off, is_closed, x, y)
    low = distance_beside(mesh, toe, near[1], WINDOW * off, is_closed, x, y)
    return min(2.0 * max(high, low), chord.width)
