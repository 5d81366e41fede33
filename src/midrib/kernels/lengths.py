"""Lengths in the plane."""

import numpy as np

from midrib.kernels.jit import njit

__all__ = ["length"]


@njit(borrows=True)
def length(dx: float, dy: float) -> float:
    """Length of a vector; several times quicker than ``hypot``, and as good short of overflow."""
    return np.sqrt(dx * dx + dy * dy)
