"""Normal equations of cells, and errors that come in blocks.

block     cells near each other: the same bump of the wall, or beam, may be in all of them
"""

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.types import Floats, Ints

__all__ = ["blocks_of", "covariance_of", "joined", "product", "solved"]

RIDGE = 1e-10  # of the scaled diagonal


def product(left: "Any", weight: "Floats", right: "Any") -> "Floats":
    """Weighted product of two sparse designs, dense."""
    dense: Floats = np.asarray((left.T @ right.multiply(weight[:, None]).tocsr()).toarray())
    return dense


def solved(normal: "Floats", right: "Floats") -> "Floats":
    """Solve normal equations, with the least of a ridge against unknowns that nothing tells."""
    from scipy.linalg import cho_factor, cho_solve

    diagonal = np.diag(normal)
    scale = 1.0 / np.sqrt(np.maximum(diagonal, 1e-12 * diagonal.max()))
    scaled = normal * np.outer(scale, scale) + RIDGE * np.eye(len(normal))
    answer: Floats = cho_solve(cho_factor(scaled), (right.T * scale).T)
    unscaled: Floats = (answer.T * scale).T
    return unscaled


def blocks_of(cells: "Cells", height: float, around: int) -> "Ints":
    """Block of each cell, numbered from 0: so high, and so many around the tower."""
    rise = max(1, round(height / cells.grid.level))
    wide = max(1, cells.grid.n_sectors // around)
    key = cells.level // rise * cells.grid.n_sectors + cells.sector // wide
    _, block = np.unique(key, return_inverse=True)
    numbers: Ints = block.astype(np.intp)
    return numbers


def joined(errors: "Floats", block: "Ints") -> float:
    """How many cells count as one, as they err together in blocks; at least 1."""
    sums = np.bincount(block, weights=errors)
    return max(1.0, float((sums**2).sum() / max((errors**2).sum(), 1e-300)))


def covariance_of(
    design: "Any", weight: "Floats", residual: "Floats", block: "Ints", penalty: "Floats"
) -> "Floats":
    """Covariance of the coefficients: jackknife over blocks, and what the penalty hides."""
    normal = product(design, weight, design)
    inverse = solved(normal + penalty, np.eye(len(normal)))
    order = np.argsort(block, kind="stable")
    starts = np.flatnonzero(np.diff(block[order], prepend=-1))
    meat = np.zeros_like(normal)
    for rows in np.split(order, starts[1:]):
        root = np.sqrt(weight[rows])
        part = design[rows].toarray() * root[:, None]
        told = np.eye(len(rows)) - part @ inverse @ part.T
        pull = part.T @ np.linalg.solve(told + 1e-3 * np.eye(len(rows)), root * residual[rows])
        meat += np.outer(pull, pull)
    free = max(float((weight > 0.0).sum() - np.trace(inverse @ normal)), 1.0)
    noise = float((weight * residual**2).sum()) / free
    together = float(np.trace(meat @ inverse)) / max(
        noise * float(np.trace(normal @ inverse)), 1e-300
    )
    share = noise * max(together, 1.0)
    covariance: Floats = inverse @ (meat + share * penalty) @ inverse
    return covariance
