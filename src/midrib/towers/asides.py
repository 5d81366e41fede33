"""Levels whose own section lies aside of the centre that they are given.

A smooth axis passes by a short lift that was set aside, or a bulge, and its standard deviation is
that of the smooth axis. The ring of a level that is seen all round knows better. How well it does
is told by what no motion of it makes: bumps of a wall have as much of the second and the third
harmonic as of the first. What a fit leaves does not tell it, for the lifts set aside are in it.
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

NORMAL, CERTAIN = 1.96, 3.72  # standard deviations: 95 % of one coordinate, 99.9 % of a distance
OTHERS = (2.0, 3.0)  # harmonics that tell how far a round wall moves its rings


def asides_at(shell: "Shell", s: "Floats", xy: "Floats", least: float) -> "Floats":
    """Distances (n,) of the rings at heights from the centres given there; 0 if not certain.

    Parameters
    ----------
    shell : Shell
    s : (n,) heights of the frame
    xy : (n, 2) centres there, of the frame
    least : the smallest distance that counts, if it may be so large

    Notes
    -----
    Where the axis leaps within a level its ring is half here, half there. So one between two that
    are aside in opposite directions is as far aside as they are.
    """
    cells, fit = shell.cells, shell.fit
    normal, off_corner = normals_of(cells)
    used = off_corner & ~grazed(cells, shell.unit)
    has_ring = is_seen(cells, normal, used)
    found = np.zeros(s.size)
    if not has_ring.any():
        return found
    turns = cells.azimuth[:, None] * OTHERS
    round_ = not len(cells.reference.faces)
    others = [np.cos(turns), np.sin(turns)] if round_ else []
    design = np.column_stack([normal, np.ones(len(normal)), *others])
    rings = rings_of(cells, design, fit.residual, used, has_ring)
    count = np.bincount(cells.level[used], minlength=has_ring.size)[has_ring]
    sigma = np.sqrt(2.0 * fit.variance / count)
    if round_:
        own = 1.4826 * float(np.median(np.abs(rings[:, 3:]))) * np.sqrt(np.median(count) / count)
        sigma = np.minimum(sigma, own)
    at = cells.grid.middles[has_ring]
    nearest = np.abs(s[:, None] - at).argmin(axis=1)
    is_near = np.abs(s - at[nearest]) <= cells.grid.level / 2.0 * (1.0 + 1e-9)
    ring = fit.values(s)[:, :2] - xy + rings[nearest, :2]
    off = np.maximum(np.hypot(*ring.T), beside(rings[:, :2], CERTAIN * sigma)[nearest])
    may_be = (
        off + NORMAL * sigma[nearest] + drift(rings[:, :2], at)[nearest] * np.abs(s - at[nearest])
    )
    is_certain = is_near & (may_be > least) & (off > CERTAIN * sigma[nearest])
    found[is_certain] = off[is_certain]
    return found


def beside(rings: "Floats", certain: "Floats") -> "Floats":
    """Tell of each ring (k, 2) how far its neighbours are, if both are aside in opposite ways."""
    between = np.zeros(len(rings))
    below, above = rings[:-2], rings[2:]
    off = np.array([np.hypot(*below.T), np.hypot(*above.T)])
    is_torn = ((below * above).sum(axis=1) < 0.0) & (off.min(axis=0) > certain[1:-1])
    between[1:-1] = np.where(is_torn, off.max(axis=0), 0.0)
    return between


def drift(rings: "Floats", at: "Floats") -> "Floats":
    """By how much rings (k, 2) change with height: each is that of its level's middle.

    The smaller of the changes to either neighbour, for the other may be no ring of the wall.
    """
    if len(rings) < 2:
        return np.zeros(len(rings))
    rate = np.hypot(*np.diff(rings, axis=0).T) / np.diff(at)
    found: Floats = np.minimum(np.append(rate, np.inf), np.append(np.inf, rate))
    return found
