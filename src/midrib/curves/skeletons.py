"""What finds the skeletons of areas, prunes them, and takes their trunks."""

from typing import TYPE_CHECKING, Any

import numpy as np
from shapely import LineString, Polygon

from midrib.checks import is_number, shown
from midrib.curves.axes import AXES
from midrib.curves.finding import Finder, Found, made
from midrib.curves.graphs import Graph, pruned
from midrib.curves.trunks import trunk_of
from midrib.errors import ParameterError
from midrib.ragged import normalised, pack_areas
from midrib.strip import divide

if TYPE_CHECKING:
    from collections.abc import Callable

    from midrib.curves.axes import Axis
    from midrib.ends import End
    from midrib.layout import Layout, Scale
    from midrib.types import Floats, Ints

__all__ = ["graph_finder", "pruning", "trunk_finder"]


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
