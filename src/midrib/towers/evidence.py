"""Evidence for hinges and leaps of an axis: by how much -2 log L falls.

h_j(s)    hinge: 0 below the height s_j, s - s_j above it
l_k(s)    leap: 0 below level k, 1 above; level k itself, whose cells are mixed, is where it likes
β         change of direction, or offset, there, of x and y
λ, τ²     stiffness of the smooth axis and long-wave variance of a cell, as of the joint fit

Polynomials up to a degree are free of the penalty: they bend the tower as a whole, and would make
the rest as pliant. The joint model with β h_j or β l_k in its axis is held against the one without,
each with the stiffness that suits it best. What freeing level k is good for alone is no evidence of
a leap: it may be a flange.

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

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.towers.joint import Fit
    from midrib.towers.splines import Basis
    from midrib.types import Bools, Floats, Ints

__all__ = ["Gain", "Problem", "Trials", "gain_of", "problem_of", "trials_between"]

STEP, MOST = 0.5, 240  # metres between heights of hinges; how many of them at the most
STIFFNESSES = AXIS_STIFFNESS[::2]  # every second one: a factor of 10 is near enough
BEND, BENDS = 10.0, (3, 7)  # metres of a tower for each degree of what bends all of it; bounds
LEAST_NOISE = 1e-4  # metres, of a cell: bends that splines miss, where a scan has less noise


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
    """Hinges and leaps that are tried: columns (n, 2) or (n, 4) of a design each."""

    heights: "Floats"  # (m,)
    is_leap: "Bools"  # (m,)
    columns: "list[Floats]"
    apart: float  # two that are chosen are so far apart at the least

    def beside(self, taken: "Floats") -> "Trials":
        """Return those that are far enough from heights that are taken."""
        away = np.abs(self.heights[:, None] - taken)
        rows = (away >= self.apart * (1.0 - 1e-9)).all(axis=1)
        columns = [self.columns[i] for i in np.flatnonzero(rows)]
        return Trials(self.heights[rows], self.is_leap[rows], columns, self.apart)

    def free(self, rows: "Ints", chosen: list[int]) -> "Ints":
        """Those of some rows that are far enough from all that are chosen."""
        away = np.abs(self.heights[rows][:, None] - self.heights[chosen])
        found: Ints = rows[(away >= self.apart * (1.0 - 1e-9)).all(axis=1)]
        return found


class Gain(NamedTuple):
    """What hinges and leaps are good for."""

    fall: "Floats"  # (m,) of -2 log L
    own: "Floats"  # (m,) the same, less what columns beyond the first two are good for alone
    size: "Floats"  # (m, 2) of what each changes: direction, or place
    sigma: "Floats"  # (m,) of either part of it


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


def trials_between(cells: "Cells", low: float, high: float, apart: float, unit: float) -> Trials:
    """Hinges, then leaps, between two heights: in x and in y, as the axis' own columns are."""
    normal, _ = normals_of(cells)
    reference, step = cells.reference, cells.reference.step
    taper = (reference.at(cells.s + step) - reference.at(cells.s - step))[:, 2] / (2.0 * step)
    lever = reference.at(cells.s)[:, 2] * taper
    heights = np.arange(low, high, max(STEP * unit, (high - low) / MOST))
    middles = cells.grid.middles
    levels = np.flatnonzero((middles >= low) & (middles <= high))
    hinges = [normal * ((cells.s - at + lever) * (cells.s > at))[:, None] for at in heights]
    leaps = [
        np.concatenate(
            [normal * (cells.level > level)[:, None], normal * (cells.level == level)[:, None]],
            axis=1,
        )
        for level in levels
    ]
    is_leap = np.repeat([False, True], [heights.size, levels.size])
    every = np.concatenate([heights, middles[levels]])
    return Trials(every, is_leap, hinges + leaps, apart)


def gain_of(problem: Problem, columns: "list[Floats]") -> Gain:
    """Tell what each hinge or leap would be good for, each model with its own best stiffness."""
    design, known, weight = problem.design, problem.known, problem.weight
    normal, right = product(design, weight, design), design.T @ (weight * known)
    crossed = np.array([design.T @ (weight[:, None] * c) for c in columns])  # (m, k, 2 or 4)
    own = np.array([c.T @ (weight[:, None] * c) for c in columns])
    told = np.array([c.T @ (weight * known) for c in columns])
    flat = crossed.transpose(1, 0, 2).reshape(len(right), -1)
    width = own.shape[2]
    # Cells that do not count tell nothing of a level's own columns.
    own += 1e-12 * own.max(initial=0.0) * np.eye(width)
    plain, beside_level, broken, sizes, variances = [], [], [], [], []
    for penalty, rank in zip(problem.penalties, problem.ranks, strict=True):
        factor = factor_of(normal + penalty)
        solved = factor.solve(np.column_stack([right, flat]))
        level = factor.log_determinant - rank - float(right @ solved[:, 0])
        pulled = solved[:, 1:].reshape(len(right), len(columns), width).transpose(1, 0, 2)
        left = own - crossed.transpose(0, 2, 1) @ pulled
        score = told - np.einsum("mki,k->mi", crossed, solved[:, 0])
        size = np.linalg.solve(left, score[:, :, None])[:, :, 0]
        alone = np.linalg.solve(left[:, 2:, 2:], score[:, 2:, None])[:, :, 0]
        plain.append(level)
        beside_level.append(level - (alone * score[:, 2:]).sum(axis=1))
        broken.append(level - (size * score).sum(axis=1))
        sizes.append(size[:, :2])
        variances.append(np.trace(np.linalg.inv(left)[:, :2, :2], axis1=1, axis2=2) / 2.0)
    best = np.argmin(broken, axis=0)
    rows = np.arange(len(columns))
    least = np.array(broken)[best, rows]
    sigma = np.sqrt(np.maximum(np.array(variances)[best, rows], 0.0))
    return Gain(
        min(plain) - least, np.min(beside_level, axis=0) - least, np.array(sizes)[best, rows], sigma
    )
