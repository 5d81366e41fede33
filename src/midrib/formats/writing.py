"""Features to files: whole or not at all."""

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import pyarrow as pa
import pyogrio
import pyogrio.errors
import shapely

from midrib.errors import ParameterError
from midrib.formats.endings import PARQUET, SHAPEFILE_SIDES, format_of
from midrib.formats.geoparquet import write_parquet
from midrib.formats.reading import Geometries

__all__ = ["Features", "check_free", "staged", "write_layer"]

# What pyogrio calls a kind of geometry, by whether it has Z and M.
NAMES = {
    (False, False): "{}",
    (True, False): "{} Z",
    (False, True): "Measured {}",
    (True, True): "Measured 3D {}",
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
        If a file is there already and is not to be overwritten, or its folder is not there.
    """
    for path in paths:
        if not path.parent.is_dir():
            msg = f"{name} {str(path)!r} lies in a folder that does not exist"
            raise ParameterError(msg)
        if path.exists() and not overwrite:
            msg = f"{name} {str(path)!r} exists, give --overwrite to replace it"
            raise ParameterError(msg)


@contextmanager
def staged(folder: Path, stale: Sequence[Path] = ()) -> Iterator[Path]:
    """Open a folder inside ``folder``: what is written there moves up once all is well.

    The files ``stale`` go away then, unless they are replaced. After an error or an interrupt
    nothing has moved and the temporary folder is gone.
    """
    with TemporaryDirectory(dir=folder, prefix=".midrib-") as name:
        stage = Path(name) / "new"
        stage.mkdir()
        yield stage
        new = sorted(stage.iterdir())
        for path in {*stale, *(folder / path.name for path in new)}:
            put_aside(path, Path(name), everything=path in stale)
        for path in new:
            path.replace(folder / path.name)


def put_aside(path: Path, place: Path, *, everything: bool) -> None:
    """Move away what a rename would not replace: folders, and side files of a shapefile."""
    endings = SHAPEFILE_SIDES if path.suffix.lower() == ".shp" else ()
    old = [side for ending in endings if (side := path.with_suffix(f".{ending}")).exists()]
    if path.is_dir() or (everything and path.exists()):
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
    geometries, kind = uniform(features.geometries, features.kind)
    wkb = pa.array(shapely.to_wkb(geometries, flavor="iso"), type=pa.binary())
    attributes = features.attributes
    columns = dict(zip(attributes.column_names, attributes.columns, strict=True))
    table = pa.table({**columns, features.geometry: wkb})
    if target.driver == PARQUET:
        write_parquet(path, table, features.geometry, features.crs)
        return []
    lost = ["attributes"] * target.is_drawing
    lost += ["a CRS"] * (features.crs is not None and not target.has_crs)
    notes = [f"{target.driver} has no place for {what}" for what in lost]
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
    build = shapely.multilinestrings if "LineString" in kinds else shapely.multipolygons
    for i, geometry in enumerate(geometries):
        if geometry is not None and not geometry.geom_type.startswith("Multi"):
            multi[i] = build([geometry])
    return multi, name.format(max(kinds, key=len))
