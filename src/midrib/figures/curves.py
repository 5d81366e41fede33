"""The curves behind the lines of ``collapse``: their sides and radii, to be drawn.

The lines are made as ``collapse`` makes them, with a finder that also keeps what a picture shows.
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from shapely import LineString

from midrib.curves.aftercare import aftercare
from midrib.curves.collapse import Joint, Log, filled_parts, lines_of_parts, valid_parts
from midrib.curves.finding import Found
from midrib.curves.methods import construction_of_collapse
from midrib.ragged import normalised
from midrib.strip import divide

if TYPE_CHECKING:
    from midrib.curves.joining import Path
    from midrib.curves.radii import Radii
    from midrib.ends import End
    from midrib.formats.reading import Geometries
    from midrib.layout import Layout, Scale
    from midrib.types import Floats, Ints

__all__ = ["Sketch", "curves_of"]


class Sketch(NamedTuple):
    """What a picture shows of a curve of minimal radii."""

    main: "Floats"  # (k, 2)
    auxiliary: "Floats"
    radii: "Floats"  # (n, 2, 2) P and Q of each
    middles: "Floats"  # (n, 2) their S

    @classmethod
    def of(cls, layout: "Layout", radii: "Radii", path: "Path") -> "Sketch":
        """Sketch of the curve that was made from a layout."""
        main, auxiliary = (
            np.column_stack([layout.mesh.x[chain.vertex], layout.mesh.y[chain.vertex]])
            for chain in (layout.main, layout.auxiliary)
        )
        ends = np.stack([radii.points[:, :2], radii.points[:, 2:4]], axis=1)
        return cls(main, auxiliary, ends, path.middles)


def curves_of(
    areas: "Geometries", along: "Geometries | None", geographic: bool, options: dict[str, Any]
) -> tuple[list[tuple[int, Sketch, LineString]], list[Joint]]:
    """Position of the area, sketch and line of each part that is not refused; and joints.

    ``options`` are those of ``collapse``; with ``connect`` the curves lead from joint to joint.
    """
    options = dict(options)
    connect = options.pop("connect", False)
    care = aftercare(options.pop("simplify", None), options.pop("smooth", False))
    construction = construction_of_collapse(**options)
    sketches: list[Sketch] = []

    def find(
        coordinates: "Floats",
        offsets: "Ints",
        along: LineString | None,
        scale: "Scale",
        joints: "tuple[End, End] | None" = None,
    ) -> Found:
        layout = divide(*normalised(coordinates, offsets), scale, along=along, ends=joints)
        radii, path = construction.of(layout)
        sketches.append(Sketch.of(layout, radii, path))
        return Found(path.points, path.height, path.loops)

    log = Log(None, strict=False)
    parts = list(valid_parts(areas, log))
    if construction.holes == "ignored":
        parts = filled_parts(parts)
    lines = lines_of_parts(parts, areas, find, along, geographic, log, care, connect=connect)
    there = [(part.area, line) for part, line in zip(parts, lines, strict=True) if line is not None]
    drawn = [(index, sketch, line) for (index, line), sketch in zip(there, sketches, strict=True)]
    return drawn, [p for p in log.problems if isinstance(p, Joint) and p.kind != "none"]
