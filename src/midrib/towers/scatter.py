"""How cells err together: the bumps of a wall are larger than a cell.

c(i, j)   autocovariance of the residuals, i levels and j sectors apart; over c(0, 0) correlation
reach     where the correlation has fallen to nothing, up the tower and around it
block     so many reaches high and wide that blocks hardly err together
τ²        long-wave variance: what a sum of many cells near each other varies by, a cell;
          c(0, 0) where cells are independent, and Σ c where they are not

An axis is a long wave: of errors with the reach L its part averages out as if there were only one
cell in each area of 2πL². The variance of blocks' sums tells τ²; three things are put right:

    freedom   a fit follows the errors: E[(Σ r)²] is less than τ² times the cells of a block
    edges     cells of two blocks err together near their edges: by the blocks' part of Σ c
    weights   Tukey's weights see the same errors as smaller, by mean w over mean ψ'

References
----------
Kuensch, The jackknife and the bootstrap for general stationary observations, Annals of Statistics
17(3), 1989: blocks of a few reaches, and the edges' part of them.
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from midrib.towers.blocks import blocks_of

if TYPE_CHECKING:
    from midrib.towers.blocks import Factor
    from midrib.towers.cells import Cells
    from midrib.types import Bools, Floats

__all__ = ["Reach", "long_wave_variance", "reach_of"]

NOTHING = 0.05  # autocorrelation that counts as none
PAIRS = 20  # of cells, that tell an autocovariance
REACHES = 4  # in a block
LEAST_HEIGHT, LEAST_ANGLE = 2.5, 30.0  # metres, degrees of a block: what one beam or board is in
MOST_SHARE, MOST_ANGLE = 8, 90.0  # of the height, degrees: larger blocks are too few to tell


class Reach(NamedTuple):
    """How far residuals are correlated."""

    levels: int
    sectors: int
    correlation: "Floats"  # (2 levels + 1, 2 sectors + 1) about the middle, nothing below 0

    def inside(self, rise: int, wide: int) -> float:
        """Share of the correlation that blocks so high and wide have within them."""
        up = np.abs(np.arange(-self.levels, self.levels + 1)) / rise
        across = np.abs(np.arange(-self.sectors, self.sectors + 1)) / wide
        held = np.clip(1.0 - up, 0.0, 1.0)[:, None] * np.clip(1.0 - across, 0.0, 1.0)
        return float((self.correlation * held).sum() / self.correlation.sum())


def reach_of(cells: "Cells", errors: "Floats", used: "Bools") -> Reach:
    """Find how far errors of the used cells are correlated; O(n log n)."""
    grid = cells.grid
    field = np.zeros((2 * grid.n_levels, grid.n_sectors))  # zeros above: levels do not wrap
    there = np.zeros_like(field)
    field[cells.level[used], cells.sector[used]] = errors[used]
    there[cells.level[used], cells.sector[used]] = 1.0
    pairs = np.fft.irfft2(np.abs(np.fft.rfft2(there)) ** 2, s=field.shape)
    sums = np.fft.irfft2(np.abs(np.fft.rfft2(field)) ** 2, s=field.shape)
    mean = np.where(pairs > PAIRS, sums / np.maximum(pairs, 1.0), 0.0)
    if mean[0, 0] <= 0.0:
        return Reach(0, 0, np.ones((1, 1)))
    correlation = mean / mean[0, 0]
    levels = first_nothing(correlation[: max(2, grid.n_levels // MOST_SHARE), 0])
    sectors = first_nothing(correlation[0, : max(2, grid.n_sectors // 4)])
    near = correlation[np.ix_(range(-levels, levels + 1), range(-sectors, sectors + 1))]
    return Reach(levels, sectors, np.maximum(near, 0.0))


def first_nothing(correlation: "Floats") -> int:
    """First step at which an autocorrelation has fallen to nothing."""
    low = np.flatnonzero(correlation < NOTHING)
    return int(low[0]) if low.size else len(correlation)


def long_wave_variance(
    cells: "Cells",
    design: "Any",
    normal: "Floats",
    inverse: "Factor",
    weight: "Floats",
    residual: "Floats",
    unit: float,
) -> float:
    """Long-wave variance τ² of a cell from the residuals of a fit.

    Parameters
    ----------
    cells : Cells
    design : sparse (n, k)
    normal : (k, k) design' weight design
    inverse : Factor of the (k, k) normal matrix with its penalty, in units of ``normal``
    weight, residual : (n,)
    unit : coordinate units in a metre

    Returns
    -------
    float
        In squared coordinate units: the mean of two sizes of blocks, twice as large the second.
    """
    grid = cells.grid
    reach = reach_of(cells, weight * residual, weight > 0.0)
    rise = max(REACHES * reach.levels, round(LEAST_HEIGHT * unit / grid.level))
    wide = max(REACHES * reach.sectors, round(LEAST_ANGLE / 360.0 * grid.n_sectors))
    most = max(1, grid.n_levels // MOST_SHARE), max(1, round(MOST_ANGLE / 360.0 * grid.n_sectors))
    found = []
    for size in (1, 2):
        high, across = (min(size * a, b) for a, b in zip((rise, wide), most, strict=True))
        sums, freedom = block_sums(
            blocks_of(cells, high, across), design, normal, inverse, weight, residual
        )
        found.append(float((sums**2).sum()) / max(freedom, 1e-300) / reach.inside(high, across))
    return float(np.mean(found))


def block_sums(
    block: "Any",
    design: "Any",
    normal: "Floats",
    inverse: "Factor",
    weight: "Floats",
    residual: "Floats",
) -> "tuple[Floats, float]":
    """Weighted sums (b,) of residuals in blocks, and what their squares add up to if τ² is 1."""
    from scipy.sparse import csr_array

    gather = csr_array((weight, (block, np.arange(block.size))))
    parts = (gather @ design).toarray()
    pulled = inverse.solve(parts.T).T
    cells = float(weight.sum())
    followed = 2.0 * float((pulled * parts).sum()) - float(((pulled @ normal) * pulled).sum())
    return gather @ residual, cells - followed
