"""Text: columns of numbers with any delimiter, a heading or none, names of points or none.

Columns x, y, z (or easting, northing, height) go by their names where there is a heading; else
they are the first three columns of numbers, or the three after a leading column of names.

A row with another number of columns is a point without coordinates, unless it is a comment or, in
.pts, the number of points of a scan that follows.
"""

import io
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from midrib.errors import ParameterError
from midrib.formats.clouds.common import STATIONS, refusing
from midrib.towers.cloud import InOrder

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["TextCloud"]

NAMES = (
    {"x", "e", "east", "easting"},
    {"y", "n", "north", "northing"},
    {"z", "h", "height", "elevation", "alt", "altitude"},
)
PROBED, BLOCK = 60, 1 << 24  # lines looked at, bytes read at a time
COMMENTS = ("#", "//", "%", ";")
MANY = 3
MOST_ODD = 0.01  # of the rows: with more of another number of columns, the layout is not understood


class Layout(NamedTuple):
    """How lines are divided, and which parts are x, y, z."""

    skipped: int  # lines before the first point
    delimiter: str  # "," ";" "\t" or " " for any run of blanks
    columns: tuple[int, ...]  # x, y, z, and the station if a heading names it
    n_columns: int
    decimal: str = "."  # a comma where semicolons divide


class Odd:
    """Rows with another number of columns than the first point has."""

    def __init__(self, has_counts: bool) -> None:
        self.has_counts = has_counts  # one whole number in a line says how many points follow
        self.count, self.example = 0, ""

    def skip(self, row: Any) -> str:
        """Count a row, unless it is meant to be no point."""
        text = row.text.strip()
        is_count = self.has_counts and text.isdecimal()
        if not is_count and not text.startswith(COMMENTS):
            self.count += 1
            self.example = self.example or text[:60]
        return "skip"


class TextCloud(InOrder):
    """A text file of points; how many there are, only reading tells."""

    metres: float | None = None
    crs: str | None = None
    count: int | None = None

    def __init__(self, path: Path) -> None:
        self.path, self.name = path, f"CLOUD {str(path)!r}"
        with refusing(path, UnicodeDecodeError), path.open("rb") as file:
            probe = file.read(1 << 16)
            lines = probe.decode("utf-8-sig").splitlines()
        self.layout = layout_of(lines[:PROBED], self.name)
        self.has_stations = len(self.layout.columns) > MANY

    def chunks(self, *, with_stations: bool = False) -> Iterator["Floats"]:
        """Points (n, 3), or (n, 4) with stations, a chunk at a time."""
        n, rows, odd = MANY + with_stations, 0, Odd(self.path.suffix.lower() == ".pts")
        with refusing(self.path, ValueError), self.path.open("rb") as file:
            for _ in range(self.layout.skipped):
                file.readline()
            while block := file.read(BLOCK):
                before = odd.count
                points = self.parsed(block + file.readline(), n, odd)
                # Who reads them counts the points that lack a coordinate.
                points = np.vstack([points, np.full((odd.count - before, n), np.nan)])
                rows += len(points)
                yield points[np.isfinite(points).all(axis=1)] if with_stations else points
        self.check_rows(odd, rows)

    def check_rows(self, odd: "Odd", rows: int) -> None:
        """Refuse a file whose rows are not alike.

        Raises
        ------
        ParameterError
            If too many rows have another number of columns than the first point.
        """
        if odd.count > MOST_ODD * rows:
            msg = (
                f"{self.name} has {odd.count:,} of {rows:,} rows with another number of columns "
                f"than the first point, such as {odd.example!r}, expected {self.layout.n_columns} "
                f"columns in all but {MOST_ODD:.0%} of the rows"
            )
            raise ParameterError(msg)

    def parsed(self, block: bytes, n: int, odd: "Odd") -> "Floats":
        """Points of some whole lines, ``n`` columns of them.

        Raises
        ------
        ParameterError
            If a line does not have the numbers.
        """
        import pyarrow as pa
        from pyarrow import csv

        delimiter = self.layout.delimiter
        if delimiter == " ":
            block = re.sub(rb"[ \t]+", b" ", re.sub(rb"(?m)^[ \t]+|[ \t\r]+$", b"", block))
        names = [str(k) for k in range(self.layout.n_columns)]
        wanted = [names[k] for k in self.layout.columns[:n]]
        parse = csv.ParseOptions(delimiter=delimiter, invalid_row_handler=odd.skip)
        convert = csv.ConvertOptions(
            include_columns=wanted,
            column_types={name: pa.float64() for name in wanted},
            decimal_point=self.layout.decimal,
        )
        read = csv.ReadOptions(column_names=names, block_size=max(len(block), 1 << 16))
        try:
            table = csv.read_csv(io.BytesIO(block), read, parse, convert)
        except pa.ArrowInvalid as error:
            found = re.search(r"conversion error to double: invalid value '(.*)'", str(error))
            what = f"has {found[1]!r} for a coordinate" if found else f"cannot be read: {error}"
            msg = f"{self.name} {what}, expected numbers in columns {wanted_text(self.layout)}"
            raise ParameterError(msg) from error
        columns: list[Any] = [table.column(name).to_numpy() for name in wanted]
        points: Floats = np.column_stack(columns)
        return points


