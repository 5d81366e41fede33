"""Placing strokes anew where calm ones do not do."""

import numpy as np

from midrib.hatching.laying import Found, draw_at, ratios_of
from midrib.hatching.rule import Rule
from midrib.kernels.ladder import TAU, THETA, Strokes, turn_rungs
from midrib.kernels.placing import choose_places
from midrib.types import Bools, Floats

__all__ = ["improved"]

BESIDE = 6  # calm strokes on either side of trouble that are placed anew too


def improved(found: Found, rule: Rule, offset: float, stiffness: float) -> Found:
    """Place strokes anew where they had to be mended: turned, they ask for other gaps.

    Each stretch in trouble, with some calm strokes beside it, is filled by the cheapest sequence of
    chords. What comes of it is taken only if it is better.
    """
    strokes, kept, ground = found
    middle, ladder = ground.middle, ground.ladder
    if kept.size < 2 or not (trouble := found.trouble(rule)).any():
        return found
    ratios = ratios_of(strokes, ground, rule)
    calm = ~(trouble[: ratios.size] | np.roll(trouble, -1)[: ratios.size])
    stretch = float(np.median(ratios[calm])) if np.count_nonzero(calm) > 1 else 1.0
    chosen = []
    for first, last in stretches(trouble, middle.is_closed):
        if middle.is_closed and first < 0:
            return found  # no calm stroke to begin with
        new = choose_places(
            ladder, strokes, ground.spacing, first, last, offset, stretch, stiffness,
            middle.periods,
        )  # fmt: skip
        if not len(new):
            return found
        chosen.append((first, last, new))
    stations, turns = spliced(strokes, chosen, middle.periods[2])
    if middle.is_closed and (len(stations) - len(kept)) % len(rule.pattern):
        return found
    tau, period = ladder.rungs[:, TAU], middle.periods[2] or None
    theta = ladder.rungs[:, THETA] + np.interp(tau, stations, turns, period=period)
    turned = ground._replace(ladder=turn_rungs(ladder, theta, ground.spacing))
    other = draw_at(turned, stations, stiffness, is_final=True)
    return other if other.badness(rule) < found.badness(rule) else found


def stretches(trouble: Bools, is_closed: bool) -> list[tuple[int, int]]:
    """First and last stroke of each stretch, calm ones; -1 at an end of the slope."""
    n = trouble.size
    near = trouble.copy()
    for k in range(1, BESIDE + 1):
        for way in (-k, k):
            moved = np.roll(trouble, way)
            if not is_closed:
                moved[(slice(n + way, None) if way < 0 else slice(0, way))] = False
            near |= moved
    if near.all():
        return [(-1, -1)]
    first = int(np.argmin(near)) if is_closed else 0
    edges = np.flatnonzero(np.diff(np.roll(near, -first), prepend=False, append=False))
    found = []
    for low, high in edges.reshape(-1, 2).tolist():
        is_open_first, is_open_last = not is_closed and low == 0, not is_closed and high == n
        a, b = low - 1 + first, high + first
        found.append((-1 if is_open_first else a % n, -1 if is_open_last else b % n))
    return found


def spliced(
    strokes: Strokes, chosen: list[tuple[int, int, Floats]], period: float
) -> tuple[Floats, Floats]:
    """Stations and turns of all strokes in order, those of some stretches replaced."""
    station = strokes.pivot[:, 0]
    stays = np.ones(station.size, dtype=np.bool_)
    for first, last, _ in chosen:
        stop = station.size if last < 0 else last
        if first < stop:
            stays[first + 1 : stop] = False
        else:  # round a closed slope
            stays[first + 1 :], stays[:stop] = False, False
    old = np.column_stack([station[stays], np.zeros(np.count_nonzero(stays))])
    rows = np.concatenate([old, *(new for _, _, new in chosen)])
    order = rows[:, 0]
    if period > 0.0:  # as before: the stroke that is now where the first one was is the first
        start = station[0] - (station[1] - station[0]) / 2.0
        order = (order - start) % period
    at, turn = rows[np.argsort(order)].T
    return at, turn
