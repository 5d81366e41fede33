"""Whether areas are valid, also where they have a great many holes."""

from typing import Any

import numpy as np
import shapely
from shapely import Polygon, STRtree

from midrib.kernels.sweep import enclosed
from midrib.types import Bools

__all__ = ["is_valid", "is_valid_one"]

MANY = 100  # holes; GEOS looks at the whole shell for each one


def is_valid(areas: Any) -> Bools:
    """Whether areas of an array are valid; None and what is no geometry are not."""
    n_holes = shapely.get_num_interior_rings(areas)
    if n_holes.max(initial=0) < MANY:
        return np.asarray(shapely.is_valid(areas))
    return np.array([is_valid_one(area) for area in areas], dtype=bool)


def is_valid_one(area: Any) -> bool:
    """Whether an area is valid, as ``shapely.is_valid`` says; None is not.

    Takes n log n for n vertices, where GEOS takes n times the holes, unless rings touch.
    """
    if shapely.get_num_interior_rings(area) >= MANY and has_rings_apart(area):
        return True
    return bool(shapely.is_valid(area))


def has_rings_apart(area: Polygon) -> bool:
    """Whether rings are simple, do not meet, and each hole is in the shell but in no other hole."""
    rings = shapely.get_rings(area)
    polygons = shapely.polygons(rings)
    if not (
        shapely.is_valid(polygons).all() and shapely.is_simple(shapely.multilinestrings(rings))
    ):
        return False
    starts = shapely.get_point(rings[1:], 0)  # one point tells, as rings do not meet
    if not enclosed(shapely.get_coordinates(rings[0]), shapely.get_coordinates(starts)).all():
        return False
    start, hole = STRtree(polygons[1:]).query(starts, "intersects")
    return bool((start == hole).all())
