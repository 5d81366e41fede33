"""Normal equations of cells, and blocks of cells.

block     cells near each other: the same bump of the wall, or beam, may be in all of them
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.types import Floats, Ints

__all__ = ["Factor", "blocks_of", "factor_of", "product"]

RIDGE = 1e-13  # of the scaled diagonal


class Factor(NamedTuple):
    """A symmetric matrix, factored: L L' = D A D with ones on the diagonal."""

    matrix: "Floats"
    scale: "Floats"
    lower: "Floats"

    def solve(self, right: "Floats") -> "Floats":
        """Solve, with one step of refinement against what the ridge does."""
        answer = self.once(right)
        return answer + self.once(right - self.matrix @ answer)

    def once(self, right: "Floats") -> "Floats":
        """Solve with the ridge."""
        from scipy.linalg import cho_solve

        scaled: Floats = cho_solve((self.lower, True), (right.T * self.scale).T)
        unscaled: Floats = (scaled.T * self.scale).T
        return unscaled

    @property
    def log_determinant(self) -> float:
        """Natural logarithm of the determinant."""
        return 2.0 * float(np.log(np.diag(self.lower)).sum() - np.log(self.scale).sum())


def factor_of(matrix: "Floats") -> Factor:
    """Factor a normal matrix, with the least of a ridge against unknowns that nothing tells."""
    from scipy.linalg import cholesky

    diagonal = np.diag(matrix)
    scale = 1.0 / np.sqrt(np.maximum(diagonal, 1e-12 * diagonal.max()))
    scaled = matrix * np.outer(scale, scale) + RIDGE * np.eye(len(matrix))
    return Factor(matrix, scale, cholesky(scaled, lower=True))


def product(left: "Any", weight: "Floats", right: "Any") -> "Floats":
    """Weighted product of two sparse designs, dense."""
    dense: Floats = np.asarray((left.T @ right.multiply(weight[:, None]).tocsr()).toarray())
    return dense


def blocks_of(cells: "Cells", rise: int, wide: int) -> "Ints":
    """Block of each cell, numbered from 0: so many levels high, about so many sectors wide."""
    sectors = cells.grid.n_sectors
    around = max(1, round(sectors / wide))
    key = cells.level // rise * around + cells.sector * around // sectors
    _, block = np.unique(key, return_inverse=True)
    numbers: Ints = block.astype(np.intp)
    return numbers
