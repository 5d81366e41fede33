"""Columns of types that GDAL has none for, as columns of types that it has."""

import pyarrow as pa
import pyarrow.compute as pc

__all__ = ["stored", "stored_type"]

PER_SECOND = {"s": 1, "ms": 1_000, "us": 1_000_000, "ns": 1_000_000_000}


def stored_type(kind: pa.DataType) -> pa.DataType:
    """Type of the column that stands for one: durations are in seconds, nothing is a text."""
    if pa.types.is_duration(kind):
        return pa.float64()
    return pa.string() if pa.types.is_null(kind) else kind


def stored(column: pa.ChunkedArray) -> pa.ChunkedArray:
    """Return a column of such a type."""
    kind = column.type
    if pa.types.is_duration(kind):
        counts = column.cast(pa.int64()).cast(pa.float64(), safe=False)
        return pc.divide(counts, float(PER_SECOND[kind.unit]))
    return column.cast(stored_type(kind)) if stored_type(kind) != kind else column
