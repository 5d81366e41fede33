"""Features to files: whole or not at all."""

import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyogrio
import pyogrio.errors
import shapely

from midrib import interrupts
from midrib.errors import ParameterError
from midrib.formats.columns import stored, stored_type
from midrib.formats.endings import (
    DECIMALS,
    FOLDERS,
    PARQUET,
    SHAPEFILE_SIDES,
    Format,
    format_of,
    sides_of,
)
from midrib.formats.failures import check_room, failures_named
from midrib.formats.fitting import distinct_names, fit, fitted
from midrib.formats.geoparquet import GeoParquetWriter, Kind, More, kinds_of
from midrib.formats.reading import Geometries
from midrib.formats.units import is_wgs84

__all__ = [
    "KINDS",
    "Features",
    "Layer",
    "check_free",
    "one_kind_each",
    "staged",
    "write_layer",
    "write_tables",
]

# WKT, in which CSV holds geometries; GDAL looks at it once, before it writes the first.
pyogrio.set_gdal_config_options({"OGR_WKT_PRECISION": DECIMALS})
CATALOGUE = "a00000001.gdbtable"  # the first table of every geodatabase
# Kinds of geometry that go into a layer together, by what is added to its name.
KINDS = {
    "": ("Polygon", "MultiPolygon"),
    "_lines": ("LineString", "LinearRing", "MultiLineString"),
    "_points": ("Point", "MultiPoint"),
}


class Features(NamedTuple):
    """What goes into one layer."""

    layer: str
    attributes: pa.Table
    geometries: Geometries
    geometry: str  # name of the column
    kind: str  # of geometry, where none is there to tell
    crs: str | None
    more: More = ()  # metadata of GeoParquet


class Layer(NamedTuple):
    """What is known of a layer before its features are there."""

    name: str
    attributes: pa.Schema
    geometry: str  # name of the column
    kind: str  # of geometry, where none is there to tell
    crs: str | None
    kinds: frozenset[Kind]  # that there are
    more: More = ()  # metadata of GeoParquet


def check_free(paths: Sequence[Path], name: str, *, overwrite: bool) -> None:
    """Refuse places that cannot be written to, before any work is done.

    Raises
    ------
    ParameterError
        If a file is there already and is not to be overwritten, a folder is in its place, or the
        folder it would be in is not there.
    """
    for path in paths:
        is_folder = path.suffix.lower() in FOLDERS
        if path.exists() and path.is_dir() != is_folder:
            found, wanted = ("a file", "a folder") if is_folder else ("a folder", "a file")
            msg = f"{name} {str(path)!r} is {found}, expected {wanted} or nothing there"
            raise ParameterError(msg)
        if is_folder and path.exists() and not is_geodatabase(path):
            msg = f"{name} {str(path)!r} is a folder, but no geodatabase that could be replaced"
            raise ParameterError(msg)
        if not path.parent.is_dir():
            msg = f"{name} {str(path)!r} lies in a folder that does not exist"
            raise ParameterError(msg)
        if path.exists() and not overwrite:
            msg = f"{name} {str(path)!r} exists, give --overwrite to replace it"
            raise ParameterError(msg)


def is_geodatabase(path: Path) -> bool:
    """Whether a folder is a geodatabase, or has nothing in it."""
    files = list(path.iterdir())
    return not files or (path / CATALOGUE in files and all(file.is_file() for file in files))


@contextmanager
def staged(folder: Path, stale: Sequence[Path] = ()) -> Iterator[Path]:
    """Open a folder inside ``folder``: what is written there moves up once all is well.

    The files ``stale`` go away then, unless they are replaced. After an error or an interrupt
    nothing has moved and the temporary folder is gone.
    """
    try:
        place = TemporaryDirectory(dir=folder, prefix=".midrib-")
    except OSError as error:
        msg = f"nothing can be written into the folder {str(folder)!r}: {error.strerror}"
        raise ParameterError(msg) from error
    with place as name, interrupts.rubbish(name):
        stage = Path(name) / "new"
        stage.mkdir()
        yield stage
        new = sorted(stage.iterdir())
        with interrupts.shielded():
            for path in {*stale, *(folder / path.name for path in new)}:
                put_aside(path, Path(name), everything=path in stale)
            for path in new:
                path.replace(folder / path.name)


def put_aside(path: Path, place: Path, *, everything: bool) -> None:
    """Move away what a rename would not replace: geodatabases, and side files of a shapefile."""
    endings = SHAPEFILE_SIDES if path.suffix.lower() == ".shp" else ()
    old = [side for ending in endings if (side := path.with_suffix(f".{ending}")).exists()]
    is_folder = path.is_dir() and path.suffix.lower() in FOLDERS
    if is_folder or (everything and path.is_file()):
        old.append(path)
    for file in old:
        file.replace(place / file.name)


def write_layer(path: Path, features: Features) -> list[str]:
    """Write features as a layer of a file; into a file that is there if its format has layers.

    Returns
    -------
    list of str
        What the format could not keep.

    Raises
    ------
    ParameterError
        If the format cannot hold the features.
    """
    wkb = pa.array(shapely.to_wkb(features.geometries, flavor="iso"), type=pa.binary())
    schema, kinds = features.attributes.schema, kinds_of(features.geometries)
    layer = Layer(
        features.layer,
        schema,
        features.geometry,
        features.kind,
        features.crs,
        frozenset(kinds),
        features.more,
    )
    names = [*schema.names, features.geometry]
    table = pa.table([*features.attributes.columns, wkb], names=names)
    return write_tables(path, layer, lambda: iter([table]))


