"""The public door to label lines."""

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import shapely
from shapely import LineString

from midrib.curves.each import find_in_each
from midrib.curves.finding import Finder
from midrib.curves.graphs import pruned
from midrib.curves.labels import Label, Wanted, best_label
from midrib.curves.methods import finder_of
from midrib.curves.partial import positive
from midrib.curves.skeletons import graph_finder
from midrib.curves.spines import spines_of
from midrib.errors import InvalidAreaError, ParameterError
from midrib.ragged import pack_areas

if TYPE_CHECKING:
    from shapely import Polygon

    from midrib.layout import Scale

__all__ = ["Labels", "label_line"]

ASPECT = 6.0  # of a name of some ten letters
NO_CORNER = 1.5  # radii that a branch reaches, corners reach 1.41


class Labels(NamedTuple):
    """Label lines of areas.

    Attributes
    ----------
    lines : LineString; object array; GeoSeries
        The middle of the text, to be read from its start.
    heights : float; array of float
        Of the text that fits there, in coordinate units, in metres if geographic; NaN without.
    """

    lines: Any
    heights: Any


def label_line(
    areas: Any,
    *,
    length: float | None = None,
    height: float | None = None,
    aspect: float | None = None,
    on_error: Literal["raise", "report"] = "raise",
    geographic: bool | None = None,
) -> Any:
    """Find lines for the names of areas: curves with few bends in their widest parts.

    Parameters
    ----------
    areas : Polygon, MultiPolygon, array_like of them, GeoSeries or GeoDataFrame
        None and empty areas have no label. Of several parts the one with most room has it.
    length, height : float, optional
        Of the text, in coordinate units, in metres if geographic. With one of them the other is as
        large as it can be, with neither both are, in the proportion ``aspect``.
    aspect : float, optional
        Length over height, where neither is given; 6 unless you say otherwise.
    on_error : {"raise", "report"}, default "raise"
        ``"report"`` returns ``(labels, problems)``, as ``midrib.collapse`` does; areas without room
        for the text are refused.
    geographic : bool, optional
        Whether coordinates are degrees of longitude and latitude. Taken from the CRS of a
        GeoSeries, otherwise False.

    Returns
    -------
    Labels
        ``lines`` as ``areas`` is one area, an array or a GeoSeries, and ``heights``. A band of the
        height along the line is in the area: all that is within half of it from the line.

    Raises
    ------
    GeometryTypeError
        If something is not an area.
    InvalidAreaError
        If an area has no place for the text, or is not valid and the repair is not certain.
    ParameterError
        If an option has a value it cannot have.

    Notes
    -----
    Polynomials of degree 1 to 3 are tried along stretches of the line of ``midrib.collapse``, of
    ways of the medial axis through the three widest places, and of the level lines through these:
    some thousands, and then more about the best one. A name is read eastwards, or upwards where it
    is steeper than 70 degrees; a level one is taken unless another leaves room for more by a ninth,
    and of one that is upside down or falls steeply for a part much less. A plainer one is taken
    unless one with more bends leaves room for text a twentieth larger. No text is bent with a
    radius of less than 1.5 times its height. O(m log m + k m) for m vertices and k candidates.

    Examples
    --------
    >>> label = label_line(box(0, 0, 30, 4))
    >>> round(label.lines.length, 6), round(label.heights, 6)
    (24.0, 4.0)
    """
    sizes = {"length": length, "height": height}
    checked = {name: None if v is None else positive(v, name) for name, v in sizes.items()}
    given = [name for name, value in checked.items() if value is not None]
    if aspect is not None and given:
        msg = f"aspect is given beside {' and '.join(given)}, expected one or the other"
        raise ParameterError(msg)
    proportion = ASPECT if aspect is None else positive(aspect, "aspect")
    wanted = Wanted(checked["length"], checked["height"], proportion)
    trunk_of, graph_of = finder_of("minimal-radii"), graph_finder("medial-axis")

    def find(area: "Polygon", scale: "Scale") -> Label:
        area = shapely.force_2d(area)  # heights say nothing of the room for a name
        graph = pruned(graph_of(area, scale)[0], scale, 0.0, NO_CORNER)
        spines = [trunk_line(trunk_of, area, scale), *spines_of(graph, area, scale)]
        return best_label(area, spines, scale, wanted)

    each = find_in_each(areas, find, on_error, geographic)
    best = [max(labels, key=room, default=None) for labels in each.parts]
    lines = np.array([None, *(label and label.line for label in best)], dtype=object)[1:]
    heights = np.array([np.nan if label is None else label.height for label in best])
    array = each.taken.array
    result = Labels(
        each.taken.given_back(lines),
        heights.reshape(array.shape) if array.ndim else float(heights[0]),
    )
    return each.reported(result)


def room(label: Label) -> float:
    """How much text fits along a label line."""
    return float(label.line.length * label.height)


def trunk_line(find: Finder, area: "Polygon", scale: "Scale") -> LineString:
    """Line of ``collapse``."""
    rings = pack_areas(np.array([area], dtype=object)).rings(0)
    found = find(rings[0][:, :2].copy(), rings[1], None, scale)
    line = LineString(found.points)
    if line.length == 0.0:
        msg = "the line is one point"
        raise InvalidAreaError(msg)
    return line
