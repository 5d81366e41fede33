r"""Placing: where strokes are and how they run on a stretch that calm ones do not suit.

At places along the stretch there are fans of chords. Of all sequences of chords that advance on
both edges the cheapest is looked for (``fans``): how many there are, at which places, and in which
directions. Then places and directions become finer around the choice. That is done twice: from
places all along the stretch on, and from the strokes that are there already, which often need to
be moved a little only, as coarse places do not let them. The cheaper outcome is taken.

       first                 last      calm strokes that stay, or an end of the slope
         |  \|/ \|/ \|/ \|/   |
         o   o   o   o   o    o        places, each with a fan of chords; some are left out

place     station along the middle line, counted in rungs of the ladder, on a closed slope on after
          the last one
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.chords import ON_TOE, ON_TOP, shoot
from midrib.kernels.fans import BROKEN, Fans, Wanted, cheapest_way, middle_of_fans
from midrib.kernels.gauging import MOST_TILT, Course, direction_on, is_straight
from midrib.kernels.jit import njit
from midrib.kernels.ladder import (
    LOCAL,
    TAU,
    THETA,
    Ladder,
    Spacing,
    Strokes,
    X,
    Y,
    effective,
    follow,
    gap_at,
)
from midrib.types import Floats, Ints

__all__ = ["choose_places"]

COARSE = 2  # rungs from one place to the next
FAN, STEP = 9, np.pi / 30.0  # directions on either side, 6 degrees each
LIKELY, EQUAL = 2, 1e-9  # directions tried first, on either side; what costs as much, relative
NARROW, NARROWER = 2, 0.5  # directions on either side then, and the step over the one before
FINE, GRAZE, LEAP_OF_FOOT = np.pi / 90.0, 20.0, 0.5  # steps from which on grazes cost; gaps
FINER, LEVELS, AGAIN = (-1.0, 0.0, 1.0), 4, 3  # places then, in steps that are halved as well
ENOUGH = 1.0  # cost
CALM_COST = 5.0  # for each squared radian from the calm direction
TILT_WALL, TILT_ROOM = 20_000.0, 0.01  # for each squared radian beyond the bound, but for so much


class Stretch(NamedTuple):
    """Where strokes are placed."""

    first: int  # strokes at its ends, which stay; -1 for an end of the slope
    last: int
    low: float  # stations there
    high: float


@njit(borrows=True)
def station_at(rungs: Floats, place: float, periods: Floats) -> tuple[int, float, float]:
    """Rung at or before a place, share of the way to the next one, and station; infinite past."""
    lap = rungs.shape[0] - 1
    k = int(np.floor(place))
    share, laps = place - k, 0
    if periods[2] > 0.0:
        laps = k // lap
        k -= laps * lap
    elif k >= lap:
        return lap, 0.0, rungs[lap, TAU] if place == lap else np.inf
    step = rungs[k + 1, TAU] - rungs[k, TAU]
    return k, share, rungs[k, TAU] + share * step + laps * periods[2]


@njit()
def ends_of(ladder: Ladder) -> Floats:
    """Stations of both ends on top, toe and middle line: where the chords next to them end."""
    rungs, lap = ladder.rungs, ladder.rungs.shape[0] - 1
    found = np.full((2, 3), np.nan)
    for row, k in enumerate((1, lap - 1)):
        chord = shoot(ladder.ground, ladder.at[k, 0], rungs[k, X], rungs[k, Y], rungs[k, THETA])
        found[row, 2] = rungs[row * lap, TAU]
        if chord.top_on == ON_TOP and chord.toe_on == ON_TOE:
            found[row, 0], found[row, 1] = chord.s, chord.t
    return found


@njit(borrows=True)
def add_grazes(fans: Fans, step: float) -> None:
    """Let chords cost more beside which others end elsewhere: rounding may send them there."""
    n, m = fans.turn.shape
    for i in range(n):
        for c in range(m - 1):
            if fans.cost[i, c] == np.inf or fans.cost[i, c + 1] == np.inf:
                continue
            wide = max(fans.width[i, c], fans.width[i, c + 1])
            near = LEAP_OF_FOOT * min(fans.gap[i, c], fans.gap[i, c + 1]) + 2.0 * step * wide
            for edge in range(2):
                if abs(fans.feet[i, c + 1, edge] - fans.feet[i, c, edge]) > near:
                    fans.cost[i, c] += GRAZE
                    fans.cost[i, c + 1] += GRAZE


@njit(borrows=True)
def beyond_upright(top: Course, station: float, width: float, theta: float, bound: Floats) -> float:
    """Return how far a stroke leans beyond its bound: of a straight top, or else the one given."""
    off = theta - np.pi / 2.0 - direction_on(top, station, width)
    upright = abs(off - np.pi * np.round(off / np.pi)) - MOST_TILT
    off = theta - bound[0]
    anywhere = abs(off - np.pi * np.round(off / np.pi)) - bound[1]
    if upright <= -TILT_ROOM and anywhere <= -TILT_ROOM:  # whether it is straight does not matter
        return anywhere
    return upright if is_straight(top, station, width) else anywhere


@njit()
def open_fans(
    ladder: Ladder,
    strokes: Strokes,
    rule: Spacing,
    places: Floats,
    half: int,
    step: float,
    stretch: Stretch,
    periods: Floats,
    allowed: Floats,
    upright: Floats,
) -> Fans:
    """Shoot the chords of all fans; of a fixed stroke, the first or the last, only its own one."""
    n, m = places.shape[0], 2 * half + 1
    rungs, lap, mesh = ladder.rungs, ladder.rungs.shape[0] - 1, ladder.ground.mesh
    tau, calm, most = np.empty(n), np.empty(n), np.empty(n)
    turn, feet = np.empty((n, m)), np.empty((n, m, 2))
    width, gap, cost = np.empty((n, m)), np.empty((n, m)), np.full((n, m), np.inf)
    for i in range(n):
        row = stretch.first if i == 0 else stretch.last if i == n - 1 else -1
        if row >= 0:
            tau[i], calm[i] = strokes.pivot[row, 0], strokes.pivot[row, 3]
            most[i] = allowed[min(max(np.searchsorted(rungs[:, TAU], tau[i]), 0), lap)]
            if i > 0 and tau[i] <= tau[0]:  # round a closed slope
                tau[i] += periods[2]
                calm[i] += rungs[lap, THETA] - rungs[0, THETA]
            turn[i, half] = strokes.pivot[row, 4] - strokes.pivot[row, 3]
            feet[i, half, 0], feet[i, half, 1] = strokes.chord[row, 0], strokes.chord[row, 1]
            width[i, half] = effective(strokes.chord[row, 6], strokes.pivot[row, 6])
            gap[i, half], cost[i, half] = strokes.pivot[row, 5], 0.0
            continue
        k, share, tau[i] = station_at(rungs, places[i, 0], periods)
        t, x, y = ladder.at[k, 0], rungs[k, X], rungs[k, Y]
        theta, most[i], local = rungs[k, THETA], allowed[k], rungs[k, LOCAL]
        if share > 0.0:
            on_line = rungs[k, TAU] + share * (rungs[k + 1, TAU] - rungs[k, TAU])
            t, _, x, y = follow(mesh, ladder.line, ladder.arc, t, ladder.at[k, 1], x, y, on_line)
            theta += share * (rungs[k + 1, THETA] - theta)
            local += share * (rungs[k + 1, LOCAL] - local)
        calm[i] = theta
        if periods[2] > 0.0:
            calm[i] += (places[i, 0] // lap) * (rungs[lap, THETA] - rungs[0, THETA])
        for c in range(m):
            turn[i, c] = places[i, 1] + (c - half) * step
            chord = shoot(ladder.ground, t, x, y, theta + turn[i, c])
            if chord.top_on != ON_TOP or chord.toe_on != ON_TOE:
                continue
            feet[i, c, 0], feet[i, c, 1] = chord.s, chord.t
            width[i, c] = effective(chord.width, local)
            gap[i, c] = gap_at(rule, width[i, c])
            cost[i, c] = CALM_COST * turn[i, c] * turn[i, c]
            over = beyond_upright(
                ladder.crest, chord.s, width[i, c], theta + turn[i, c], upright[k]
            )
            if over > -TILT_ROOM:  # not where there is no bound, which is NaN
                room = over + TILT_ROOM
                cost[i, c] += TILT_WALL * room * room + BROKEN * (over > 0.0)
    fans = Fans(tau, calm, most, turn, feet, width, gap, cost)
    if step < FINE:
        add_grazes(fans, step)
    return fans


@njit()
def has_ends(stretch: Stretch) -> tuple[int, int]:
    """1 for each end of a stretch that is a stroke, 0 for an end of the slope."""
    return 1 if stretch.first >= 0 else 0, 1 if stretch.last >= 0 else 0


@njit()
def places_all_along(rungs: Floats, stretch: Stretch, periods: Floats) -> Floats:
    """Every other rung of a stretch as a place, and one for each stroke at its ends."""
    k = 0
    while station_at(rungs, k, periods)[2] <= stretch.low:
        k += 1
    n = 0
    while station_at(rungs, k + n, periods)[2] < stretch.high:
        n += 1
    n = (n + COARSE - 1) // COARSE
    before, after = has_ends(stretch)
    found = np.zeros((before + n + after, 2))
    for i in range(n):
        found[before + i, 0] = k + COARSE * i
    return found


@njit()
def places_around(
    rungs: Floats, chosen: Floats, apart: float, stretch: Stretch, periods: Floats
) -> Floats:
    """Places of chosen strokes and so far before and behind, and one for each stroke at the ends.

    What is chosen are places, and turns from the directions there.
    """
    before, after = has_ends(stretch)
    found = np.zeros((before + chosen.shape[0] * len(FINER) + after, 2))
    n = before
    for i in range(chosen.shape[0]):
        for share in FINER:
            place = chosen[i, 0] + share * apart
            if stretch.low < station_at(rungs, max(place, 0.0), periods)[2] < stretch.high:
                found[n, 0], found[n, 1] = place, chosen[i, 1]
                n += 1
    return found[: n + after]


@njit()
def at_places(rungs: Floats, known: Floats, periods: Floats) -> Floats:
    """Strokes with places instead of stations."""
    found, lap = known.copy(), rungs.shape[0] - 1
    for i in range(known.shape[0]):
        laps = np.floor(known[i, 0] / periods[2]) if periods[2] > 0.0 else 0.0
        tau = known[i, 0] - laps * periods[2]
        k = min(max(np.searchsorted(rungs[:, TAU], tau, side="right") - 1, 0), lap - 1)
        share = (tau - rungs[k, TAU]) / (rungs[k + 1, TAU] - rungs[k, TAU])
        found[i, 0] = laps * lap + k + share
    return found


@njit()
def chosen_of(way: Ints, fans: Fans, places: Floats, ends: tuple[int, int]) -> Floats:
    """Places and turns of a sequence of chords, but for those at the ends that stay."""
    k, m = way.shape[0] - ends[0] - ends[1], fans.turn.shape[1]
    chosen = np.empty((max(k, 0), 2))
    for i in range(k):
        at, c = way[ends[0] + i] // m, way[ends[0] + i] % m
        chosen[i, 0], chosen[i, 1] = places[at, 0], fans.turn[at, c]
    return chosen


@njit()
def cheapest_from(
    ladder: Ladder,
    strokes: Strokes,
    rule: Spacing,
    places: Floats,
    half: int,
    stretch: Stretch,
    wanted: Wanted,
    periods: Floats,
    allowed: Floats,
    upright: Floats,
) -> tuple[Floats, float]:
    """Cheapest sequence from some places with so many directions on, ever finer; and its cost.

    It is as ``choose_places`` returns it, but for places instead of stations.
    """
    ends, far = has_ends(stretch), ends_of(ladder)
    step, apart = STEP, COARSE / 2.0
    for level in range(LEVELS + AGAIN + 1):
        fans = open_fans(
            ladder, strokes, rule, places, half, step, stretch, periods, allowed, upright
        )
        most = np.inf
        if half > NARROW:
            some = middle_of_fans(fans, LIKELY)
            _, most = cheapest_way(some, ends, wanted, far, periods, most)
            most *= 1.0 + EQUAL
        way, cost = cheapest_way(fans, ends, wanted, far, periods, most)
        chosen = chosen_of(way, fans, places, ends)
        if chosen.shape[0] == 0:
            return chosen, np.inf
        if level < LEVELS + AGAIN:
            places, half = places_around(ladder.rungs, chosen, apart, stretch, periods), NARROW
            if level < LEVELS:
                step, apart = step * NARROWER, apart / 2.0
    return chosen, cost


@njit(entry=True)
def choose_places(
    ladder: Ladder,
    strokes: Strokes,
    rule: Spacing,
    first: int,
    last: int,
    known: Floats,
    wanted: Wanted,
    periods: Floats,
    allowed: Floats,
    upright: Floats,
) -> Floats:
    """Choose strokes for a stretch of a slope.

    Parameters
    ----------
    ladder : calm directions of the slope
    strokes : as they are, in order along the middle line
    rule : for gaps
    first, last : strokes at the ends of the stretch, calm ones, which stay; -1 for an end of the
        slope
    known : (k, 2) station, and turn from the direction there, of the strokes between
    wanted : what is asked for besides
    periods : (3,) lengths of top, toe and middle line of a closed slope, 0 of an open one
    allowed : (n,) angle at each rung that neighbours may turn
    upright : (n, 2) direction of the normal of an edge at each rung, and how far strokes may lean
        from it where the top is not straight; NaN where there is no bound

    Returns
    -------
    (k, 2) station, and turn from the direction there, of the strokes between; empty if there is no
        sequence that advances on both edges. O(n) for n rungs.
    """
    rungs, lap = ladder.rungs, ladder.rungs.shape[0] - 1
    low = strokes.pivot[first, 0] if first >= 0 else 0.0
    high = strokes.pivot[last, 0] if last >= 0 else rungs[lap, TAU]
    if periods[2] > 0.0 and high <= low:
        high += periods[2]
    stretch = Stretch(first, last, low, high)
    near = at_places(rungs, known, periods)
    places = places_around(rungs, near, COARSE / 2.0, stretch, periods)
    best, least = cheapest_from(
        ladder, strokes, rule, places, NARROW, stretch, wanted, periods, allowed, upright
    )
    if least > ENOUGH:
        places = places_all_along(rungs, stretch, periods)
        other, cost = cheapest_from(
            ladder, strokes, rule, places, FAN, stretch, wanted, periods, allowed, upright
        )
        if cost < least:
            best = other
    for i in range(best.shape[0]):
        best[i, 0] = station_at(rungs, best[i, 0], periods)[2]
    return best
