"""GeoParquet 1.1: the "geo" metadata that makes a column of WKB a column of geometries.

Source: https://geoparquet.org/releases/v1.1.0/
"""

import base64
import json
from collections.abc import Iterator
from contextlib import suppress
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias, TypeVar

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import shapely

from midrib.errors import ParameterError
from midrib.formats.row_sizes import row_sizes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from midrib.formats.reading import Geometries
    from midrib.types import Floats

__all__ = ["CRS84_TEXT", "GeoColumn", "GeoParquetWriter", "Kind", "More", "geo_column", "kinds_of"]

Some = TypeVar("Some")
More: TypeAlias = tuple[tuple[str, Any], ...]  # metadata of a column that results keep
Kind: TypeAlias = tuple[str, bool, bool]  # name, has Z, has M

VERSION = "1.1.0"
GROUP_ROWS, GROUP_BYTES = 50_000, 64_000_000  # of a row group at most
KEPT = {"epoch": None, "edges": "planar"}  # what no entry stands for
CORNERS = ("xmin", "ymin", "xmax", "ymax")
BOX = pa.struct([(corner, pa.float64()) for corner in CORNERS])
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
CRS84_TEXT = json.dumps(CRS84)


class GeoColumn(NamedTuple):
    """What the metadata says about the primary geometry column."""

    name: str
    crs: str | None  # PROJJSON
    kind: str  # of geometry, "Unknown" if it holds several
    covering: str | None  # column with the boxes of the geometries
    more: More  # "epoch" of the coordinates, "edges" that are not straight


def geo_column(schema: pa.Schema, path: Path) -> GeoColumn:
    """Find the primary geometry column of a Parquet file.

    Raises
    ------
    ParameterError
        If there is none, if it is not told as the format has it, or if its geometries are not WKB.
    """
    metadata = schema.metadata or {}
    if b"geo" not in metadata:
        msg = f"IN {str(path)!r} is Parquet without geometries, expected GeoParquet"
        raise ParameterError(msg)
    try:
        geo = json.loads(metadata[b"geo"])
    except ValueError as error:
        raise broken(path, "it is no JSON") from error
    name = entry(geo, "primary_column", str, path)
    column = entry(entry(geo, "columns", dict, path), name, dict, path)
    encoding = entry(column, "encoding", str, path)
    if name not in schema.names:
        raise broken(path, f"'primary_column' is {name!r}, which is no column of the file")
    if encoding != "WKB":
        msg = f"IN {str(path)!r} has geometries in the encoding {encoding!r}, expected WKB"
        raise ParameterError(msg)
    kinds = {str(kind).removesuffix(" Z") for kind in column.get("geometry_types") or []}
    return GeoColumn(
        name,
        projjson_of(column.get("crs", CRS84), path),
        kinds.pop() if len(kinds) == 1 else "Unknown",
        covering_of(column),
        tuple((key, column[key]) for key, usual in KEPT.items() if column.get(key, usual) != usual),
    )


def entry(about: Any, name: str, kind: type[Some], path: Path) -> Some:
    """Look up what the metadata must have.

    Raises
    ------
    ParameterError
        If it is not there, or something else.
    """
    found = about.get(name) if isinstance(about, dict) else None
    if not isinstance(found, kind):
        was = "missing" if found is None else f"{found!r:.40}"
        wanted = "an object" if kind is dict else "a text"
        raise broken(path, f"{name!r} is {was}, expected {wanted}")
    return found


def projjson_of(crs: Any, path: Path) -> str | None:
    """CRS as text; it may be text inside the metadata too.

    Raises
    ------
    ParameterError
        If it is no PROJJSON.
    """
    found = crs
    if isinstance(crs, str):
        with suppress(ValueError):
            found = json.loads(crs)
    if found is None:
        return None
    if not (isinstance(found, dict) and str(found.get("type")).endswith("CRS")):
        raise broken(path, f"'crs' is {crs!r:.40}, expected PROJJSON")
    return json.dumps(found)


def covering_of(column: dict[str, Any]) -> str | None:
    """Name of the column with the boxes of geometries, None if there is none."""
    try:
        return str(column["covering"]["bbox"]["xmin"][0])
    except (LookupError, TypeError):
        return None


def broken(path: Path, what: str) -> ParameterError:
    """Error about metadata that are not as the format has them."""
    return ParameterError(f"IN {str(path)!r} has broken GeoParquet metadata (geo): {what}")


