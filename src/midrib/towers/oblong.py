"""Whether the sections of a sample are ovals, and how large ones.

oval      r = r₀ + e cos 2θ + f sin 2θ about a centre, of one slab that is seen all round

A large oval is neither near a circle nor near a polygon, but nearer to some polygon than to any
circle; so it is looked for by itself. Its cells would lie beyond the reach of a circle's.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.towers.rough import off_shell, slabs_of

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Oval", "oval_of"]

SECTORS, LEAST_SEEN = 24, 20  # of a slab: an oval is told by five sixths of it
LEAST_SLABS = 3  # that tell an oval
LEAST_NEAR = 0.3  # of the points of slabs are near their ovals, as of a polygon
ROUNDS = 12
LEAST_OFF = 1e-3  # metres: points nearer than that all weigh alike


class Oval(NamedTuple):
    """The usual oval of a tower's sections; lengths in coordinate units."""

    radius: float
    size: float  # amplitude: half the difference of the longest and the shortest radius
    off: float  # median distance of the points of slabs from their ovals


UNTOLD = Oval(np.inf, 0.0, np.inf)


def oval_of(sample: "Floats", unit: float) -> Oval:
    """Fit an oval to each slab of an upright sample; infinitely far off if too few tell one."""
    sizes, beyond, radii = [], [], []
    for _, points in slabs_of(sample, unit):
        found = fitted(points[:, :2], unit)
        if found is not None:
            (radius, *_, e, f), left = found
            sizes.append(np.hypot(e, f))
            beyond.append(left)
            radii.append(np.full(left.size, radius))
    if len(sizes) < LEAST_SLABS:
        return UNTOLD
    off = off_shell(np.concatenate(beyond), np.concatenate(radii), LEAST_NEAR)
    return Oval(float(np.median([radius[0] for radius in radii])), float(np.median(sizes)), off)


def fitted(xy: "Floats", unit: float) -> "tuple[Floats, Floats] | None":
    """Oval (r, x, y, e, f) of a slab and what it leaves of its points; None if it is not told.

    Least absolute distances, by weights; the centre follows what the first harmonic tells.
    """
    centre = np.percentile(xy, [3, 97], axis=0).mean(axis=0)
    weight = np.ones(len(xy))
    for _ in range(ROUNDS):
        way = xy - centre
        angle, away = np.arctan2(way[:, 1], way[:, 0]), np.hypot(*way.T)
        turns = angle[:, None] * (1.0, 2.0)
        cosines, sines = np.cos(turns), np.sin(turns)
        first, second = (np.column_stack([cosines[:, k], sines[:, k]]) for k in (0, 1))
        design = np.column_stack([np.ones(len(xy)), first, second])
        root = np.sqrt(weight)
        oval: Floats = np.linalg.lstsq(root[:, None] * design, root * away, rcond=None)[0]
        left: Floats = away - design @ oval
        weight = 1.0 / np.maximum(np.abs(left), LEAST_OFF * unit)
        centre = centre + oval[1:3]
    sector = (angle / (2.0 * np.pi) * SECTORS).astype(np.intp) % SECTORS
    near = np.abs(left) < max(3.0 * float(np.median(np.abs(left))), LEAST_OFF * unit)
    if np.unique(sector[near]).size < LEAST_SEEN or not oval[0] > 0.0:
        return None
    return oval, left
