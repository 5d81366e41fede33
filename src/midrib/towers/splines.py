"""Penalised cubic splines, and what it takes to choose how smooth they are.

B(s)      the cubic B-splines on even knots; B'(s) their slopes
P         the penalty: f' P f is the integral of the squared second derivative
leap      a height where f may leap: a column that is 0 below it and 1 above, free of the penalty
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Basis", "basis_on"]

DEGREE = 3
GAUSS = np.array([-1.0, 1.0]) / np.sqrt(3.0)  # exact for the squares of straight lines


class Basis(NamedTuple):
    """Cubic B-splines on even knots between two heights, and leaps."""

    knots: "Floats"
    leaps: "Floats"

    @property
    def smooth(self) -> int:
        """Number of B-splines."""
        return len(self.knots) - DEGREE - 1

    @property
    def size(self) -> int:
        """Number of coefficients: of B-splines, then of leaps."""
        return self.smooth + len(self.leaps)

    @property
    def lines(self) -> "Floats":
        """Coefficients (size, 2) of the lines f(s) = 1 and f(s) = s: means of inner knots."""
        inner = [self.knots[1 + k : 1 + k + self.smooth] for k in range(DEGREE)]
        columns = np.column_stack([np.ones(self.smooth), np.mean(inner, axis=0)])
        return np.concatenate([columns, np.zeros((len(self.leaps), 2))])

    def design(self, s: "Floats", derivative: int = 0) -> "Floats":
        """Values, or derivatives (n, size); straight on beyond the ends."""
        from scipy.interpolate import BSpline

        low, high = self.knots[DEGREE], self.knots[-DEGREE - 1]
        inside = np.clip(s, low, high)
        splines = BSpline(self.knots, np.eye(self.smooth), DEGREE)
        rows: Floats = splines(inside, nu=derivative)
        above = np.zeros((s.size, len(self.leaps)))
        if derivative == 0:
            rows = rows + (s - inside)[:, None] * splines(inside, nu=1)
            above += s[:, None] > self.leaps
        return np.concatenate([rows, above], axis=1)

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


def basis_on(
    low: float, high: float, spacing: float, leaps: "Floats | tuple[float, ...]" = ()
) -> Basis:
    """Cubic B-splines with knots about ``spacing`` apart, and leaps at heights."""
    count = max(1, round((high - low) / spacing))
    inner = np.linspace(low, high, count + 1)
    ends = np.full(DEGREE, low), np.full(DEGREE, high)
    return Basis(np.concatenate([ends[0], inner, ends[1]]), np.asarray(leaps, dtype=np.float64))
