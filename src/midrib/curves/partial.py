"""Partial collapse: the narrow parts of an area become lines, the wide ones stay areas."""

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import shapely
from shapely import MultiLineString, MultiPolygon, Polygon

from midrib.checks import is_number, shown
from midrib.curves.cuts import edge_of
from midrib.curves.dividing import Divided, divide_area
from midrib.curves.each import find_in_each
from midrib.curves.graphs import radii_of
from midrib.curves.narrowing import divided_at, parts_of
from midrib.curves.network import check_merge, lines_of_graph, with_heights
from midrib.curves.skeletons import graph_finder, pruning
from midrib.errors import ParameterError
from midrib.ragged import pack_areas

if TYPE_CHECKING:
    from midrib.layout import Layout, Scale
    from midrib.types import Floats

__all__ = ["Partial", "partial_collapse"]

NOWHERE = np.empty((0, 2))
FINE = 1e-3  # of the width: arcs of the medial axis are within that


class Partial(NamedTuple):
    """What a partial collapse makes of areas.

    Attributes
    ----------
    areas : Polygon or MultiPolygon; object array; GeoSeries
        What is at least as wide; an empty Polygon where nothing is.
    lines : MultiLineString; object array; GeoSeries
        Centre lines of the rest, from node to node; empty where there is none.
    """

    areas: Any
    lines: Any


def partial_collapse(
    areas: Any,
    narrower_than: float,
    *,
    min_length: float | None = None,
    method: str = "medial-axis",
    merge: float = 1.0,
    min_branch_length: float | None = None,
    min_significance: float | None = 3.0,
    on_error: Literal["raise", "report"] = "raise",
    geographic: bool | None = None,
    **options: Any,
) -> Any:
    """Collapse the parts of areas that are narrower than a width to lines, and keep the others.

    Parameters
    ----------
    areas : Polygon, MultiPolygon, array_like of them, GeoSeries or GeoDataFrame
        None and empty areas stay what they are. Z is carried along.
    narrower_than : float
        The width, in coordinate units, in metres if geographic: twice the distance from the
        skeleton to the boundary.
    min_length : float, optional
        A narrow part counts from this length on, all ways of the skeleton in it together, between
        the cuts; so does a wide one, but for what is in the discs around junctions, or one that
        stands out: it is somewhere 1.4 times as wide as the widest way out within three radii, or
        twice where three ways leave. Others go with what is beside them, the narrow ones first. As
        long as the width unless you say otherwise.
    method : {"medial-axis"}
        The skeleton whose every disc touches two banks, on either side: cuts need that. Those of
        other methods do not, and their cuts may cross.
    merge, min_branch_length, min_significance
        Of the network of lines, as in ``midrib.network``. A dead end that is left out stays in the
        area that it is of.
    on_error : {"raise", "report"}, default "raise"
        ``"report"`` returns ``(partial, problems)``, as ``midrib.collapse`` does; a narrow part
        that could not be cut off, and so has stayed an area, is a problem with the status "uncut".
    geographic : bool, optional
        Whether coordinates are degrees of longitude and latitude. Taken from the CRS of a
        GeoSeries, otherwise False.
    **options
        Those of the method, as in ``midrib.skeleton``.

    Returns
    -------
    Partial
        ``areas`` and ``lines``, each as ``areas`` is one area, an array or a GeoSeries. None for
        both where an area was refused.

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
    Where the skeleton becomes as wide as that, the area is cut straight from bank to bank, between
    the two points that the disc there touches. These cuts do not cross: they are sides of a
    Delaunay triangulation of their ends. The line of a narrow part ends in a vertex of the cut, the
    same bit by bit. The areas are covered by the given ones, exactly, and the lines are covered by
    the rest. With the same ``min_length`` areas only lose, and lines only gain, as the width grows.

    O(n log n) beside the skeleton, for discs that reach few walls.

    Examples
    --------
    >>> dumbbell = shapely.union_all([box(0, 0, 4, 4), box(4, 1, 9, 3), box(9, 0, 13, 4)])
    >>> found = partial_collapse(dumbbell, narrower_than=3)
    >>> found.lines.wkt, found.areas.equals(shapely.union_all([box(0, 0, 4, 4), box(9, 0, 13, 4)]))
    ('MULTILINESTRING ((9 2, 4 2))', True)
    """
    check_method(method)
    check_merge(merge)
    width = positive(narrower_than, "narrower_than")
    least = width if min_length is None else positive(min_length, "min_length")
    find_graph = graph_finder(method, **({"tolerance": FINE * width} | options))
    prune = pruning(min_branch_length, min_significance)

    def find(area: Polygon, scale: "Scale") -> Divided:
        whole, layout = find_graph(area, scale)
        coordinates, offsets = pack_areas(np.array([area], dtype=object)).rings(0)
        pruned = prune(whole, scale)

        def radii(points: "Floats") -> "Floats":
            return radii_of(coordinates, offsets, points, scale)

        parts = parts_of(divided_at(pruned, width / 2.0, radii, scale), least, scale)
        if not parts.is_narrow.any():
            return Divided([area], [], NOWHERE)
        if parts.is_narrow.all():
            lines = lines_of_graph(whole, pruned, layout, area, float(merge))
            return Divided([], [with_heights(layout, line) for line in lines], NOWHERE)
        found = divide_area(parts, edge_of(area, scale), width / 2.0, least, float(merge))
        lines = [with_heights(layout, line) for line in found.lines]
        return Divided([lifted(layout, piece) for piece in found.wide], lines, found.uncut)

    each = find_in_each(areas, find, on_error, geographic, reasons)
    kept, lines = each.flat.copy(), each.flat.copy()
    for i, pieces in enumerate(each.parts):
        is_there = bool(pieces) or each.is_empty(i)
        wide = [area for piece in pieces for area in piece.wide]
        chains = [shapely.linestrings(line) for piece in pieces for line in piece.lines]
        kept[i] = together(wide) if is_there else None
        lines[i] = MultiLineString(chains) if is_there else None
    return each.reported(Partial(each.taken.given_back(kept), each.taken.given_back(lines)))


def check_method(method: Any) -> None:
    """Refuse skeletons whose discs do not touch both banks."""
    if not isinstance(method, str) or method != "medial-axis":
        msg = (
            f"method is {shown(method)}, expected 'medial-axis': cuts lead from bank to bank of "
            "its discs, and no other method has discs that touch both"
        )
        raise ParameterError(msg)


def reasons(found: Divided) -> list[str]:
    """Say where narrow parts could not be cut off."""
    return [f"the narrow part at ({x:.12g}, {y:.12g}) has stayed an area" for x, y in found.uncut]


def positive(value: Any, name: str) -> float:
    """Return a number above 0.

    Raises
    ------
    ParameterError
        If it is none.
    """
    if not is_number(value) or not 0.0 < value < np.inf:
        msg = f"{name} is {shown(value)}, expected a number above 0"
        raise ParameterError(msg)
    return float(value)


def together(pieces: list[Polygon]) -> Polygon | MultiPolygon:
    """One area of pieces."""
    if len(pieces) > 1:
        return MultiPolygon(pieces)
    return pieces[0] if pieces else Polygon()


def lifted(layout: "Layout", area: Polygon) -> Polygon:
    """Area with the Z of its corners and of the triangles that its other vertices are in."""
    if layout.height is None:
        return area
    rings = [
        with_heights(layout, shapely.get_coordinates(r)) for r in (area.exterior, *area.interiors)
    ]
    return Polygon(rings[0], rings[1:])
