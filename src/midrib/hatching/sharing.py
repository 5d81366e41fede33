r"""Slopes that share an edge: their patterns start at the same end of it.

Both sides of a dyke share the crest, both sides of a ditch its bottom. "Left" as one looks down is
another end of that edge for either of them: long strokes of one side would meet long or short ones
of the other, as the count happens to be. With one end for both, strokes are in step, and meet where
the slopes are as wide:

      |   |   |         | |   |   |
      | ' | ' |         | ' | ' | '       meet: the same kinds from the same end
    --+-+-+-+-+--     --+-+-+-+-+-+-      between: half a gap on, so that no stroke meets another
      | , | , |          | , | , |
      |   |   |          |   |   |
"""

from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np
import shapely
from shapely import LinearRing, LineString

from midrib.hatching.asked import check_choice

if TYPE_CHECKING:
    from collections.abc import Sequence

    from midrib.hatching.slope import Slope

__all__ = ["SHARED", "Shared", "in_step"]

Shared: TypeAlias = Literal["meet", "between", "apart"]
SHARED: tuple[Shared, ...] = ("meet", "between", "apart")
MOST = 0.5  # of the shorter edge: slopes that have this much in common share it
HALF = 0.5  # of a gap
SIDES = ("left", "right")


class Beginning(NamedTuple):
    """Where the pattern of a slope starts."""

    at_first: bool  # at the first point of its top and toe, or at the last
    is_between: bool  # half a gap on


def in_step(
    slopes: "Sequence[Slope]", options: dict[str, Any], shared: Shared
) -> list[dict[str, Any]]:
    """Return the options of ``hatch`` for each slope, so that those that share an edge go together.

    Parameters
    ----------
    slopes : sequence of Slope
    options : dict
        Of all slopes. Where they say that patterns start at the first or the last point of a top,
        or ask for the paper's rule, that holds.
    shared : {"meet", "between", "apart"}
        "meet": a slope starts its pattern at that end of a shared top or toe where an earlier slope
        starts its own; "between": half a gap on as well; "apart": each as if it were alone.

    Returns
    -------
    list of dict

    Raises
    ------
    ParameterError
        If ``shared`` is none of these.

    Notes
    -----
    Slopes share an edge if half the shorter one's length is in common, vertex by vertex or not.
    O(n log n) for n slopes that few others touch.
    """
    check_choice(shared, "shared", SHARED)
    side = options.get("start", SIDES[0])
    if shared == "apart" or side not in SIDES or options.get("rule") == "paper":
        return [options] * len(slopes)
    partners = partners_of(slopes)
    begun: list[Beginning] = []
    told = []
    for k, slope in enumerate(slopes):
        left_first = is_left_first(slope)
        begin = Beginning(left_first == (side == SIDES[0]), is_between=False)
        if k in partners:
            _, j, same_way = partners[k]
            begin = Beginning(begun[j].at_first == same_way, not begun[j].is_between)
        begun.append(begin)
        own = options | {"start": SIDES[begin.at_first != left_first]}
        if shared == "between" and begin.is_between:
            offset = options.get("offset", 1.0)
            own["offset"] = offset - HALF if offset > HALF else offset + HALF
        told.append(own)
    return told


def partners_of(slopes: "Sequence[Slope]") -> dict[int, tuple[float, int, bool]]:
    """Earlier slope that each shares the most with, if it shares an edge with one.

    Returns
    -------
    dict of int to (float, int, bool)
        Length in common, which slope, and whether both edges run the same way.
    """
    found: dict[int, tuple[float, int, bool]] = {}
    for name in ("top", "toe"):
        edges = shapely.force_2d([getattr(slope, name) for slope in slopes])
        pairs = shapely.STRtree(edges).query(edges, predicate="intersects")
        for k, j in pairs[:, pairs[0] > pairs[1]].T.tolist():
            common = common_part(edges[k], edges[j])
            if common is None:
                continue
            ends = shapely.points(shapely.get_coordinates(common)[[0, -1]])
            ways = [np.diff(edge.line_locate_point(ends))[0] > 0.0 for edge in (edges[k], edges[j])]
            length = float(shapely.intersection(edges[k], edges[j]).length)
            if k not in found or length > found[k][0]:
                found[k] = length, j, bool(ways[0] == ways[1])
    return found


def common_part(edge: LineString, other: LineString) -> LineString | None:
    """Longest part that two edges have in common, None if they do not share enough, or are closed.

    Closed ones start their patterns at the same vertex as it is.
    """
    if edge.is_closed or other.is_closed:
        return None
    shared = shapely.intersection(edge, other)
    if shared.length < MOST * min(edge.length, other.length):
        return None
    parts = shapely.get_parts(shared)
    lines = parts[shapely.get_type_id(parts) == shapely.GeometryType.LINESTRING]
    merged = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(lines)))
    longest: LineString = max(merged, key=lambda line: line.length)
    return longest


def is_left_first(slope: "Slope") -> bool:
    """Whether the first point of the top is on the left as one looks down from it."""
    top, toe = (shapely.get_coordinates(edge) for edge in (slope.top, slope.toe))
    return bool(LinearRing([*top, *toe[::-1]]).is_ccw)
