"""Kinks: heights at which the axis turns more suddenly than a smooth curve does.

h_j(s)    hinge: 0 below the height s_j, s - s_j above it
β         change of direction there, of x and y
λ, τ²     stiffness of the smooth axis and long-wave variance of a cell, as of the joint fit

Polynomials up to a degree are free of the penalty: they bend the tower as a whole, and would make
the rest as pliant. The joint model with β h_j in its axis is held against the one without it: by
how much -2 log L falls, each with the stiffness that suits it best. An axis that bends smoothly
near by is pliant anyway and gains little by a hinge; one that is straight on either side of a kink
gains much, for without the hinge all of it has to be pliant. The best kink is taken in and the
search goes on beside it; in the end each has to be certain beside all others.

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
    from midrib.types import Floats

__all__ = ["Kink", "kinks_of"]

END, APART = 5.0, 5.0  # metres from either end, and between kinks, at the least
STEP, MOST = 0.5, 240  # metres between heights of kinks; how many of them at the most
SEARCHED = 2  # every second height is tried at first, and
STIFFNESSES = AXIS_STIFFNESS[::2]  # every second stiffness: a factor of 10 is near enough
CERTAIN = 24.0  # fall of -2 log L: by chance once in 1000 towers of 100 m, bends aside
WORTH = 10.0  # the same, to be taken in for a trial: kinks hide each other till all are in
LEAST_KINK = 2e-4  # change of direction: less is nothing, however certain
BEND, BENDS = 10.0, (3, 7)  # metres of a tower for each degree of what bends all of it; bounds
LEAST_NOISE = 1e-4  # metres, of a cell: bends that splines miss, where a scan has less noise
SUDDEN = 0.25  # of what the axis turns by from 2.5 m below to 2.5 m above: less is a bend's
FEW = 20  # kinks: an axis with more is no axis with kinks
MENDED = 3.0  # metres: a kink may move so far once its neighbours are known


class Kink(NamedTuple):
    """A change of direction."""

    z: float
    turn: float  # mm per m
    azimuth: float  # degrees from y clockwise: where the axis turns to
    sigma: float  # mm per m


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


class Gain(NamedTuple):
    """What hinges are good for."""

    fall: "Floats"  # (m,) of -2 log L
    turn: "Floats"  # (m, 2)
    sigma: "Floats"  # (m,) of either part of a turn


def kinks_of(cells: "Cells", fit: "Fit", unit: float) -> list[Kink]:
    """Find the kinks of an axis, from the base up.

    Notes
    -----
    Forward selection, then each kink once more given the others; those that are not certain beside
    the others go. O(q m n) for q kinks, m heights that are tried and n cells.
    """
    low, high = float(cells.s.min()) + END * unit, float(cells.s.max()) - END * unit
    if high <= low:
        return []
    step = max(STEP * unit, (high - low) / MOST)
    heights = np.arange(low, high, step)
    hinges = [hinge_of(cells, at) for at in heights]
    problem = problem_of(cells, fit, unit)
    chosen: list[int] = []
    while len(chosen) < FEW:
        tried = range(0, heights.size, SEARCHED)
        free = [i for i in tried if is_apart(heights, i, chosen, APART * unit)]
        best, fall = best_of(problem, hinges, free, chosen)
        if fall < WORTH:
            break
        chosen.append(best)
    for k, place in enumerate(chosen):
        others = chosen[:k] + chosen[k + 1 :]
        near = np.flatnonzero(np.abs(heights - heights[place]) <= MENDED * unit)
        free = [int(i) for i in near if is_apart(heights, int(i), others, APART * unit)]
        chosen[k], _ = best_of(problem, hinges, free, others)
    while chosen:
        falls = [
            best_of(problem, hinges, [i], chosen[:k] + chosen[k + 1 :])[1]
            for k, i in enumerate(chosen)
        ]
        if min(falls) >= CERTAIN:
            break
        del chosen[int(np.argmin(falls))]
    found = [kink_at(cells, fit, problem, hinges, heights, chosen, k) for k in range(len(chosen))]
    half = APART * unit / 2.0
    ends = [heights[i] + np.array([-half, half]) for i in chosen]
    least = [
        max(LEAST_KINK, SUDDEN * float(np.hypot(*np.diff(fit.slopes(pair), axis=0)[0])))
        for pair in ends
    ]
    return sorted(k for k, turn in zip(found, least, strict=True) if k.turn > 1e3 * turn)


def is_apart(heights: "Floats", i: int, chosen: list[int], least: float) -> bool:
    """Whether a height is far enough from those that are chosen."""
    return all(abs(heights[i] - heights[j]) >= least - 1e-9 * least for j in chosen)


def best_of(
    problem: Problem, hinges: "list[Floats]", free: list[int], chosen: list[int]
) -> tuple[int, float]:
    """Find which of the free hinges makes -2 log L fall most beside the chosen ones."""
    if not free:
        return -1, 0.0
    for j in chosen:
        problem = problem.beside(hinges[j])
    fall = gain_of(problem, [hinges[i] for i in free]).fall
    return free[int(np.argmax(fall))], float(fall.max())


def kink_at(
    cells: "Cells",
    fit: "Fit",
    problem: Problem,
    hinges: "list[Floats]",
    heights: "Floats",
    chosen: list[int],
    k: int,
) -> Kink:
    """Return a chosen kink with its size, given the others."""
    for j in chosen[:k] + chosen[k + 1 :]:
        problem = problem.beside(hinges[j])
    gain = gain_of(problem, [hinges[chosen[k]]])
    frame, s = cells.reference.frame, heights[chosen[k]]
    z = frame.outwards(np.array([[*fit.values(np.array([s]))[0, :2], s]]))[0, 2]
    x, y = gain.turn[0] @ frame.turn[:2, :2]
    turn, sigma = 1e3 * float(np.hypot(x, y)), 1e3 * float(gain.sigma[0])
    return Kink(float(z), turn, float(azimuth_of(x, y)), sigma)


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


def hinge_of(cells: "Cells", at: float) -> "Floats":
    """Columns (n, 2) of the design for a hinge in x and in y, as the axis' own columns are."""
    normal, _ = normals_of(cells)
    reference, step = cells.reference, cells.reference.step
    taper = (reference.at(cells.s + step) - reference.at(cells.s - step))[:, 2] / (2.0 * step)
    lever = reference.at(cells.s)[:, 2] * taper
    rise = np.maximum(cells.s - at, 0.0) + lever * (cells.s > at)
    columns: Floats = normal * rise[:, None]
    return columns


