"""Rings: sections of single levels, by which cells are weighed before the taper is known.

ring      the section of one level, a circle seen all round or a polygon by most of its faces,
          as (x, y, r) beyond the reference shell
smooth    the medians of the rings near by

A stiff cone does not fit a tower whose batter bends or breaks, and weights by its residuals would
throw out whole zones. A ring knows nothing of the taper, and what lies off it is no wall. A ring
that is far from its neighbours is a platform's or a flange's: there the smooth one counts.
"""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.types import Bools, Floats

__all__ = ["beyond_rings", "is_seen", "rings_of"]

SEEN = 300.0  # degrees of a level that tell its circle
FACES, FACE_CELLS = 3, 2  # faces that tell a polygon, if more than half; cells they are seen by
NEAR = 2.5  # metres above and below: whose median counts
FAR = 0.015  # metres from the smooth ring: a batter that breaks moves no ring so far
ROUNDS, CLIPPED = 8, 1.5  # of Huber's weights, and their bound in standard deviations
MOST = 0.5  # of the levels must have rings: fewer are no ground to loosen the taper on


def beyond_rings(cells: "Cells", normal: "Floats", prior: "Floats", unit: float) -> "Floats | None":
    """Distances (n,) of cells beyond the rings; None unless most levels have one.

    Levels without a ring take those of their neighbours.
    """
    grid = cells.grid
    used = prior > 0.0
    has_ring = is_seen(cells, normal, used)
    if has_ring.sum() <= MOST * np.unique(cells.level[used]).size:
        return None
    design = np.column_stack([normal, np.ones(cells.d.size)])
    rings = rings_of(cells, design, cells.d, used, has_ring)
    smooth = smoothed(rings, NEAR * unit / grid.level)
    is_far = np.abs(rings - smooth).max(axis=1) > FAR * unit
    rings[is_far] = smooth[is_far]
    at = grid.middles[has_ring]
    circles = np.column_stack([np.interp(cells.s, at, column) for column in rings.T])
    beyond: Floats = cells.d - (design * circles).sum(axis=1)
    return beyond


def is_seen(cells: "Cells", normal: "Floats", used: "Bools") -> "Bools":
    """Which levels (m,) have their ring told by the cells that are used."""
    grid, faces = cells.grid, cells.reference.faces
    if not len(faces):
        sectors = np.bincount(cells.level[used], minlength=grid.n_levels)
        return np.asarray(sectors * 360.0 / grid.n_sectors >= SEEN)
    face = np.argmax(normal @ faces.T, axis=1)
    counts = np.zeros((grid.n_levels, len(faces)))
    np.add.at(counts, (cells.level[used], face[used]), 1.0)
    return np.asarray((counts >= FACE_CELLS).sum(axis=1) >= max(FACES, len(faces) // 2 + 1))


def rings_of(
    cells: "Cells", design: "Floats", d: "Floats", used: "Bools", has_ring: "Bools"
) -> "Floats":
    """Coefficients (k, c) of a design (m, c) at the levels that have a ring, by Huber's weights.

    Cells are ``d`` out.
    """
    row = np.cumsum(has_ring) - 1
    inside = used & has_ring[cells.level]
    level, design, d = row[cells.level[inside]], design[inside], d[inside]
    n, width = int(has_ring.sum()), design.shape[1]
    weight: Floats = np.ones(d.size)
    rings: Floats = np.zeros((n, width))
    for _ in range(ROUNDS):
        normal, right = np.zeros((n, width, width)), np.zeros((n, width))
        np.add.at(normal, level, weight[:, None, None] * design[:, :, None] * design[:, None, :])
        np.add.at(right, level, (weight * d)[:, None] * design)
        rings = np.linalg.solve(normal, right[:, :, None])[:, :, 0].astype(np.float64)
        off: Floats = np.abs(d - (design * rings[level]).sum(axis=1))
        bound = CLIPPED * max(1.4826 * float(np.median(off)), 1e-9 * float(np.ptp(d)), 1e-300)
        weight = bound / np.maximum(off, bound)
    return rings


def smoothed(rings: "Floats", reach: float) -> "Floats":
    """Find running medians (k, 3), as many rings above as below: slopes do not move them."""
    n = len(rings)
    half = [min(int(reach), i, n - 1 - i) for i in range(n)]
    return np.array([np.median(rings[i - h : i + h + 1], axis=0) for i, h in enumerate(half)])
