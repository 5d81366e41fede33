"""Bytes of single rows of Arrow columns: what a row group is cut by, however rows come."""

from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

if TYPE_CHECKING:
    from midrib.types import Ints

__all__ = ["row_sizes"]

BYTE = 8  # bits


def row_sizes(table: pa.Table) -> "Ints":
    """Return the bytes of each row's values, (n,), those inside lists and structures too."""
    sizes = np.zeros(table.num_rows, np.intp)
    for column in table.itercolumns():
        if table.num_rows:
            sizes += sizes_in(pa.concat_arrays(column.chunks))
    return sizes


def sizes_in(column: pa.Array) -> "Ints":
    """Return the bytes of each value of a column, (n,)."""
    kind = column.type
    if isinstance(kind, pa.ExtensionType):
        return sizes_in(column.storage)
    if pa.types.is_map(kind):
        pair = pa.struct([kind.key_field, kind.item_field])
        return sizes_in(column.cast(pa.list_(pair)))
    if pa.types.is_struct(kind):
        fields = [sizes_in(field) for field in column.flatten()]
        return sum(fields, np.zeros(len(column), np.intp))
    if has_length(kind):
        return numbers(pc.binary_length(column))
    if is_list(kind):
        lengths = numbers(pc.list_value_length(column))
        before = np.concatenate([[0], np.cumsum(sizes_in(pc.list_flatten(column)))])
        stops = np.cumsum(lengths)
        return np.asarray(before[stops] - before[stops - lengths], np.intp)
    return np.full(len(column), width_of(kind), np.intp)


def numbers(column: pa.Array) -> "Ints":
    """Return whole numbers of a column, none where a value is missing."""
    return np.asarray(pc.fill_null(column, 0).to_numpy(zero_copy_only=False), np.intp)


def has_length(kind: pa.DataType) -> bool:
    """Whether values are texts or bytes."""
    types = pa.types
    return bool(
        types.is_string(kind)
        or types.is_large_string(kind)
        or types.is_binary(kind)
        or types.is_large_binary(kind)
    )


def is_list(kind: pa.DataType) -> bool:
    """Whether values are rows of values."""
    types = pa.types
    return bool(types.is_list(kind) or types.is_large_list(kind) or types.is_fixed_size_list(kind))


def width_of(kind: pa.DataType) -> int:
    """Bytes of a value, if all have as many; those of the number where values have numbers."""
    if pa.types.is_dictionary(kind):
        return width_of(kind.index_type)
    try:
        return max(int(kind.bit_width) // BYTE, 1)
    except ValueError:  # nothing but nulls
        return 1
