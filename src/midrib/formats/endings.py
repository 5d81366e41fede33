"""Endings: the format that a file is written in, and what that format cannot do."""

from dataclasses import dataclass
from pathlib import Path

from midrib.errors import ParameterError

__all__ = [
    "DECIMALS",
    "FOLDERS",
    "PARQUET",
    "SHAPEFILE_SIDES",
    "Format",
    "endings_with_m",
    "format_of",
    "sides_of",
]

PARQUET = "Parquet"
SHAPEFILE_SIDES = ("shx", "dbf", "prj", "cpg", "qix", "sbn", "sbx", "qpj")
SIDES = {  # files beside one, by its ending: attributes, CRS, schema
    "shp": SHAPEFILE_SIDES,
    "tab": ("dat", "map", "id", "ind"),
    "mif": ("mid",),
    "csv": ("csvt", "prj"),
    "gml": ("gfs", "xsd"),
}


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
    is_folder : bool
        Whether it is a folder with files of its own kind.
    has_one_kind : bool
        Whether a layer's geometries are all points, all lines or all areas, with or without Z.
    rounds : bool
        Whether coordinates lose digits.
    is_global : bool
        Whether all coordinates are turned into longitude and latitude (WGS 84).
    hides_failures : bool
        Whether its driver says nothing of a disk that is full.
    identifier : str
        Name of its column for numbers of features, if it has one among the others.
    options : tuple of pairs
        Layer options of the driver.
    """

    driver: str
    has_layers: bool = False
    is_drawing: bool = False
    has_crs: bool = True
    has_m: bool = False
    is_folder: bool = False
    has_one_kind: bool = False
    rounds: bool = False
    is_global: bool = False
    hides_failures: bool = False
    identifier: str = ""
    options: tuple[tuple[str, str], ...] = ()


# Digits that make a double come back bit by bit: 17 that count, or so many after the point (from
# 0.0001 on).
FIGURES, DECIMALS = "17", "20"
FORMATS = {
    "gpkg": Format("GPKG", has_layers=True, has_m=True, identifier="fid"),
    "parquet": Format(PARQUET),
    "geoparquet": Format(PARQUET),
    # FlatGeobuf's spatial index sorts the features and has no place for missing geometries.
    "fgb": Format("FlatGeobuf", has_m=True, options=(("SPATIAL_INDEX", "NO"),)),
    "geojson": Format("GeoJSON", options=(("SIGNIFICANT_FIGURES", FIGURES),)),
    "json": Format("GeoJSON", options=(("SIGNIFICANT_FIGURES", FIGURES),)),
    "geojsonl": Format("GeoJSONSeq", is_global=True, options=(("COORDINATE_PRECISION", DECIMALS),)),
    "shp": Format("ESRI Shapefile", has_m=True, has_one_kind=True),
    "gdb": Format(
        "OpenFileGDB", has_layers=True, has_m=True, is_folder=True, has_one_kind=True, rounds=True
    ),
    "sqlite": Format(
        "SQLite",
        has_layers=True,
        has_m=True,
        identifier="ogc_fid",
        options=(("FORMAT", "SPATIALITE"),),
    ),
    "gml": Format("GML", rounds=True),
    "kml": Format("KML", is_global=True, hides_failures=True),
    "csv": Format("CSV", has_crs=False, has_m=True, options=(("GEOMETRY", "AS_WKT"),)),
    "tab": Format("MapInfo File", rounds=True),
    "mif": Format("MapInfo File", rounds=True, hides_failures=True),
    "jml": Format("JML", rounds=True, hides_failures=True),
    "dxf": Format("DXF", is_drawing=True, has_crs=False, rounds=True, hides_failures=True),
}
FOLDERS = tuple(f".{ending}" for ending, known in FORMATS.items() if known.is_folder)


def format_of(path: Path, name: str = "OUT", more: tuple[str, ...] = ()) -> Format:
    """Return the format that a file name's ending stands for.

    ``name`` is what messages call the file, ``more`` are endings that somebody else takes care of.

    Raises
    ------
    ParameterError
        If no format that can be written has the ending.
    """
    ending = path.suffix.removeprefix(".").lower()
    if ending not in FORMATS:
        found = f"ends in {path.suffix!r}" if path.suffix else "has no ending"
        known = ", ".join((*more, *(f".{known}" for known in FORMATS if f".{known}" not in more)))
        msg = f"{name} {str(path)!r} {found}, expected one of {known}"
        raise ParameterError(msg)
    return FORMATS[ending]


def sides_of(path: Path) -> list[Path]:
    """Files beside one that belong to it: of the same name, with endings of its format."""
    endings = SIDES.get(path.suffix.removeprefix(".").lower(), ())
    return sorted(
        file
        for file in (path.parent.iterdir() if endings else ())
        if file.stem == path.stem and file.suffix.removeprefix(".").lower() in endings
    )


def endings_with_m() -> list[str]:
    """Name the endings of formats whose geometries can have M values."""
    return [f".{ending}" for ending, known in FORMATS.items() if known.has_m]
