"""NumPy files: an array (n, 3), or the first of that shape in an archive.

Points are read from where they lie in the file, a chunk at a time; an array in Fortran's order has
its x, y and z one after the other, and each is read where it lies. Archives are unpacked as they
are read, forwards only, since a step back would begin anew.
"""

import zipfile
import zlib
from collections.abc import Iterator
from contextlib import ExitStack
from io import BufferedIOBase
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np

from midrib.errors import ParameterError
from midrib.formats.clouds.common import refusing
from midrib.towers.cloud import CHUNK, spots_in

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["NumpyCloud"]


class Table(NamedTuple):
    """An array in a file."""

    member: str  # of an archive
    shape: tuple[int, ...]
    by_columns: bool
    kind: "np.dtype[Any]"
    start: int  # bytes before its first number


class NumpyCloud:
    """A .npy file or a .npz archive."""

    metres: float | None = None
    crs: str | None = None
    has_stations = False

    def __init__(self, path: Path) -> None:
        self.path, self.name = path, f"CLOUD {str(path)!r}"
        self.is_archive = path.suffix.lower() == ".npz"
        self.errors = (ValueError, zipfile.BadZipFile, zlib.error, NotImplementedError)
        with refusing(path, *self.errors):
            tables = self.tables()
        fitting = [t for t in tables if t.shape[1:] == (3,) and t.kind.kind in "fiu"]
        if not fitting:
            found = ", ".join(f"{t.shape} of {t.kind}" for t in tables) or "nothing"
            msg = f"{self.name} has arrays of shape {found}, expected numbers (n, 3): x, y, z"
            raise ParameterError(msg)
        self.table = fitting[0]
        self.count = self.table.shape[0]
        self.types: tuple[str, ...] = (self.table.kind.str,) * 3

    def tables(self) -> list[Table]:
        """Arrays of the file, by their headers."""
        members = [""]
        if self.is_archive:
            with zipfile.ZipFile(self.path) as archive:
                members = archive.namelist()
        found = []
        for member in members:
            with ExitStack() as stack:
                found.append(table_of(self.opened(stack, member), member))
        return found

    def opened(self, stack: ExitStack, member: str) -> BufferedIOBase:
        """Open an array to be read from its header on."""
        if not self.is_archive:
            return stack.enter_context(self.path.open("rb"))
        archive = stack.enter_context(zipfile.ZipFile(self.path))
        return stack.enter_context(cast("zipfile.ZipExtFile", archive.open(member)))

    def chunks(self, *, with_stations: bool = False) -> Iterator["Floats"]:  # noqa: ARG002
        """Points (n, 3), a chunk at a time; no station is known."""
        return self.pieces(
            (first, min(CHUNK, self.count - first)) for first in range(0, self.count, CHUNK)
        )

    def some(self, most: int) -> Iterator["Floats"]:
        """Points from all over the file."""
        return self.pieces(iter(spots_in(self.count, most)))

    def pieces(self, spots: Iterator[tuple[int, int]]) -> Iterator["Floats"]:
        """Read points in places (first, number) that follow one another."""
        table = self.table
        rows, columns = (3, 1) if table.by_columns else (1, 3)
        step = columns * table.kind.itemsize
        with refusing(self.path, *self.errors), ExitStack() as stack:
            files = [self.opened(stack, table.member) for _ in range(rows)]
            for first, count in spots:
                parts = [np.empty((count, columns), dtype=table.kind) for _ in files]
                for k, (file, part) in enumerate(zip(files, parts, strict=True)):
                    file.seek(table.start + (k * self.count + first) * step)
                    if file.readinto(part.view(np.uint8).data) < count * step:
                        msg = f"it ends before the last of {self.count} points"
                        raise ValueError(msg)
                points = np.hstack(parts) if table.by_columns else parts[0]
                yield points.astype(np.float64, copy=False)


def table_of(file: BufferedIOBase, member: str) -> Table:
    """Read the header of an array.

    Raises
    ------
    ValueError
        If it has none that arrays of numbers have.
    """
    version = np.lib.format.read_magic(file)
    if version == (1, 0):
        shape, by_columns, kind = np.lib.format.read_array_header_1_0(file)
    elif version == (2, 0):
        shape, by_columns, kind = np.lib.format.read_array_header_2_0(file)
    else:
        msg = f"its version is {version}, expected (1, 0) or (2, 0)"
        raise ValueError(msg)
    return Table(member, shape, by_columns, kind, file.tell())
