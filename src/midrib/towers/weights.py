"""Tukey's weights: what lies far off counts less, and beyond a bound nothing.

spread    standard deviation of residuals, by their median
share     a residual over the smallest that has no weight, 4.685 spreads

References
----------
Beaton and Tukey, The fitting of power series, meaning polynomials, illustrated on
band-spectroscopic data, Technometrics 16(2), 1974: the biweight.
"""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from midrib.types import Bools, Floats

__all__ = ["lost_to_weights", "tukey"]

TUKEY = 4.685  # spreads: as good as least squares on Gaussian errors, to 95 %
# Metres: less than that is never clutter, but bends that a clean scan shows and splines miss.
LEAST_SPREAD = 3e-4


def tukey(residual: "Floats", rows: "Bools", unit: float) -> "Floats":
    """Weights by the size of residuals."""
    weight: Floats = np.clip(1.0 - shares(residual, rows, unit) ** 2, 0.0, 1.0) ** 2
    return weight


def lost_to_weights(residual: "Floats", weight: "Floats", unit: float) -> float:
    """How much smaller weighted errors are than what they do to the fit: mean w over mean ψ'."""
    rows = weight > 0.0
    square = np.clip(shares(residual, rows, unit)[rows] ** 2, 0.0, 1.0)
    return float(weight[rows].mean() / max(((1.0 - square) * (1.0 - 5.0 * square)).mean(), 0.1))


def shares(residual: "Floats", rows: "Bools", unit: float) -> "Floats":
    """Residuals as shares of the smallest that has no weight."""
    spread = max(1.4826 * float(np.median(np.abs(residual[rows]))), LEAST_SPREAD * unit)
    share: Floats = residual / (TUKEY * spread)
    return share
