"""Kinks and offsets: heights at which the axis turns, or leaps, as no smooth curve does.

An axis that bends smoothly near by is pliant anyway and gains little by a hinge; one that is
straight on either side of a kink gains much, for without the hinge all of it has to be pliant. The
best of all hinges and leaps, by evidence, is taken in and the search goes on beside it; in the end
each has to be certain beside all others.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.towers.evidence import Problem, Trials, gain_of, problem_of, trials_between
from midrib.towers.summary import azimuth_of

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.towers.joint import Fit
    from midrib.types import Floats, Ints

__all__ = ["Breaks", "Kink", "Offset", "breaks_of", "offsets_of"]

END, APART = 5.0, 5.0  # metres from either end, and between breaks, at the least
SEARCHED = 2  # every second hinge is tried at first
CERTAIN = 24.0  # fall of -2 log L: by chance once in 1000 towers of 100 m, bends aside
WORTH = 10.0  # the same, to be taken in for a trial: kinks hide each other till all are in
LEAST_KINK = 2e-4  # change of direction: less is nothing, however certain
LEAST_OFFSET = 1e-3  # metres: the same
SUDDEN = 0.25  # of what the axis turns by from 2.5 m below to 2.5 m above: less is a bend's
FEW = 20  # breaks: an axis with more is no axis with kinks
MENDED = 3.0  # metres: a break may move so far once its neighbours are known


class Kink(NamedTuple):
    """A change of direction."""

    z: float
    turn: float  # mm per m
    azimuth: float  # degrees from y clockwise: where the axis turns to
    sigma: float  # mm per m


class Offset(NamedTuple):
    """A step of the axis, as between two casting lifts; lengths in coordinate units."""

    z: float
    size: float
    azimuth: float  # degrees from y clockwise: where what is above stands
    sigma: float


class Breaks(NamedTuple):
    """What is not smooth about an axis, from the base up."""

    kinks: list[Kink]
    leaps: "Floats"  # heights of the frame at which there are offsets


def breaks_of(cells: "Cells", fit: "Fit", unit: float) -> Breaks:
    """Find the kinks and offsets of an axis beside the leaps that its fit has.

    Notes
    -----
    Forward selection, then each break once more given the others; those that are not certain beside
    the others go. O(q m n) for q breaks, m heights that are tried and n cells.
    """
    low, high = float(cells.s.min()) + END * unit, float(cells.s.max()) - END * unit
    if high <= low:
        return Breaks([], np.zeros(0))
    trials = trials_between(cells, low, high, APART * unit, unit).beside(fit.model.axis.leaps)
    problem = problem_of(cells, fit, unit)
    chosen = chosen_of(problem, trials, unit)
    kinks, leaps = [], []
    for k in sorted(range(len(chosen)), key=lambda k: trials.heights[chosen[k]]):
        others = chosen[:k] + chosen[k + 1 :]
        gain = gain_of(beside(problem, trials, others), [trials.columns[chosen[k]]])
        s, size = float(trials.heights[chosen[k]]), float(np.hypot(*gain.size[0]))
        if trials.is_leap[chosen[k]]:
            leaps += [s] * (size > LEAST_OFFSET * unit)
        elif size > least_turn(fit, s, unit):
            azimuth, sigma = towards(cells, gain.size[0]), 1e3 * float(gain.sigma[0])
            kinks.append(Kink(height_of(cells, fit, s), 1e3 * size, azimuth, sigma))
    return Breaks(kinks, np.array(leaps))


def offsets_of(cells: "Cells", fit: "Fit") -> list[Offset]:
    """Tell the offsets of an axis that leaps."""
    return [
        Offset(
            height_of(cells, fit, s),
            float(np.hypot(*size)),
            towards(cells, size),
            float(np.sqrt(np.mean(sigma**2))),
        )
        for s, size, sigma in zip(fit.model.axis.leaps, *fit.leaps(), strict=True)
    ]


def height_of(cells: "Cells", fit: "Fit", s: float) -> float:
    """Height z of the axis at a height of the frame."""
    place = np.array([[*fit.values(np.array([s]))[0, :2], s]])
    return float(cells.reference.frame.outwards(place)[0, 2])


def towards(cells: "Cells", change: "Floats") -> float:
    """Azimuth of a change of place or direction (2,), of the frame, in the cloud's coordinates."""
    return float(azimuth_of(*(change @ cells.reference.frame.turn[:2, :2])))


def chosen_of(problem: Problem, trials: Trials, unit: float) -> list[int]:
    """Find the hinges and leaps that are certain, each beside all others."""
    each = np.arange(trials.heights.size)
    some = np.concatenate([each[~trials.is_leap][::SEARCHED], each[trials.is_leap]])
    chosen: list[int] = []
    while len(chosen) < FEW:
        best, fall = best_of(problem, trials, trials.free(some, chosen), chosen)
        if fall < WORTH:
            break
        chosen.append(best)
    for k, place in enumerate(chosen):
        others = chosen[:k] + chosen[k + 1 :]
        near = each[np.abs(trials.heights - trials.heights[place]) <= MENDED * unit]
        chosen[k], _ = best_of(problem, trials, trials.free(near, others), others)
    while chosen:
        falls = [
            best_of(problem, trials, np.array([i]), chosen[:k] + chosen[k + 1 :])[1]
            for k, i in enumerate(chosen)
        ]
        if min(falls) >= CERTAIN:
            break
        del chosen[int(np.argmin(falls))]
    return chosen


def best_of(problem: Problem, trials: Trials, free: "Ints", chosen: list[int]) -> tuple[int, float]:
    """Find which of the free trials makes -2 log L fall most beside the chosen ones.

    Returns its number and its own part of that; those whose own part is worth nothing come last.
    """
    problem = beside(problem, trials, chosen)
    fall, own = np.full(free.size, -np.inf), np.zeros(free.size)
    for is_leap in (False, True):
        rows = trials.is_leap[free] == is_leap
        if rows.any():
            gain = gain_of(problem, [trials.columns[i] for i in free[rows]])
            fall[rows], own[rows] = gain.fall, gain.own
    if not free.size:
        return -1, 0.0
    best = int(np.argmax(np.where(own >= WORTH, fall, own - WORTH)))
    return int(free[best]), float(own[best])


def beside(problem: Problem, trials: Trials, chosen: list[int]) -> Problem:
    """Return the problem with what is chosen in its design."""
    return (
        problem.beside(np.concatenate([trials.columns[j] for j in chosen], axis=1))
        if chosen
        else problem
    )


def least_turn(fit: "Fit", s: float, unit: float) -> float:
    """Change of direction that a kink at a height has at the least: less is a bend's."""
    near = s + APART * unit / 2.0 * np.array([-1.0, 1.0])
    return max(LEAST_KINK, SUDDEN * float(np.hypot(*np.diff(fit.slopes(near), axis=0)[0])))
