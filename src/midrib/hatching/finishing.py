"""From whole strokes to a hatching: which are drawn, how long, and what there is to say."""

from typing import Any, NamedTuple

import numpy as np
import shapely
from shapely import MultiPolygon, Point, Polygon

from midrib.errors import GeometryTypeError, InvalidAreaError
from midrib.hatching.bare import bare_stretches
from midrib.hatching.bounds import Curves, Laid, excesses, far_ends
from midrib.hatching.matching import Drawn
from midrib.hatching.middle import LONGEST_SIDE
from midrib.hatching.rule import Rule
from midrib.strip import Strip
from midrib.types import Bools, Floats, Ints

__all__ = ["Finished", "Problem", "finish", "hide", "islands_of", "lines_of", "zones_of"]

TINY, LARGEST = 2.0**-1000, 2.0**1000
LEAST_FOOT = 0.25  # of a gap: ends of strokes are not nearer to each other
MANY = 0.25  # of strokes of a closed slope: if so many are too near, all are thinned out


class Problem(NamedTuple):
    """A place where a hatching is not what the rule asks for, and why.

    ``kind`` is "missing" where a stroke is left out or ends too soon, and "beyond" where strokes
    that are drawn exceed a bound.
    """

    where: Point
    reason: str
    kind: str = "missing"


class Finished(NamedTuple):
    """Which strokes are drawn, and how much of each."""

    kept: Bools
    is_long: Bools
    share: Floats  # of the whole stroke
    problems: list[Problem]


