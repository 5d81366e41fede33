"""From whole strokes to a hatching: which are drawn, how long, and what there is to say."""

from typing import Any, NamedTuple

import numpy as np
import shapely
from shapely import MultiPolygon, Point, Polygon

from midrib.errors import GeometryTypeError, InvalidAreaError
from midrib.hatching.bare import bare_stretches
from midrib.hatching.bounds import Curves, Laid, excesses
from midrib.hatching.matching import Drawn
from midrib.hatching.rule import Rule
from midrib.strip import Strip
from midrib.types import Bools, Floats

__all__ = ["Finished", "Problem", "finish", "islands_of", "lines_of", "zones_of"]

TINY = 2.0**-1000
LEAST_FOOT = 0.25  # of a gap: ends of strokes are not nearer to each other


class Problem(NamedTuple):
    """A place where a hatching is not what the rule asks for, and why."""

    where: Point
    reason: str


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
    zones: Any,
    strip: Strip,
    curves: Curves | None,
    offset: float,
) -> Finished:
    """Decide what is drawn.

    The pattern counts the strokes that have a place, whether a zone hides them or not. With curves,
    the middle line and the edges, strokes are kept apart, and where edges are bare or a bound is
    exceeded is told.
    """
    problems = [Problem(Point(p), drawn.reason) for p in drawn.middle[~drawn.kept]]
    if not drawn.kept.size:
        reason = f"the slope is shorter than a gap, {rule.least_gap:.3g} at least; none is drawn"
        problems.append(Problem(strip.main.interpolate(0.5, normalized=True), reason))
    width = np.hypot(*(drawn.on_toe - drawn.on_top).T)
    kept = drawn.kept & (width >= least)
    if drawn.kept.any() and not kept.any():
        middle = drawn.middle[len(drawn.middle) // 2]
        reason = f"the slope is nowhere as wide as the shortest stroke, {least:.3g}; none is drawn"
        problems.append(Problem(Point(middle), reason))
    problems += too_narrow(drawn, kept, strip)
    gap = rule.gaps(width)
    if curves is not None:
        kept &= ~too_near(drawn, kept, gap, problems)
    is_long = np.zeros(kept.size, dtype=np.bool_)
    letters = pattern_from(rule.pattern, first)
    is_long[kept] = [letters[k % len(letters)] == "L" for k in range(np.count_nonzero(kept))]
    # What is drawn of a short one is not shorter than the shortest stroke either.
    short = np.clip(least / np.maximum(width, TINY), rule.short_ratio, 1.0)
    share = np.where(is_long, 1.0, short)
    if curves is not None:
        shorten(drawn, kept & is_long, gap, share, problems)
        ends = drawn.on_top[kept], drawn.on_toe[kept], drawn.feet[kept]
        for bare in bare_stretches((curves.top, curves.toe), rule, *ends, least):
            reason = f"the {bare.edge} has no stroke for {bare.length:.3g} here"
            problems.append(Problem(bare.where, reason))
    meet_islands(drawn, kept, share, strip, problems)
    if curves is not None:
        problems += beyond_bounds(drawn, kept, is_long, share, rule, curves, offset)
    if zones is not None:
        rows = np.flatnonzero(kept)
        lines = lines_of(drawn.on_top[rows], drawn.on_toe[rows], share[rows])
        kept[rows[shapely.intersects(lines, zones)]] = False
    return Finished(kept, is_long, share, problems)


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


def too_near(drawn: Drawn, kept: Bools, gap: Floats, problems: list[Problem]) -> Bools:
    """Which strokes begin so near to the one before that only one of them can be drawn."""
    near = np.zeros(kept.size, dtype=np.bool_)
    if are_apart(drawn.on_top, kept, gap):
        return near
    last = -1
    for row in np.flatnonzero(kept).tolist():
        if last >= 0 and off(drawn.on_top, last, row) < LEAST_FOOT * (gap[last] + gap[row]) / 2.0:
            near[row] = True
            reason = "strokes would begin too near to each other; one is left out"
            problems.append(Problem(Point(drawn.on_top[row]), reason))
        else:
            last = row
    return near


def shorten(
    drawn: Drawn, whole: Bools, gap: Floats, share: Floats, problems: list[Problem]
) -> None:
    """Let whole strokes end where the one before is still far enough, if not at the toe."""
    if are_apart(drawn.on_toe, whole, gap):
        return
    last = -1
    for row in np.flatnonzero(whole).tolist():
        least = LEAST_FOOT * (gap[last] + gap[row]) / 2.0
        foot = off(drawn.on_toe, last, row) if last >= 0 else np.inf
        if foot >= least:
            last = row
            continue
        head = off(drawn.on_top, last, row)
        share[row] = min(max((head - least) / (head - foot), 0.0), 1.0) if head > foot else 1.0
        reason = "whole strokes would end too near to each other; one ends before the toe"
        problems.append(Problem(Point(drawn.on_toe[row]), reason))


def are_apart(points: Floats, chosen: Bools, gap: Floats) -> bool:
    """Whether ends of chosen strokes are as far from each other as they have to be."""
    steps, gaps = np.diff(points[chosen], axis=0), gap[chosen]
    return bool((np.hypot(*steps.T) >= LEAST_FOOT * (gaps[1:] + gaps[:-1]) / 2.0).all())


def off(points: Floats, i: int, j: int) -> float:
    """Distance between two points."""
    return float(np.hypot(points[j, 0] - points[i, 0], points[j, 1] - points[i, 1]))


def meet_islands(
    drawn: Drawn, kept: Bools, share: Floats, strip: Strip, problems: list[Problem]
) -> None:
    """Leave out strokes that meet an island."""
    islands = islands_of(strip)
    if not islands:
        return
    rows = np.flatnonzero(kept)
    lines = lines_of(drawn.on_top[rows], drawn.on_toe[rows], share[rows])
    for island in islands:
        for row in rows[shapely.intersects(lines, island)]:
            if kept[row]:
                kept[row] = False
                reason = "an island of the slope is in the way; one stroke is left out"
                problems.append(Problem(Point(drawn.middle[row]), reason))


def beyond_bounds(
    drawn: Drawn, kept: Bools, is_long: Bools, share: Floats, rule: Rule,
    curves: Curves, offset: float,
) -> list[Problem]:  # fmt: skip
    """Tell where strokes exceed a bound, but between two of which one is left out: that is told."""
    rows = np.flatnonzero(kept)
    ends = np.column_stack([drawn.on_top[rows], drawn.on_toe[rows]])
    asked = rule.gaps(np.hypot(*(drawn.on_toe[rows] - drawn.on_top[rows]).T))
    on_edge = is_long[rows] & (share[rows] == 1.0)
    laid = Laid(curves, drawn.station[rows], drawn.feet[rows], ends, asked, on_edge)
    return [Problem(found.where, found.reason) for found in excesses(laid, offset)]


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
