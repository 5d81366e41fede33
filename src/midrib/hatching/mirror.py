"""Slopes that are their own mirror images."""

import numpy as np

from midrib.hatching.chains import Chain

__all__ = ["is_own_mirror"]

ALIKE = 1e-6  # of the distance between the ends: so much the image may be off


def is_own_mirror(top: Chain, toe: Chain) -> bool:
    """Whether both edges of an open slope, run backwards, are their images in one axis; O(m log m).

    Pairs of points at equal ways from both ends have their middles on the axis and lie at right
    angles to it.
    """
    ends = top.at(np.array([0.0, top.length]))
    across = ends[1] - ends[0]
    span = float(np.hypot(*across))
    if span == 0.0:
        return False
    across /= span
    along = np.array([-across[1], across[0]])
    for edge in (top, toe):
        if edge.is_closed:
            return False
        at = np.concatenate([edge.stations, edge.length - edge.stations])
        one, other = edge.at(at), edge.at(edge.length - at)
        off_axis = abs(((one + other) / 2.0 - ends.mean(axis=0)) @ across)
        if max(off_axis.max(), abs((other - one) @ along).max()) > ALIKE * span:
            return False
    return True
