"""Slopes of lines alone: which toe belongs to which top.

A top and a toe that are each other's nearest are a pair. A top that is left over takes the toe
nearest to it, and a toe the top: the crest of a dyke has two toes, the bottom of a ditch two tops.
What would lie on another slope then, or be wider than long, is none. How near two lines are is told
by their ends, whichever way they run; closed lines go together only.
"""

from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.errors import InvalidAreaError
from midrib.formats.gathering import Gathered, check_area
from midrib.hatching.slope import Slope, SlopeError
from midrib.strip import Strip

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["add_pairs", "joined"]

ON_ANOTHER = 0.01  # of the smaller one's area: slopes that share more are not side by side


def joined(pieces: Sequence[LineString]) -> list[LineString]:
    """Lines that pieces make where just two of them meet, whichever way each runs."""
    if not pieces:
        return []
    merged = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(list(pieces))))
    return [line for line in merged if line.length > 0.0]


def add_pairs(
    found: Gathered,
    tops: Sequence[LineString],
    toes: Sequence[LineString],
    source: str,
    crs: str | None = None,
) -> None:
    """Keep a slope for each pair of a top and a toe; lines that have no partner are refused.

    Pieces that meet are joined, unless each is one of a pair only as it is: edges of two slopes
    may meet in a corner.
    """
    whole = joined(tops), joined(toes)
    if not all_pair(*whole) and all_pair(tops, toes):
        whole = list(tops), list(toes)
    tops, toes = whole
    pairs = mutual_pairs(tops, toes)
    used: list[set[int]] = [{pair[side] for pair in pairs} for side in (0, 1)]
    for i, j in pairs:
        identifier = f"{source}/{len(found.slopes) + 1}"
        with found.refusing(identifier):
            found.add(slope_of(identifier, tops[i], toes[j], source, crs))
    for i, j in spare_pairs(tops, toes, used):
        identifier = f"{source}/{len(found.slopes) + 1}"
        with suppress(InvalidAreaError):  # told below, as a line that has no partner
            slope = slope_of(identifier, tops[i], toes[j], source, crs)
            if not is_on_another(slope, found.slopes):
                found.add(slope)
                used[0].add(i)
                used[1].add(j)
    for name, lines, known in (("top", tops, used[0]), ("toe", toes, used[1])):
        for k in sorted({*range(len(lines))} - known):
            with found.refusing(f"{name} {k + 1}"):
                msg = f"no line goes with this {name}"
                raise SlopeError(msg, shapely.get_coordinates(lines[k])[0])


def all_pair(tops: Sequence[LineString], toes: Sequence[LineString]) -> bool:
    """Whether every line is one of a pair."""
    return len(mutual_pairs(tops, toes)) == len(tops) == len(toes)


def spare_pairs(
    tops: Sequence[LineString], toes: Sequence[LineString], used: list[set[int]]
) -> list[tuple[int, int]]:
    """Pairs of a line that is left over and the one nearest to it, not wider than long."""
    apart = distances(tops, toes)
    if not apart.size:
        return []
    pairs = [(i, int(apart[i].argmin())) for i in range(len(tops)) if i not in used[0]]
    pairs += [(int(apart[:, j].argmin()), j) for j in range(len(toes)) if j not in used[1]]
    return [(i, j) for i, j in pairs if apart[i, j] / 2.0 <= max(tops[i].length, toes[j].length)]


def mutual_pairs(tops: Sequence[LineString], toes: Sequence[LineString]) -> list[tuple[int, int]]:
    """Pairs of lines that are each other's nearest."""
    apart = distances(tops, toes)
    if not apart.size:
        return []
    nearest_toe, nearest_top = apart.argmin(axis=1).tolist(), apart.argmin(axis=0).tolist()
    rows = enumerate(nearest_toe)
    return [(i, j) for i, j in rows if nearest_top[j] == i and np.isfinite(apart[i, j])]


def distances(tops: Sequence[LineString], toes: Sequence[LineString]) -> "Floats":
    """How far every top is from every toe."""
    rows = [[distance(top, toe) for toe in toes] for top in tops]
    return np.array(rows, dtype=np.float64).reshape(len(tops), len(toes))


def is_on_another(slope: Slope, others: Sequence[Slope]) -> bool:
    """Whether a slope lies on another one."""
    for other in others:
        shared = shapely.intersection(slope.area, other.area).area
        if shared > ON_ANOTHER * min(slope.area.area, other.area.area):
            return True
    return False


def distance(line: LineString, other: LineString) -> float:
    """How far the ends of two lines are apart; infinite if just one of the two is closed."""
    if line.is_closed != other.is_closed:
        return float("inf")
    if line.is_closed:
        return float(shapely.hausdorff_distance(line, other))
    ends, others = (shapely.get_coordinates(one)[[0, -1]] for one in (line, other))
    return float(min(np.hypot(*(ends - way).T).sum() for way in (others, others[::-1])))


def slope_of(
    identifier: str, top: LineString, toe: LineString, source: str, crs: str | None
) -> Slope:
    """Slope between two lines, their ends joined by straight caps.

    Raises
    ------
    InvalidAreaError
        If they bound no area.
    """
    if top.is_closed:
        outer, inner = sorted((top, toe), key=lambda ring: -Polygon(ring).area)
        area = check_area(Polygon(outer, [inner]))
    else:
        strip = Strip(top, toe)
        area, toe = strip.area, strip.auxiliary
    return Slope(identifier, "other", area, top, toe, source, {}, crs=crs)
