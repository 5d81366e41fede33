"""NumPy files: an array (n, 3), or the first of that shape in an archive."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from midrib.errors import ParameterError
from midrib.formats.clouds.common import refusing
from midrib.towers.cloud import ArrayCloud

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["NumpyCloud"]


class NumpyCloud(ArrayCloud):
    """A .npy file, read where it lies, or a .npz archive, read whole."""

    def __init__(self, path: Path) -> None:
        self.name = f"CLOUD {str(path)!r}"
        with refusing(path, ValueError):
            found = np.load(path, mmap_mode="r", allow_pickle=False)
            tables = list(found.values()) if path.suffix.lower() == ".npz" else [found]
        fitting = [t for t in tables if t.ndim == 2 and t.shape[1] == 3 and t.dtype.kind in "fiu"]
        if not fitting:
            shapes = ", ".join(str(table.shape) for table in tables) or "nothing"
            msg = f"{self.name} has arrays of shape {shapes}, expected numbers (n, 3): x, y, z"
            raise ParameterError(msg)
        super().__init__(np.empty((0, 3)))
        self.points = fitting[0]  # as it lies in the file: a chunk becomes doubles when it is read

    def piece(self, first: int, count: int, *, with_stations: bool) -> "Floats":
        """Read some points."""
        found = super().piece(first, count, with_stations=with_stations)
        return np.asarray(found, dtype=np.float64)
