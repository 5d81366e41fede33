"""What a vector file holds: its layers, their kinds, columns and counts, before they are read."""

import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pyogrio
import pyogrio.errors

from midrib.errors import ParameterError
from midrib.formats.endings import PARQUET
from midrib.formats.geoparquet import geo_column

__all__ = [
    "PARQUET_ENDINGS",
    "UNREADABLE",
    "choose_layer",
    "column_names",
    "count_features",
    "driver_of",
    "layer_names",
    "listed",
    "may_hold_areas",
    "without_m",
]

PARQUET_ENDINGS = (".parquet", ".geoparquet")
AREA_KINDS = ("Polygon", "Surface", "Unknown", "GeometryCollection")
UNREADABLE = (
    pa.ArrowException,
    OSError,
    pyogrio.errors.DataSourceError,
    pyogrio.errors.DataLayerError,
)


def layer_names(path: Path, name: str = "IN") -> dict[str, str | None]:
    """Layers of a file and the kind of geometry each declares, None for a table without.

    ``name`` is what messages call the file.

    Raises
    ------
    ParameterError
        If the file is missing or is not a vector file.
    """
    if not path.exists():
        msg = f"{name} {str(path)!r} does not exist"
        raise ParameterError(msg)
    try:
        if path.suffix.lower() in PARQUET_ENDINGS:
            return {path.stem: geo_column(pq.read_schema(path), path).kind}
        with without_m():
            return {str(layer): kind for layer, kind in pyogrio.list_layers(path)}
    except UNREADABLE:
        msg = f"{name} {str(path)!r} cannot be read as a vector file"
        raise ParameterError(msg) from None


def driver_of(path: Path, layer: str) -> str:
    """Return GDAL's name of the format that a layer is read from, ``"Parquet"`` for that."""
    if path.suffix.lower() in PARQUET_ENDINGS:
        return PARQUET
    with without_m():
        return str(pyogrio.read_info(path, layer=layer)["driver"])


def column_names(path: Path, layer: str | int = 0) -> list[str]:
    """Columns of a file's layer, the first unless named; none if it cannot be read."""
    try:
        if path.suffix.lower() in PARQUET_ENDINGS:
            return list(pq.read_schema(path).names)
        with without_m():
            return [str(name) for name in pyogrio.read_info(path, layer=layer)["fields"]]
    except UNREADABLE:
        return []


def choose_layer(path: Path, layer: str | None, name: str = "IN") -> str:
    """Name of the layer with areas to read: the one that is asked for, else the only one.

    ``name`` is what messages call the file.

    Raises
    ------
    ParameterError
        If there is no such layer, none with areas, or a choice of several.
    """
    layers = layer_names(path, name)
    if layer is not None:
        if layer not in layers:
            msg = f"--layer is {layer!r}, expected a layer of IN {str(path)!r}: {listed(layers)}"
            raise ParameterError(msg)
        if not may_hold_areas(layers[layer]):
            msg = f"--layer {layer!r} holds {layers[layer] or 'no geometries'}, expected areas"
            raise ParameterError(msg)
        return layer
    with_areas = [known for known, kind in layers.items() if may_hold_areas(kind)]
    if len(with_areas) == 1:
        return with_areas[0]
    if with_areas:
        wanted = "choose one with --layer" if name == "IN" else "expected one"
        msg = f"{name} {str(path)!r} has several layers, {wanted}: {listed(with_areas)}"
        raise ParameterError(msg)
    held = ", ".join(sorted({kind or "no geometries" for kind in layers.values()})) or "nothing"
    msg = f"{name} {str(path)!r} holds {held}, expected areas (Polygon or MultiPolygon)"
    raise ParameterError(msg)


def listed(names: Iterable[str]) -> str:
    """Names for a message."""
    return ", ".join(repr(name) for name in names)


def may_hold_areas(kind: str | None) -> bool:
    """Whether a layer of a declared kind of geometry can have areas in it."""
    return kind is not None and any(word in kind for word in AREA_KINDS)


def count_features(path: Path, layer: str) -> int:
    """Count the features of a layer, however long that takes."""
    if path.suffix.lower() in PARQUET_ENDINGS:
        return int(pq.read_metadata(path).num_rows)
    with without_m():
        info = pyogrio.read_info(path, layer=layer, force_feature_count=True)
    return int(info["features"])


@contextmanager
def without_m() -> Iterator[None]:
    """Pass over pyogrio's warning that it has no names for kinds of geometry with M values."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Measured")
        yield
