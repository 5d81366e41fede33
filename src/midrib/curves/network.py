"""The network of an area: centre lines of roads, or of rivers, that meet in junctions."""

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import shapely
from shapely import MultiLineString

from midrib.checks import is_number, shown
from midrib.curves.each import find_in_each
from midrib.curves.heights import heights_inside
from midrib.curves.networks import network_lines
from midrib.curves.skeletons import graph_finder, pruning
from midrib.curves.trunks import trunk_of
from midrib.errors import ParameterError

if TYPE_CHECKING:
    from shapely import Polygon

    from midrib.curves.graphs import Graph
    from midrib.layout import Layout, Scale
    from midrib.types import Floats

__all__ = ["check_merge", "lines_of_graph", "network", "with_heights"]

JUNCTION = 3  # ways of a point that is one


def network(
    areas: Any,
    method: str = "medial-axis",
    *,
    merge: float = 1.0,
    min_branch_length: float | None = None,
    min_significance: float | None = 3.0,
    on_error: Literal["raise", "report"] = "raise",
    geographic: bool | None = None,
    **options: Any,
) -> Any:
    """Find the centre lines of areas that are networks: roads with their crossings, rivers.

    Parameters
    ----------
    areas : Polygon, MultiPolygon, array_like of them, GeoSeries or GeoDataFrame
        None and empty areas stay what they are. Z is carried along.
    method : str, default "medial-axis"
        One of those of ``midrib.methods()`` that have branches.
    merge : float, default 1
        Junctions are one crossing up to so many times the sum of their radii apart, and up to
        twice as many where all arms lead to one point. 0 keeps the junctions of the skeleton.
    min_branch_length, min_significance : float, optional
        Which dead ends are left out, as in ``midrib.skeleton``.
    on_error : {"raise", "report"}, default "raise"
        ``"report"`` returns ``(lines, problems)``, as ``midrib.collapse`` does.
    geographic : bool, optional
        Whether coordinates are degrees of longitude and latitude; lengths are in metres then.
        Taken from the CRS of a GeoSeries, otherwise False.
    **options
        Those of the method, as in ``midrib.skeleton``.

    Returns
    -------
    MultiLineString; object array; GeoSeries
        As ``areas`` is one area, an array (same shape) or a GeoSeries (index and CRS kept). Lines
        lead from node to node, or round; those that meet do so in equal points at their ends, and
        nowhere else. Only of ``"point-voronoi"``, whose samples are often on one circle by four,
        may lines turn back by the last digits of coordinates.

    Raises
    ------
    GeometryTypeError
        If something is not an area.
    InvalidAreaError
        If an area is not valid and the repair is not certain.
    ParameterError
        If an option is unknown or has a value it cannot have.

    Notes
    -----
    At a junction a skeleton leaves the middle of the roads, and the crossing of two roads has two
    of them. Here arms are cut back to where they have left the discs around the junctions and are
    as narrow as farther out, and led to the point that is nearest to where all of them lead; so a
    road goes straight on past one that joins it. Where that would leave the area or cross another
    line the skeleton stays as it is. Dead ends go straight on to the edge, into the middle of a
    flat end. Every hole keeps its way round. An area without junctions has its trunk.

    Every line of a medial axis is covered by its area, exactly. Lines of other skeletons are but
    for the rounding of coordinates, where they keep vertices of the skeleton that are on the edge
    or next to it; only what is drawn anew is proven to be inside.

    O(n log n) beside the skeleton, for arms that see few walls.

    References
    ----------
    Haunert and Sester, Area collapse and road centerlines based on straight skeletons,
    GeoInformatica 12, 2008.

    Examples
    --------
    >>> network(Polygon([(0, 0), (9, 0), (9, 2), (6, 2), (6, 8), (4, 8), (4, 2), (0, 2)])).wkt
    'MULTILINESTRING ((0 1, 5 1), (5 1, 5 8), (5 1, 9 1))'
    """
    check_merge(merge)
    find_graph = graph_finder(method, **options)
    prune = pruning(min_branch_length, min_significance)

    def find(area: "Polygon", scale: "Scale") -> list["Floats"]:
        graph, layout = find_graph(area, scale)
        lines = lines_of_graph(graph, prune(graph, scale), layout, area, float(merge))
        return [with_heights(layout, line) for line in lines]

    each = find_in_each(areas, find, on_error, geographic)
    networks = each.flat.copy()
    for i, parts in enumerate(each.parts):
        lines = [shapely.linestrings(line) for part in parts for line in part]
        networks[i] = MultiLineString(lines) if lines or each.is_empty(i) else None
    return each.reported(each.taken.given_back(networks))


def check_merge(merge: Any) -> None:
    """Refuse what is no share of the radii of junctions."""
    if not is_number(merge) or not 0.0 <= merge < np.inf:
        msg = f"merge is {shown(merge)}, expected a number of 0 or more"
        raise ParameterError(msg)


def lines_of_graph(
    whole: "Graph", pruned: "Graph", layout: "Layout", area: "Polygon", merge: float
) -> list["Floats"]:
    """Lines of a network, or the trunk of an area that has neither a junction nor a way round."""
    degree = np.bincount(pruned.edges.ravel(), minlength=len(pruned.points))
    if degree.max() < JUNCTION and degree.min() == 1:
        return [trunk_of(whole, layout).points]
    return network_lines(pruned, area, layout.scale, merge)


def with_heights(layout: "Layout", points: "Floats") -> "Floats":
    """Points with the Z of the triangles that they are in, if the area has any."""
    if layout.height is None:
        return points
    return np.column_stack([points, heights_inside(layout.mesh, layout.height, points)])