class GeoParquetWriter:
    """A GeoParquet file that grows row group by row group, with a box beside each geometry.

    Row groups are cut by rows and bytes of features alone: however features come, in one table
    or in many, the file has the same bytes. At most one row group is held in memory.

    Parameters
    ----------
    path : Path
    schema : pyarrow.Schema
        Attributes, and the column of WKB.
    column : str
        Name of the column of WKB.
    crs : str or None
        PROJJSON.
    more : pairs
        Further metadata of the column.
    """

    def __init__(
        self, path: Path, schema: pa.Schema, column: str, crs: str | None, more: More = ()
    ) -> None:
        self.column, self.crs, self.more = column, crs, more
        taken = {*schema.names}
        self.covering = next(name for name in numbered("bbox") if name not in taken)
        schema = schema.remove_metadata().append(pa.field(self.covering, BOX))
        self.kinds: set[Kind] = set()
        self.types: set[str] = set()
        self.bounds: list[Floats] = []
        self.held: list[pa.Table] = []
        self.n_held = self.n_bytes = 0
        # The schema that Arrow would store at once is stored last, with what is known by then.
        self.schema = schema
        self.file = pq.ParquetWriter(path, schema, store_schema=False)

    def write(self, table: pa.Table) -> None:
        """Add features: attributes and WKB."""
        wkb = table[self.column].combine_chunks()
        geometries = shapely.from_wkb(wkb.to_numpy(zero_copy_only=False))
        self.kinds |= kinds_of(geometries)
        there = geometries[~(shapely.is_missing(geometries) | shapely.is_empty(geometries))]
        self.types |= {kind + " Z" * has_z for kind, has_z, _ in kinds_of(there)}
        boxes = shapely.bounds(geometries)
        if there.size:
            self.bounds.append(shapely.total_bounds(there))
        table = table.append_column(pa.field(self.covering, BOX), box_column(boxes))
        first = 0
        for stop in self.stops(row_sizes(table)):
            self.hold(table.slice(first, stop - first))
            self.flush()
            first = stop
        self.hold(table.slice(first))

    def stops(self, sizes: "NDArray[Any]") -> list[int]:
        """Rows of a table before which a row group ends; counts what the last one holds."""
        stops = []
        for row, size in enumerate(sizes.tolist()):
            if self.n_held and (self.n_held >= GROUP_ROWS or self.n_bytes + size > GROUP_BYTES):
                stops.append(row)
                self.n_held = self.n_bytes = 0
            self.n_held += 1
            self.n_bytes += size
        return stops

    def hold(self, table: pa.Table) -> None:
        """Keep rows until their row group is whole."""
        if table.num_rows:
            self.held.append(table)

    def flush(self) -> None:
        """Write what is held as a row group."""
        if self.held:
            table = pa.concat_tables(self.held).combine_chunks()
            self.held = []
            self.file.write_table(table.cast(self.schema), row_group_size=table.num_rows)

    def close(self, **more: str) -> None:
        """Write the last row group and the metadata, with ``more`` of it."""
        self.flush()
        about: dict[str, Any] = {
            "encoding": "WKB",
            "geometry_types": sorted(self.types),
            "crs": None if self.crs is None else json.loads(self.crs),
            "covering": {"bbox": {corner: [self.covering, corner] for corner in CORNERS}},
            **dict(self.more),
        }
        if self.bounds:
            about["bbox"] = shapely.total_bounds(shapely.box(*np.transpose(self.bounds))).tolist()
        geo = {"version": VERSION, "primary_column": self.column, "columns": {self.column: about}}
        metadata = {"geo": json.dumps(geo), **more}
        schema = self.schema.with_metadata(metadata).serialize().to_pybytes()
        metadata["ARROW:schema"] = base64.b64encode(schema).decode()
        self.file.add_key_value_metadata(metadata)
        self.file.close()

    def abandon(self) -> None:
        """Let go of a file that is not to be kept, whatever the system says to that."""
        self.held = []
        with suppress(OSError):
            self.file.close()
        self.file.is_open = False  # else it is closed once more when nothing refers to it


def numbered(name: str) -> Iterator[str]:
    """Give a name, and the name with numbers from 2 on."""
    yield name
    yield from (f"{name}_{number}" for number in count(2))


def box_column(boxes: "Floats") -> pa.Array:
    """Column of boxes, null where there is none."""
    is_missing = np.isnan(boxes).any(axis=1)
    columns = [pa.array(column) for column in boxes.T]
    return pa.StructArray.from_arrays(columns, fields=[*BOX], mask=pa.array(is_missing))


def kinds_of(geometries: "Geometries") -> "set[Kind]":
    """Kinds of geometry that there are: name, whether with Z, whether with M."""
    there = geometries[~shapely.is_missing(geometries)]
    codes = shapely.get_type_id(there) * 4 + shapely.has_z(there) * 2 + shapely.has_m(there)
    _, first = np.unique(codes, return_index=True)
    return {(g.geom_type, bool(g.has_z), bool(g.has_m)) for g in there[first]}
