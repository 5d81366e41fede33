"""Columns of views as columns of plain values: Arrow cannot choose rows of views (26)."""

from collections.abc import Iterable, Iterator

import pyarrow as pa

__all__ = ["batches_without_views", "without_views"]


def batches_without_views(batches: Iterable[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
    """Batches, each with plain values where it had views."""
    for batch in batches:
        schema = without_views(batch.schema)
        yield batch if schema == batch.schema else batch.cast(schema)


def without_views(schema: pa.Schema) -> pa.Schema:
    """Return the schema of such batches."""
    return pa.schema([plain_field(field) for field in schema], schema.metadata)


def plain(kind: pa.DataType) -> pa.DataType:
    """Type without views, inside lists and structures too."""
    if pa.types.is_string_view(kind):
        return pa.string()
    if pa.types.is_binary_view(kind):
        return pa.binary()
    if pa.types.is_list(kind):
        return pa.list_(plain_field(kind.value_field))
    if pa.types.is_struct(kind):
        return pa.struct([plain_field(kind.field(k)) for k in range(kind.num_fields)])
    return kind


def plain_field(field: pa.Field) -> pa.Field:
    """Field without views."""
    return field.with_type(plain(field.type))
