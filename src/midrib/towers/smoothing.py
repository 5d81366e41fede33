"""How stiff axis and taper are: restricted maximum likelihood.

λ     stiffness: 1 / variance of what bends a curve, a metre; the penalty is λ ∫ f''²
τ²    long-wave variance of a cell: what errs together counts once

A bend that is more than the errors explain makes the curve pliant, one that is not leaves it stiff.

References
----------
Wahba, A comparison of GCV and GML for choosing the smoothing parameter in the generalized spline
smoothing problem, Annals of Statistics 13(4), 1985. Wood, Generalized Additive Models, 2nd edition,
2017, section 6.2.
"""

from typing import TYPE_CHECKING, Protocol

import numpy as np

from midrib.towers.blocks import factor_of

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Smooth", "best_stiffness"]

AXIS_STIFFNESS = 10.0 ** np.arange(2.0, 12.1, 0.5)  # a metre
TAPER_STIFFNESS = 10.0 ** np.arange(2.0, 13.1, 1.0)
TURNS = 2  # of axis, then taper


class Smooth(Protocol):
    """What a model tells about its penalty."""

    def penalty(self, axis: float, taper: float) -> "Floats":
        """Penalty matrix for given stiffnesses."""

    @property
    def bends(self) -> tuple[int, int]:
        """Numbers of coefficients that axis stiffness and taper stiffness hold."""


def best_stiffness(
    normal: "Floats", right: "Floats", model: Smooth, unit: float
) -> tuple[float, float]:
    """Find the likeliest stiffnesses of axis and taper.

    Parameters
    ----------
    normal, right : (k, k) and (k,), over τ²
    model : what is smooth
    unit : coordinate units in a metre

    Notes
    -----
    -2 log L = log |N + P| - rank · log λ - b' (N + P)⁻¹ b, without what does not depend on λ. One
    stiffness after the other, on even steps of its logarithm; O(k³) a step.
    """
    bends = model.bends

    def unlikely(axis: float, taper: float) -> float:
        factor = factor_of(normal + model.penalty(axis, taper))
        explained = float(right @ factor.solve(right))
        held = bends[0] * np.log(axis) + bends[1] * np.log(taper)
        return factor.log_determinant - float(held) - explained

    axis, taper = float(np.median(AXIS_STIFFNESS)) * unit, 0.0
    for _ in range(TURNS):
        taper = min(TAPER_STIFFNESS * unit, key=lambda t: unlikely(axis, t))
        axis = min(AXIS_STIFFNESS * unit, key=lambda a: unlikely(a, taper))
    return float(axis), float(taper)