def finish(
    drawn: Drawn,
    rule: Rule,
    least: float,
    first: str | None,
    strip: Strip,
    curves: Curves | None,
    offset: float,
) -> Finished:
    """Decide what is drawn.

    The pattern counts the strokes that have a place, whether a zone hides them afterwards or not.
    With curves, the middle line and the edges, strokes are kept apart, and where edges are bare or
    a bound is exceeded is told.
    """
    problems = [Problem(Point(p), drawn.reason) for p in drawn.middle[~drawn.kept]]
    if not drawn.kept.size:
        reason = too_short(strip, rule, offset)
        problems.append(Problem(strip.main.interpolate(0.5, normalized=True), reason))
    width = np.hypot(*(drawn.on_toe - drawn.on_top).T)
    kept = drawn.kept & (width >= least)
    if drawn.kept.any() and not kept.any():
        middle = drawn.middle[len(drawn.middle) // 2]
        reason = f"the slope is nowhere as wide as the shortest stroke, {least:.3g}; none is drawn"
        problems.append(Problem(Point(middle), reason))
    problems += too_narrow(drawn, kept, strip)
    gap = rule.gaps(width, drawn.local)
    if curves is not None:
        kept &= ~too_near(drawn, kept, gap, len(rule.pattern), strip.is_closed, problems)
        if strip.is_closed:
            problems += pattern_broken(drawn, kept, rule.pattern)
    is_long = np.zeros(kept.size, dtype=np.bool_)
    letters = pattern_from(rule.pattern, first)
    is_long[kept] = [letters[k % len(letters)] == "L" for k in range(np.count_nonzero(kept))]
    # What is drawn of a short one is not shorter than the shortest stroke either.
    short = np.clip(least / np.maximum(width, TINY), rule.short_ratio, 1.0)
    share = np.where(is_long, 1.0, short)
    if curves is not None:
        shorten(drawn, kept & is_long, gap, share, strip.is_closed, problems)
    if curves is not None and kept.any():
        edges, side = (curves.top, curves.toe), LONGEST_SIDE * float(np.mean(drawn.local))
        for bare in bare_stretches(edges, rule, drawn.feet[kept], gap[kept], least, side):
            reason = f"the {bare.edge} has no stroke for {bare.length:.3g} here"
            problems.append(Problem(bare.where, reason))
    meet_islands(drawn, kept, is_long, share, LEAST_FOOT * gap, least, strip, problems)
    if curves is not None:
        problems += beyond_bounds(drawn, kept, is_long, share, gap, curves, offset, least)
    return Finished(kept, is_long, share, problems)


def too_short(strip: Strip, rule: Rule, offset: float) -> str:
    """Reason why no stroke has a place: an offset that is too long, or any gap is."""
    if offset > 1.0 and strip.main.length >= rule.least_gap:
        return f"offset is {offset:,g} gaps from either end, the slope is shorter; none is drawn"
    return f"the slope is shorter than a gap, {rule.least_gap:.3g} at least; none is drawn"


def hide(drawn: Drawn, finished: Finished, zones: Any) -> int:
    """Leave out the strokes that meet a zone, which is no problem unless none is left; how many."""
    rows = np.flatnonzero(finished.kept)
    lines = lines_of(drawn.on_top[rows], drawn.on_toe[rows], finished.share[rows])
    is_hidden = shapely.intersects(lines, zones)
    finished.kept[rows[is_hidden]] = False
    if rows.size and is_hidden.all():
        reason = "zones of exclude hide every stroke; none is drawn"
        middle = Point(drawn.middle[rows[rows.size // 2]])
        finished.problems.append(Problem(middle, reason))
    return int(np.count_nonzero(is_hidden))


def pattern_from(pattern: str, first: str | None) -> str:
    """Return the pattern, begun where it has a long or a short stroke if asked to."""
    if first is None:
        return pattern
    at = pattern.index(first[0].upper())
    return pattern[at:] + pattern[:at]


def too_narrow(drawn: Drawn, kept: Bools, strip: Strip) -> list[Problem]:
    """Strokes left out at necks, narrower than the shortest stroke; tips are no news."""
    reason = "the slope is narrower than the shortest stroke here; one is left out"
    rows = np.flatnonzero(kept)
    inner = drawn.kept & ~kept
    if rows.size and not strip.is_closed:
        inner[: rows[0]], inner[rows[-1] :] = False, False
    return [Problem(Point(p), reason) for p in drawn.middle[inner & kept.any()]]


def too_near(
    drawn: Drawn, kept: Bools, gap: Floats, period: int, is_closed: bool, problems: list[Problem]
) -> Bools:
    """Which strokes begin so near to another that only one of them can be drawn."""
    near = np.zeros(kept.size, dtype=np.bool_)
    if are_apart(drawn.on_top, kept, gap, is_closed):
        return near
    rows = np.flatnonzero(kept)
    stay = evenly(drawn.on_top, kept, gap, period) if is_closed else rows[:0]
    if not stay.size:
        stay = one_by_one(drawn.on_top, rows, gap, is_closed)
    near[rows], near[stay] = True, False
    for row in np.flatnonzero(near).tolist():
        reason = "strokes would begin too near to each other; one is left out"
        problems.append(Problem(Point(drawn.on_top[row]), reason))
    return near


def evenly(points: Floats, kept: Bools, gap: Floats, period: int) -> Ints:
    """Most strokes of a closed slope in whole patterns, as even as can be, that are far enough.

    None if few of them are near: then the others should stay as they are. None either if there is
    not even room for one pattern.
    """
    rows = np.flatnonzero(kept)
    ahead = np.roll(rows, -1)
    steps = np.hypot(*(points[ahead] - points[rows]).T)
    if np.mean(steps < LEAST_FOOT * (gap[ahead] + gap[rows]) / 2.0) < MANY:
        return rows[:0]
    for count in range(rows.size // period * period, 0, -period):
        chosen = every(rows, count)
        some = np.zeros(kept.size, dtype=np.bool_)
        some[chosen] = True
        if are_apart(points, some, gap, True):
            return chosen
    return rows[:0]


def every(rows: Ints, count: int) -> Ints:
    """So many rows, as even as can be."""
    return rows[np.arange(count) * rows.size // count]


def one_by_one(points: Floats, rows: Ints, gap: Floats, is_closed: bool) -> Ints:
    """Strokes that are far enough from the one before; round a closed slope, from a wide gap on."""
    if is_closed:
        steps = np.hypot(*(points[rows] - points[np.roll(rows, 1)]).T)
        rows = np.roll(rows, -int(np.argmax(steps)))
    stay = [int(rows[0])]
    for row in rows[1:].tolist():
        if off(points, stay[-1], row) >= LEAST_FOOT * (gap[stay[-1]] + gap[row]) / 2.0:
            stay.append(row)
    while (
        is_closed
        and len(stay) > 1
        and not (
            off(points, stay[-1], stay[0]) >= LEAST_FOOT * (gap[stay[-1]] + gap[stay[0]]) / 2.0
        )
    ):
        stay.pop()
    return np.array(stay)


def shorten(
    drawn: Drawn, whole: Bools, gap: Floats, share: Floats, is_closed: bool,
    problems: list[Problem],
) -> None:  # fmt: skip
    """Let whole strokes end where the one before is still far enough, if not at the toe."""
    if are_apart(drawn.on_toe, whole, gap, is_closed):
        return
    rows = np.flatnonzero(whole)
    stay = one_by_one(drawn.on_toe, rows, gap, is_closed)
    for row in np.setdiff1d(rows, stay).tolist():
        beside = [stay[(np.searchsorted(stay, row) + k) % stay.size] for k in (-1, 0)]
        for last in beside:
            least = LEAST_FOOT * (gap[last] + gap[row]) / 2.0
            head, foot = off(drawn.on_top, last, row), off(drawn.on_toe, last, row)
            if foot < least and head > foot:
                share[row] = min(share[row], max((head - least) / (head - foot), 0.0))
        if share[row] < 1.0:
            reason = "whole strokes would end too near to each other; one ends before the toe"
            problems.append(Problem(Point(drawn.on_toe[row]), reason))


def pattern_broken(drawn: Drawn, kept: Bools, pattern: str) -> list[Problem]:
    """Tell where a pattern begins anew on a closed slope that has no whole number of them."""
    count = int(np.count_nonzero(kept))
    if count % len(pattern) == 0:
        return []
    where = Point(drawn.middle[np.flatnonzero(kept)[0]])
    some = f"{count} strokes are no whole patterns" if count > 1 else "one stroke is no pattern"
    return [Problem(where, f"{some} {pattern}; it begins anew here", "beyond")]


def are_apart(points: Floats, chosen: Bools, gap: Floats, is_closed: bool) -> bool:
    """Whether ends of chosen strokes are as far from each other as they have to be."""
    rows = np.flatnonzero(chosen)
    before, after = (rows, np.roll(rows, -1)) if is_closed else (rows[:-1], rows[1:])
    steps = np.hypot(*(points[after] - points[before]).T)
    return rows.size < 2 or bool((steps >= LEAST_FOOT * (gap[after] + gap[before]) / 2.0).all())


def off(points: Floats, i: int, j: int) -> float:
    """Distance between two points."""
    return float(np.hypot(points[j, 0] - points[i, 0], points[j, 1] - points[i, 1]))


def meet_islands(
    drawn: Drawn, kept: Bools, is_long: Bools, share: Floats, clear: Floats, least: float,
    strip: Strip, problems: list[Problem],
) -> None:  # fmt: skip
    """Let strokes that would meet an island end before it, or leave them out if it is too near."""
    islands = islands_of(strip)
    if not islands:
        return
    rows = np.flatnonzero(kept)
    lines = lines_of(drawn.on_top[rows], drawn.on_toe[rows], share[rows])
    heads, width = shapely.points(drawn.on_top[rows]), np.hypot(*(drawn.on_toe - drawn.on_top).T)
    free = np.full(rows.size, LARGEST)
    for island in islands:
        free = np.fmin(free, shapely.distance(heads, shapely.intersection(lines, island)))
    free -= np.minimum(clear[rows], free / 2.0)
    for row, room in zip(rows.tolist(), free.tolist(), strict=True):
        if room >= share[row] * width[row]:
            continue
        if room < least or room <= 0.0:
            kept[row] = False
            reason = "an island of the slope is in the way; one stroke is left out"
            problems.append(Problem(Point(drawn.middle[row]), reason))
            continue
        share[row] = room / width[row]
        reason = "an island of the slope is in the way; one stroke ends before it"
        end = drawn.on_top[row] + share[row] * (drawn.on_toe[row] - drawn.on_top[row])
        problems.append(Problem(Point(end), reason))
        is_long[row] = False


def beyond_bounds(
    drawn: Drawn, kept: Bools, is_long: Bools, share: Floats, gap: Floats, curves: Curves,
    offset: float, least: float,
) -> list[Problem]:  # fmt: skip
    """Tell where strokes exceed a bound, but between two of which one is left out: that is told."""
    rows = np.flatnonzero(kept)
    ends = np.column_stack([drawn.on_top[rows], drawn.on_toe[rows]])
    on_edge = is_long[rows] & (share[rows] == 1.0)
    laid = Laid(
        curves, drawn.station[rows], drawn.feet[rows], ends, gap[rows], drawn.local[rows], on_edge
    )
    missing = (np.roll(rows, -1) - rows - 1) % max(kept.size, 1)
    found = [one for one in excesses(laid) if missing[one.row] == 0]
    found += far_ends(laid, offset, least)
    return [Problem(one.where, one.reason, "beyond") for one in found]


def islands_of(strip: Strip) -> list[Polygon]:
    """Return the holes of a slope that are neither its top nor its toe."""
    holes = [Polygon(ring) for ring in strip.area.interiors]
    if not strip.is_closed:
        return holes
    inner = min(strip.main, strip.auxiliary, key=lambda curve: Polygon(curve).area)
    edge = min(holes, key=lambda hole: float(hole.exterior.hausdorff_distance(inner)))
    return [hole for hole in holes if hole is not edge]


def lines_of(on_top: Floats, on_toe: Floats, share: Floats) -> Any:
    """Strokes from the top on, as much of each as its share."""
    end = on_top + share[:, None] * (on_toe - on_top)
    end = np.where((share == 1.0)[:, None], on_toe, end)
    return shapely.linestrings(np.stack([on_top, end], axis=1))


def zones_of(exclude: Any) -> Any:
    """One geometry of all zones, or None.

    Raises
    ------
    GeometryTypeError
        If a zone is not polygonal.
    InvalidAreaError
        If one is not valid.
    """
    if exclude is None:
        return None
    zones = list(np.atleast_1d(np.asarray(exclude, dtype=object)))
    for i, zone in enumerate(zones):
        if not isinstance(zone, Polygon | MultiPolygon):
            kind = getattr(zone, "geom_type", type(zone).__name__)
            msg = f"exclude[{i}] is a {kind}, expected a Polygon or MultiPolygon"
            raise GeometryTypeError(msg)
        if not zone.is_valid:
            msg = f"exclude[{i}] is not valid: {shapely.is_valid_reason(zone)}"
            raise InvalidAreaError(msg)
    return shapely.union_all(zones)
