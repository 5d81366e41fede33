"""Penalised cubic splines, and what it takes to choose how smooth they are.

B(s)      the cubic B-splines on even knots; B'(s) their slopes
P         the penalty: f' P f is the integral of the squared second derivative
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Basis", "basis_on"]

DEGREE = 3
GAUSS = np.array([-1.0, 1.0]) / np.sqrt(3.0)  # exact for the squares of straight lines


class Basis(NamedTuple):
    """Cubic B-splines on even knots between two heights."""

    knots: "Floats"

    @property
    def size(self) -> int:
        """Number of coefficients."""
        return len(self.knots) - DEGREE - 1

    @property
    def averages(self) -> "Floats":
        """Means (size,) of each B-spline's inner knots: the coefficients of the line f(s) = s."""
        inner = [self.knots[1 + k : 1 + k + self.size] for k in range(DEGREE)]
        means: Floats = np.mean(inner, axis=0)
        return means

    def design(self, s: "Floats", derivative: int = 0) -> "Floats":
        """Values, or derivatives, of the B-splines (n, size); straight on beyond the ends."""
        from scipy.interpolate import BSpline

        low, high = self.knots[DEGREE], self.knots[-DEGREE - 1]
        inside = np.clip(s, low, high)
        rows: Floats = BSpline(self.knots, np.eye(self.size), DEGREE)(inside, nu=derivative)
        if derivative == 0:
            beyond = (s - inside)[:, None]
            rows = rows + beyond * self.design(inside, 1)
        return rows

    @property
    def penalty(self) -> "Floats":
        """The matrix P (size, size)."""
        edges = self.knots[DEGREE : len(self.knots) - DEGREE]
        half = np.diff(edges) / 2.0
        middle = (edges[1:] + edges[:-1]) / 2.0
        at = (middle[:, None] + half[:, None] * GAUSS).ravel()
        bend = self.design(at, 2)
        weighted: Floats = bend.T @ (np.repeat(half, GAUSS.size)[:, None] * bend)
        return weighted


def basis_on(low: float, high: float, spacing: float) -> Basis:
    """Cubic B-splines with knots about ``spacing`` apart."""
    count = max(1, round((high - low) / spacing))
    inner = np.linspace(low, high, count + 1)
    ends = np.full(DEGREE, low), np.full(DEGREE, high)
    return Basis(np.concatenate([ends[0], inner, ends[1]]))
