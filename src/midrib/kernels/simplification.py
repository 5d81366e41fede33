"""Which vertex of a run is farthest from the straight segment that would replace the run.

a         first vertex of the run
b         last vertex of the run
far       the vertex between them that is farthest from the segment ab

           far
          .   .
        .      .    off: its distance to the segment
       a-------b
"""

import numpy as np

from midrib.kernels.boxtree import nearest_share
from midrib.kernels.jit import njit
from midrib.types import Floats, Ints

__all__ = ["farthest_vertices"]


@njit(entry=True)
def farthest_vertices(x: Floats, y: Floats, first: Ints, last: Ints) -> tuple[Ints, Floats]:
    """Farthest vertex of each run and its distance to the segment between the run's ends.

    Parameters
    ----------
    x, y : coordinates of vertices
    first, last : (k,) rows of the first and the last vertex of each run

    Returns
    -------
    far, off
        (k,) the first of the farthest rows, -1 where a run has no vertex between its ends; (k,)
        its distance.
    """
    far, off = np.full(first.size, -1, np.intp), np.zeros(first.size)
    for k in range(first.size):
        a, b = first[k], last[k]
        most = -1.0
        for v in range(a + 1, b):
            share, _ = nearest_share(x[v], y[v], x[a], y[a], x[b], y[b], 0.0, 1.0, 0, 0)
            dx = x[a] + share * (x[b] - x[a]) - x[v]
            dy = y[a] + share * (y[b] - y[a]) - y[v]
            squared = dx * dx + dy * dy
            if squared > most:
                most, far[k] = squared, v
        if far[k] >= 0:
            off[k] = np.sqrt(most)
    return far, off
