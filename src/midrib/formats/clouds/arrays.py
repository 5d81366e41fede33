"""NumPy files: an array (n, 3), or the first of that shape in an archive."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from midrib.errors import ParameterError
from midrib.formats.clouds.common import refusing
from midrib.towers.cloud import CHUNK

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["NumpyCloud"]


class NumpyCloud:
    """A .npy file, read where it lies, or a .npz archive, read whole."""

    metres: float | None = None
    crs: str | None = None

    def __init__(self, path: Path) -> None:
        self.path, self.name = path, f"CLOUD {str(path)!r}"
        with refusing(path, ValueError):
            found = np.load(path, mmap_mode="r", allow_pickle=False)
            tables = list(found.values()) if path.suffix.lower() == ".npz" else [found]
        fitting = [t for t in tables if t.ndim == 2 and t.shape[1] == 3 and t.dtype.kind in "fiu"]
        if not fitting:
            shapes = ", ".join(str(table.shape) for table in tables) or "nothing"
            msg = f"{self.name} has arrays of shape {shapes}, expected numbers (n, 3): x, y, z"
            raise ParameterError(msg)
        self.table = fitting[0]
        self.count = len(self.table)

    def chunks(self) -> Iterator["Floats"]:
        """Points (n, 3), a chunk at a time."""
        for first in range(0, self.count, CHUNK):
            yield np.asarray(self.table[first : first + CHUNK], dtype=np.float64)
