"""Zones that no stroke may enter, from a file."""

from collections import Counter
from pathlib import Path
from typing import Any

from shapely import MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

from midrib.errors import ParameterError
from midrib.formats.contents import choose_layer
from midrib.formats.reading import open_layer
from midrib.formats.units import check_same_plane

__all__ = ["zones_in"]


def zones_in(path: Path, crs: str | None) -> list[Polygon | MultiPolygon]:
    """Read the areas of a file, those in collections too; features without geometry are none.

    Raises
    ------
    ParameterError
        If they are in another CRS than the slopes, cannot be read, or have others among them.
    """
    found: list[Any] = []
    with open_layer(path, choose_layer(path, None, "--exclude")) as source:
        check_same_plane(source.crs, crs, f"--exclude {str(path)!r}")
        for batch in source.batches():
            for row, reason in batch.unreadable.items():
                msg = f"--exclude {str(path)!r}: feature {batch.first + row}: {reason}"
                raise ParameterError(msg)
            for geometry in batch.geometries:
                found += members(geometry)
    others = [part for part in found if not isinstance(part, Polygon | MultiPolygon)]
    if others:
        kinds = Counter(part.geom_type for part in others)
        told = ", ".join(f"{count:,} {kind}" for kind, count in kinds.items())
        msg = f"--exclude {str(path)!r} holds {told}, expected Polygons and MultiPolygons only"
        raise ParameterError(msg)
    return found


def members(geometry: BaseGeometry | None) -> list[BaseGeometry]:
    """Return what is in a collection, and in those in it; anything else as it is, unless empty."""
    if geometry is None or geometry.is_empty:
        return []
    if geometry.geom_type != "GeometryCollection":
        return [geometry]
    return [part for member in geometry.geoms for part in members(member)]
