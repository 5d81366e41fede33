"""PLY: vertices of binary or text files, whatever other properties they have."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.errors import ParameterError
from midrib.formats.clouds.common import STATIONS, refusing
from midrib.towers.cloud import CHUNK, DOUBLES, InOrder

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["PlyCloud"]

TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2",
    "ushort": "u2", "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip
ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">", "ascii": "="}
LONGEST = 1_000_000  # bytes of a header


class Header(NamedTuple):
    """What the header says about vertices."""

    form: str
    n_vertices: int
    fields: list[tuple[str, str]]
    size: int  # bytes


class PlyCloud(InOrder):
    """A PLY file whose first element is its vertices."""

    metres: float | None = None
    crs: str | None = None

    def __init__(self, path: Path) -> None:
        self.path, self.name = path, f"CLOUD {str(path)!r}"
        with refusing(path, ValueError, UnicodeDecodeError):
            self.header = header_of(path)
        self.count = self.header.n_vertices
        missing = {"x", "y", "z"} - {name for name, _ in self.header.fields}
        if missing:
            msg = f"{self.name} has no property {min(missing)}, expected x, y and z of vertices"
            raise ParameterError(msg)
        kinds = dict(self.header.fields)
        # Digits of a text are as many as whoever wrote it wanted.
        self.types = DOUBLES if self.header.form == "ascii" else tuple(kinds[c] for c in "xyz")
        self.station = next((name for name, _ in self.header.fields if name in STATIONS), "")
        self.has_stations = self.station != ""

    def chunks(self, *, with_stations: bool = False) -> Iterator["Floats"]:
        """Points (n, 3), or (n, 4) with stations, a chunk at a time."""
        names = [*"xyz", self.station] if with_stations else [*"xyz"]
        with refusing(self.path, ValueError), self.path.open("rb") as file:
            file.seek(self.header.size)
            for first in range(0, self.count, CHUNK):
                count = min(CHUNK, self.count - first)
                if self.header.form == "ascii":
                    rows = np.loadtxt(file, max_rows=count, ndmin=2)
                    columns = [[name for name, _ in self.header.fields].index(c) for c in names]
                    points = rows[:, columns]
                else:
                    order = ORDERS[self.header.form]
                    record = np.dtype([(name, order + kind) for name, kind in self.header.fields])
                    block = file.read(count * record.itemsize)
                    block = block[: len(block) // record.itemsize * record.itemsize]
                    found = np.frombuffer(block, dtype=record)
                    points = np.column_stack([found[c].astype(np.float64) for c in names])
                if len(points) < count:
                    msg = f"it ends after {first + len(points)} of {self.count} points"
                    raise ValueError(msg)
                yield points


def header_of(path: Path) -> Header:
    """Read a header.

    Raises
    ------
    ValueError
        If the file is no PLY, or its vertices have properties that are lists.
    """
    with path.open("rb") as file:
        text = file.read(LONGEST)
    end = text.find(b"end_header")
    if not text.startswith(b"ply") or end < 0:
        msg = "it is no PLY file"
        raise ValueError(msg)
    size = text.index(b"\n", end) + 1
    form, count, fields, element = "", 0, [], ""
    for line in text[:end].decode("ascii").splitlines():
        words = line.split()
        if words[:1] == ["format"]:
            form = words[1]
        elif words[:1] == ["element"]:
            if not element and words[1] != "vertex":
                msg = f"its first element is {words[1]!r}, expected 'vertex'"
                raise ValueError(msg)
            element = words[1]
            count = int(words[2]) if element == "vertex" else count
        elif words[:1] == ["property"] and element == "vertex":
            if words[1] not in TYPES:
                msg = f"a vertex has the property {' '.join(words[1:])!r}, expected numbers"
                raise ValueError(msg)
            fields.append((words[2], TYPES[words[1]]))
    if form not in ORDERS:
        msg = f"its format is {form!r}, expected one of {', '.join(ORDERS)}"
        raise ValueError(msg)
    return Header(form, count, fields, size)