def gain_of(problem: Problem, hinges: "list[Floats]") -> Gain:
    """Tell what each hinge would be good for, each model with its own best stiffness."""
    design, known, weight = problem.design, problem.known, problem.weight
    normal, right = product(design, weight, design), design.T @ (weight * known)
    crossed = np.array([design.T @ (weight[:, None] * h) for h in hinges])  # (m, k, 2)
    own = np.array([h.T @ (weight[:, None] * h) for h in hinges])
    told = np.array([h.T @ (weight * known) for h in hinges])
    flat = crossed.transpose(1, 0, 2).reshape(len(right), -1)
    plain, hinged, turns, variances = [], [], [], []
    for penalty, rank in zip(problem.penalties, problem.ranks, strict=True):
        factor = factor_of(normal + penalty)
        solved = factor.solve(np.column_stack([right, flat]))
        level = factor.log_determinant - rank - float(right @ solved[:, 0])
        pulled = solved[:, 1:].reshape(len(right), len(hinges), 2).transpose(1, 0, 2)
        left = own - crossed.transpose(0, 2, 1) @ pulled
        score = told - np.einsum("mki,k->mi", crossed, solved[:, 0])
        turn = np.linalg.solve(left, score[:, :, None])[:, :, 0]
        plain.append(level)
        hinged.append(level - (turn * score).sum(axis=1))
        turns.append(turn)
        variances.append(np.trace(np.linalg.inv(left), axis1=1, axis2=2) / 2.0)
    best = np.argmin(hinged, axis=0)
    rows = np.arange(len(hinges))
    fall = min(plain) - np.array(hinged)[best, rows]
    return Gain(fall, np.array(turns)[best, rows], np.sqrt(np.array(variances)[best, rows]))
