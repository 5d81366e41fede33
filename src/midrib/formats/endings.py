"""Endings: the format that a file is written in, and what that format cannot do."""

from dataclasses import dataclass
from pathlib import Path

from midrib.errors import ParameterError

__all__ = ["PARQUET", "SHAPEFILE_SIDES", "Format", "endings_with_m", "format_of"]

PARQUET = "Parquet"
SHAPEFILE_SIDES = ("shx", "dbf", "prj", "cpg", "qix", "sbn", "sbx", "qpj")


@dataclass(frozen=True)
class Format:
    """A way to write features.

    Attributes
    ----------
    driver : str
        GDAL's name of it, or ``"Parquet"``.
    has_layers : bool
        Whether one file takes several layers.
    is_drawing : bool
        Whether it takes geometries only: no attributes, no feature without a geometry.
    has_crs : bool
        Whether it says what coordinates mean.
    has_m : bool
        Whether its geometries can have M values.
    options : tuple of pairs
        Layer options of the driver.
    """

    driver: str
    has_layers: bool = False
    is_drawing: bool = False
    has_crs: bool = True
    has_m: bool = False
    options: tuple[tuple[str, str], ...] = ()


FORMATS = {
    "gpkg": Format("GPKG", has_layers=True, has_m=True),
    "parquet": Format(PARQUET),
    "geoparquet": Format(PARQUET),
    # FlatGeobuf's spatial index sorts the features and has no place for missing geometries.
    "fgb": Format("FlatGeobuf", has_m=True, options=(("SPATIAL_INDEX", "NO"),)),
    "geojson": Format("GeoJSON"),
    "json": Format("GeoJSON"),
    "geojsonl": Format("GeoJSONSeq"),
    "shp": Format("ESRI Shapefile", has_m=True),
    "gdb": Format("OpenFileGDB", has_layers=True, has_m=True),
    "sqlite": Format("SQLite", has_layers=True, has_m=True, options=(("FORMAT", "SPATIALITE"),)),
    "gml": Format("GML"),
    "kml": Format("KML"),
    "csv": Format("CSV", has_crs=False, has_m=True, options=(("GEOMETRY", "AS_WKT"),)),
    "tab": Format("MapInfo File"),
    "mif": Format("MapInfo File"),
    "jml": Format("JML"),
    "dxf": Format("DXF", is_drawing=True, has_crs=False),
}


def format_of(path: Path) -> Format:
    """Return the format that a file name's ending stands for.

    Raises
    ------
    ParameterError
        If no format that can be written has the ending.
    """
    ending = path.suffix.removeprefix(".").lower()
    if ending not in FORMATS:
        found = f"ends in {path.suffix!r}" if path.suffix else "has no ending"
        known = ", ".join(f".{known}" for known in FORMATS)
        msg = f"OUT {str(path)!r} {found}, expected one of {known}"
        raise ParameterError(msg)
    return FORMATS[ending]


def endings_with_m() -> list[str]:
    """Name the endings of formats whose geometries can have M values."""
    return [f".{ending}" for ending, known in FORMATS.items() if known.has_m]
