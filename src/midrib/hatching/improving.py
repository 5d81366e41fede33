"""Placing strokes anew where calm ones do not do."""

import numpy as np

from midrib.hatching.bare import bare_stretches
from midrib.hatching.bounds import Laid
from midrib.hatching.laying import Found, Ground, draw_at
from midrib.hatching.middle import LONGEST_SIDE
from midrib.hatching.mirror import is_own_mirror
from midrib.hatching.rule import LEAST_LENGTH, Rule
from midrib.kernels.fans import Wanted
from midrib.kernels.gauging import STEP, Course, allowed_turns, leans
from midrib.kernels.ladder import (
    MOST_LOCAL,
    TAU,
    THETA,
    Strokes,
    draw_strokes,
    draw_turned,
    turn_rungs,
)
from midrib.kernels.placing import choose_places
from midrib.types import Bools, Floats

__all__ = ["improved"]

AXIS_ROOMS = (0.0, 0.25, 0.5, 0.75)  # gaps on either side of an axis that half the strokes leave
WORSE = (1.1, 0.3)  # how much farther beyond bounds strokes may be for being their own mirror image
AS_BAD = 1.05  # of images that are as bad but for so much, the evenest is taken
IN_TROUBLE = 1.2  # as bad as being oblique by so much, for a stroke that stays
BESIDE = 6  # calm strokes on either side of trouble that are placed anew too
Chosen = tuple[int, int, Floats]  # first and last stroke of a stretch, which stay; and new ones


def improved(found: Found, rule: Rule, offset: float, stiffness: float) -> Found:
    """Place strokes anew where they are beyond a bound: turned, they ask for other gaps.

    Each stretch in trouble, with some calm strokes beside it, is filled by the cheapest sequence of
    chords. What comes of it is taken where it is better.
    """
    kept, ground, laid = found.kept, found.ground, found.laid(rule)
    if kept.size < 2 or not (trouble := found.trouble(laid)).any():
        return found
    steps = laid.between(STEP)
    stretch = float(np.median(steps)) if steps.size > 1 else 1.0
    period = len(rule.pattern) if ground.middle.is_closed else 1
    oblique = found.strokes.chord[:, 6] / found.strokes.pivot[:, 6]
    ends = stretches(trouble, kept, ground.middle.is_closed, oblique)
    spans = [span(found, first, last) for first, last in ends]
    allowed, upright = bounds_at_rungs(ground, spans)
    chosen: list[Chosen] = []
    for first, last in ends:
        inner = (last - first - 1) % kept.size if ground.middle.is_closed else 0
        wanted = Wanted(offset, stretch, stiffness, period, (inner + 1) % period)
        new = choose_places(
            ground.ladder, found.strokes, ground.spacing, first, last,
            rows_between(found, first, last), wanted, ground.middle.periods, allowed, upright,
        )  # fmt: skip
        if len(new):
            chosen.append((first, last, new))
    other = with_chosen(found, chosen, stiffness)
    now, better = other.laid(rule), []
    for part in chosen:
        between = span(found, *part[:2])
        if other.badness(now, between, offset) < found.badness(laid, between, offset):
            better.append(part)
    if better and is_barer(now, laid, rule):
        better = []
    best = other if len(better) == len(chosen) else with_chosen(found, better, stiffness)
    if ground.middle.is_closed:
        return best
    wanted = Wanted(offset, stretch, stiffness, 1, 0)
    return mirrored(found, best, chosen, rule, wanted, stiffness)


