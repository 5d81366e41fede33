"""Slopes of lines alone: which toe belongs to which top.

A top and a toe that are each other's nearest are a pair. A top that is left over takes the toe
nearest to it, and a toe the top: the crest of a dyke has two toes, the bottom of a ditch two tops.
How near two lines are is told by their ends, whichever way they run; closed lines go together only.
"""

from collections.abc import Sequence

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.formats.gathering import Gathered, check_area
from midrib.hatching.slope import Slope, SlopeError
from midrib.strip import Strip

__all__ = ["add_pairs", "joined"]


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
    """Keep a slope for each pair of a top and a toe; lines that have no partner are refused."""
    apart = np.array([[distance(top, toe) for toe in toes] for top in tops])
    apart = apart.reshape(len(tops), len(toes))
    pairs = set()
    if apart.size:
        nearest_toe, nearest_top = apart.argmin(axis=1), apart.argmin(axis=0)
        mutual = {(i, j) for i, j in enumerate(nearest_toe) if nearest_top[j] == i}
        used_tops, used_toes = ({pair[side] for pair in mutual} for side in (0, 1))
        pairs = mutual
        pairs |= {(i, nearest_toe[i]) for i in range(len(tops)) if i not in used_tops}
        pairs |= {(nearest_top[j], j) for j in range(len(toes)) if j not in used_toes}
        pairs = {pair for pair in pairs if np.isfinite(apart[pair])}
    for number, (i, j) in enumerate(sorted(pairs), start=1):
        with found.refusing(f"{source}/{number}"):
            found.add(slope_of(f"{source}/{number}", tops[i], toes[j], source, crs))
    for name, lines, side in (("top", tops, 0), ("toe", toes, 1)):
        for k in sorted({*range(len(lines))} - {int(pair[side]) for pair in pairs}):
            with found.refusing(f"{name} {k + 1}"):
                msg = f"no line goes with this {name}"
                raise SlopeError(msg, shapely.get_coordinates(lines[k])[0])


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
