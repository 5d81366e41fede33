"""Layers of vector files, read in batches of Arrow columns and shapely geometries."""

import json
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple, TypeAlias

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pyogrio
import shapely

from midrib import interrupts
from midrib.errors import ParameterError
from midrib.formats.contents import PARQUET_ENDINGS, UNREADABLE, without_m
from midrib.formats.geoparquet import More, geo_column
from midrib.formats.views import batches_without_views, without_views

__all__ = [
    "BUFFER",
    "Batch",
    "Geometries",
    "Source",
    "decoded",
    "open_layer",
    "parquet_batches",
]

Geometries: TypeAlias = "np.ndarray[tuple[int], np.dtype[np.object_]]"
BATCH = 500  # features: some tenths of a second of work
BUFFER = 1_000_000  # bytes of a column read at a time, else a whole row group is
EXTENSION = b"ARROW:extension:metadata"


Rows: TypeAlias = tuple[int, int | None]  # the first of them, and how many; None for all
ALL: Rows = (0, None)


class Batch(NamedTuple):
    """Some features in the order of the file."""

    first: int  # number of features before it
    attributes: pa.Table
    geometries: Geometries  # None where missing
    unreadable: dict[int, str]  # row to reason; their geometry is None


@dataclass(frozen=True)
class Source:
    """A layer that is open for reading.

    Attributes
    ----------
    layer : str
        Its name; of a file that has no layers, the file's.
    attributes : pyarrow.Schema
        The columns apart from the geometry.
    geometry : str
        Name of the geometry column.
    kind : str
        Kind of geometry that the file declares, ``"Unknown"`` where it does not.
    crs : str or None
        PROJJSON.
    count : int or None
        Number of features, None where it takes long to find out.
    stream : iterator of pyarrow.RecordBatch
        The features.
    more : pairs
        Metadata of GeoParquet that results keep.
    """

    layer: str
    attributes: pa.Schema
    geometry: str
    kind: str
    crs: str | None
    count: int | None
    stream: Iterator[pa.RecordBatch]
    more: More = ()

    def batches(self) -> Iterator[Batch]:
        """Features in the order of the file, after a batch of none; can be walked through once."""
        yield Batch(0, self.attributes.empty_table(), np.empty(0, dtype=object), {})
        first = 0
        for batch in self.stream:
            interrupts.check()
            attributes = pa.Table.from_batches([batch]).select(self.attributes.names)
            yield Batch(first, attributes, *decoded(batch.column(self.geometry)))
            first += batch.num_rows


@contextmanager
def open_layer(
    path: Path, layer: str, *, batch_size: int = BATCH, rows: Rows = ALL
) -> Iterator[Source]:
    """Open one layer, one of ``layer_names(path)``, or some rows of it: first row and number.

    Raises
    ------
    ParameterError
        If the file cannot be read.
    """
    opened = open_parquet if path.suffix.lower() in PARQUET_ENDINGS else open_vector
    with ExitStack() as stack:
        try:
            source = stack.enter_context(opened(path, layer, batch_size, rows))
        except UNREADABLE as error:
            msg = f"IN {str(path)!r} cannot be read: {error}"
            raise ParameterError(msg) from error
        yield replace(source, stream=checked_stream(source.stream, path))


def checked_stream(stream: Iterator[pa.RecordBatch], path: Path) -> Iterator[pa.RecordBatch]:
    """Batches of a stream; where it breaks, an error that names the file."""
    try:
        yield from stream
    except UNREADABLE as error:
        msg = f"IN {str(path)!r} cannot be read to its end: {error}"
        raise ParameterError(msg) from error


