"""Layers of vector files, read in batches of Arrow columns and shapely geometries."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, TypeAlias

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pyogrio
import pyogrio.errors
import shapely

from midrib.errors import ParameterError
from midrib.formats.geoparquet import geo_column

__all__ = ["Batch", "Geometries", "Source", "layer_names", "open_layer"]

Geometries: TypeAlias = "np.ndarray[tuple[int], np.dtype[np.object_]]"
PARQUET_ENDINGS = (".parquet", ".geoparquet")
BATCH = 500  # features: some tenths of a second of work
EXTENSION = b"ARROW:extension:metadata"


class Batch(NamedTuple):
    """Some features in the order of the file."""

    attributes: pa.Table
    geometries: Geometries  # None where missing
    unreadable: dict[int, str]  # row to reason; their geometry is None
    wkb: pa.Array  # as they were read


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
    """

    layer: str
    attributes: pa.Schema
    geometry: str
    kind: str
    crs: str | None
    count: int | None
    stream: Iterator[pa.RecordBatch]

    def batches(self) -> Iterator[Batch]:
        """Features in the order of the file; can be walked through once."""
        for batch in self.stream:
            wkb = batch.column(self.geometry)
            attributes = pa.Table.from_batches([batch]).select(self.attributes.names)
            yield Batch(attributes, *decoded(wkb), wkb)


def layer_names(path: Path) -> dict[str, str | None]:
    """Layers of a file and the kind of geometry each declares, None for a table without.

    Raises
    ------
    ParameterError
        If the file is missing or is not a vector file.
    """
    if not path.exists():
        msg = f"IN {str(path)!r} does not exist"
        raise ParameterError(msg)
    if path.suffix.lower() in PARQUET_ENDINGS:
        return {path.stem: "Unknown"}
    try:
        return {str(name): kind for name, kind in pyogrio.list_layers(path)}
    except pyogrio.errors.DataSourceError:
        msg = f"IN {str(path)!r} cannot be read as a vector file"
        raise ParameterError(msg) from None


@contextmanager
def open_layer(path: Path, layer: str, *, batch_size: int = BATCH) -> Iterator[Source]:
    """Open one layer, one of ``layer_names(path)``.

    Raises
    ------
    ParameterError
        If the file cannot be read.
    """
    opened = open_parquet if path.suffix.lower() in PARQUET_ENDINGS else open_vector
    try:
        with opened(path, layer, batch_size) as source:
            yield source
    except (pa.ArrowException, pyogrio.errors.DataSourceError, pyogrio.errors.DataLayerError) as e:
        msg = f"IN {str(path)!r} cannot be read: {e}"
        raise ParameterError(msg) from e


@contextmanager
def open_parquet(path: Path, layer: str, batch_size: int) -> Iterator[Source]:
    """Open a GeoParquet file."""
    with pq.ParquetFile(path) as file:
        schema = file.schema_arrow
        column = geo_column(schema.metadata, path)
        dropped = (column.name, column.covering)
        names = [name for name in schema.names if name not in dropped]
        kinds = {kind.removesuffix(" Z") for kind in column.kinds}
        yield Source(
            layer,
            pa.schema([schema.field(name) for name in names]),
            column.name,
            kinds.pop() if len(kinds) == 1 else "Unknown",
            column.crs,
            file.metadata.num_rows,
            file.iter_batches(batch_size, columns=[*names, column.name]),
        )


@contextmanager
def open_vector(path: Path, layer: str, batch_size: int) -> Iterator[Source]:
    """Open a layer of a file that GDAL reads."""
    # GDAL's own Arrow stream of FlatGeobuf (3.12) breaks at a missing geometry; the generic one
    # does not.
    pyogrio.set_gdal_config_options({"OGR_FLATGEOBUF_STREAM_BASE_IMPL": "YES"})
    options = {"KEEP_GEOM_COLUMNS": "NO"} if path.suffix.lower() == ".csv" else {}
    count = pyogrio.read_info(path, layer=layer)["features"]
    with pyogrio.open_arrow(
        path, layer=layer, batch_size=batch_size, use_pyarrow=True, **options
    ) as (meta, reader):
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
            iter(reader),
        )


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