def mirrored(
    found: Found, best: Found, parts: list[Chosen], rule: Rule, wanted: Wanted, stiffness: float
) -> Found:
    """Strokes of a slope that is its own mirror image, so that they are theirs, if not much worse.

    Tried are either half of the best ones with its image, with a stroke on the axis and without,
    and the cheapest sequence from an end to a stroke on the axis.
    """
    ground, laid = found.ground, best.laid(rule)
    ladder, length, periods = ground.ladder, ground.middle.length, ground.middle.periods
    spans = [(part, span(found, *part[:2])) for part in parts]
    inner = [part[:2] for part, (low, high) in spans if low < length / 2.0 < high]
    if not inner or not is_own_mirror(ground.curves.top, ground.curves.toe):
        return best
    first, last = with_its_image(*inner[0], found.kept.size)
    low, high = span(found, first, last)
    others = [part for part, (a, b) in spans if not (a < high and low < b)]
    rows = rows_between(best, first, last)
    axis = draw_turned(ladder, np.array([length / 2.0]), np.zeros(1), ground.spacing)
    ends = Strokes(
        *(np.concatenate([old[[first]], new]) for old, new in zip(found.strokes, axis, strict=True))
    )
    allowed, upright = bounds_at_rungs(ground, [(0.0, length)])
    half = choose_places(
        ladder, ends, ground.spacing, min(first, 0), 1, rows[rows[:, 0] < length / 2.0], wanted,
        periods, allowed, upright,
    )  # fmt: skip
    halves = [(half, True)] if len(half) else []
    for some in (rows, np.column_stack([length - rows[::-1, 0], -rows[::-1, 1]])):
        for room in AXIS_ROOMS:
            near = some[some[:, 0] < length / 2.0 - room * axis.pivot[0, 5]]
            halves += [(near, False), (near, True)]
    images = [with_image(near, length, has_axis) for near, has_axis in halves]
    missing, beyond, _ = best.badness(laid, (0.0, length), wanted.offset)
    most = missing, WORSE[0] * beyond + WORSE[1] * (beyond > 0.0), np.inf
    tried = []
    for image in images:
        if not len(image):
            continue
        other = with_chosen(found, [*others, (first, last, image)], stiffness)
        now = other.laid(rule)
        badness = other.badness(now, (0.0, length), wanted.offset)
        if badness < most and not is_barer(now, laid, rule):
            tried.append((badness, other))
    if not tried:
        return best
    missing, beyond, _ = min(badness for badness, _ in tried)
    as_good = [one for one in tried if one[0][0] == missing and one[0][1] <= AS_BAD * beyond]
    return min(as_good, key=lambda one: one[0][2])[1]


def with_its_image(first: int, last: int, count: int) -> tuple[int, int]:
    """First and last stroke of a stretch across the axis that is its own image."""
    if first < 0 or last < 0:
        return -1, -1
    first = min(first, count - 1 - last)
    return first, count - 1 - first


def with_image(rows: Floats, length: float, has_axis: bool) -> Floats:
    """Stations and turns of half the strokes, of one on the axis perhaps, and of the other half."""
    axis = np.array([[length / 2.0, 0.0]])[: int(has_axis)]
    image = np.column_stack([length - rows[::-1, 0], -rows[::-1, 1]])
    return np.concatenate([rows, axis, image])


def is_barer(now: Laid, before: Laid, rule: Rule) -> bool:
    """Whether there are fewer strokes than before and more of an edge is bare."""
    if now.station.size >= before.station.size:
        return False
    bare = bare_length(now, rule)
    return bare > 0.0 and bare > bare_length(before, rule)


def bare_length(laid: Laid, rule: Rule) -> float:
    """Length of both edges that is bare."""
    edges, side = laid.curves[1:], LONGEST_SIDE * float(laid.local.mean())
    least = LEAST_LENGTH * rule.least_gap
    return sum(b.length for b in bare_stretches(edges, rule, laid.feet, laid.asked, least, side))


def bounds_at_rungs(ground: Ground, spans: list[tuple[float, float]]) -> tuple[Floats, Floats]:
    """How far neighbours may turn at each rung, and how far strokes may lean from what, in radians.

    Only from some stations to others; elsewhere it is infinite and NaN.
    """
    ladder, curves = ground.ladder, ground.curves
    tau, period = ladder.rungs[:, TAU], ground.middle.periods[2]
    near = np.zeros(tau.size, dtype=np.bool_)
    for low, high in spans:
        ahead = (tau - low) % period if period > 0.0 else tau - low
        near |= (ahead >= 0.0) & (ahead <= high - low)
    near |= np.roll(near, 1) | np.roll(near, -1)
    strokes = draw_strokes(ladder, tau[near], ground.spacing)
    station, asked, local = (strokes.pivot[:, column].copy() for column in (0, 5, 6))
    line, top, toe = (Course(*curve) for curve in curves)
    widths = np.minimum(strokes.chord[:, 6], MOST_LOCAL * local)
    allowed, upright = np.full(tau.size, np.inf), np.full((tau.size, 2), np.nan)
    allowed[near] = allowed_turns(line, station, widths, asked)
    upright[near] = leans(top, toe, strokes.chord[:, :2].copy(), widths)
    return allowed, upright


