"""The bridge between geometries and arrays: polygons to rings, chains to lines."""

from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, Polygon

from midrib.errors import GeometryTypeError, InvalidAreaError
from midrib.kernels.rings import LARGEST, SMALLEST, Rings, find_rings, normalise_rings, sizes
from midrib.types import Bools, Floats, Ints

__all__ = [
    "Packed",
    "area_of_one",
    "normalised",
    "pack_areas",
    "pack_rings",
    "place_text",
    "rings_of_area",
    "without_holes",
]


class Packed(NamedTuple):
    """Polygons as arrays: coordinates, where each ring starts, where each polygon's rings do."""

    coordinates: Floats  # (n, 2 or 3)
    ring_offsets: Ints
    area_offsets: Ints
    has_z: Bools  # of each polygon

    def rings(self, i: int) -> tuple[Floats, Ints]:
        """Rows (x, y and Z if it has any) of polygon i and where each of its rings starts."""
        offsets = self.ring_offsets[self.area_offsets[i] : self.area_offsets[i + 1] + 1]
        rows = self.coordinates[offsets[0] : offsets[-1]]
        if not self.has_z[i] and rows.shape[1] > 2:
            rows = rows[:, :2].copy()
        return rows, offsets - offsets[0]


def normalised(rows: Floats, offsets: Ints) -> tuple[Rings, Floats | None]:
    """Rings of one polygon in normal form, and the Z of each row or None.

    Raises
    ------
    InvalidAreaError
        If it is too large or too small for exact arithmetic.
    """
    largest, extent = sizes(rows)
    if largest > LARGEST:
        msg = f"the largest coordinate is {largest:.3g}, expected less than {LARGEST:.3g}"
        raise InvalidAreaError(msg)
    if extent < SMALLEST:
        msg = f"the area's extent is {extent:.3g}, expected more than {SMALLEST:.3g}"
        raise InvalidAreaError(msg)
    return normalise_rings(rows, offsets), (rows[:, 2] if rows.shape[1] > 2 else None)


def pack_areas(polygons: NDArray[np.object_]) -> Packed:
    """Arrays of an array of Polygons, none missing or empty."""
    has_z = shapely.has_z(polygons)
    coordinates = shapely.get_coordinates(polygons, include_z=bool(has_z.any()))
    area_offsets = offsets(1 + shapely.get_num_interior_rings(polygons))
    # Without holes areas are rings; to make the rings of all takes a third of the time otherwise.
    has_holes = area_offsets[-1] > polygons.size
    rings = shapely.get_rings(polygons) if has_holes else polygons
    return Packed(coordinates, offsets(shapely.get_num_coordinates(rings)), area_offsets, has_z)


def pack_rings(area: Polygon) -> tuple[Floats, Ints]:
    """Rows (x, y) of one valid polygon and where each of its rings starts; its Z is left out.

    It takes a third of the time that ``pack_areas`` takes for an array of one.
    """
    coordinates = shapely.get_coordinates(area)
    starts = np.empty(shapely.get_num_interior_rings(area) + 2, dtype=np.intp)
    if not find_rings(coordinates, starts):
        rings = shapely.get_rings(area)
        starts = offsets(shapely.get_num_coordinates(rings))
    return coordinates, starts


def offsets(sizes: Ints) -> Ints:
    """Where each of several runs starts, and where the last one ends."""
    result = np.zeros(sizes.size + 1, dtype=np.intp)
    np.cumsum(sizes, out=result[1:])
    return result


def rings_of_area(area: Polygon) -> tuple[Rings, Floats | None]:
    """Rings of one polygon in normal form, and the Z of each row or None."""
    return normalised(*pack_areas(np.array([area], dtype=object)).rings(0))


def area_of_one(area: object, name: str) -> Polygon:
    """Return a valid Polygon, or the only part of a MultiPolygon."""
    if isinstance(area, MultiPolygon) and len(area.geoms) == 1:
        area = area.geoms[0]
    if not isinstance(area, Polygon):
        kind = getattr(area, "geom_type", type(area).__name__)
        parts = f" of {len(area.geoms)} parts" if isinstance(area, MultiPolygon) else ""
        msg = f"{name} is a {kind}{parts}, expected a Polygon"
        raise GeometryTypeError(msg)
    if area.is_empty:
        msg = f"{name} is empty"
        raise InvalidAreaError(msg)
    if not np.isfinite(shapely.get_coordinates(area)).all():
        msg = f"{name} has a coordinate that is not finite"
        raise InvalidAreaError(msg)
    if not area.is_valid:
        msg = f"{name} is not valid: {shapely.is_valid_reason(area)}"
        raise InvalidAreaError(msg)
    return area


def place_text(point: Floats) -> str:
    """Coordinates of a point for a message."""
    return f"({point[0]:.12g}, {point[1]:.12g})"


def without_holes(area: Any) -> Any:
    """Polygon or MultiPolygon without the holes of its parts; anything else as it is."""
    if isinstance(area, Polygon):
        return Polygon(area.exterior)
    if isinstance(area, MultiPolygon):
        return MultiPolygon([Polygon(part.exterior) for part in area.geoms])
    return area
