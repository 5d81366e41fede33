"""GeoParquet 1.1: the "geo" metadata that makes a column of WKB a column of geometries.

Source: https://geoparquet.org/releases/v1.1.0/
"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import pyarrow as pa
import pyarrow.parquet as pq
import shapely

from midrib.errors import ParameterError

if TYPE_CHECKING:
    from midrib.formats.reading import Geometries

__all__ = ["GeoColumn", "geo_column", "write_parquet"]

VERSION = "1.1.0"
CRS84 = {  # what a column without "crs" means
    "type": "GeographicCRS",
    "name": "WGS 84 (CRS84)",
    "datum": {
        "type": "GeodeticReferenceFrame",
        "name": "World Geodetic System 1984",
        "ellipsoid": {
            "name": "WGS 84",
            "semi_major_axis": 6378137,
            "inverse_flattening": 298.257223563,
        },
    },
    "coordinate_system": {
        "subtype": "ellipsoidal",
        "axis": [
            {
                "name": "Geodetic longitude",
                "abbreviation": "Lon",
                "direction": "east",
                "unit": "degree",
            },
            {
                "name": "Geodetic latitude",
                "abbreviation": "Lat",
                "direction": "north",
                "unit": "degree",
            },
        ],
    },
    "id": {"authority": "OGC", "code": "CRS84"},
}


class GeoColumn(NamedTuple):
    """What the metadata says about the primary geometry column."""

    name: str
    crs: str | None  # PROJJSON
    kind: str  # of geometry, "Unknown" if it holds several
    covering: str | None  # column with the boxes of the geometries


def geo_column(metadata: dict[bytes, bytes] | None, path: Path) -> GeoColumn:
    """Find the primary geometry column of a Parquet file's schema.

    Raises
    ------
    ParameterError
        If there is none, or its geometries are not WKB.
    """
    if not metadata or b"geo" not in metadata:
        msg = f"IN {str(path)!r} is Parquet without geometries, expected GeoParquet"
        raise ParameterError(msg)
    geo = json.loads(metadata[b"geo"])
    name = geo["primary_column"]
    column = geo["columns"][name]
    if column["encoding"] != "WKB":
        msg = (
            f"IN {str(path)!r} has geometries in the encoding {column['encoding']!r}, expected WKB"
        )
        raise ParameterError(msg)
    crs = column.get("crs", CRS84)
    kinds = {kind.removesuffix(" Z") for kind in column.get("geometry_types", [])}
    covering = column.get("covering", {}).get("bbox", {}).get("xmin", [None])[0]
    return GeoColumn(
        name,
        crs if crs is None or isinstance(crs, str) else json.dumps(crs),
        kinds.pop() if len(kinds) == 1 else "Unknown",
        covering,
    )


def write_parquet(path: Path, table: pa.Table, column: str, crs: str | None) -> None:
    """Write a table with a column of WKB as GeoParquet."""
    geometries = shapely.from_wkb(table[column].to_numpy())
    about: dict[str, Any] = {
        "encoding": "WKB",
        "geometry_types": kinds_of(geometries),
        "crs": None if crs is None else json.loads(crs),
    }
    if about["geometry_types"]:
        about["bbox"] = shapely.total_bounds(geometries).tolist()
    geo = {"version": VERSION, "primary_column": column, "columns": {column: about}}
    pq.write_table(table.replace_schema_metadata({"geo": json.dumps(geo)}), path)


def kinds_of(geometries: "Geometries") -> list[str]:
    """Names of the kinds of geometry that are not empty, with " Z" where they have heights."""
    return sorted({g.geom_type + " Z" * g.has_z for g in geometries if g})
