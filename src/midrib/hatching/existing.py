r"""Strokes that somebody has drawn, beside the slopes they are meant for.

A stroke is on the slope that holds most of it, and sticks out where it leaves that. What runs along
the boundaries of slopes, as outlines around several of them do, is not outside.

     _________
    |  |   |  |  |      inside; sticks out; outside of every slope
    |__|___|__|  |
           |
"""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import LineString, Point

from midrib.hatching.finding import Finding
from midrib.hatching.measures import outside_of, rounding_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from midrib.hatching.slope import Slope
    from midrib.types import Ints

__all__ = ["crossings", "outside"]

MEET_IN_ENDS = "F********"  # DE-9IM: two strokes have no inner point in common
NO_SLOPE = -1


def crossings(strokes: "NDArray[np.object_]", slopes: "Sequence[Slope]") -> Iterator[Finding]:
    """Find pairs of strokes that cross or lie on each other, and the slope each is on."""
    areas = shapely.STRtree([slope.area for slope in slopes])
    found = shapely.STRtree(strokes).query(strokes, predicate="intersects")
    for one, other in found.T[found[0] < found[1]]:
        pair = strokes[[one, other]]
        if shapely.relate_pattern(*pair, MEET_IN_ENDS) or meet_in_ends(pair):
            continue
        place = shapely.intersection(*pair).representative_point()
        near = areas.query(place, predicate="intersects")
        name = slopes[near[0]].id if len(near) else ""
        yield Finding(name, "crossing", f"strokes {one + 1} and {other + 1} cross", place)


def meet_in_ends(pair: "NDArray[np.object_]") -> bool:
    """Whether all that two strokes have in common are ends of theirs, but for rounding."""
    reach, common = rounding_of(shapely.union_all(pair)), shapely.intersection(*pair)
    ends = shapely.union_all(shapely.boundary(pair))
    places = shapely.points(shapely.get_coordinates(common))
    off = shapely.distance(places, ends)  # NaN if both are closed and have no ends
    return bool(common.length <= reach and (off <= reach).all())


def outside(
    strokes: "NDArray[np.object_]", slopes: "Sequence[Slope]", reach: float
) -> Iterator[Finding]:
    """Find strokes off every slope, and parts that stick out of theirs by more than a reach."""
    areas = np.array([*(slope.area for slope in slopes), None], dtype=object)[:-1]
    edges = shapely.STRtree(shapely.boundary(areas))
    owner = owners(strokes, areas, reach)
    for row in np.flatnonzero(owner == NO_SLOPE):
        if strokes[row] is not None and not strokes[row].is_empty:
            long = f"{strokes[row].length:.3g} long"
            reason = f"stroke {row + 1}, {long}, is outside of every slope"
            yield Finding("", "outside", reason, middle_of(strokes[row]))
    for k in np.unique(owner[owner != NO_SLOPE]):
        rows = np.flatnonzero(owner == k)
        for part, row in zip(*outside_of(strokes[rows], areas[k], reach), strict=True):
            near = edges.query(part, predicate="dwithin", distance=reach)
            ribbons = shapely.union_all(shapely.buffer(edges.geometries[near], reach))
            if not ribbons.covers(part):
                reason = f"{part.length:.3g} of stroke {rows[row] + 1} is outside of the slope"
                yield Finding(slopes[k].id, "outside", reason, middle_of(part))


def owners(strokes: "NDArray[np.object_]", areas: "NDArray[np.object_]", reach: float) -> "Ints":
    """Slope that holds most of each stroke, but for a reach; ``NO_SLOPE`` if none has any of it."""
    grown = shapely.buffer(areas, reach)
    shapely.prepare(grown)
    row, k = shapely.STRtree(grown).query(strokes)
    held = shapely.length(strokes[row])
    is_part = ~shapely.covers(grown[k], strokes[row])
    held[is_part] = shapely.length(shapely.intersection(strokes[row[is_part]], grown[k[is_part]]))
    owner = np.full(len(strokes), NO_SLOPE)
    rising = np.lexsort((-k, held))
    rising = rising[held[rising] > 0.0]
    owner[row[rising]] = k[rising]  # the last one that is written stays
    return owner


def middle_of(line: LineString) -> Point:
    """Middle of a line."""
    return shapely.force_2d(line).interpolate(0.5, normalized=True)
