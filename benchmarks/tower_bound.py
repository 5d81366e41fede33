"""How near an axis can be known at all where the wall's own form is off in patches.

a(s)      first harmonic of the form error in a section: it moves the section as an axis would
C         covariance of a(s) between levels, from the scenario's own correlation exp(-d² / 2 L²)

With C known, the best unbiased estimate of what a design X spans has the covariance
(X' C⁻¹ X)⁻¹: no method does better, however many points there are.
"""

import numpy as np
from numpy.typing import NDArray

from midrib.towers.splines import basis_on
from midrib.towers.tower import Tower

__all__ = ["bound_text"]

Floats = NDArray[np.float64]
KNOTS = 2.5  # metres: of the spline whose best stiffness the truth itself chooses


def level_covariance(tower: Tower, s: Floats) -> Floats:
    """Covariance of a(s) in one direction, squared mm."""
    radius, reach = (tower.base_radius + tower.top_radius) / 2.0, tower.form_length
    angle = np.linspace(-np.pi, np.pi, 20_001)
    around = np.exp(-((radius * angle) ** 2) / 2.0 / reach**2) * np.cos(angle)
    variance = (1e3 * tower.form_error) ** 2 / np.pi * np.trapezoid(around, angle)
    correlation = np.exp(-((s[:, None] - s) ** 2) / 2.0 / reach**2)
    found: Floats = variance * (correlation + 1e-4 * np.eye(s.size))
    return found


def bound(design: Floats, covariance: Floats) -> float:
    """Least RMS distance from the true axis, both directions, of unbiased estimates."""
    told = np.linalg.inv(design.T @ np.linalg.solve(covariance, design))
    return float(np.sqrt(2.0 * np.mean(((design @ told) * design).sum(axis=1))))


def best_spline(tower: Tower, s: Floats, covariance: Floats) -> float:
    """RMS distance of a smoothing spline whose stiffness is the best for the true axis."""
    basis = basis_on(0.0, tower.height, KNOTS)
    design, true = basis.design(s), 1e3 * tower.axis(s)
    found = []
    for stiffness in 10.0 ** np.arange(-1.0, 9.0, 0.25):
        normal = design.T @ design + stiffness * basis.penalty + 1e-9 * np.eye(basis.size)
        hat = design @ np.linalg.solve(normal, design.T)
        bias = float(((hat @ true - true) ** 2).sum(axis=1).mean())
        found.append(np.sqrt(bias + 2.0 * float(np.trace(hat @ covariance @ hat.T)) / s.size))
    return float(min(found))


def bound_text(tower: Tower) -> str:
    """Say what is attainable on a tower with form errors."""
    s = np.arange(0.25, tower.height, 0.5)
    covariance, share = level_covariance(tower, s), s / tower.height
    ones = np.ones_like(s)
    known = [
        np.column_stack([ones]),
        np.column_stack([ones, share]),
        np.column_stack([ones, share, share * np.sin(2.0 * np.pi * share)]),
    ]
    shift, line, bend = (bound(design, covariance) for design in known)
    level = np.sqrt(2.0 * float(covariance[0, 0]))
    return (
        f"What is attainable with form errors of {1e3 * tower.form_error:g} mm in patches of "
        f"{tower.form_length:g} m, whatever the method and the number of points, mm RMS: a level "
        f"alone {level:.1f}; an axis of which all but a shift is known {shift:.2f}, all but a "
        f"straight line {line:.2f}, all but a straight line and the size of its bend {bend:.2f}; "
        f"a spline whose stiffness the true axis itself chooses "
        f"{best_spline(tower, s, covariance):.2f}.\n"
    )
