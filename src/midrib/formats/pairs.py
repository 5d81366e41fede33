r"""Slopes of lines alone: which toe belongs to which top.

A top and a toe that are each other's nearest are a pair. A top that is left over takes the toe
nearest to it, and a toe the top: the crest of a dyke has two toes, the bottom of a ditch two tops.
What would lie on another slope then, or be wider than long, is none. How near two lines are is told
by their ends, whichever way they run; closed lines go together only.

Where heights are known, a top is paired with what is lower only, and a line that is left over may
be the toe of one slope and the top of the next, whichever of the two it is called:

    crest  toe     top   toe        A berm lies between a toe and a top. Its lines may be nearer to
      \                             each other than to those that they belong to, but it does not
       \______ ______               fall. Without heights only a doubt can be told.
              berm   \
"""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.errors import InvalidAreaError
from midrib.formats.gathering import Gathered, check_area, heights_of
from midrib.hatching.edges import Doubt
from midrib.hatching.slope import Slope, SlopeError
from midrib.strip import Strip

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["add_pairs", "joined"]

ON_ANOTHER = 0.01  # of the smaller one's area: slopes that share more are not side by side
SAME = 1e-6  # of its length: a line this near to another all along is that one
FLATTEST = 0.05  # fall over width: paths and berms fall by up to 3 % sideways
RIVAL = 3.0  # times as far away as its partner, or less: this line could be the partner too
NAMES = ("top", "toe")


def joined(pieces: Sequence[LineString]) -> list[LineString]:
    """Lines that pieces make where just two of them meet, whichever way each runs.

    They are in the order of their first pieces, so that slopes and reasons are numbered as the
    lines of the file are.
    """
    known = [piece for piece in pieces if piece.length > 0.0]
    if not known:
        return []
    merged = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(known)))
    middles = shapely.line_interpolate_point(known, 0.5, normalized=True)
    first = shapely.STRtree(merged).nearest(middles).tolist()
    rows = dict.fromkeys([*first, *range(len(merged))])  # all, where some lie on each other too
    return [merged[row] for row in rows]


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
    lines = Lines(joined(tops), joined(toes))
    if not lines.all_pair() and (pieces := Lines(tops, toes)).all_pair():
        lines = pieces
    used: set[int] = set()
    for i, j in lines.mutual_pairs():
        used |= {i, j}
        identifier = f"{source}/{len(found.slopes) + 1}"
        with found.refusing(identifier):
            slope = slope_of(identifier, lines.all[i], lines.all[j], source, crs)
            found.add(slope, lines.doubts(i, j))
    for i, j in lines.spare_pairs(used):
        identifier = f"{source}/{len(found.slopes) + 1}"
        with suppress(InvalidAreaError):  # told below, as a line that has no partner
            slope = slope_of(identifier, lines.all[i], lines.all[j], source, crs)
            if not is_on_another(slope, found.slopes):
                found.add(slope, lines.doubts(i, j))
                used |= {i, j}
    for k in sorted({*range(len(lines.all))} - used):
        with found.refusing(lines.name(k)):
            raise SlopeError(lines.why_alone(k), shapely.get_coordinates(lines.all[k])[0])