def write_tables(path: Path, layer: Layer, tables: Callable[[], Iterable[pa.Table]]) -> list[str]:
    """Write a layer that comes table by table, as ``write_layer`` does.

    Each call of ``tables`` walks through them from the first: attributes, and WKB as the last
    column. One of them is held in memory at a time; of Parquet a row group.
    """
    target = format_of(path)
    wanted, notes = fit(layer.kinds, layer.kind, target)
    names: list[str] = []
    if not target.is_drawing:
        numbering = [
            name
            for k, name in enumerate(layer.attributes.names)
            if name.lower() == target.identifier and is_numbering(table[k] for table in tables())
        ]
        names, renamed = distinct_names(layer.attributes.names, layer.geometry, target, numbering)
        notes += renamed
    types = layer.attributes.types[: len(names)]
    if target.driver != PARQUET:
        known, types = types, [stored_type(kind) for kind in types]
        notes += [
            f"the field {name!r} is written in seconds"
            for name, kind in zip(names, known, strict=True)
            if pa.types.is_duration(kind)
        ]
    schema = pa.schema([*zip(names, types, strict=True), (layer.geometry, pa.binary())])

    def fitting() -> Iterator[pa.Table]:
        for table in tables():
            *columns, wkb = table.columns
            columns = columns[: len(names)]
            if target.driver != PARQUET:
                columns = [stored(column) for column in columns]
            wkb = fitted(wkb, wanted)
            whole = pa.table([*columns, wkb], schema=schema)
            yield whole.filter(pc.is_valid(wkb)) if target.is_drawing else whole

    if target.driver == PARQUET:
        with failures_named(f"OUT {path.name!r}"):
            writer = GeoParquetWriter(path, schema, layer.geometry, layer.crs, layer.more)
            for table in fitting():
                writer.write(table)
            writer.close()
        return notes
    notes += changes(layer, target)
    lost = ["attributes"] * target.is_drawing
    lost += ["a CRS"] * (layer.crs is not None and not target.has_crs)
    notes += [f"{target.driver} has no place for {what}" for what in lost]
    notes += [f"{key!r} of IN, {value!r}, is kept in GeoParquet only" for key, value in layer.more]
    batches = (batch for table in fitting() for batch in table.to_batches())
    reader = pa.RecordBatchReader.from_batches(schema, batches)
    return notes + write_by_gdal(path, layer, target, wanted.kind, reader)


def write_by_gdal(
    path: Path, layer: Layer, target: Format, kind: str, reader: pa.RecordBatchReader
) -> list[str]:
    """Write batches by a driver of GDAL, and return what it has to say."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            pyogrio.write_arrow(
                reader,
                path,
                layer=layer.name,
                driver=target.driver,
                geometry_name=layer.geometry,
                geometry_type=kind,
                crs=layer.crs,
                layer_options=dict(target.options),
            )
        except (
            pa.ArrowException,
            pyogrio.errors.DataSourceError,
            pyogrio.errors.DataLayerError,
            pyogrio.errors.FieldError,
            pyogrio.errors.FeatureError,
            pyogrio.errors.CRSError,
        ) as error:
            msg = f"OUT {path.name!r} cannot be written as {target.driver}: {error}"
            raise ParameterError(msg) from error
    for file in (path, *sides_of(path)) if target.hides_failures else ():
        check_room(file, f"OUT {path.name!r}")
    said = dict.fromkeys(str(w.message) for w in caught)
    return [text for text in said if not text.startswith("'crs' was not provided")]


def changes(layer: Layer, target: Format) -> list[str]:
    """Say what a format does to coordinates."""
    if not layer.kinds:
        return []
    notes = []
    if target.is_global and layer.crs is not None and not is_wgs84(layer.crs):
        notes.append(f"{target.driver} turns coordinates into longitude and latitude")
    if target.rounds:
        notes.append(f"{target.driver} rounds coordinates, so that lines may leave their areas")
    return notes


def is_numbering(chunks: Iterable[pa.ChunkedArray]) -> bool:
    """Whether a column can number features: whole numbers, each once."""
    column = pa.chunked_array([chunk for some in chunks for chunk in some.chunks] or [[]])
    return (
        pa.types.is_integer(column.type)
        and column.null_count == 0
        and len(column.unique()) == len(column)
    )


def one_kind_each(features: Features, target: Format) -> tuple[dict[str, Features], list[str]]:
    """Features by what is added to their layer's name, one kind each if the format asks for that.

    Collections have no place in such a format. They go with the areas, as features without a
    geometry, and a note says so; so do features that had none.
    """
    if not target.has_one_kind:
        return {"": features}, []
    geometries = features.geometries.copy()
    kinds = np.array([getattr(geometry, "geom_type", "") for geometry in geometries])
    known = [kind for some in KINDS.values() for kind in some]
    homeless = np.isin(kinds, [*known, ""], invert=True)
    notes = [f"{target.driver} has no place for a {kind}" for kind in np.unique(kinds[homeless])]
    geometries[homeless] = None
    kinds[homeless] = ""
    apart = {}
    for name, some in KINDS.items():
        rows = np.flatnonzero(np.isin(kinds, some if name else [*some, ""]))
        if rows.size:
            apart[name] = features._replace(
                layer=features.layer + name,
                attributes=features.attributes.take(rows),
                geometries=geometries[rows],
                kind=some[0],
            )
    return apart, notes
