"""Features to files: whole or not at all."""

import warnings
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np
import pyarrow as pa
import pyogrio
import pyogrio.errors
import shapely

from midrib import interrupts
from midrib.errors import ParameterError
from midrib.formats.endings import DECIMALS, FOLDERS, PARQUET, SHAPEFILE_SIDES, Format, format_of
from midrib.formats.geoparquet import write_parquet
from midrib.formats.reading import Geometries
from midrib.formats.units import is_wgs84

__all__ = [
    "KINDS",
    "Features",
    "check_free",
    "free_name",
    "one_kind_each",
    "staged",
    "write_layer",
]

# WKT, in which CSV holds geometries; GDAL looks at it once, before it writes the first.
pyogrio.set_gdal_config_options({"OGR_WKT_PRECISION": DECIMALS})
# What pyogrio calls a kind of geometry, by whether it has Z and M.
NAMES = {
    (False, False): "{}",
    (True, False): "{} Z",
    (False, True): "Measured {}",
    (True, True): "Measured 3D {}",
}
CATALOGUE = "a00000001.gdbtable"  # the first table of every geodatabase
BUILDERS = {  # of the multiple kinds
    "Point": shapely.multipoints,
    "LineString": shapely.multilinestrings,
    "Polygon": shapely.multipolygons,
}
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
    target = format_of(path)
    if target.is_drawing:
        there = features.geometries[~shapely.is_missing(features.geometries)]
        features = features._replace(attributes=pa.table({}), geometries=there)
    geometries, notes = with_even_heights(features.geometries, target)
    geometries, kind = uniform(geometries, features.kind)
    wkb = pa.array(shapely.to_wkb(geometries, flavor="iso"), type=pa.binary())
    names, renamed = distinct_names(features, target)
    notes += renamed
    columns = dict(zip(names, features.attributes.columns, strict=True))
    table = pa.table({**columns, features.geometry: wkb})
    if target.driver == PARQUET:
        write_parquet(path, table, features.geometry, features.crs)
        return notes
    notes += changes(features, target)
    lost = ["attributes"] * target.is_drawing
    lost += ["a CRS"] * (features.crs is not None and not target.has_crs)
    notes += [f"{target.driver} has no place for {what}" for what in lost]
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            pyogrio.write_arrow(
                table,
                path,
                layer=features.layer,
                driver=target.driver,
                geometry_name=features.geometry,
                geometry_type=kind,
                crs=features.crs,
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
    said = dict.fromkeys(str(w.message) for w in caught)
    return notes + [text for text in said if not text.startswith("'crs' was not provided")]


def changes(features: Features, target: Format) -> list[str]:
    """Say what a format does to coordinates."""
    if shapely.is_missing(features.geometries).all():
        return []
    notes = []
    if target.is_global and features.crs is not None and not is_wgs84(features.crs):
        notes.append(f"{target.driver} turns coordinates into longitude and latitude")
    if target.rounds:
        notes.append(f"{target.driver} rounds coordinates, so that lines may leave their areas")
    return notes


def distinct_names(features: Features, target: Format) -> tuple[list[str], list[str]]:
    """Names of the attributes that the format tells apart, and notes about new ones.

    Formats other than Parquet take names that differ only by case for one, or refuse the second;
    some write its values into the first.
    """
    fold: Callable[[str], str] = str if target.driver == PARQUET else str.lower
    taken = {fold(features.geometry)}
    table = features.attributes
    for name, column in zip(table.column_names, table.columns, strict=True):
        if fold(name) == target.identifier and not is_numbering(column):
            taken.add(fold(name))
    names: list[str] = []
    for name in table.column_names:
        new = name
        if fold(name) in taken:
            new = free_name(name, taken | {fold(known) for known in table.column_names}, fold)
        taken.add(fold(new))
        names.append(new)
    pairs = zip(table.column_names, names, strict=True)
    return names, [f"the field {old!r} is written as {new!r}" for old, new in pairs if old != new]


def is_numbering(column: pa.ChunkedArray) -> bool:
    """Whether a column can number features: whole numbers, each once."""
    return (
        pa.types.is_integer(column.type)
        and column.null_count == 0
        and len(column.unique()) == len(column)
    )


def free_name(name: str, taken: Collection[str], fold: Callable[[str], str] = str.lower) -> str:
    """Return a name, numbered on where it is taken: ``length_2``."""
    free, number = name, 2
    while fold(free) in taken:
        free, number = f"{name}_{number}", number + 1
    return free


def uniform(geometries: Geometries, default: str) -> tuple[Geometries, str]:
    """Geometries of one kind and its name: single ones become multi where both occur."""
    there = geometries[~shapely.is_missing(geometries)]
    kinds = {geometry.geom_type for geometry in there}
    dimensions = set(zip(shapely.has_z(there), shapely.has_m(there), strict=True))
    if not kinds:
        return geometries, default
    if len({kind.removeprefix("Multi") for kind in kinds}) > 1 or len(dimensions) > 1:
        return geometries, "Unknown"
    name = NAMES[dimensions.pop()]
    if len(kinds) == 1:
        return geometries, name.format(kinds.pop())
    multi = geometries.copy()
    build = BUILDERS[min(kinds, key=len)]
    for i, geometry in enumerate(geometries):
        if geometry is not None and not geometry.geom_type.startswith("Multi"):
            multi[i] = build([geometry])
    return multi, name.format(max(kinds, key=len))


def with_even_heights(geometries: Geometries, target: Format) -> tuple[Geometries, list[str]]:
    """Geometries all with Z or all without, if the format asks for that, and a note about it."""
    there = ~shapely.is_missing(geometries)
    has_z = shapely.has_z(geometries)
    if not target.has_one_kind or not 0 < has_z.sum() < there.sum():
        return geometries, []
    even = geometries.copy()
    even[there & ~has_z] = shapely.force_3d(geometries[there & ~has_z], 0.0)
    return even, [f"{target.driver} has a Z for all or for none, it is 0 where there was none"]


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
