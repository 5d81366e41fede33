"""The curves behind the lines of ``collapse``: their sides and radii, to be drawn.

The lines are made as ``collapse`` makes them, with a finder that also keeps what a picture shows.
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from shapely import LineString

from midrib.curves.aftercare import aftercare
from midrib.curves.axes import AXES
from midrib.curves.collapse import lines_of_parts
from midrib.curves.finding import Found
from midrib.curves.log import Joint, Log
from midrib.curves.methods import OF_METHOD, construction_of_collapse, finder_of
from midrib.curves.parts import filled_parts, valid_parts
from midrib.curves.trunks import trunk_of
from midrib.ragged import normalised
from midrib.strip import divide

if TYPE_CHECKING:
    from collections.abc import Callable

    from midrib.curves.graphs import Graph
    from midrib.curves.joining import Path
    from midrib.curves.radii import Radii
    from midrib.ends import End
    from midrib.formats.reading import Geometries
    from midrib.layout import Layout, Scale
    from midrib.types import Floats, Ints

__all__ = ["Sketch", "curves_of"]


class Sketch(NamedTuple):
    """What a picture shows of how a line is made."""

    main: "Floats"  # (k, 2)
    auxiliary: "Floats"
    across: "Floats"  # (n, 2) vectors as long as the area is wide
    radii: "Floats"  # (n, 2, 2) P and Q of each
    middles: "Floats"  # (n, 2) their S
    branches: "Floats"  # (m, 2, 2) edges of a skeleton


Made = tuple[Sketch, Found]
NONE = np.empty((0, 2, 2))


def sketch_of_radii(layout: "Layout", radii: "Radii", path: "Path") -> Sketch:
    """Sketch of a curve that was made from radii."""
    ends = np.stack([radii.points[:, :2], radii.points[:, 2:4]], axis=1)
    return Sketch(*sides(layout), ends[:, 1] - ends[:, 0], ends, path.middles, NONE)


def sketch_of_branches(layout: "Layout", graph: "Graph") -> Sketch:
    """Sketch of a trunk with the skeleton that it is of."""
    across = np.array([[layout.mean_width / layout.scale[0], 0.0]])
    return Sketch(*sides(layout), across, NONE, NONE[:, 0], graph.points[graph.edges])


def sides(layout: "Layout") -> "tuple[Floats, Floats]":
    """Both sides of an area as rows of points."""
    main, auxiliary = (
        np.column_stack([layout.mesh.x[chain.vertex], layout.mesh.y[chain.vertex]])
        for chain in (layout.main, layout.auxiliary)
    )
    return main, auxiliary


def maker_of(method: str, options: dict[str, Any]) -> "Callable[[Floats, Ints, Layout], Made]":
    """Return what makes sketches and lines by a method, of rings and the layout of their area."""
    finder_of(method, **options)  # checks both
    if method in AXES:
        axis = AXES[method](**options)

        def by_axis(coordinates: "Floats", offsets: "Ints", layout: "Layout") -> Made:
            graph = axis(coordinates, offsets, layout)
            return sketch_of_branches(layout, graph), trunk_of(graph, layout)

        return by_axis
    construction = construction_of_collapse(**(OF_METHOD.get(method, {}) | options))

    def by_radii(_: "Floats", __: "Ints", layout: "Layout") -> Made:
        radii, path = construction.of(layout)
        return sketch_of_radii(layout, radii, path), Found(path.points, path.height, path.loops)

    return by_radii


def curves_of(
    areas: "Geometries", along: "Geometries | None", geographic: bool, options: dict[str, Any]
) -> tuple[list[tuple[int, Sketch, LineString]], list[Joint]]:
    """Position of the area, sketch and line of each part that is not refused; and joints.

    ``options`` are those of ``collapse``; with ``connect`` the curves lead from joint to joint.
    """
    options = dict(options)
    connect = options.pop("connect", False)
    care = aftercare(options.pop("simplify", None), options.pop("smooth", False))
    fills = options.get("holes") == "ignored"
    make = maker_of(options.pop("method", "minimal-radii"), options)
    sketches: list[Sketch] = []

    def find(
        coordinates: "Floats",
        offsets: "Ints",
        along: LineString | None,
        scale: "Scale",
        joints: "tuple[End, End] | None" = None,
    ) -> Found:
        layout = divide(*normalised(coordinates, offsets), scale, along=along, ends=joints)
        sketch, found = make(coordinates, offsets, layout)
        sketches.append(sketch)
        return found

    log = Log(None, strict=False)
    parts = list(valid_parts(areas, log))
    if fills:
        parts = filled_parts(parts)
    lines = lines_of_parts(parts, areas, find, along, geographic, log, care, connect=connect)
    there = [(part.area, line) for part, line in zip(parts, lines, strict=True) if line is not None]
    drawn = [(index, sketch, line) for (index, line), sketch in zip(there, sketches, strict=True)]
    return drawn, [p for p in log.problems if isinstance(p, Joint) and p.kind != "none"]