def with_chosen(found: Found, chosen: list[Chosen], stiffness: float) -> Found:
    """Strokes, some stretches of them replaced."""
    if not chosen:
        return found
    ground = found.ground
    ladder, periods = ground.ladder, ground.middle.periods
    stations, turns = spliced(found.strokes, chosen, periods[2])
    tau = ladder.rungs[:, TAU]
    order = np.argsort(stations)
    at, by = stations[order], turns[order]
    theta = ladder.rungs[:, THETA] + np.interp(tau, at, by, period=periods[2] or None)
    drawn = draw_at(ground, stations, stiffness, turns)
    turned = ground._replace(ladder=turn_rungs(ladder, theta, ground.spacing))
    return drawn._replace(ground=turned)


def span(found: Found, first: int, last: int) -> tuple[float, float]:
    """Stations from which to which a stretch reaches."""
    station, middle = found.strokes.pivot[:, 0], found.ground.middle
    low = float(station[first]) if first >= 0 else 0.0
    high = float(station[last]) if last >= 0 else middle.length
    return low, high + (middle.periods[2] if middle.is_closed and high <= low else 0.0)


def rows_between(found: Found, first: int, last: int) -> Floats:
    """Stations and turns of the strokes that stay inside a stretch, on beyond a closed seam."""
    pivot, period = found.strokes.pivot[found.kept], found.ground.middle.periods[2]
    low, high = span(found, first, last)
    ahead = (pivot[:, 0] - low) % period if period > 0.0 else pivot[:, 0] - low
    inner = np.flatnonzero((ahead > 0.0) & (ahead < high - low))
    inner = inner[np.argsort(ahead[inner])]
    return np.column_stack([low + ahead, pivot[:, 4] - pivot[:, 3]])[inner]


def stretches(
    trouble: Bools, kept: Bools, is_closed: bool, oblique: Floats | None = None
) -> list[tuple[int, int]]:
    """First and last stroke of each stretch, calm ones; -1 at an end of the slope.

    Round a closed slope without a calm one, a stretch leads from one stroke that stays to itself:
    the least oblique one, and no one in trouble if that is little more so. ``oblique`` is lengths
    over local widths.
    """
    n = trouble.size
    near = trouble.copy()
    for k in range(1, BESIDE + 1):
        for way in (-k, k):
            moved = np.roll(trouble, way)
            if not is_closed:
                moved[(slice(n + way, None) if way < 0 else slice(0, way))] = False
            near |= moved
    if near.all():
        if not is_closed:
            return [(-1, -1)]
        rank = (np.ones(n) if oblique is None else oblique) * np.where(trouble, IN_TROUBLE, 1.0)
        row = int(np.argmin(np.where(kept, rank, np.inf)))
        return [(row, row)] if kept.any() else []
    first = int(np.argmin(near)) if is_closed else 0
    edges = np.flatnonzero(np.diff(np.roll(near, -first), prepend=False, append=False))
    found = []
    for low, high in edges.reshape(-1, 2).tolist():
        is_open_first, is_open_last = not is_closed and low == 0, not is_closed and high == n
        a, b = low - 1 + first, high + first
        found.append((-1 if is_open_first else a % n, -1 if is_open_last else b % n))
    return found


def spliced(strokes: Strokes, chosen: list[Chosen], period: float) -> tuple[Floats, Floats]:
    """Stations and turns of all strokes in order, those of some stretches replaced."""
    station = strokes.pivot[:, 0]
    stays = np.ones(station.size, dtype=np.bool_)
    for first, last, _ in chosen:
        stop = station.size if last < 0 else last
        if first < stop:
            stays[first + 1 : stop] = False
        else:  # round a closed slope
            stays[first + 1 :], stays[:stop] = False, False
    old = np.column_stack([station, strokes.pivot[:, 4] - strokes.pivot[:, 3]])[stays]
    rows = np.concatenate([old, *(new for _, _, new in chosen)])
    order = rows[:, 0]
    if period > 0.0:  # as before: the stroke that is now where the first one was is the first
        start = station[0] - (station[1] - station[0]) / 2.0
        order = (order - start) % period
    at, turn = rows[np.argsort(order)].T
    return at, turn
