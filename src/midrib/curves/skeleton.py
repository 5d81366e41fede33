"""Skeletons of areas: all branches with their radii, and the trunk from end to end."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from shapely import LineString, MultiLineString, MultiPolygon, Polygon

from midrib.curves.each import find_in_each
from midrib.curves.skeletons import graph_finder, pruning
from midrib.curves.trunks import trunk_of
from midrib.kernels.graph import branches_of

if TYPE_CHECKING:
    from midrib.curves.graphs import Graph
    from midrib.layout import Layout, Scale
    from midrib.types import Floats, Ints

__all__ = ["Skeleton", "skeleton"]


@dataclass(frozen=True, eq=False)
class Skeleton:
    """A skeleton of an area: a graph of branches that meet in junctions and end in tips.

    Attributes
    ----------
    area : Polygon or MultiPolygon
    method : str
    points : (n, 2) array of float
        Every vertex.
    radius : (n,) array of float
        Distance of each to the boundary, holes included, in coordinate units, in metres if
        geographic.
    edges : (m, 2) array of int
        Rows of the points that are joined.
    """

    area: Polygon | MultiPolygon
    method: str
    points: "Floats"
    radius: "Floats"
    edges: "Ints"
    parts: "tuple[tuple[Graph, Layout], ...]"

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
    def trunk(self) -> LineString | MultiLineString:
        """Shortest way through the skeleton between the two ends of the area, and on to these.

        One of each part where there are several.
        """
        trunks = [LineString(trunk_of(graph, layout).points) for graph, layout in self.parts]
        return trunks[0] if len(trunks) == 1 else MultiLineString(trunks)


def skeleton(
    areas: Any,
    method: str = "medial-axis",
    *,
    min_branch_length: float | None = None,
    min_significance: float | None = None,
    on_error: Literal["raise", "report"] = "raise",
    geographic: bool | None = None,
    **options: Any,
) -> Any:
    """Find the skeletons of areas: every branch, with its distance to the boundary.

    Parameters
    ----------
    areas : Polygon, MultiPolygon, array_like of them, GeoSeries or GeoDataFrame
        None and empty areas have no skeleton. Z is left out.
    method : str, default "medial-axis"
        One of those of ``midrib.methods()`` that have branches.
    min_branch_length : float, optional
        Leave out shorter branches to tips; in coordinate units, in metres if geographic.
    min_significance : float, optional
        Leave out branches to tips that reach less than so many radii from their junction: how far
        the disc of the tip reaches over the radius of the disc around the junction. A corner
        reaches 1.41, so that 1.5 leaves out corners, and 3 all but arms.
    on_error : {"raise", "report"}, default "raise"
        ``"report"`` returns ``(skeletons, problems)``, as ``midrib.collapse`` does.
    geographic : bool, optional
        Whether coordinates are degrees of longitude and latitude. Taken from the CRS of a
        GeoSeries, otherwise False.
    **options
        Those of the method: ``tolerance`` of "medial-axis", how far its arcs may be from their
        chords; ``spacing`` of "point-voronoi".

    Returns
    -------
    Skeleton; object array
        With ``lines``, ``points``, ``radius``, ``branches``, ``edges`` and ``trunk``. An array of
        the same shape for an array, or of one axis for a GeoSeries; None where an area is missing,
        empty or refused.

    Raises
    ------
    GeometryTypeError
        If something is not an area.
    InvalidAreaError
        If an area is not valid and the repair is not certain.
    ParameterError
        If there is no such method, it has no branches, or an option has a value it cannot have.

    Examples
    --------
    >>> found = skeleton(box(0, 0, 9, 2), min_significance=1.5)
    >>> found.trunk.wkt
    'LINESTRING (0 1, 1 1, 8 1, 9 1)'
    """
    find_graph = graph_finder(method, **options)
    prune = pruning(min_branch_length, min_significance)

    def find(area: Polygon, scale: "Scale") -> "tuple[Graph, Layout]":
        graph, layout = find_graph(area, scale)
        return prune(graph, scale), layout

    each = find_in_each(areas, find, on_error, geographic)
    found = np.empty(each.flat.size, dtype=object)
    for i, parts in enumerate(each.parts):
        found[i] = together(each.flat[i], method, parts) if parts else None
    array = each.taken.array
    return each.reported(found.reshape(array.shape) if array.ndim else found[0])


def together(
    area: Polygon | MultiPolygon, method: str, parts: "list[tuple[Graph, Layout]]"
) -> Skeleton:
    """One skeleton of those of the parts of an area."""
    graphs = [graph for graph, _ in parts]
    sizes = [len(graph.points) for graph in graphs]
    before = np.cumsum([0, *sizes[:-1]])
    return Skeleton(
        area,
        method,
        np.concatenate([graph.points for graph in graphs]),
        np.concatenate([graph.radius for graph in graphs]),
        np.concatenate([graph.edges + n for graph, n in zip(graphs, before, strict=True)]),
        tuple(parts),
    )
