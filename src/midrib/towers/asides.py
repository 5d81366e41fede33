"""Levels whose own section lies aside of the centre that they are given.

A smooth axis passes by a short lift that was set aside, or a bulge, and its standard deviation is
that of the smooth axis. The ring of a level that is seen all round knows better.
"""

from typing import TYPE_CHECKING

import numpy as np

from midrib.towers.grazing import grazed
from midrib.towers.joint import normals_of
from midrib.towers.rings import is_seen, rings_of

if TYPE_CHECKING:
    from midrib.towers.pipeline import Shell
    from midrib.types import Floats

__all__ = ["asides_at"]

CERTAIN = 3.72  # standard deviations: 99.9 % of a distance


def asides_at(shell: "Shell", s: "Floats", xy: "Floats", least: float) -> "Floats":
    """Distances (n,) of the rings at heights from the centres given there; 0 if not certain.

    Parameters
    ----------
    shell : Shell
    s : (n,) heights of the frame
    xy : (n, 2) centres there, of the frame
    least : the smallest distance that counts
    """
    cells, fit = shell.cells, shell.fit
    normal, off_corner = normals_of(cells)
    used = off_corner & ~grazed(cells, shell.unit)
    has_ring = is_seen(cells, normal, used)
    found = np.zeros(s.size)
    if not has_ring.any():
        return found
    design = np.column_stack([normal, np.ones(len(normal))])
    rings = rings_of(cells, design, fit.residual, used, has_ring)
    count = np.bincount(cells.level[used], minlength=has_ring.size)[has_ring]
    sigma = np.sqrt(2.0 * fit.variance / count)
    at = cells.grid.middles[has_ring]
    nearest = np.abs(s[:, None] - at).argmin(axis=1)
    is_near = np.abs(s - at[nearest]) <= cells.grid.level / 2.0 * (1.0 + 1e-9)
    ring = fit.values(s)[:, :2] + rings[nearest, :2]
    off = np.hypot(*(ring - xy).T)
    is_certain = is_near & (off > np.maximum(least, CERTAIN * sigma[nearest]))
    found[is_certain] = off[is_certain]
    return found
