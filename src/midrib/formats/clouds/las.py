"""LAS and LAZ: coordinates by scale and offset, the unit from the file's reference system.

Heights come in the unit of x and y: where the reference system has another for them, they are
turned into that.
"""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from midrib.checks import check_library
from midrib.errors import ParameterError
from midrib.formats.clouds.common import check_signature, refusing
from midrib.formats.crs import definition
from midrib.formats.units import horizontal, is_geographic, unit_of, vertical_unit_of
from midrib.towers.cloud import CHUNK, DOUBLES, spots_in

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["LasCloud"]

WKT_RECORD = 2112  # LAS 1.4, 3.2: OGC coordinate system WKT
GEOTIFF_RECORD = 34735  # GeoKeyDirectory
PROJECTED_KEY, UNIT_KEY = 3072, 3076
VERTICAL_KEY, VERTICAL_UNIT_KEY = 4096, 4099
UNITS = {9001: 1.0, 9002: 0.3048, 9003: 1200.0 / 3937.0}  # EPSG: metre, foot, US survey foot
USER_DEFINED = 32767
STATION = "point_source_id"  # LAS 1.4, 2.6: the file, flight line or station a point is from
SIGNATURE, LEAST_HEADER = b"LASF", 227  # bytes
PACKED = 50_000  # points that LAZ packs together, and only together unpacks
PACKED_LEAST = 20  # bytes: the first point of a pack is not compressed, and none is shorter
PACKS = 40  # of these, that a sample is taken from


class Reference(NamedTuple):
    """What a file says about its coordinates."""

    crs: str | None = None  # PROJJSON
    metres: float | None = None  # of the unit of x and y
    vertical: float | None = None  # metres of the unit of z

    @property
    def stretch(self) -> float:
        """Units of x and y in one of z; 1 where one of them is not known."""
        return self.vertical / self.metres if self.vertical and self.metres else 1.0


