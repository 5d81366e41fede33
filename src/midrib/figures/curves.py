"""The curves behind the lines of ``collapse``: its strips and radii, to be drawn."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import shapely

from midrib.curves.collapse import Log, valid_parts
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
) -> Iterator[tuple[int, Curve]]:
    """Position of the area and curve of minimal radii, of each part that is not refused."""
    construction = construction_of_collapse(**options)
    for index, _, polygon in valid_parts(areas, Log(None, strict=False)):
        scale = degree_lengths(shapely.bounds(polygon)) if geographic else PLANE
        guide = None if along is None else along[index]
        try:
            layout = divide(*rings_of_area(polygon), scale, along=guide)
            strip = Strip._of_layout(layout, polygon)  # has its scale
            yield index, Curve(strip, *construction.of(layout))
        except MidribError:
            continue
