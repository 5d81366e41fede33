r"""Placing: where strokes are and how they run on a stretch that calm ones do not suit.

On every rung of the stretch there is a fan of chords. Of all sequences of chords that advance on
both edges the cheapest is looked for, by dynamic programming: how many there are, on which rungs,
and in which directions. Then the fans are narrowed around the choice, on its rungs.

       first                 last      calm strokes that stay, or an end of the slope
         |  \|/ \|/ \|/ \|/   |
         o   o   o   o   o    o        rungs, each with a fan of chords; some are left out

l         logarithm of a gap over what the rule asks for, stretched as on the rest of the slope
bend      how much more neighbours turn than calm ones do
"""

import numpy as np

from midrib.kernels.chords import ON_TOE, ON_TOP, shoot
from midrib.kernels.jit import njit
from midrib.kernels.ladder import TAU, THETA, Ladder, Spacing, Strokes, X, Y, gap_at
from midrib.kernels.mending import FOOT_COST, LEAST_FOOT, MOST_FOOT, MOST_TURN
from midrib.types import Floats

__all__ = ["choose_places"]

FAN, STEP = 9, np.pi / 30.0  # directions on either side, 6 degrees each
NARROW, NARROWER, LEVELS = 4, 0.25, 3  # directions on either side, step over the one before
GAP_COST, UNEVEN_COST = 5.0, 200.0  # for each l squared, and for what is beyond UNEVEN
TURN_COST = 200.0  # for each squared radian of a turn that is too large
UNEVEN, FARTHEST = 0.1, 0.7  # of l
AT_END, FARTHEST_END = 10.0, 1.0  # cost of l squared at ends, and the most l there
TURN_ROOM = 0.9  # of the most turn: what the rungs' width may still add to one
NEAR_ROOM, FAR_ROOM = 1.5, 0.95  # of the nearest and farthest feet, likewise
TIED = 1.0 - 2.0**-30  # a way that is cheaper by less is as cheap, whatever rounding says


@njit(borrows=True)
def cost_of_end(away: float, gap: float) -> float:
    """Cost of a first or last stroke that is so far from the end, where it should be a gap."""
    off = abs(np.log(away / gap)) if away > 0.0 else np.inf
    return AT_END * off * off if off < FARTHEST_END else np.inf


@njit(borrows=True)
def cost_of_gap(off: float) -> float:
    """Cost of a gap whose logarithm is so far off."""
    uneven = max(off - UNEVEN, 0.0)
    return GAP_COST * off * off + UNEVEN_COST * uneven * uneven


@njit(borrows=True)
def cost_of_foot(foot: float) -> float:
    """Cost of feet that are so many gaps apart; they have to advance."""
    if foot <= 0.0:
        return np.inf
    off = max(NEAR_ROOM * LEAST_FOOT - foot, foot - FAR_ROOM * MOST_FOOT, 0.0)
    return FOOT_COST * off * off


