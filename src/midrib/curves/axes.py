"""Axes: what finds the skeleton of an area, one maker a method."""

from collections.abc import Callable
from itertools import product
from typing import TypeAlias

import numpy as np
import shapely
from shapely import Polygon

from midrib.checks import is_number, shown
from midrib.curves.graphs import Graph, radii_of
from midrib.curves.straight_skeleton import straight_skeleton_in
from midrib.curves.turning import TURNS, turned, turned_back
from midrib.errors import InvariantError, ParameterError, TooManyStationsError
from midrib.kernels.chordal import chordal_axis
from midrib.kernels.medial import medial_axis
from midrib.kernels.mesh import Mesh
from midrib.kernels.voronoi import voronoi_inside
from midrib.layout import Layout, boundary_of
from midrib.ragged import normalised, offsets
from midrib.types import Floats, Ints

__all__ = ["AXES", "Axis"]

ARCS_WITHIN = 0.01  # of the mean width
POINTS_PER_WIDTH = 4.0
MOST_POINTS = 5_000_000
# Of the extent: vertices that follow each other and are no farther apart are one, if the axis is
# not found otherwise. Where the wall between them leads, rounding says.
APART = (0.0, 2.0**-46, 2.0**-40)

# Of closed rings (rows, and where each starts) and the layout of their area.
Axis: TypeAlias = Callable[[Floats, Ints, Layout], Graph]


def chordal() -> Axis:
    """Chordal axis: through the middles of the sides of the triangles between the vertices."""

    def find(coordinates: Floats, starts: Ints, layout: Layout) -> Graph:
        points, edges = chordal_axis(layout.mesh, *layout.scale)
        return Graph(points, edges, radii_of(coordinates, starts, points, layout.scale))

    return find


def point_voronoi(*, spacing: float | None = None) -> Axis:
    """Voronoi diagram of points along the boundary, what of it is inside."""
    if spacing is not None and (not is_number(spacing) or not 0.0 < spacing < np.inf):
        msg = f"spacing is {shown(spacing)}, expected a number above 0"
        raise ParameterError(msg)

    def find(coordinates: Floats, starts: Ints, layout: Layout) -> Graph:
        apart = layout.mean_width / POINTS_PER_WIDTH if spacing is None else float(spacing)
        rings = coordinates[:, :2] * layout.scale
        rows, row_starts = densified(rings, starts, apart)
        points, edges = voronoi_inside(boundary_of(normalised(rows, row_starts)[0]).mesh)
        points, edges = kept_inside(points, edges, rings, starts)
        points = points / layout.scale
        return Graph(points, edges, radii_of(coordinates, starts, points, layout.scale))

    return find


def straight() -> Axis:
    """Straight skeleton: the bisectors of shrinking edges."""

    def find(coordinates: Floats, starts: Ints, layout: Layout) -> Graph:
        mesh = whole_mesh(coordinates, starts, layout)
        x, y = layout.scale
        found = straight_skeleton_in(mesh._replace(x=mesh.x * x, y=mesh.y * y))
        used, edges = np.unique(found.ridges, return_inverse=True)
        points = found.points[used] / layout.scale
        radius = radii_of(coordinates, starts, points, layout.scale)
        return Graph(points, edges.reshape(-1, 2), radius)

    return find


def medial(*, tolerance: float | None = None) -> Axis:
    """Medial axis: centres of the discs that touch the boundary twice; arcs to a tolerance."""
    if tolerance is not None and (not is_number(tolerance) or not 0.0 < tolerance < np.inf):
        msg = f"tolerance is {shown(tolerance)}, expected a number above 0"
        raise ParameterError(msg)

    def find(coordinates: Floats, starts: Ints, layout: Layout) -> Graph:
        within = layout.mean_width * ARCS_WITHIN if tolerance is None else float(tolerance)
        mesh = whole_mesh(coordinates, starts, layout)
        is_done, points, radius, edges, fault = medial_axis(mesh, *layout.scale, within, 0.0)
        if is_done:
            return Graph(points, edges, radius)
        scale = np.array(layout.scale)
        for apart, angle in product(APART, range(TURNS)):
            is_done, points, radius, edges, _ = medial_axis(
                turned(mesh, float(angle), scale), 1.0, 1.0, within, apart
            )
            if is_done:
                points = turned_back(points, radius == 0.0, mesh, float(angle), scale)
                return Graph(points, edges, radius)
        msg = (
            f"the medial axis was not found, it is wrong about ({fault.x:.9g}, {fault.y:.9g}), "
            "please report this area"
        )
        raise InvariantError(msg)

    return find


AXES: dict[str, Callable[..., Axis]] = {
    "medial-axis": medial,
    "chordal-axis": chordal,
    "point-voronoi": point_voronoi,
    "straight-skeleton": straight,
}


def whole_mesh(coordinates: Floats, starts: Ints, layout: Layout) -> Mesh:
    """Return the mesh of an area: that of its layout, unless an end has put a vertex in there."""
    rings = normalised(coordinates, starts)[0]
    return layout.mesh if layout.mesh.x.size == rings.x.size else boundary_of(rings).mesh


def densified(rings: Floats, starts: Ints, apart: float) -> tuple[Floats, Ints]:
    """Put points on the segments of closed rings, at most so far from each other.

    Raises
    ------
    TooManyStationsError
        If that makes too many.
    """
    steps = np.diff(rings, axis=0)
    steps[starts[1:-1] - 1] = 0.0  # from one ring to the next
    wanted = np.maximum(np.ceil(np.hypot(*steps.T) / apart), 1.0)
    if wanted.sum() > MOST_POINTS:
        msg = f"spacing {apart:.3g} makes {wanted.sum():.3g} points, expected {MOST_POINTS} at most"
        raise TooManyStationsError(msg)
    count = np.append(wanted.astype(np.intp), 1)
    share = np.arange(count.sum()) - np.repeat(offsets(count)[:-1], count)
    share = share / np.repeat(count, count)
    rows = np.repeat(rings, count, axis=0)
    rows += share[:, None] * np.repeat(np.vstack([steps, [0.0, 0.0]]), count, axis=0)
    return rows, offsets(count)[starts]


def kept_inside(points: Floats, edges: Ints, rings: Floats, starts: Ints) -> tuple[Floats, Ints]:
    """Edges inside an area, and their points; where points are far apart, some leave it."""
    shell, *holes = np.split(rings, starts[1:-1])
    area = Polygon(shell, holes)
    shapely.prepare(area)
    is_good = np.isfinite(points[edges]).all(axis=(1, 2))
    edges = edges[is_good]
    edges = edges[shapely.covers(area, shapely.linestrings(points[edges]))]
    used, edges = np.unique(edges, return_inverse=True)
    return points[used], edges.reshape(-1, 2)
