"""The curves behind the lines of ``collapse``: its strips and radii, to be drawn."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import shapely
from shapely import LineString

from midrib import interrupts
from midrib.curves.aftercare import aftercare, tend
from midrib.curves.collapse import Log, filled_parts, valid_parts
from midrib.curves.methods import construction_of_collapse
from midrib.curves.minimal_radii import Curve
from midrib.errors import MidribError
from midrib.geodesy import degree_lengths
from midrib.ragged import rings_of_area
from midrib.strip import PLANE, Strip, divide

if TYPE_CHECKING:
    from midrib.formats.reading import Geometries

__all__ = ["curves_of"]


def curves_of(
    areas: "Geometries", along: "Geometries | None", geographic: bool, options: dict[str, Any]
) -> Iterator[tuple[int, Curve, LineString]]:
    """Position of the area, curve of minimal radii and line, of each part that is not refused.

    The line is the curve's, after its after-care.
    """
    options = dict(options)
    care = aftercare(options.pop("simplify", None), options.pop("smooth", False))
    construction = construction_of_collapse(**options)
    parts = list(valid_parts(areas, Log(None, strict=False)))
    if construction.holes == "ignored":
        parts = filled_parts(parts)
    for index, _, polygon in parts:
        interrupts.check()
        scale = degree_lengths(shapely.bounds(polygon)) if geographic else PLANE
        guide = None if along is None else along[index]
        try:
            layout = divide(*rings_of_area(polygon), scale, along=guide)
            strip = Strip._of_layout(layout, polygon)  # has its scale
            curve = Curve(strip, *construction.of(layout))
        except MidribError:
            continue
        (line,) = tend([curve.line], [polygon], care, geographic=geographic)
        yield index, curve, line or curve.line
