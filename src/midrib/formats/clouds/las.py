"""LAS and LAZ: coordinates by scale and offset, the unit from the file's reference system."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from midrib.checks import check_library
from midrib.errors import ParameterError
from midrib.formats.clouds.common import refusing
from midrib.formats.crs import definition
from midrib.formats.units import is_geographic, unit_of
from midrib.towers.cloud import CHUNK, spots_in

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["LasCloud"]

WKT_RECORD = 2112  # LAS 1.4, 3.2: OGC coordinate system WKT
GEOTIFF_RECORD = 34735  # GeoKeyDirectory
PROJECTED_KEY, UNIT_KEY = 3072, 3076
UNITS = {9001: 1.0, 9002: 0.3048, 9003: 1200.0 / 3937.0}  # EPSG: metre, foot, US survey foot
USER_DEFINED = 32767
STATION = "point_source_id"  # LAS 1.4, 2.6: the file, flight line or station a point is from
PACKED = 50_000  # points that LAZ packs together, and only together unpacks
PACKS = 40  # of these, that a sample is taken from


class LasCloud:
    """A LAS or LAZ file."""

    has_stations = True  # points have a number for it; whether it is used, they tell

    def __init__(self, path: Path) -> None:
        check_library("laspy", "a LAS or LAZ file", "towers")
        import laspy

        self.path, self.name = path, f"CLOUD {str(path)!r}"
        self.errors: tuple[type[Exception], ...] = (
            laspy.errors.LaspyException,
            ValueError,
            RuntimeError,
        )
        with refusing(path, *self.errors), laspy.open(path) as reader:
            header = reader.header
            self.count = int(header.point_count)
            self.crs, self.metres = reference_of(header)

    def chunks(self, *, with_stations: bool = False) -> Iterator["Floats"]:
        """Points (n, 3), or (n, 4) with their source, a chunk at a time."""
        import laspy

        with refusing(self.path, *self.errors), laspy.open(self.path) as reader:
            for points in reader.chunk_iterator(CHUNK):
                yield placed(points, reader.header, with_stations=with_stations)

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
                    yield placed(points, reader.header, with_stations=True)


def placed(points: Any, header: Any, *, with_stations: bool) -> "Floats":
    """Coordinates, by scale and offset, and the source of points."""
    raw = points.array
    table = np.empty((len(raw), 3 + with_stations))
    for k, axis in enumerate("XYZ"):
        np.multiply(raw[axis], header.scales[k], out=table[:, k])
        table[:, k] += header.offsets[k]
    if with_stations:
        table[:, 3] = raw[STATION]
    return table


def reference_of(header: Any) -> tuple[str | None, float | None]:
    """Return the reference system and its unit in metres, as far as a header tells."""
    for record in [*header.vlrs, *(header.evlrs or [])]:
        if record.record_id == WKT_RECORD:
            text = record.string if isinstance(record.string, str) else record.string.decode()
            return told(definition(text.rstrip("\0")))
        if record.record_id == GEOTIFF_RECORD:
            keys = {key.id: key.value_offset for key in record.geo_keys}
            code = keys.get(PROJECTED_KEY, USER_DEFINED)
            crs = None if code == USER_DEFINED else definition(f"EPSG:{code}")
            return (None, UNITS.get(keys.get(UNIT_KEY, 0))) if crs is None else told(crs)
    return None, None


def told(crs: str | None) -> tuple[str | None, float | None]:
    """Return a reference system and the metres of its unit.

    Raises
    ------
    ParameterError
        If coordinates are degrees.
    """
    if is_geographic(crs):
        msg = "CLOUD is in degrees, expected a projected CRS or a local one"
        raise ParameterError(msg)
    unit = unit_of(crs)
    return crs, None if unit is None else unit.metres