def wanted_text(layout: Layout) -> str:
    """Columns as people count them."""
    return ", ".join(str(k + 1) for k in layout.columns[:MANY])


def layout_of(lines: list[str], name: str) -> Layout:
    """Find delimiter, heading and columns in the first lines.

    Raises
    ------
    ParameterError
        If no line has three numbers.
    """
    for skipped, line in enumerate(lines):
        if not line.strip() or line.lstrip().startswith(COMMENTS):
            continue
        delimiter = delimiter_of(line)
        parts = parts_of(line, delimiter)
        decimal = "," if delimiter == ";" and "," in line and "." not in line else "."
        parts = [part.replace(decimal, ".") for part in parts]
        numbers = [k for k, part in enumerate(parts) if is_number_text(part)]
        if len(numbers) < MANY:
            continue
        heading = heading_of(lines[:skipped], len(parts), delimiter)
        columns = heading or first_columns(numbers, parts)
        if columns[-1] not in numbers:
            columns = columns[:MANY]  # stations have names: points are all one cloud
        return Layout(skipped, delimiter, columns, len(parts), decimal)
    last = f", the last of which is {lines[-1][:60]!r}" if lines else ""
    msg = (
        f"{name} has no line with three numbers among its first {len(lines)}{last}, expected x, y, "
        "z; decimal commas need semicolons between the columns"
    )
    raise ParameterError(msg)


def first_columns(numbers: list[int], parts: list[str]) -> tuple[int, int, int]:
    """Three columns of numbers; a whole number before numbers with a point is a name."""
    has_point = ["." in parts[k] or "e" in parts[k].lower() for k in numbers]
    if len(numbers) > MANY and not has_point[0] and all(has_point[1 : MANY + 1]):
        numbers = numbers[1:]
    return numbers[0], numbers[1], numbers[2]


def heading_of(before: list[str], count: int, delimiter: str) -> tuple[int, ...] | None:
    """Columns by the names in the line before the first point, if it has them."""
    if not before:
        return None
    parts = [part.lower().strip('"') for part in parts_of(before[-1].lstrip("#/% "), delimiter)]
    if len(parts) != count:
        return None
    found = [next((k for k, part in enumerate(parts) if part in some), -1) for some in NAMES]
    if min(found) < 0:
        return None
    return (*found, *(k for k, part in enumerate(parts) if part in STATIONS))[: MANY + 1]


def delimiter_of(line: str) -> str:
    """Return what divides a line."""
    return next((mark for mark in (";", ",", "\t") if line.count(mark) >= 2), " ")


def parts_of(line: str, delimiter: str) -> list[str]:
    """Divide a line."""
    parts = line.split() if delimiter == " " else line.split(delimiter)
    return [part.strip() for part in parts]


def is_number_text(text: str) -> bool:
    """Whether a text is a number."""
    try:
        return bool(np.isfinite(float(text)))
    except ValueError:
        return False
