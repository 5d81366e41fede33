"""Kinks and offsets: heights at which the axis turns, or leaps, as no smooth curve does.

h_j(s)    hinge: 0 below the height s_j, s - s_j above it
l_j(s)    leap: 0 below, 1 above
β         change of direction, or offset, there, of x and y
λ, τ²     stiffness of the smooth axis and long-wave variance of a cell, as of the joint fit

Polynomials up to a degree are free of the penalty: they bend the tower as a whole, and would make
the rest as pliant. The joint model with β h_j or β l_j in its axis is held against the one without:
by how much -2 log L falls, each with the stiffness that suits it best. An axis that bends smoothly
near by is pliant anyway and gains little by a hinge; one that is straight on either side of a kink
gains much, for without the hinge all of it has to be pliant. The best of all hinges and leaps is
taken in and the search goes on beside it; in the end each has to be certain beside all others.

References
----------
Ansley and Kohn, Estimation, filtering and smoothing in state space models with incompletely
specified initial conditions, Annals of Statistics 13(4), 1985: smoothing splines beside regressors.
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from midrib.towers.blocks import factor_of, product
from midrib.towers.joint import design_of, normals_of
from midrib.towers.smoothing import AXIS_STIFFNESS
from midrib.towers.summary import azimuth_of

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.towers.joint import Fit
    from midrib.towers.splines import Basis
    from midrib.types import Bools, Floats, Ints

__all__ = ["Breaks", "Kink", "Offset", "breaks_of", "offsets_of"]

END, APART = 5.0, 5.0  # metres from either end, and between breaks, at the least
STEP, MOST = 0.5, 240  # metres between heights of breaks; how many of them at the most
SEARCHED = 2  # every second height is tried at first, and
STIFFNESSES = AXIS_STIFFNESS[::2]  # every second stiffness: a factor of 10 is near enough
CERTAIN = 24.0  # fall of -2 log L: by chance once in 1000 towers of 100 m, bends aside
WORTH = 10.0  # the same, to be taken in for a trial: kinks hide each other till all are in
LEAST_KINK = 2e-4  # change of direction: less is nothing, however certain
LEAST_OFFSET = 1e-3  # metres: the same
BEND, BENDS = 10.0, (3, 7)  # metres of a tower for each degree of what bends all of it; bounds
LEAST_NOISE = 1e-4  # metres, of a cell: bends that splines miss, where a scan has less noise
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


class Problem(NamedTuple):
    """The joint fit's cells, as least squares."""

    design: Any  # sparse (n, k)
    known: "Floats"  # (n,)
    weight: "Floats"  # (n,) over τ²
    penalties: "list[Floats]"  # (k, k) for each stiffness
    ranks: "Floats"  # log |P| of what each penalty holds, but for a constant

    def beside(self, columns: "Floats") -> "Problem":
        """Return the problem with more columns (n, c), which no penalty holds."""
        from scipy.sparse import csr_array, hstack

        more = columns.shape[1]
        penalties = [np.pad(penalty, (0, more)) for penalty in self.penalties]
        design = csr_array(hstack([self.design, csr_array(columns)]))
        return self._replace(design=design, penalties=penalties)


class Trials(NamedTuple):
    """Hinges and leaps that are tried: two columns (n, 2) of a design each."""

    heights: "Floats"  # (m,)
    is_leap: "Bools"  # (m,)
    columns: "list[Floats]"
    apart: float  # two that are chosen are so far apart at the least

    def free(self, rows: "Ints", chosen: list[int]) -> list[int]:
        """Those of some rows that are far enough from all that are chosen."""
        away = np.abs(self.heights[rows][:, None] - self.heights[chosen])
        return [int(i) for i in rows[(away >= self.apart * (1.0 - 1e-9)).all(axis=1)]]


class Gain(NamedTuple):
    """What hinges and leaps are good for."""

    fall: "Floats"  # (m,) of -2 log L
    size: "Floats"  # (m, 2) of what each changes: direction, or place
    sigma: "Floats"  # (m,) of either part of it


def breaks_of(cells: "Cells", fit: "Fit", unit: float) -> Breaks:
    """Find the kinks and offsets of an axis.

    Notes
    -----
    Forward selection, then each break once more given the others; those that are not certain beside
    the others go. O(q m n) for q breaks, m heights that are tried and n cells.
    """
    low, high = float(cells.s.min()) + END * unit, float(cells.s.max()) - END * unit
    if high <= low:
        return Breaks([], np.zeros(0))
    trials = trials_at(cells, np.arange(low, high, max(STEP * unit, (high - low) / MOST)), unit)
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
    some = np.concatenate([each[~trials.is_leap][::SEARCHED], each[trials.is_leap][::SEARCHED]])
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
            best_of(problem, trials, [i], chosen[:k] + chosen[k + 1 :])[1]
            for k, i in enumerate(chosen)
        ]
        if min(falls) >= CERTAIN:
            break
        del chosen[int(np.argmin(falls))]
    return chosen


