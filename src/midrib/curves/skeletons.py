"""Skeletons of areas: all branches with their radii, and the trunk from end to end."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from shapely import LineString, MultiLineString, Polygon

from midrib.checks import check_flag, is_number, shown
from midrib.curves.axes import AXES
from midrib.curves.finding import Finder, Found, made
from midrib.curves.graphs import Graph, pruned, trunk_of
from midrib.errors import ParameterError
from midrib.geodesy import degree_lengths
from midrib.kernels.graph import branches_of
from midrib.ragged import area_of_one, normalised, pack_areas
from midrib.strip import PLANE, divide

if TYPE_CHECKING:
    from collections.abc import Callable

    from midrib.curves.axes import Axis
    from midrib.ends import End
    from midrib.layout import Layout, Scale
    from midrib.types import Floats, Ints

__all__ = ["Skeleton", "graph_finder", "pruning", "skeleton", "trunk_finder"]


@dataclass(frozen=True, eq=False)
class Skeleton:
    """A skeleton of an area: a graph of branches that meet in junctions and end in tips.

    Attributes
    ----------
    area : Polygon
    method : str
    points : (n, 2) array of float
        Every vertex.
    radius : (n,) array of float
        Distance of each to the boundary, holes included, in coordinate units, in metres if
        geographic.
    edges : (m, 2) array of int
        Rows of the points that are joined.
    """

    area: Polygon
    method: str
    points: "Floats"
    radius: "Floats"
    edges: "Ints"
    layout: "Layout"

    def __repr__(self) -> str:
        """Show what there is of it."""
        return f"<Skeleton: {self.method}, {len(self.branches)} branches>"

    @cached_property
    def branches(self) -> "list[Ints]":
        """Rows of the points of each branch, from a tip or junction to the next one, or round."""
        rows, offsets = branches_of(len(self.points), self.edges)
        return np.split(rows, offsets[1:-1]) if rows.size else []

    @property
    def lines(self) -> MultiLineString:
        """Every branch as a line."""
        return MultiLineString([LineString(self.points[rows]) for rows in self.branches])

    @cached_property
    def trunk(self) -> LineString:
        """Shortest way through the skeleton between the two ends of the area, and on to these."""
        graph = Graph(self.points, self.edges, self.radius)
        return LineString(trunk_of(graph, self.layout).points)


def skeleton(
    area: Any,
    method: str = "medial-axis",
    *,
    min_branch_length: float | None = None,
    min_significance: float | None = None,
    geographic: bool = False,
    **options: Any,
) -> Skeleton:
    """Find the skeleton of an area: every branch, with its distance to the boundary.

    Parameters
    ----------
    area : Polygon
    method : str, default "medial-axis"
        One of those of ``midrib.methods()`` that have branches.
    min_branch_length : float, optional
        Leave out shorter branches to tips; in coordinate units, in metres if geographic.
    min_significance : float, optional
        Leave out branches to tips that reach less than so many radii from their junction: how far
        the disc of the tip reaches over the radius of the disc around the junction. A corner
        reaches 1.41, so that 1.5 leaves out corners, and 3 all but arms.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude.
    **options
        Those of the method: ``tolerance`` of "medial-axis", how far its arcs may be from their
        chords; ``spacing`` of "point-voronoi".

    Returns
    -------
    Skeleton
        ``lines``, ``points``, ``radius``, ``branches``, ``edges`` and ``trunk``.

    Raises
    ------
    GeometryTypeError
        If ``area`` is no Polygon.
    InvalidAreaError
        If it is not valid.
    ParameterError
        If there is no such method, it has no branches, or an option has a value it cannot have.

    Examples
    --------
    >>> found = skeleton(box(0, 0, 9, 2), min_significance=1.5)
    >>> found.trunk.wkt
    'LINESTRING (0 1, 1 1, 8 1, 9 1)'
    """
    find = graph_finder(method, **options)
    prune = pruning(min_branch_length, min_significance)
    check_flag(geographic, "geographic")
    area = area_of_one(area, "area")
    scale = degree_lengths(shapely.bounds(area)) if geographic else PLANE
    graph, layout = find(area, scale)
    graph = prune(graph, scale)
    return Skeleton(area, method, graph.points, graph.radius, graph.edges, layout)


def graph_finder(method: str, **options: Any) -> "Callable[[Polygon, Scale], tuple[Graph, Layout]]":
    """Return what finds skeletons of valid areas, by a method and its options.

    Raises
    ------
    ParameterError
        If there is no such method, it has no branches, or an option has a value it cannot have.
    """
    of_rings = made(axis_of(method), method, options)

    def find(area: Polygon, scale: "Scale") -> "tuple[Graph, Layout]":
        coordinates, offsets = pack_areas(np.array([area], dtype=object)).rings(0)
        layout = divide(*normalised(coordinates, offsets), scale)
        return of_rings(coordinates, offsets, layout), layout

    return find


def pruning(
    min_branch_length: float | None, min_significance: float | None
) -> "Callable[[Graph, Scale], Graph]":
    """Return what prunes skeletons, by the options of ``skeleton``.

    Raises
    ------
    ParameterError
        If an option has a value it cannot have.
    """
    least = {"min_branch_length": min_branch_length, "min_significance": min_significance}
    for name, value in least.items():
        if value is not None and (not is_number(value) or not 0.0 <= value < np.inf):
            msg = f"{name} is {shown(value)}, expected a number of 0 or more"
            raise ParameterError(msg)

    def prune(graph: Graph, scale: "Scale") -> Graph:
        if not min_branch_length and not min_significance:
            return graph
        return pruned(graph, scale, min_branch_length or 0.0, min_significance or 0.0)

    return prune


def axis_of(method: str) -> "Callable[..., Axis]":
    """Return what makes a method's axis, once its options are known.

    Raises
    ------
    ParameterError
        If there is no such method with branches.
    """
    if not isinstance(method, str) or method not in AXES:
        msg = f"method is {shown(method)}, expected {' or '.join(map(repr, AXES))}"
        raise ParameterError(msg)
    return AXES[method]


def trunk_finder(method: str, **options: Any) -> Finder:
    """Trunks of the skeletons that a method finds."""
    axis = AXES[method](**options)

    def find(
        coordinates: "Floats",
        offsets: "Ints",
        along: LineString | None,
        scale: "Scale",
        joints: "tuple[End, End] | None" = None,
    ) -> Found:
        rings, height = normalised(coordinates, offsets)
        layout = divide(rings, height, scale, along=along, ends=joints)
        return trunk_of(axis(coordinates, offsets, layout), layout)

    return find
