r"""Fans: of chords at places along a slope, the cheapest sequence that advances on both edges.

Dynamic programming: the cheapest way to each chord comes from one of the chords half a gap to two
gaps before it. Most of them are passed over by what their ways have cost already. A cheap sequence,
looked for among the chords next to the middle of the fans only, says how much any other may cost.
That takes a tenth of the time of looking at all.

    \|/ \|/ \|/ \|/ \|/
     o   o   o   o   o       places, each with a fan of chords

l         logarithm of a gap over what the rule asks for, stretched as on the rest of the slope
bend      how much more neighbours turn than calm ones do
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.jit import njit
from midrib.types import Floats, Ints

__all__ = [
    "BROKEN",
    "Fans",
    "Wanted",
    "cheapest_way",
    "cost_of_end",
    "cost_of_step",
    "middle_of_fans",
]

GAP_COST, UNEVEN_COST, GAP_WALL = 5.0, 200.0, 4000.0  # of l: squared, beyond UNEVEN, beyond FAR_OFF
UNEVEN, FAR_OFF, FARTHEST = 0.08, 0.2, 0.7  # of l
TURN_COST, TURN_ROOM = 200.0, 0.9  # for each squared radian beyond so much of what is allowed
TURN_WALL, TURN_NEARLY = 20_000.0, 0.985
FOOT_COST, FOOT_NEAR, FOOT_FAR = 60.0, 0.45, 1.5  # for each squared gap beyond these
FOOT_WALL, FOOT_NEAREST, FOOT_FARTHEST = 2000.0, 0.28, 1.7
LEAP, LEAP_COST = 0.3, 400.0  # gaps beyond that; then of the cubed logarithm
BROKEN = 20.0  # for each bound that is exceeded, however little
MOST_OFF, LEAST_FOOT, MOST_FOOT = np.log(1.25), 0.25, 1.75  # of l, and gaps between feet
AT_END, FARTHEST_END = 10.0, 1.0  # cost of l squared at ends, and the most l there
END_ROOM = 0.35  # of l there; more costs much
TIED = 1.0 - 2.0**-30  # a way that is cheaper by less is as cheap, whatever rounding says
NEAREST_STEP, FARTHEST_STEP = np.exp(-FARTHEST), np.exp(FARTHEST)


class Fans(NamedTuple):
    """m chords at each of n places, in order along the middle line."""

    tau: Floats  # (n,) stations
    calm: Floats  # (n,) calm directions
    allowed: Floats  # (n,) that neighbours may turn
    turn: Floats  # (n, m) from the calm direction
    feet: Floats  # (n, m, 2) stations on top and toe
    width: Floats  # (n, m)
    gap: Floats  # (n, m) that the rule asks for
    cost: Floats  # (n, m) of each chord by itself; infinite if it does not join the edges


class Wanted(NamedTuple):
    """What is asked for besides."""

    offset: float  # gaps from an end of the slope to the stroke beside it
    stretch: float  # by how much gaps are wider than the rule asks for
    stiffness: float  # as for the ladder
    period: int  # strokes from the first place to the last one make a whole multiple of it,
    rest: int  # and this


@njit(borrows=True)
def cost_of_end(fans: Fans, i: int, c: int, end: Floats, wanted: Wanted) -> float:
    """Cost of a first or last stroke that is so far from the end, where it should be a gap.

    ``end`` has the stations on top, toe and middle line; NaN what there is not.
    """
    away, gap = abs(fans.tau[i] - end[2]), wanted.offset * wanted.stretch * fans.gap[i, c]
    if away <= 0.0 or abs(np.log(away / gap)) >= FARTHEST_END:
        return np.inf
    off = np.log(away / gap)
    beyond = max(off - END_ROOM, 0.0)
    cost = AT_END * off * off + GAP_WALL * beyond * beyond
    for edge in range(2):
        if not np.isnan(end[edge]):
            cost += cost_of_leap(abs(fans.feet[i, c, edge] - end[edge]) / gap)
    return cost


@njit(borrows=True)
def cost_of_step(fans: Fans, j: int, d: int, i: int, c: int, wanted: Wanted, most: float,
                 periods: Floats) -> float:  # fmt: skip
    """Cost of going on from chord d at place j to chord c at place i; infinite from ``most`` on."""
    ahead = fans.tau[i] - fans.tau[j]
    plain = (fans.gap[i, c] + fans.gap[j, d]) / 2.0
    b = wanted.stretch * plain
    if not NEAREST_STEP * b <= ahead <= FARTHEST_STEP * b:
        return np.inf
    # 1. Bends, which are told most quickly.
    bend = fans.turn[i, c] - fans.turn[j, d]
    reach = wanted.stiffness * (fans.width[i, c] + fans.width[j, d]) / 2.0
    cost = reach * reach / (ahead * b) * bend * bend
    turn, allowed = abs(fans.calm[i] - fans.calm[j] + bend), min(fans.allowed[i], fans.allowed[j])
    over = max(turn - TURN_ROOM * allowed, 0.0)
    beyond = max(turn - TURN_NEARLY * allowed, 0.0)
    cost += TURN_COST * over * over + TURN_WALL * beyond * beyond + BROKEN * (turn > allowed)
    if cost >= most:
        return np.inf
    # 2. The gap.
    off = abs(np.log(ahead / b))
    uneven = max(off - UNEVEN, 0.0)
    off_plain = abs(np.log(ahead / plain))
    beyond = max(off_plain - FAR_OFF, 0.0)
    cost += GAP_COST * off * off + UNEVEN_COST * uneven * uneven + GAP_WALL * beyond * beyond
    cost += BROKEN * (off_plain > MOST_OFF)
    if cost >= most:
        return np.inf
    # 3. Feet, which have to advance.
    for edge in range(2):
        foot, period = fans.feet[i, c, edge] - fans.feet[j, d, edge], periods[edge]
        if period > 0.0:
            expected = ahead / periods[2] * period
            foot -= period * np.round((foot - expected) / period)
        if foot <= 0.0:
            return np.inf
        foot /= plain
        cost += cost_of_foot(foot)
    return cost


@njit(borrows=True)
def cost_of_foot(foot: float) -> float:
    """Cost of feet that are so many gaps apart on an edge.

    Where an edge leaps, as at the walls of a bay that is deeper than wide, some ends have to be far
    apart. Then the cost grows slowly: the strokes around need not lean for it. Yet a leap costs
    more than two of half the way, so that a stroke in the bay is worth it.
    """
    over = min(max(FOOT_NEAR - foot, foot - FOOT_FAR, 0.0), LEAP)
    beyond = max(FOOT_NEAREST - foot, 0.0)
    broken = BROKEN * (foot > MOST_FOOT or foot < LEAST_FOOT)
    return FOOT_COST * over * over + FOOT_WALL * beyond * beyond + broken + cost_of_leap(foot)


@njit(borrows=True)
def cost_of_leap(foot: float) -> float:
    """Return the part of it that is for ends too far apart."""
    beyond = min(max(foot - FOOT_FARTHEST, 0.0), LEAP)
    leap = np.log(max(foot / (FOOT_FARTHEST + LEAP), 1.0))
    return FOOT_WALL * beyond * beyond + LEAP_COST * leap**3


@njit(entry=True)
def cheapest_way(
    fans: Fans, fixed: tuple[int, int], wanted: Wanted, ends: Floats, periods: Floats, most: float
) -> tuple[Ints, float]:
    """Return the cheapest sequence of chords, as i m + c for chord c at place i, and its cost.

    It is empty if there is none, or none cheaper than ``most``.

    Parameters
    ----------
    fans : Fans
    fixed : whether it has to begin at the first place, and to end at the last one
    wanted : Wanted
    ends : (2, 3) stations of both ends of an open slope on top, toe and middle line
    periods : (3,) lengths of top, toe and middle line of a closed slope, 0 of an open one
    most : float
    """
    (n, m), period = fans.turn.shape, wanted.period
    # By the chord, and by how many strokes, but for whole periods, there are before it.
    cost, came = np.full((n, m, period), np.inf), np.full((n, m, period), -1, np.intp)
    least, narrow, wide = np.full(n, np.inf), np.full(n, np.inf), np.zeros(n)
    for i in range(n):
        for c in range(m):
            if fans.cost[i, c] < np.inf:
                narrow[i] = min(narrow[i], fans.gap[i, c])
                wide[i] = max(wide[i], fans.gap[i, c])
    # 1. The cheapest way to each chord.
    start = 0
    for i in range(n):
        while start < i and (
            fans.tau[i] - fans.tau[start]
            > FARTHEST_STEP * wanted.stretch * (wide[i] + wide[start]) / 2.0
        ):
            start += 1
        for c in range(m):
            own, gap = fans.cost[i, c], fans.gap[i, c]
            if own == np.inf:
                continue
            if fixed[0] == 0:
                cost[i, c, 0] = own + cost_of_end(fans, i, c, ends[0], wanted)
            elif i == 0:
                cost[i, c, 0] = own
            # From a gap before this place on, those farther and then those nearer: so a cheap way
            # is found early, and few others are looked at.
            middle = i - 1
            while middle > start and fans.tau[i] - fans.tau[middle] < wanted.stretch * gap:
                middle -= 1
            for k in range(start, i):
                j = middle - (k - start) if k <= middle else k
                worst = 0.0
                for r in range(period):
                    worst = max(worst, TIED * cost[i, c, r])
                if own + least[j] >= min(worst, most):
                    continue
                if (
                    fans.tau[i] - fans.tau[j]
                    < NEAREST_STEP * wanted.stretch * (gap + narrow[j]) / 2
                ):
                    break
                for d in range(m):
                    if np.isinf(fans.cost[j, d]):
                        continue
                    room = 0.0
                    for r in range(period):
                        cheaper_than = min(TIED * cost[i, c, (r + 1) % period], most)
                        room = max(room, cheaper_than - cost[j, d, r])
                    if not own < room:
                        continue
                    step = own + cost_of_step(fans, j, d, i, c, wanted, room - own, periods)
                    for r in range(period):
                        way, after = cost[j, d, r] + step, (r + 1) % period
                        if way < min(TIED * cost[i, c, after], most):
                            cost[i, c, after], came[i, c, after] = way, (j * m + d) * period + r
            for r in range(period):
                least[i] = min(least[i], cost[i, c, r])
    # 2. The cheapest of all, from its end back.
    best, at = most, -1
    for i in range(n - 1 if fixed[1] != 0 else 0, n):
        for c in range(m):
            way = cost[i, c, wanted.rest]
            if np.isinf(way):
                continue
            if fixed[1] == 0:
                way += cost_of_end(fans, i, c, ends[1], wanted)
            if way < TIED * best:
                best, at = way, (i * m + c) * period + wanted.rest
    count, back, ways = 0, at, came.ravel()
    while back >= 0:
        count, back = count + 1, ways[back]
    found = np.empty(count, np.intp)
    while at >= 0:
        count -= 1
        found[count] = at // period
        at = ways[at]
    return found, best


@njit()
def middle_of_fans(fans: Fans, half: int) -> Fans:
    """Fans of which only so many chords to either side of the middle one are left."""
    n, m = fans.turn.shape
    cost = np.full((n, m), np.inf)
    for i in range(n):
        for c in range(max(m // 2 - half, 0), min(m // 2 + half + 1, m)):
            cost[i, c] = fans.cost[i, c]
    return Fans(fans.tau, fans.calm, fans.allowed, fans.turn, fans.feet, fans.width, fans.gap, cost)