class Lines:
    """Tops and toes by number, tops first; how far apart they are, and whether they fall."""

    def __init__(self, tops: Sequence[LineString], toes: Sequence[LineString]) -> None:
        self.all = [*tops, *toes]
        self.n_tops = len(tops)
        self.apart = distances(self.all)  # from each, as a top, to each, as a toe
        self.tree = shapely.STRtree(self.all)
        self.level: set[tuple[int, int]] = set()  # pairs that do not fall
        self.known: dict[tuple[int, int], bool | None] = {}

    def name(self, k: int) -> str:
        """Name of a line, for messages."""
        is_toe = k >= self.n_tops
        return f"{NAMES[is_toe]} {k - self.n_tops * is_toe + 1}"

    def falls(self, i: int, j: int) -> bool | None:
        """Whether it goes down from one line to another; None if nothing tells."""
        if (i, j) not in self.known:
            self.known[i, j] = falls(self.all[i], self.all[j])
        return self.known[i, j]

    def mutual_pairs(self) -> list[tuple[int, int]]:
        """Pairs of a top and a toe that are each other's nearest, among those that may fall."""
        n = self.n_tops
        apart = self.apart[:n, n:].copy()
        if not apart.size:
            return []
        while True:
            toe, top = apart.argmin(axis=1), apart.argmin(axis=0)
            pairs = [(i, int(j)) for i, j in enumerate(toe) if top[j] == i]
            pairs = [(i, j) for i, j in pairs if np.isfinite(apart[i, j])]
            level = [(i, j) for i, j in pairs if self.falls(i, n + j) is False]
            if not level:
                return [(i, n + j) for i, j in pairs]
            self.level |= {(i, n + j) for i, j in level}
            for pair in level:
                apart[pair] = np.inf

    def all_pair(self) -> bool:
        """Whether every line is one of a pair."""
        return 2 * len(self.mutual_pairs()) == len(self.all)

    def spare_pairs(self, used: set[int]) -> Iterator[tuple[int, int]]:
        """Pairs of a line that is left over and the nearest that it may go with.

        A pair is not wider than long.
        """
        for k in range(len(self.all)):
            if k in used:
                continue
            is_top = k < self.n_tops
            apart = self.apart[k] if is_top else self.apart[:, k]
            for other in np.argsort(apart, kind="stable").tolist():
                if not apart[other] / 2.0 <= max(self.all[k].length, self.all[other].length):
                    break
                i, j = (k, other) if is_top else (other, k)
                has_fall, are_alike = self.falls(i, j), is_top == (other < self.n_tops)
                if has_fall or (has_fall is None and not are_alike):
                    yield i, j
                    break
                if has_fall is False and not are_alike:
                    self.level.add((i, j))

    def doubts(self, i: int, j: int) -> list[Doubt]:
        """Say of a pair without heights that one of its lines could go with another as well."""
        if self.falls(i, j) is not None:
            return []
        n, far = self.n_tops, RIVAL * self.apart[i, j]
        rivals = [(j, k) for k in range(n) if k != i and self.apart[k, j] <= far]
        rivals += [(i, k) for k in range(n, len(self.all)) if k != j and self.apart[i, k] <= far]
        for line, other in rivals:
            if self.are_beside(line, other):
                reason = (
                    f"{self.name(i)} and {self.name(j)} have no heights, and {self.name(other)} is "
                    f"beside this {NAMES[line >= n]} too: a berm or a path is no slope"
                )
                return [Doubt("pairs", reason, self.all[i].interpolate(0.5, normalized=True))]
        return []

    def are_beside(self, i: int, j: int) -> bool:
        """Whether no line lies between two."""
        middle = self.all[i].interpolate(0.5, normalized=True)
        way = shapely.shortest_line(middle, self.all[j])
        return {*self.tree.query(way, predicate="intersects").tolist()} <= {i, j}

    def why_alone(self, k: int) -> str:
        """Say why a line has no partner."""
        what = NAMES[k >= self.n_tops]
        others = sorted({i + j - k for i, j in self.level if k in {i, j}})
        reason = f"no line goes with this {what}"
        if not others:
            return reason
        lies = "lower" if what == "top" else "higher"
        return f"{reason}: {self.name(others[0])} beside it is not {lies} than a path may be"


def falls(top: LineString, toe: LineString) -> bool | None:
    """Whether it goes down from one line to another by more than across a path.

    None if one has no heights, or both are one line. The other line is held against the first one
    beside it, as a whole slope may rise along itself.
    """
    high, low = heights_of(top), heights_of(toe)
    if not len(high) or not len(low):
        return None
    on_top, on_toe = (shapely.points(rows[:, :2]) for rows in (high, low))
    station = top.line_locate_point(on_top)
    order = np.argsort(station)
    beside = np.interp(top.line_locate_point(on_toe), station[order], high[order, 2])
    width = float(np.mean(shapely.distance(on_toe, top)))
    return bool(np.median(beside - low[:, 2]) > FLATTEST * width)


def distances(lines: Sequence[LineString]) -> "Floats":
    """How far the ends of lines are apart; infinite if just one of two is closed, or they are one.

    Of closed lines it is the Hausdorff distance, if neither is quite beside the other.
    """
    ends = np.array([shapely.get_coordinates(line)[[0, -1]] for line in lines]).reshape(-1, 2, 2)
    apart = np.empty((len(lines), len(lines)))
    for k, own in enumerate(ends):  # row by row, as all differences at once take 4 times the memory
        straight, crosswise = (np.hypot(*(ends - way).T).sum(axis=0) for way in (own, own[::-1]))
        apart[k] = np.minimum(straight, crosswise)
    closed = np.array([line.is_closed for line in lines], dtype=np.bool_)
    apart[closed[:, None] != closed] = np.inf
    rings = np.flatnonzero(closed)
    apart[np.ix_(rings, rings)] = np.inf
    boxes = shapely.box(*np.array([lines[k].bounds for k in rings.tolist()]).reshape(-1, 4).T)
    for i, j in rings[shapely.STRtree(boxes).query(boxes, predicate="intersects")].T:
        apart[i, j] = shapely.hausdorff_distance(lines[i], lines[j])
    reach = SAME * np.array([line.length for line in lines])
    for i, j in np.argwhere(apart <= reach[:, None]).tolist():
        if i == j or shapely.hausdorff_distance(lines[i], lines[j]) <= reach[i]:
            apart[i, j] = np.inf
    return apart


def is_on_another(slope: Slope, others: Sequence[Slope]) -> bool:
    """Whether a slope lies on another one."""
    for other in others:
        shared = shapely.intersection(slope.area, other.area).area
        if shared > ON_ANOTHER * min(slope.area.area, other.area.area):
            return True
    return False


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
