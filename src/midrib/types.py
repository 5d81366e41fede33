"""Aliases for the arrays and geometries that travel between the rooms."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["Bools", "Floats", "Ints", "Places", "Singles"]

Floats: TypeAlias = NDArray[np.float64]
Singles: TypeAlias = NDArray[np.float32]
Ints: TypeAlias = NDArray[np.intp]
Places: TypeAlias = NDArray[np.integer]
Bools: TypeAlias = NDArray[np.bool_]
