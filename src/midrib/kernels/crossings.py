"""Whether segments meet, by exact signs."""

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.mending import crosses
from midrib.types import Bools, Floats, Ints

__all__ = ["meet"]


@njit(entry=True)
def meet(segments: Floats, first: Ints, second: Ints) -> Bools:
    """Whether pairs of segments have a point in common.

    Parameters
    ----------
    segments : (n, 4) x and y of both ends
    first, second : (k,) rows of the pairs
    """
    n = segments.shape[0]
    chords = np.zeros((n, 7))
    for i in range(n):
        for column in range(4):
            chords[i, 2 + column] = segments[i, column]
    found = np.empty(first.size, np.bool_)
    for k in range(first.size):
        found[k] = crosses(chords, first[k], second[k])
    return found