@njit()
def cheapest_way(
    ladder: Ladder,
    strokes: Strokes,
    rule: Spacing,
    places: Floats,
    half: int,
    step: float,
    fixed: tuple[int, int],
    offset: float,
    stretch: float,
    stiffness: float,
    periods: Floats,
) -> Floats:
    """Return the cheapest sequence, as rows of ``places``; none if none is.

    These are the rung, on a closed slope counted on after the last one, and the turn that the fan
    of 2 half + 1 directions is around; fixed strokes are the first and the last one, whose rung is
    no matter.
    """
    n, m = places.shape[0], 2 * half + 1
    rungs, lap = ladder.rungs, ladder.rungs.shape[0] - 1
    tau, calm = np.empty(n), np.empty(n)
    feet, width, gap = np.full((n, m, 2), np.nan), np.empty((n, m)), np.empty((n, m))
    cost, came = np.full((n, m), np.inf), np.full((n, m), -1, np.intp)
    # 1. The fans.
    for i in range(n):
        row = fixed[0] if i == 0 else fixed[1] if i == n - 1 else -1
        if row >= 0:
            tau[i], calm[i] = strokes.pivot[row, 0], strokes.pivot[row, 3]
            if i > 0 and tau[i] <= tau[0]:  # round a closed slope
                tau[i] += periods[2]
                calm[i] += rungs[lap, THETA] - rungs[0, THETA]
            feet[i, half, 0], feet[i, half, 1] = strokes.chord[row, 0], strokes.chord[row, 1]
            width[i, half] = strokes.chord[row, 6]
            gap[i, half] = stretch * gap_at(rule, width[i, half])
            continue
        k, laps = int(places[i, 0]), 0
        if periods[2] > 0.0:
            k, laps = k % lap, k // lap
        tau[i] = rungs[k, TAU] + laps * periods[2]
        calm[i] = rungs[k, THETA] + laps * (rungs[lap, THETA] - rungs[0, THETA])
        for c in range(m):
            theta = rungs[k, THETA] + places[i, 1] + (c - half) * step
            chord = shoot(ladder.ground, ladder.at[k, 0], rungs[k, X], rungs[k, Y], theta)
            width[i, c], gap[i, c] = chord.width, stretch * gap_at(rule, chord.width)
            if chord.top_on == ON_TOP and chord.toe_on == ON_TOE:
                feet[i, c, 0], feet[i, c, 1] = chord.s, chord.t
    # 2. The cheapest way to each chord.
    for i in range(n):
        is_first, is_last = fixed[0] >= 0 and i == 0, fixed[1] >= 0 and i == n - 1
        for c in range(half, half + 1) if is_first or is_last else range(m):
            if np.isnan(feet[i, c, 0]):
                continue
            turn = places[i, 1] + (c - half) * step
            tilt = turn * turn
            if is_first:
                cost[i, c] = tilt
                continue
            if fixed[0] < 0:
                cost[i, c] = tilt + cost_of_end(tau[i], offset * gap[i, c])
            for j in range(i - 1, -1, -1):
                ahead = tau[i] - tau[j]
                if ahead > 2.0 * np.exp(FARTHEST) * gap[i, c]:
                    break
                for d in range(m):
                    if not cost[j, d] < TIED * cost[i, c]:
                        continue
                    b = (gap[i, c] + gap[j, d]) / 2.0
                    off = abs(np.log(ahead / b))
                    if off > FARTHEST:
                        continue
                    bend = turn - places[j, 1] - (d - half) * step
                    reach = stiffness * (width[i, c] + width[j, d]) / 2.0
                    over = max(abs(calm[i] - calm[j] + bend) - TURN_ROOM * MOST_TURN, 0.0)
                    way = cost[j, d] + tilt + cost_of_gap(off) + TURN_COST * over * over
                    way += reach * reach / (ahead * b) * bend * bend
                    for edge in range(2):
                        foot, period = feet[i, c, edge] - feet[j, d, edge], periods[edge]
                        if period > 0.0:
                            expected = ahead / periods[2] * period
                            foot -= period * np.round((foot - expected) / period)
                        way += cost_of_foot(foot / b)
                    if way < TIED * cost[i, c]:
                        cost[i, c], came[i, c] = way, j * m + d
    # 3. The cheapest of all, from its end back.
    best, at = np.inf, -1
    for i in range(n - 1 if fixed[1] >= 0 else 0, n):
        for c in range(m):
            if np.isinf(cost[i, c]):
                continue
            total = cost[i, c]
            if fixed[1] < 0:
                total += cost_of_end(rungs[lap, TAU] - tau[i], offset * gap[i, c])
            if total < TIED * best:
                best, at = total, i * m + c
    count, back = 0, at
    while back >= 0:
        count, back = count + 1, came[back // m, back % m]
    found = np.empty((count, 2))
    while at >= 0:
        count -= 1
        i, c = at // m, at % m
        found[count, 0], found[count, 1] = places[i, 0], places[i, 1] + (c - half) * step
        at = came[i, c]
    return found


@njit(entry=True)
def choose_places(
    ladder: Ladder,
    strokes: Strokes,
    rule: Spacing,
    first: int,
    last: int,
    offset: float,
    stretch: float,
    stiffness: float,
    periods: Floats,
) -> Floats:
    """Choose strokes for a stretch of a slope.

    Parameters
    ----------
    ladder : calm directions of the slope
    strokes : as they are, in order along the middle line
    rule : for gaps
    first, last : strokes at the ends of the stretch, calm ones, which stay; -1 for an end of the
        slope
    offset : gaps from an end of the slope to the stroke beside it
    stretch : by how much gaps are wider than the rule asks for
    stiffness : as for the ladder
    periods : (3,) lengths of top, toe and middle line of a closed slope, 0 of an open one

    Returns
    -------
    (k, 2) station, and turn from the direction there, of the strokes between; empty if there is no
        sequence that advances on both edges. O(n) for n rungs, each with some 5000 steps.
    """
    rungs, lap = ladder.rungs, ladder.rungs.shape[0] - 1
    low = strokes.pivot[first, 0] if first >= 0 else 0.0
    high = strokes.pivot[last, 0] if last >= 0 else rungs[lap, TAU]
    if periods[2] > 0.0 and high <= low:
        high += periods[2]
    # 1. The rungs between, and a place for each fixed stroke.
    k = 0
    while at_rung(rungs, k, periods) <= low:
        k += 1
    n = 0
    while at_rung(rungs, k + n, periods) < high:
        n += 1
    before, after = (1 if first >= 0 else 0), (1 if last >= 0 else 0)
    found = np.zeros((before + n + after, 2))
    for i in range(n):
        found[before + i, 0] = k + i
    # 2. Places and directions; then finer directions on these places.
    half, step = FAN, STEP
    for _ in range(LEVELS):
        found = cheapest_way(
            ladder, strokes, rule, found, half, step, (first, last), offset, stretch, stiffness,
            periods,
        )  # fmt: skip
        if found.shape[0] < before + after + 1:
            return np.empty((0, 2))
        half, step = NARROW, step * NARROWER
    chosen = np.empty((found.shape[0] - before - after, 2))
    for i in range(chosen.shape[0]):
        chosen[i, 0] = at_rung(rungs, int(found[before + i, 0]), periods)
        chosen[i, 1] = found[before + i, 1]
    return chosen


@njit(borrows=True)
def at_rung(rungs: Floats, k: int, periods: Floats) -> float:
    """Station of a rung, on a closed slope counted on after the last one; infinite past an end."""
    lap = rungs.shape[0] - 1
    if periods[2] > 0.0:
        return rungs[k % lap, TAU] + (k // lap) * periods[2]
    return rungs[k, TAU] if k <= lap else np.inf