def best_of(
    problem: Problem, trials: Trials, free: list[int], chosen: list[int]
) -> tuple[int, float]:
    """Find which of the free trials makes -2 log L fall most beside the chosen ones."""
    if not free:
        return -1, 0.0
    fall = gain_of(beside(problem, trials, chosen), [trials.columns[i] for i in free]).fall
    return free[int(np.argmax(fall))], float(fall.max())


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


def problem_of(cells: "Cells", fit: "Fit", unit: float) -> Problem:
    """Return the joint fit's least squares, with a penalty for every stiffness of the axis."""
    design, _ = design_of(cells, fit.model)
    known = design @ fit.bends + fit.residual
    variance = max(fit.variance, (LEAST_NOISE * unit) ** 2)
    stiffnesses = STIFFNESSES * unit
    axis = fit.model.axis
    degree = int(np.clip(round((axis.knots[-1] - axis.knots[0]) / (BEND * unit)), *BENDS))
    size, free = axis.size, free_of_bends(axis, degree)
    penalties = []
    for stiffness in stiffnesses:
        penalty = fit.model.penalty(0.0, fit.stiffness[1])
        for first in (0, size):
            penalty[first : first + size, first : first + size] = stiffness * free
        penalties.append(penalty)
    ranks = (fit.model.bends[0] - 2 * (degree - 1)) * np.log(stiffnesses)
    return Problem(design, known, fit.weight / variance, penalties, ranks)


def free_of_bends(axis: "Basis", degree: int) -> "Floats":
    """Penalty (size, size) of an axis that polynomials up to a degree are free of."""
    low, high = axis.knots[0], axis.knots[-1]
    share = np.linspace(-1.0, 1.0, 4 * axis.size)
    bends = np.polynomial.legendre.legvander(share, degree)[:, 2:]
    at = low + (share + 1.0) / 2.0 * (high - low)
    spanned = np.linalg.lstsq(axis.design(at), bends, rcond=None)[0]
    held = axis.penalty @ spanned
    free: Floats = axis.penalty - held @ np.linalg.pinv(spanned.T @ held) @ held.T
    return (free + free.T) / 2.0


def trials_at(cells: "Cells", heights: "Floats", unit: float) -> Trials:
    """Hinges, then leaps, at heights: in x and in y, as the axis' own columns are."""
    normal, _ = normals_of(cells)
    reference, step = cells.reference, cells.reference.step
    taper = (reference.at(cells.s + step) - reference.at(cells.s - step))[:, 2] / (2.0 * step)
    lever = reference.at(cells.s)[:, 2] * taper
    above = [cells.s > at for at in heights]
    hinges = [
        normal * ((cells.s - at + lever) * is_above)[:, None]
        for at, is_above in zip(heights, above, strict=True)
    ]
    leaps = [normal * is_above[:, None] for is_above in above]
    is_leap = np.repeat([False, True], heights.size)
    return Trials(np.tile(heights, 2), is_leap, hinges + leaps, APART * unit)


def gain_of(problem: Problem, columns: "list[Floats]") -> Gain:
    """Tell what each hinge or leap would be good for, each model with its own best stiffness."""
    design, known, weight = problem.design, problem.known, problem.weight
    normal, right = product(design, weight, design), design.T @ (weight * known)
    crossed = np.array([design.T @ (weight[:, None] * h) for h in columns])  # (m, k, 2)
    own = np.array([h.T @ (weight[:, None] * h) for h in columns])
    told = np.array([h.T @ (weight * known) for h in columns])
    flat = crossed.transpose(1, 0, 2).reshape(len(right), -1)
    plain, broken, sizes, variances = [], [], [], []
    for penalty, rank in zip(problem.penalties, problem.ranks, strict=True):
        factor = factor_of(normal + penalty)
        solved = factor.solve(np.column_stack([right, flat]))
        level = factor.log_determinant - rank - float(right @ solved[:, 0])
        pulled = solved[:, 1:].reshape(len(right), len(columns), 2).transpose(1, 0, 2)
        left = own - crossed.transpose(0, 2, 1) @ pulled
        score = told - np.einsum("mki,k->mi", crossed, solved[:, 0])
        size = np.linalg.solve(left, score[:, :, None])[:, :, 0]
        plain.append(level)
        broken.append(level - (size * score).sum(axis=1))
        sizes.append(size)
        variances.append(np.trace(np.linalg.inv(left), axis1=1, axis2=2) / 2.0)
    best = np.argmin(broken, axis=0)
    rows = np.arange(len(columns))
    fall = min(plain) - np.array(broken)[best, rows]
    return Gain(fall, np.array(sizes)[best, rows], np.sqrt(np.array(variances)[best, rows]))
