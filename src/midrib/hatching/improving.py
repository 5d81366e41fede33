"""Placing strokes anew where calm ones do not do."""

import numpy as np

from midrib.hatching.bounds import Laid
from midrib.hatching.laying import Found, Ground, draw_at
from midrib.hatching.mirror import is_own_mirror
from midrib.hatching.rule import Rule
from midrib.kernels.fans import Wanted
from midrib.kernels.gauging import LEAN, NORMAL, STEP, Course, allowed_turns
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
LONGER = 1.05  # how much longer than before a step along an edge may be if there are fewer strokes
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
    ends = stretches(trouble, kept, ground.middle.is_closed)
    spans = [span(found, first, last) for first, last in ends]
    allowed, upright = bounds_at_rungs(ground, spans)
    chosen: list[Chosen] = []
    for first, last in ends:
        inner = (last - first - 1) % kept.size if ground.middle.is_closed else 0
        wanted = Wanted(offset, stretch, stiffness, period, (inner + 1) % period)
        new = choose_places(
            ground.ladder, found.strokes, ground.spacing, first, last, wanted,
            ground.middle.periods, allowed, upright,
        )  # fmt: skip
        if len(new):
            chosen.append((first, last, new))
    other = with_chosen(found, chosen, stiffness)
    now, better = other.laid(rule), []
    for part in chosen:
        between = span(found, *part[:2])
        if is_better(other, now, found, laid, between, offset):
            better.append(part)
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
    rows = best.strokes.pivot[best.kept]
    rows = np.column_stack([rows[:, 0], rows[:, 4] - rows[:, 3]])
    rows = rows[(rows[:, 0] > low) & (rows[:, 0] < high)]
    axis = draw_turned(ladder, np.array([length / 2.0]), np.zeros(1), ground.spacing)
    ends = Strokes(
        *(np.concatenate([old[[first]], new]) for old, new in zip(found.strokes, axis, strict=True))
    )
    allowed, upright = bounds_at_rungs(ground, [(0.0, length)])
    half = choose_places(
        ladder, ends, ground.spacing, min(first, 0), 1, wanted, periods, allowed, upright
    )
    halves = [(half, True)] if len(half) else []
    for some in (rows, np.column_stack([length - rows[::-1, 0], -rows[::-1, 1]])):
        for room in AXIS_ROOMS:
            near = some[some[:, 0] < length / 2.0 - room * axis.pivot[0, 5]]
            halves += [(near, False), (near, True)]
    images = [with_image(near, length, has_axis) for near, has_axis in halves]
    chosen, least = best, best.badness(laid, (0.0, length), wanted.offset)
    least = (least[0], WORSE[0] * least[1] + WORSE[1] * (least[1] > 0.0), np.inf)
    for image in images:
        if not len(image):
            continue
        other = with_chosen(found, [*others, (first, last, image)], stiffness)
        now = other.laid(rule)
        badness = other.badness(now, (0.0, length), wanted.offset)
        if badness < least and not is_barer(now, laid):
            chosen, least = other, badness
    return chosen


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


def is_better(
    other: Found, now: Laid, found: Found, laid: Laid, between: tuple[float, float], offset: float
) -> bool:
    """Whether other strokes are less bad, and not fewer that leave an edge bare for longer."""
    if not other.badness(now, between, offset) < found.badness(laid, between, offset):
        return False
    return not is_barer(now, laid)


def is_barer(now: Laid, before: Laid) -> bool:
    """Whether there are fewer strokes than before and an edge is without one for longer."""
    is_fewer = now.station.size < before.station.size
    return is_fewer and now.longest_step > LONGER * before.longest_step


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
    station, asked, chord = strokes.pivot[:, 0], strokes.pivot[:, 5], strokes.chord
    local = strokes.pivot[:, 6]
    laid = Laid(curves, station, chord[:, :2], chord[:, 2:6], asked, local)
    line, widths = Course(*curves.middle), np.minimum(chord[:, 6], MOST_LOCAL * local)
    allowed, upright = np.full(tau.size, np.inf), np.full((tau.size, 2), np.nan)
    allowed[near] = allowed_turns(line, station.copy(), widths, asked.copy())
    upright[near] = laid.gauged[:, [NORMAL, LEAN]]
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


def stretches(trouble: Bools, kept: Bools, is_closed: bool) -> list[tuple[int, int]]:
    """First and last stroke of each stretch, calm ones; -1 at an end of the slope.

    Round a closed slope without a calm one, a stretch leads from one stroke that stays to itself.
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
        some = kept if trouble[kept].all() else ~trouble
        row = int(np.argmax(some))
        return [(row, row)] if some.any() else []
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
