r"""Heights of what is drawn on a slope, from those of its edges.

p         a point of the slope
t, u      the points of the top and of the toe nearest to it

        top  ------t-----------     The height at p lies between those at t and u, in proportion to
                   |                how far p is from either: straight down the slope, and exact on
                   p                both edges.
        toe  ------u-----------
"""

from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import LineString

from midrib.formats.gathering import is_height
from midrib.types import Floats

if TYPE_CHECKING:
    from midrib.formats.reading import Geometries

__all__ = ["Relief", "relief_of"]


class Relief:
    """Heights on a slope between two edges that have them."""

    def __init__(self, top: LineString, toe: LineString) -> None:
        self.edges = [(shapely.force_2d(edge), *profile_of(edge)) for edge in (top, toe)]

    def raised(self, points: Floats) -> Floats:
        """(n, 3) points of the slope with their heights."""
        there = shapely.points(points[:, :2])
        away = np.array([shapely.distance(there, line) for line, _, _ in self.edges])
        height = np.array(
            [np.interp(shapely.line_locate_point(line, there), s, z) for line, s, z in self.edges]
        )
        whole = away.sum(axis=0)
        share = np.divide(away[0], whole, out=np.zeros_like(whole), where=whole > 0.0)
        return np.column_stack([points[:, :2], height[0] + share * (height[1] - height[0])])

    def lifted(self, geometries: "Geometries") -> "Geometries":
        """Geometries on the slope with the heights of their vertices."""
        flat = shapely.force_3d(geometries)
        higher: Geometries = shapely.transform(flat, self.raised, include_z=True)
        return higher


def relief_of(top: LineString, toe: LineString) -> Relief | None:
    """Return the heights between two edges; None if one of their vertices has none."""
    for edge in (top, toe):
        if not edge.has_z or not all(map(is_height, edge_heights(edge))):
            return None
    return Relief(top, toe)


def profile_of(edge: LineString) -> tuple[Floats, Floats]:
    """Stations and heights of the vertices of an edge."""
    points = shapely.get_coordinates(edge)
    steps = np.hypot(*np.diff(points, axis=0).T)
    return np.concatenate([[0.0], np.cumsum(steps)]), edge_heights(edge)


def edge_heights(edge: LineString) -> Floats:
    """Heights of the vertices of an edge."""
    heights: Floats = shapely.get_coordinates(edge, include_z=True)[:, 2]
    return heights
