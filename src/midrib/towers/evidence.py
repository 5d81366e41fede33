"""Evidence for breaks of an axis, and of the wall around it: by how much -2 log L falls.

h_j(s)    hinge: 0 below the height s_j, s - s_j above it
l_k(s)    leap: 0 below level k, 1 above; level k itself, whose cells are mixed, is where it likes
β         change of direction, or of place, there: of x and y, or of the radius
λ, τ²     stiffness of the smooth axis and long-wave variance of a cell, as of the joint fit

    break     part     column       is
    kink      axis     h_j
    offset    axis     l_k
    batter    radius   h_j          a change of the taper: no leap, but it would look like steps
    step      radius   l_k

Polynomials up to a degree are free of the penalty: they bend the tower as a whole, and would make
the rest as pliant. The joint model with β h_j or β l_k in it is held against the one without, each
with the stiffness of the axis that suits it best. What freeing level k is good for alone is no
evidence of a leap: it may be a flange.

References
----------
Ansley and Kohn, Estimation, filtering and smoothing in state space models with incompletely
specified initial conditions, Annals of Statistics 13(4), 1985: smoothing splines beside regressors.
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from midrib.towers.blocks import factor_of, product
from midrib.towers.joint import MIXED, PLIANT, design_of, mixed, normals_of, variance_left
from midrib.towers.smoothing import AXIS_STIFFNESS

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.towers.joint import Fit
    from midrib.towers.splines import Basis
    from midrib.types import Bools, Floats, Ints

__all__ = ["OF_AXIS", "OWN", "Gain", "Problem", "Trials", "gain_of", "problem_of", "trials_of"]

STEP, MOST = 0.5, 240  # metres between heights of hinges; how many of them at the most
STIFFNESSES = AXIS_STIFFNESS[::2]  # every second one: a factor of 10 is near enough
BEND, BENDS = 10.0, (3, 7)  # metres of a tower for each degree of what bends all of it; bounds
LEAST_NOISE = 1e-4  # metres, of a cell: bends that splines miss, where a scan has less noise
OWN = {"kink": 2, "offset": 2, "batter": 1, "step": 1}  # columns; others free a level
OF_AXIS = ("kink", "offset")


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
    """Hinges and leaps that are tried: columns (n, c) of a design each."""

    heights: "Floats"  # (m,)
    kinds: "np.ndarray[Any, np.dtype[np.str_]]"  # (m,)
    columns: "list[Floats]"
    apart: tuple[float, float]  # two of the wall, or of the axis, are so far apart at the least

    @property
    def is_of_axis(self) -> "Bools":
        """(m,) which break the axis, not the wall around it."""
        return np.isin(self.kinds, OF_AXIS)

    def away(self, taken: "Floats", part: int) -> "Bools":
        """(m,) which are far enough from heights that are taken by breaks of a part."""
        distance = np.abs(self.heights[:, None] - taken)
        return np.asarray((distance >= self.apart[part] * (1.0 - 1e-9)).all(axis=1))

    def free(self, rows: "Ints", chosen: list[int]) -> "Ints":
        """Those of some rows that are far enough from all of their part that are chosen."""
        of_axis, taken = self.is_of_axis, np.array(chosen, dtype=np.intp)
        away = [self.away(self.heights[taken[of_axis[taken] == part]], part) for part in (0, 1)]
        found: Ints = rows[np.where(of_axis, away[1], away[0])[rows]]
        return found


class Gain(NamedTuple):
    """What breaks of one kind are good for."""

    fall: "Floats"  # (m,) of -2 log L
    own: "Floats"  # (m,) the same, less what columns beyond their own are good for alone
    size: "Floats"  # (m, 1 or 2) of what each changes: direction, or place, or radius
    sigma: "Floats"  # (m,) of either part of it


def problem_of(cells: "Cells", fit: "Fit", unit: float) -> Problem:
    """Return the joint fit's least squares, with a penalty for every stiffness of the axis.

    What leaps in the fit does not in the problem: found beside what was not yet known, it has to be
    found again. The variance is that beside whole rings, for a step of the radius that is not yet
    known makes rings of residuals, in which all else would drown.
    """
    leaping, _ = design_of(cells, fit.model)
    known = leaping @ fit.bends + fit.residual
    variance = ringless_variance(cells, leaping, known, fit, unit)
    model = fit.model.smooth
    design, _ = design_of(cells, model)
    variance = max(min(variance, fit.variance), (LEAST_NOISE * unit) ** 2)
    stiffnesses = STIFFNESSES * unit
    axis = model.axis
    degree = int(np.clip(round((axis.knots[-1] - axis.knots[0]) / (BEND * unit)), *BENDS))
    size, free = axis.size, free_of_bends(axis, degree)
    penalties = []
    for stiffness in stiffnesses:
        penalty = model.penalty(0.0, fit.stiffness[1])
        for first in (0, size):
            penalty[first : first + size, first : first + size] = stiffness * free
        penalties.append(penalty)
    ranks = (model.bends[0] - 2 * (degree - 1)) * np.log(stiffnesses)
    weight = fit.weight / np.where(mixed(cells, fit.model), MIXED, 1.0)
    return Problem(design, known, weight / variance, penalties, ranks)


def ringless_variance(
    cells: "Cells", design: "Any", known: "Floats", fit: "Fit", unit: float
) -> float:
    """Long-wave variance of a cell beside a radius that is free at every level."""
    from scipy.sparse import csr_array, hstack

    first, last = fit.model.ends[1:3]
    kept = np.r_[0:first, last : design.shape[1]]
    levels = csr_array((np.ones(cells.s.size), (np.arange(cells.s.size), cells.level)))
    pliant = fit.model.penalty(*(unit**3 * k for k in PLIANT))[np.ix_(kept, kept)]
    free = csr_array(hstack([design[:, kept], levels]))
    pliant = np.pad(pliant, (0, levels.shape[1]))
    return variance_left(cells, free, known, pliant, fit.weight, unit)[0]


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


def trials_of(
    cells: "Cells", ends: tuple[float, float], apart: tuple[float, float], unit: float
) -> Trials:
    """Return breaks of every kind, those of the axis in x and in y as its own columns are.

    ``ends`` is how far from either end those of the wall are, and those of the axis.
    """
    normal, _ = normals_of(cells)
    reference, step = cells.reference, cells.reference.step
    taper = (reference.at(cells.s + step) - reference.at(cells.s - step))[:, 2] / (2.0 * step)
    lever = reference.at(cells.s)[:, 2] * taper
    middles, every = cells.grid.middles, np.ones((cells.s.size, 1))
    columns, heights, counts = [], [], []
    for part, own, lift, level in (
        (1, normal, lever, normal),
        (0, every, 0.0, np.hstack([normal, every])),
    ):
        low, high = float(cells.s.min()) + ends[part], float(cells.s.max()) - ends[part]
        hinged = np.arange(low, high, max(STEP * unit, (high - low) / MOST))
        levels = np.flatnonzero((middles >= low) & (middles <= high))
        columns += [own * ((cells.s - at + lift) * (cells.s > at))[:, None] for at in hinged]
        columns += [
            np.hstack([own * (cells.level > k)[:, None], level * (cells.level == k)[:, None]])
            for k in levels
        ]
        heights += [*hinged, *middles[levels]]
        counts += [hinged.size, levels.size]
    return Trials(np.array(heights), np.repeat(list(OWN), counts), columns, apart)


def gain_of(problem: Problem, columns: "list[Floats]", own: int) -> Gain:
    """Tell what each break would be good for, each model with its own best stiffness.

    The first ``own`` columns are the break's, the others free a level.
    """
    design, known, weight = problem.design, problem.known, problem.weight
    normal, right = product(design, weight, design), design.T @ (weight * known)
    crossed = np.array([design.T @ (weight[:, None] * c) for c in columns])  # (m, k, c)
    inner = np.array([c.T @ (weight[:, None] * c) for c in columns])
    told = np.array([c.T @ (weight * known) for c in columns])
    flat = crossed.transpose(1, 0, 2).reshape(len(right), -1)
    width = inner.shape[2]
    # Cells that do not count tell nothing of a level's own columns.
    inner += 1e-12 * inner.max(initial=0.0) * np.eye(width)
    plain, beside_level, broken, sizes, variances = [], [], [], [], []
    for penalty, rank in zip(problem.penalties, problem.ranks, strict=True):
        factor = factor_of(normal + penalty)
        solved = factor.solve(np.column_stack([right, flat]))
        level = factor.log_determinant - rank - float(right @ solved[:, 0])
        pulled = solved[:, 1:].reshape(len(right), len(columns), width).transpose(1, 0, 2)
        left = inner - crossed.transpose(0, 2, 1) @ pulled
        score = told - np.einsum("mki,k->mi", crossed, solved[:, 0])
        size = np.linalg.solve(left, score[:, :, None])[:, :, 0]
        alone = np.linalg.solve(left[:, own:, own:], score[:, own:, None])[:, :, 0]
        plain.append(level)
        beside_level.append(level - (alone * score[:, own:]).sum(axis=1))
        broken.append(level - (size * score).sum(axis=1))
        sizes.append(size[:, :own])
        spread = np.linalg.inv(left)[:, :own, :own]
        variances.append(np.trace(spread, axis1=1, axis2=2) / own)
    best = np.argmin(broken, axis=0)
    rows = np.arange(len(columns))
    least = np.array(broken)[best, rows]
    sigma = np.sqrt(np.maximum(np.array(variances)[best, rows], 0.0))
    return Gain(
        min(plain) - least, np.min(beside_level, axis=0) - least, np.array(sizes)[best, rows], sigma
    )
