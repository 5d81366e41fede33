"""Polygons that areas are made of, each valid by itself."""

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely
from shapely import MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

from midrib.errors import GeometryTypeError, InvalidAreaError
from midrib.ragged import without_holes
from midrib.repair import overlaps, repaired
from midrib.validity import is_valid

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from midrib.curves.log import Log

    Areas = NDArray[np.object_]

__all__ = ["Part", "filled_parts", "polygons_of", "refused_parts", "valid_parts"]


class Part(NamedTuple):
    """One polygon to collapse: the area it is of, its number there, itself."""

    area: int
    number: int
    polygon: Polygon


def polygons_of(parts: list[Part]) -> "Areas":
    """Array of the polygons of parts."""
    polygons: Areas = np.empty(len(parts), dtype=object)
    polygons[:] = [part.polygon for part in parts]
    return polygons


def valid_parts(areas: "Areas", log: "Log") -> Iterator[Part]:
    """Polygons of all areas, repaired where they are not valid."""
    is_area = np.array([isinstance(area, Polygon | MultiPolygon) for area in areas], dtype=bool)
    only_areas = areas.copy()
    only_areas[~is_area] = None
    valid = is_valid(only_areas)
    for i, area in enumerate(areas):
        if area is None or (isinstance(area, BaseGeometry) and area.is_empty):
            continue
        if not is_area[i]:
            kind = getattr(area, "geom_type", type(area).__name__)
            log.refuse(i, 0, GeometryTypeError(f"is a {kind}, expected a Polygon or MultiPolygon"))
            continue
        polygons = area.geoms if isinstance(area, MultiPolygon) else (area,)
        if valid[i]:
            yield from (Part(i, number, polygon) for number, polygon in enumerate(polygons))
        else:
            yield from apart(list(repaired_parts(i, polygons, log)), log)


def filled_parts(parts: Iterable[Part]) -> list[Part]:
    """Parts without their holes."""
    return [part._replace(polygon=without_holes(part.polygon)) for part in parts]


def repaired_parts(i: int, polygons: Sequence[Polygon], log: "Log") -> Iterator[Part]:
    """Polygons of one area, each valid by itself."""
    for number, polygon in enumerate(polygons):
        if polygon.is_valid and not polygon.is_empty:
            yield Part(i, number, polygon)
            continue
        try:
            pieces, reason = repaired(polygon)
        except InvalidAreaError as error:
            log.refuse(i, number, error)
            continue
        log.note(i, number, "repaired", reason)
        yield from (Part(i, number, piece) for piece in pieces)


def apart(parts: list[Part], log: "Log") -> Iterator[Part]:
    """Parts of one area that do not overlap others."""
    found = overlaps([part.polygon for part in parts], [part.number for part in parts])
    for row, part in enumerate(parts):
        overlap = found.get(row)
        if overlap is not None and overlap.is_refused:
            log.refuse(part.area, part.number, InvalidAreaError(overlap.reason))
            continue
        if overlap is not None:
            log.note(part.area, part.number, "repaired", overlap.reason)
        if overlap is None or not overlap.is_left_out:
            yield part


def refused_parts(areas: "Areas", refused: set[tuple[int, int]]) -> Iterator[Part]:
    """Polygons that were refused, if their coordinates are finite; others share edges with them."""
    for i, number in sorted(refused):
        area = areas[i]
        if isinstance(area, Polygon | MultiPolygon):
            polygon = area.geoms[number] if isinstance(area, MultiPolygon) else area
            if not polygon.is_empty and np.isfinite(shapely.get_coordinates(polygon)).all():
                yield Part(i, number, polygon)