@contextmanager
def open_parquet(path: Path, layer: str, batch_size: int, rows: Rows) -> Iterator[Source]:
    """Open a GeoParquet file."""
    with pq.ParquetFile(path, buffer_size=BUFFER) as file:
        schema = file.schema_arrow
        column = geo_column(schema, path)
        dropped = (column.name, column.covering)
        names = [name for name in schema.names if name not in dropped]
        yield Source(
            layer,
            without_views(pa.schema([schema.field(name) for name in names])),
            column.name,
            column.kind,
            column.crs,
            file.metadata.num_rows,
            batches_without_views(parquet_batches(file, batch_size, [*names, column.name], rows)),
            column.more,
        )


def parquet_batches(
    file: pq.ParquetFile, batch_size: int, names: list[str], rows: Rows = ALL
) -> Iterator[pa.RecordBatch]:
    """Read some rows of a Parquet file; row groups without any of them are not read."""
    first, count = rows
    last = file.metadata.num_rows if count is None else first + count
    position = 0
    for k in range(file.num_row_groups):
        n_rows = file.metadata.row_group(k).num_rows
        if position >= last or position + n_rows <= first:
            position += n_rows
            continue
        # A walk through several row groups (Arrow 26) keeps all of them in memory to its end.
        for batch in file.iter_batches(batch_size, row_groups=[k], columns=names):
            low, high = max(first - position, 0), min(last - position, batch.num_rows)
            position += batch.num_rows
            if high > low:
                yield batch.slice(low, high - low)


@contextmanager
def open_vector(path: Path, layer: str, batch_size: int, rows: Rows) -> Iterator[Source]:
    """Open a layer of a file that GDAL reads."""
    # GDAL's own Arrow stream of FlatGeobuf (3.12) breaks at a missing geometry; the generic one
    # does not.
    pyogrio.set_gdal_config_options({"OGR_FLATGEOBUF_STREAM_BASE_IMPL": "YES"})
    options = {"KEEP_GEOM_COLUMNS": "NO"} if path.suffix.lower() == ".csv" else {}
    with ExitStack() as stack:
        with without_m():
            count = pyogrio.read_info(path, layer=layer)["features"]
            reading = pyogrio.open_arrow(
                path,
                layer=layer,
                skip_features=rows[0],
                batch_size=batch_size,
                use_pyarrow=True,
                **options,
            )
            meta, reader = stack.enter_context(reading)
        geometry = meta["geometry_name"] or "wkb_geometry"
        if geometry not in reader.schema.names:
            msg = f"layer {layer!r} of IN {str(path)!r} has no geometries, expected areas"
            raise ParameterError(msg)
        metadata = reader.schema.field(geometry).metadata or {}
        crs = json.loads(metadata.get(EXTENSION, b"{}") or b"{}").get("crs")
        yield Source(
            layer,
            pa.schema([field for field in reader.schema if field.name != geometry]),
            geometry,
            (meta["geometry_type"] or "Unknown").removesuffix(" Z").removeprefix("2.5D "),
            crs if crs is None else json.dumps(crs),
            count if count >= 0 else None,
            first_rows(reader, rows[1]),
        )


def first_rows(batches: Iterable[pa.RecordBatch], count: int | None) -> Iterator[pa.RecordBatch]:
    """End a stream after so many rows: pyogrio's can begin anywhere, but ends with the layer."""
    for batch in batches:
        if count is not None and batch.num_rows >= count:
            yield batch.slice(0, count)
            return
        yield batch
        count = None if count is None else count - batch.num_rows


def decoded(wkb: pa.Array) -> tuple[Geometries, dict[int, str]]:
    """Geometries of a column of WKB, and why some of them cannot be read."""
    rows = wkb.to_numpy(zero_copy_only=False)
    try:
        return shapely.from_wkb(rows), {}
    except shapely.errors.GEOSException:
        geometries = np.empty(rows.size, dtype=object)
    unreadable = {}
    for i, row in enumerate(rows):
        try:
            geometries[i] = shapely.from_wkb(row)
        except shapely.errors.GEOSException as error:
            unreadable[i] = f"the geometry cannot be read: {error}"
    return geometries, unreadable
