"""The joint model: one spline axis and one spline taper through all cells at once.

x, y, r   splines along the frame's axis; r is stiff
e, f      oval: cos 2θ and sin 2θ in the radius, stiffer still; only where the section has it
n         outward normal of the shell in the section: the cell's azimuth, or its face's normal

A cell that is d beyond the reference shell (x₀, y₀, r₀) tells

    d = n · (x - x₀, y - y₀) + (r - r₀) + r r' n · (x - x₀, y - y₀)'  [+ e cos 2θ + f sin 2θ]

The third term is the tapered shell's: its foot moves along the axis when the axis turns.
Where only a part of the shell is seen, x and r cannot be told apart level by level; the stiff taper
does it.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from midrib.towers.blocks import factor_of, product
from midrib.towers.grazing import grazed
from midrib.towers.rings import beyond_rings
from midrib.towers.scatter import long_wave_variance
from midrib.towers.smoothing import best_stiffness
from midrib.towers.splines import Basis, basis_on
from midrib.towers.weights import lost_to_weights, tukey

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.types import Bools, Floats, Ints

__all__ = [
    "MIXED",
    "PLIANT",
    "Fit",
    "design_of",
    "fit_cells",
    "mixed",
    "normals_of",
    "variance_left",
]

KNOTS, OVAL_KNOTS = 2.5, 20.0  # metres: of axis and taper, of ovals
ROUNDS, CHOOSING = 14, (2, 5)
WEIGHED = 2  # times that a pliant curve's own residuals weigh, before they tell the variance
MIXED = 1e-3  # weight of cells that a leap may go through
SETTLED = 0.5  # of the pliant taper's stiffness: where the next one is no softer, it is found
CORNER = 0.12  # of a face's angle: cells nearer to a corner than that are left out
LEAST_ERROR = 1e-6  # metres: of a cell, where there is no noise at all
USUAL = (1e3, 1e6)  # stiffnesses to begin with: straight lines and cones are free anyway
PLIANT = (3e1, 1e5)


class Model(NamedTuple):
    """Design of the unknowns: x, y, r, and e, f where the shell is oval."""

    axis: Basis
    taper: Basis
    oval: Basis | None

    @property
    def smooth(self) -> "Model":
        """The same without leaps."""
        axis, taper = (basis._replace(leaps=np.zeros(0)) for basis in (self.axis, self.taper))
        return Model(axis, taper, self.oval)

    @property
    def ends(self) -> "Ints":
        """Where the coefficients of x, y, r, e, f end."""
        sizes = [self.axis.size, self.axis.size, self.taper.size]
        if self.oval is not None:
            sizes += [self.oval.size] * 2
        return np.cumsum(sizes)

    @property
    def bends(self) -> tuple[int, int]:
        """Numbers of coefficients that axis stiffness and taper stiffness hold."""
        oval = 0 if self.oval is None else 2 * (self.oval.smooth - 2)
        return 2 * (self.axis.smooth - 2), self.taper.smooth - 2 + oval

    @property
    def straight(self) -> "Floats":
        """Coefficients (unknowns, 6) of straight x, y, r: what no penalty holds."""
        ends = self.ends
        lines = np.zeros((ends[-1], 6))
        starts = [0, *ends[:-1]]
        for k, basis in enumerate((self.axis, self.axis, self.taper)):
            rows = slice(starts[k], ends[k])
            lines[rows, 2 * k : 2 * k + 2] = basis.lines
        return lines

    def penalty(self, axis: float, taper: float) -> "Floats":
        """Penalty matrix for given stiffnesses."""
        ends = self.ends
        whole = np.zeros((ends[-1], ends[-1]))
        starts = [0, *ends[:-1]]
        parts = [axis * self.axis.penalty] * 2 + [taper * self.taper.penalty]
        if self.oval is not None:
            parts += [1e2 * taper * self.oval.penalty] * 2
        for first, last, part in zip(starts, ends, parts, strict=True):
            whole[first:last, first:last] = part
        return whole


@dataclass(frozen=True, eq=False)
class Fit:
    """A fitted model."""

    model: Model
    coefficients: "Floats"
    covariance: "Floats"
    weight: "Floats"  # (n,) of the cells, 0 to 1
    residual: "Floats"  # (n,) of the cells
    stiffness: tuple[float, float]
    bends: "Floats"  # coefficients less those of straight lines
    variance: float  # long-wave variance of a cell

    def values(self, s: "Floats") -> "Floats":
        """x, y, r (n, 3) at heights."""
        columns = []
        first = 0
        for basis, last in zip(
            (self.model.axis, self.model.axis, self.model.taper), self.model.ends, strict=False
        ):
            columns.append(basis.design(s) @ self.coefficients[first:last])
            first = last
        return np.column_stack(columns)

    def slopes(self, s: "Floats") -> "Floats":
        """Slopes of x and y (n, 2) at heights."""
        n = self.model.axis.size
        design = self.model.axis.design(s, 1)
        return np.column_stack(
            [design @ self.coefficients[:n], design @ self.coefficients[n : 2 * n]]
        )

    def leaps(self) -> "tuple[Floats, Floats]":
        """Sizes (m, 2) of the leaps of x and y, and their standard deviations."""
        n, m = self.model.axis.size, len(self.model.axis.leaps)
        rows = np.array([np.arange(n - m, n), np.arange(2 * n - m, 2 * n)]).T
        sigma = np.sqrt(np.diag(self.covariance))
        return self.coefficients[rows], sigma[rows]

    def steps(self) -> "tuple[Floats, Floats]":
        """Sizes (m,) of the steps of the radius, and their standard deviations."""
        last, m = self.model.ends[2], len(self.model.taper.leaps)
        rows = slice(last - m, last)
        return self.coefficients[rows], np.sqrt(np.diag(self.covariance)[rows])

    def oval(self, s: "Floats") -> "Floats":
        """Coefficients e and f (n, 2) at heights; zero if the model is round."""
        if self.model.oval is None:
            return np.zeros((s.size, 2))
        first = self.model.ends[2]
        design, n = self.model.oval.design(s), self.model.oval.size
        return np.column_stack(
            [design @ self.coefficients[first : first + n], design @ self.coefficients[first + n :]]
        )

    def covariances(self, s: "Floats") -> "Floats":
        """Covariances (n, 2, 2) of x and y at heights."""
        n = self.model.axis.size
        design = self.model.axis.design(s)
        found = np.empty((s.size, 2, 2))
        for i in range(2):
            for j in range(2):
                block = self.covariance[i * n : (i + 1) * n, j * n : (j + 1) * n]
                found[:, i, j] = ((design @ block) * design).sum(axis=1)
        return found


def normals_of(cells: "Cells") -> "tuple[Floats, Bools]":
    """Outward normals (n, 2) of the shell at cells, and which cells are on no corner."""
    faces = cells.reference.faces
    direction = np.column_stack([np.cos(cells.azimuth), np.sin(cells.azimuth)])
    if not len(faces):
        return direction, np.ones(len(direction), dtype=np.bool_)
    along = direction @ faces.T
    face = np.argmax(along, axis=1)
    angle = np.arccos(np.clip(along.max(axis=1), -1.0, 1.0))
    half = np.pi / len(faces)
    margin = CORNER * 2.0 * half + np.pi / cells.grid.n_sectors
    return faces[face], angle < half - margin


def fit_cells(
    cells: "Cells",
    unit: float,
    *,
    is_oval: bool = False,
    leaps: "Floats | tuple[float, ...]" = (),
    steps: "Floats | tuple[float, ...]" = (),
    rough: bool = False,
) -> Fit:
    """Fit axis and taper to cells; a ``rough`` fit has the usual stiffnesses and no covariance.

    At the heights ``leaps`` the axis leaps, at ``steps`` the radius; cells that are partly below
    one hardly count.

    Notes
    -----
    Tukey's weights against what is not the wall. What cells err by together, the long-wave variance
    τ², is told by the residuals (see ``scatter``); with it the stiffnesses are the likeliest ones,
    and the covariance is that of the coefficients given the cells (Nychka 1988), which allows for
    what a smooth curve misses. O(n log n) for n cells, and dense solutions for the unknowns.
    """
    low, high = float(cells.s.min()), float(cells.s.max())
    spacing = max(KNOTS * unit, 2.0 * cells.grid.level)
    model = Model(
        basis_on(low, high, spacing, leaps),
        basis_on(low, high, spacing, steps),
        basis_on(low, high, OVAL_KNOTS * unit) if is_oval else None,
    )
    design, known = design_of(cells, model)
    # Straight lines are taken off first: what is left is small, and so are rounding errors.
    lines = model.straight
    straight = lines @ np.linalg.lstsq(design @ lines, known, rcond=None)[0]
    known = known - design @ straight
    normal_of_cell, off_corner = normals_of(cells)
    prior = (off_corner & ~grazed(cells, unit)).astype(np.float64)
    prior[mixed(cells, model)] *= MIXED
    variance, stiffness = 1.0, (USUAL[0] * unit**3, USUAL[1] * unit**3)
    weight: Floats = prior
    residual: Floats = known
    beyond = beyond_rings(cells, normal_of_cell, prior, unit)
    if beyond is not None:
        # The rings alone weigh: by a fit's own residuals a zone that it misses would be thrown out,
        # and the fit, free of it, would miss more of it the next time.
        weight = prior * tukey(beyond, prior > 0.0, unit)
        variance, stiffness = chosen_by_turns(cells, design, known, model, prior, weight, unit)
    for round_ in range(ROUNDS):
        normal, right = product(design, weight, design), design.T @ (weight * known)
        inverse = factor_of(normal + variance * model.penalty(*stiffness))
        bends = inverse.solve(right)
        residual = known - design @ bends
        if beyond is not None:
            break
        if round_ in CHOOSING and not rough:
            pliant = model.penalty(*(unit**3 * k for k in PLIANT))
            variance, _ = variance_left(cells, design, known, pliant, weight, unit)
            stiffness = best_stiffness(normal / variance, right / variance, model, unit)
        before, weight = weight, prior * tukey(residual, prior > 0.0, unit)
        if round_ > max(CHOOSING) and np.abs(weight - before).max() < 0.01:
            break
    covariance = np.zeros((0, 0))
    if not rough:
        told = product(design, weight, design) / variance + model.penalty(*stiffness)
        covariance = factor_of(told).solve(np.eye(len(told)))
    whole = straight + bends
    return Fit(model, whole, covariance, weight, residual, stiffness, bends, variance)


def mixed(cells: "Cells", model: Model) -> "Bools":
    """Which cells are partly below a leap."""
    leaps = np.concatenate([model.axis.leaps, model.taper.leaps])
    found: Bools = (np.abs(cells.s[:, None] - leaps) <= cells.grid.level / 2.0).any(axis=1)
    return found


def chosen_by_turns(
    cells: "Cells",
    design: "Any",
    known: "Floats",
    model: Model,
    prior: "Floats",
    weight: "Floats",
    unit: float,
) -> tuple[float, tuple[float, float]]:
    """Long-wave variance and the likeliest stiffnesses of a batter that may bend, by turns.

    A pliant taper that is too stiff leaves the batter's own bends, which count as errors; a soft
    one follows the wall's bumps, which then do not. So it is as stiff as the likeliest, and that is
    found by and by. The variance goes by the curve's own residuals: rings know no axis, and with
    their weights cells beside a sharp kink, which no spline follows, would count as errors of the
    whole wall, so that kinks drown in them.
    """
    normal, right = product(design, weight, design), design.T @ (weight * known)
    axis, taper = (unit**3 * k for k in PLIANT)
    for _ in range(ROUNDS):
        pliant, own = model.penalty(axis, taper), weight
        for _ in range(WEIGHED):
            _, left = variance_left(cells, design, known, pliant, own, unit)
            own = prior * tukey(left, prior > 0.0, unit)
        variance, _ = variance_left(cells, design, known, pliant, own, unit)
        stiffness = best_stiffness(normal / variance, right / variance, model, unit)
        before, taper = taper, min(taper, variance * stiffness[1])
        if taper > SETTLED * before:
            break
    return variance, stiffness


def variance_left(
    cells: "Cells", design: "Any", known: "Floats", pliant: "Floats", weight: "Floats", unit: float
) -> "tuple[float, Floats]":
    """Long-wave variance of a cell by what a pliant curve leaves (n,), and this.

    What it leaves is error; a stiff curve leaves the tower's own bends too.
    """
    normal = product(design, weight, design)
    inverse = factor_of(normal + pliant)
    left = known - design @ inverse.solve(design.T @ (weight * known))
    variance = long_wave_variance(cells, design, normal, inverse, weight, left, unit)
    variance *= lost_to_weights(left, weight, unit) ** 2
    return max(variance, (LEAST_ERROR * unit) ** 2), left


def design_of(cells: "Cells", model: Model) -> "tuple[Any, Floats]":
    """Sparse design (n, unknowns) and what it has to explain: d and the reference's own part."""
    from scipy.sparse import csr_array, hstack

    normal, _ = normals_of(cells)
    reference, step = cells.reference.at(cells.s), cells.reference.step
    ahead, behind = cells.reference.at(cells.s + step), cells.reference.at(cells.s - step)
    taper = (ahead[:, 2] - behind[:, 2]) / (2.0 * step)
    lever = (reference[:, 2] * taper)[:, None]
    along = csr_array(model.axis.design(cells.s) + lever * model.axis.design(cells.s, 1))
    parts = [along.multiply(normal[:, :1]), along.multiply(normal[:, 1:])]
    parts.append(csr_array(model.taper.design(cells.s)))
    if model.oval is not None:
        oval = csr_array(model.oval.design(cells.s))
        double = 2.0 * cells.azimuth[:, None]
        parts += [oval.multiply(np.cos(double)), oval.multiply(np.sin(double))]
    known = cells.d + reference[:, 2]
    known = known + (normal * (reference[:, :2] + lever * reference[:, 3:5])).sum(axis=1)
    return csr_array(hstack(parts)), known
