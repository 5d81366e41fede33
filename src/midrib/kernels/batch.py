"""Many areas in one call: ragged rings in, ragged lines out, nothing of Python in between.

    areas      | area 0        | area 1   | ...     area_offsets: where each one's rings begin
    rings      | shell | hole  | shell    | ...     ring_offsets: where each one's rows begin
    rows       x y x y x y ...                      coordinates

A call takes a run of areas and lets other threads go on meanwhile; what it finds for an area does
not depend on the others, nor on how many of them there are in the run.
"""

import numpy as np

from midrib.kernels.collapsing import collapse_rings
from midrib.kernels.jit import njit
from midrib.kernels.tables import with_rows
from midrib.types import Floats, Ints

__all__ = ["UNDONE", "collapse_many"]

UNDONE = -1  # loops of a line that is not there


@njit(entry=True)
def collapse_many(
    coordinates: Floats,
    ring_offsets: Ints,
    area_offsets: Ints,
    first: int,
    last: int,
    is_known: bool,
    share: float,
    scales: Floats,
    offsets: Ints,
    loops: Ints,
) -> Floats:
    """Trunks of the areas from ``first`` up to ``last``, as ``collapse_rings`` finds them.

    Parameters
    ----------
    coordinates, ring_offsets, area_offsets : polygons as drawn above
    first, last : which of them
    is_known : whether they are known to be valid; those that may not be are left out otherwise
    share : tolerance, as a share of the mean width
    scales : (n, 2) lengths of one unit of x and of y in each area; NaN where none is wanted
    offsets : filled; where the points of each line begin, and where those of the last one end
    loops : filled; how many each line has lost, UNDONE where there is none, as the single steps
        know what to do or to say

    Returns
    -------
    points : (m, 2) those of all lines

    It is the only array that is handed back: should a signal's handler raise meanwhile, Numba
    notices it for one array and not for several.
    """
    n = last - first
    points, used = np.empty((32 * n + 16, 2)), 0
    offsets[0] = 0
    for i in range(n):
        start, stop = area_offsets[first + i], area_offsets[first + i + 1] + 1
        rings = np.empty(stop - start, np.intp)
        for k in range(rings.size):
            rings[k] = ring_offsets[start + k] - ring_offsets[start]
        rows = coordinates[ring_offsets[start] : ring_offsets[stop - 1]]
        scale_x, scale_y = scales[first + i, 0], scales[first + i, 1]
        offsets[i + 1], loops[i] = used, UNDONE
        if not np.isfinite(scale_x * scale_y):
            continue
        done, line, lost = collapse_rings(rows, rings, is_known, share, scale_x, scale_y)
        if done and is_finite(line):
            size = line.shape[0]
            if used + size > points.shape[0]:
                points = with_rows(points, 2 * (used + size))
            for k in range(size):
                points[used + k, 0], points[used + k, 1] = line[k, 0], line[k, 1]
            used += size
            loops[i], offsets[i + 1] = lost, used
    return with_rows(points[:used], used)


@njit(borrows=True)
def is_finite(points: Floats) -> bool:
    """Whether all coordinates are numbers; tools choke on others."""
    for k in range(points.shape[0]):
        if not (np.isfinite(points[k, 0]) and np.isfinite(points[k, 1])):
            return False
    return True
