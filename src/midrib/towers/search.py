"""Search for breaks: forward, then each beside all others, till all are certain.

An axis that bends smoothly near by is pliant anyway and gains little by a hinge; one that is
straight on either side of a kink gains much, for without the hinge all of it has to be pliant. The
best of all breaks, by evidence, is taken in and the search goes on beside it. Before all are known
one may be told as two, on either side of where it is; so two neighbours are held against one
between them. In the end each has to be certain beside all others.
"""

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from midrib.towers.evidence import OWN, Gain, Problem, Trials, gain_of

if TYPE_CHECKING:
    from midrib.types import Bools, Ints

__all__ = ["chosen_of", "gain_beside"]

HINGES, SEARCHED = ("kink", "batter"), 2  # every second hinge is tried at first
CERTAIN = 24.0  # fall of -2 log L: by chance once in 1000 towers of 100 m, bends aside
WORTH = 10.0  # the same, to be taken in for a trial: breaks hide each other till all are in
FREED = 5.0  # the same: a level may gain so much by being free, so less is no difference
FEW = 20  # breaks: an axis with more is no axis with kinks
MENDED = 3.0  # metres: a break may move so far once its neighbours are known
PAIRED = 10.0  # metres: two that are no farther apart may be one


def chosen_of(problem: Problem, trials: Trials, unit: float) -> list[int]:
    """Find the breaks that are certain, each beside all others."""
    each = np.arange(trials.heights.size)
    is_hinge = np.isin(trials.kinds, HINGES)
    some = np.concatenate([each[is_hinge][::SEARCHED], each[~is_hinge]])
    chosen: list[int] = []
    while len(chosen) < FEW:
        best, fall = best_of(problem, trials, trials.free(some, chosen), chosen)
        if fall < WORTH:
            break
        chosen.append(best)
    chosen = mended(problem, trials, merged(problem, trials, chosen, unit), unit)
    while chosen:
        falls = [
            float(gain_beside(problem, trials, i, chosen[:k] + chosen[k + 1 :]).own[0])
            for k, i in enumerate(chosen)
        ]
        if min(falls) >= CERTAIN:
            break
        del chosen[int(np.argmin(falls))]
    return chosen


def merged(problem: Problem, trials: Trials, chosen: list[int], unit: float) -> list[int]:
    """Put one break in the place of two neighbours wherever that is about as good."""
    for below, above in neighbours(trials, chosen, unit):
        if below not in chosen or above not in chosen:
            continue
        others = [i for i in chosen if i not in {below, above}]
        low, high = trials.heights[[below, above]]
        between = (trials.heights >= low) & (trials.heights <= high) & same_part(trials, below)
        free = trials.free(np.flatnonzero(between), others)
        one, _ = best_of(problem, trials, free, others)
        falls = [
            float(gain_beside(problem, trials, i, beside_these).fall[0])
            for i, beside_these in ((below, others), (above, [*others, below]), (one, others))
        ]
        if falls[0] + falls[1] - falls[2] < CERTAIN:
            chosen = [*others, one]
    return chosen


def neighbours(trials: Trials, chosen: list[int], unit: float) -> list[tuple[int, int]]:
    """Pairs of chosen breaks of one part, the lower one first, with none between them."""
    found: list[tuple[int, int]] = []
    for part in (False, True):
        of_part = [i for i in chosen if trials.is_of_axis[i] == part]
        found += pairwise(sorted(of_part, key=lambda i: float(trials.heights[i])))
    return [(i, j) for i, j in found if trials.heights[j] - trials.heights[i] <= PAIRED * unit]


def mended(problem: Problem, trials: Trials, chosen: list[int], unit: float) -> list[int]:
    """Move each break to where it is best beside all others."""
    chosen = list(chosen)
    for k, place in enumerate(chosen):
        others = chosen[:k] + chosen[k + 1 :]
        near = np.abs(trials.heights - trials.heights[place]) <= MENDED * unit
        free = trials.free(np.flatnonzero(near & same_part(trials, place)), others)
        chosen[k], _ = best_of(problem, trials, free, others)
    return chosen


def same_part(trials: Trials, place: int) -> "Bools":
    """Which trials break the same part as one does: the axis, or the wall around it."""
    found: Bools = trials.is_of_axis == trials.is_of_axis[place]
    return found


def best_of(problem: Problem, trials: Trials, free: "Ints", chosen: list[int]) -> tuple[int, float]:
    """Find which of the free trials makes -2 log L fall most beside the chosen ones.

    Returns its number and its own part of that; those whose own part is worth nothing come last.
    """
    if not free.size:
        return -1, 0.0
    problem = beside(problem, trials, chosen)
    fall, own = np.zeros(free.size), np.zeros(free.size)
    for kind, width in OWN.items():
        rows = trials.kinds[free] == kind
        if rows.any():
            gain = gain_of(problem, [trials.columns[i] for i in free[rows]], width)
            fall[rows], own[rows] = gain.fall, gain.own
    best = int(np.argmax(np.where(own >= WORTH, fall, own - WORTH)))
    as_good = (trials.kinds[free] == trials.kinds[free[best]]) & (fall >= fall[best] - FREED)
    low, high = run_around(best, as_good)
    # A leap that is a level off gains as much by the level that it frees, but not of its own; at
    # missing levels it gains the same wherever it is, and is put in the middle of them.
    best = low + int(np.argmax(own[low:high]))
    low, high = run_around(best, as_good & (own >= own[best] - FREED))
    middle = (low + high - 1) // 2
    return int(free[middle]), float(own[middle])


def run_around(place: int, rows: "Bools") -> tuple[int, int]:
    """First row and one past the last one of the run of rows that a place is in."""
    others = np.flatnonzero(~rows)
    at = int(np.searchsorted(others, place))
    low = int(others[at - 1]) + 1 if at else 0
    high = int(others[at]) if at < others.size else rows.size
    return low, high


def gain_beside(problem: Problem, trials: Trials, place: int, others: list[int]) -> Gain:
    """Tell what one break is good for beside others."""
    problem, width = beside(problem, trials, others), OWN[trials.kinds[place]]
    return gain_of(problem, [trials.columns[place]], width)


def beside(problem: Problem, trials: Trials, chosen: list[int]) -> Problem:
    """Return the problem with what is chosen in its design."""
    return (
        problem.beside(np.concatenate([trials.columns[j] for j in chosen], axis=1))
        if chosen
        else problem
    )