class LasCloud:
    """A LAS or LAZ file."""

    has_stations = True  # points have a number for it; whether it is used, they tell
    types: tuple[str, ...] = DOUBLES  # of whole numbers, but these have a step that the file chose

    def __init__(self, path: Path) -> None:
        check_library("laspy", "a LAS or LAZ file", "towers")
        import laspy

        self.path, self.name = path, f"CLOUD {str(path)!r}"
        self.errors: tuple[type[Exception], ...] = (
            laspy.errors.LaspyException,
            ValueError,
            RuntimeError,
        )
        with refusing(path, *self.errors):
            check_signature(path, SIGNATURE, LEAST_HEADER)
        with refusing(path, *self.errors), laspy.open(path) as reader:
            header = reader.header
            self.count = int(header.point_count)
            if header.are_points_compressed:
                check_packs(path, header.offset_to_point_data)
            else:
                check_records(path, header)
            reference = reference_of(header)
            self.crs, self.metres, self.stretch = *reference[:2], reference.stretch

    def chunks(self, *, with_stations: bool = False) -> Iterator["Floats"]:
        """Points (n, 3), or (n, 4) with their source, a chunk at a time."""
        import laspy

        with refusing(self.path, *self.errors), laspy.open(self.path) as reader:
            for points in reader.chunk_iterator(CHUNK):
                yield self.placed(points, reader.header, with_stations=with_stations)

    def some(self, most: int) -> Iterator["Floats"]:
        """Points from all over the file, with their source."""
        import laspy

        with refusing(self.path, *self.errors), laspy.open(self.path) as reader:
            if not reader.header.are_points_compressed:
                spots = spots_in(self.count, most)
            else:
                spots = spots_in(self.count, PACKED * PACKS, PACKED)
                spots = [(first // PACKED * PACKED, count) for first, count in spots]
            for first, count in spots:
                for start in range(first, first + count, CHUNK):
                    reader.seek(start)
                    points = reader.read_points(min(CHUNK, first + count - start))
                    yield self.placed(points, reader.header, with_stations=True)

    def placed(self, points: Any, header: Any, *, with_stations: bool) -> "Floats":
        """Coordinates, by scale and offset, and the source of points."""
        raw = points.array
        table = np.empty((len(raw), 3 + with_stations))
        for k, axis in enumerate("XYZ"):
            np.multiply(raw[axis], header.scales[k], out=table[:, k])
            table[:, k] += header.offsets[k]
        if self.stretch != 1.0:
            table[:, 2] *= self.stretch
        if with_stations:
            table[:, 3] = raw[STATION]
        return table


def check_records(path: Path, header: Any) -> None:
    """Refuse a LAS file that breaks off before its last point.

    Raises
    ------
    ValueError
        With how many points there are.
    """
    there = (path.stat().st_size - header.offset_to_point_data) // header.point_format.size
    if there < header.point_count:
        msg = f"it breaks off after {max(there, 0):,} of {header.point_count:,} points"
        raise ValueError(msg)


def check_packs(path: Path, start: int) -> None:
    """Refuse a LAZ file that breaks off, or that says it has more packs of points than fit into it.

    The library that unpacks them would ask for the memory of all, and end the process without it.

    Raises
    ------
    ValueError
        If the table of packs lies behind the file's end, or has too many.
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        file.seek(start)
        table = int.from_bytes(file.read(8), "little", signed=True)
        if table == -1:  # written at the end, by who could not go back
            file.seek(max(size - 8, 0))
            table = int.from_bytes(file.read(8), "little", signed=True)
        if table > size - 8:
            msg = f"it breaks off after {size:,} bytes, more than {table:,} were written"
            raise ValueError(msg)
        file.seek(max(table, 0) + 4)  # after a version
        packs = int.from_bytes(file.read(4), "little")
    if packs * PACKED_LEAST > size:
        msg = f"it says it has {packs:,} packs of points in {size:,} bytes, it is damaged"
        raise ValueError(msg)


def reference_of(header: Any) -> Reference:
    """Return the reference system and its units, as far as a header tells."""
    for record in [*header.vlrs, *(header.evlrs or [])]:
        if record.record_id == WKT_RECORD:
            text = record.string if isinstance(record.string, str) else record.string.decode()
            return told(definition(text.rstrip("\0")))
        if record.record_id == GEOTIFF_RECORD:
            return of_keys({key.id: key.value_offset for key in record.geo_keys})
    return Reference()


def of_keys(keys: dict[int, int]) -> Reference:
    """Return what GeoTIFF keys say; a unit of heights goes before that of their system.

    Raises
    ------
    ParameterError
        If heights have a unit that is not known here.
    """
    found = Reference(metres=UNITS.get(keys.get(UNIT_KEY, 0)))
    code = keys.get(PROJECTED_KEY, USER_DEFINED)
    crs = None if code == USER_DEFINED else definition(f"EPSG:{code}")
    if crs is not None:
        found = told(crs)
    unit, system = (keys.get(key, 0) for key in (VERTICAL_UNIT_KEY, VERTICAL_KEY))
    if unit not in {0, USER_DEFINED}:
        if unit not in UNITS:
            known = ", ".join(map(str, UNITS))
            msg = f"CLOUD has heights in the unit EPSG:{unit}, expected one of {known}"
            raise ParameterError(msg)
        return found._replace(vertical=UNITS[unit])
    if system not in {0, USER_DEFINED}:
        height = vertical_unit_of(definition(f"EPSG:{system}"))
        return found._replace(vertical=None if height is None else height.metres)
    return found


def told(crs: str | None) -> Reference:
    """Return a reference system and its units; heights that will be turned are none of its own.

    Raises
    ------
    ParameterError
        If coordinates are degrees.
    """
    if is_geographic(crs):
        msg = "CLOUD is in degrees, expected a projected CRS or a local one"
        raise ParameterError(msg)
    metres, vertical = (
        None if unit is None else unit.metres for unit in (unit_of(crs), vertical_unit_of(crs))
    )
    found = Reference(crs, metres, vertical)
    return found if found.stretch == 1.0 else found._replace(crs=json.dumps(horizontal(crs)))
