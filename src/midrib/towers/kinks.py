"""Kinks, offsets and steps: heights at which the axis turns, or leaps, or the radius does.

No smooth curve does any of them. The joint fit follows leaps; all else near them it would take for
errors of the wall.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.towers.evidence import problem_of, trials_of
from midrib.towers.search import chosen_of, gain_beside
from midrib.towers.summary import azimuth_of

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.towers.joint import Fit
    from midrib.types import Floats

__all__ = ["Breaks", "Kink", "Offset", "RadiusStep", "breaks_of", "offsets_of", "steps_of"]

END, APART = 5.0, 5.0  # metres from either end, and between breaks of the axis, at the least
RING = 2  # levels: the same for the wall around it, as a flange has two steps
LEAST_KINK = 2e-4  # change of direction: less is nothing, however certain
LEAST_LEAP = 1e-3  # metres: the same, of the axis or of the radius
NEAR, SUDDEN = 2.5, 0.25  # metres below and above; of what bends near by: less is a part of that


class Kink(NamedTuple):
    """A change of direction."""

    z: float
    turn: float  # mm per m
    azimuth: float  # degrees from y clockwise: where the axis turns to
    sigma: float  # mm per m


class Offset(NamedTuple):
    """A step of the axis, as between two casting lifts; lengths in coordinate units."""

    z: float
    size: float
    azimuth: float  # degrees from y clockwise: where what is above stands
    sigma: float


class RadiusStep(NamedTuple):
    """A step of the radius, all round; lengths in coordinate units."""

    z: float
    size: float  # above 0 where what is above is wider
    sigma: float


class Breaks(NamedTuple):
    """What is not smooth about an axis and the wall around it, from the base up."""

    kinks: list[Kink]
    leaps: "Floats"  # heights of the frame at which there are offsets
    steps: "Floats"  # heights of the frame at which the radius steps

    def are_in(self, fit: "Fit") -> bool:
        """Whether a fit leaps where these do, and nowhere else."""
        model = fit.model
        return np.array_equal(self.leaps, model.axis.leaps) and np.array_equal(
            self.steps, model.taper.leaps
        )


def breaks_of(cells: "Cells", fit: "Fit", unit: float) -> Breaks:
    """Find the kinks, offsets and steps of a tower, whether or not its fit has them.

    Notes
    -----
    Forward selection, then each break once more given the others; those that are not certain beside
    the others go. O(q m n) for q breaks, m heights that are tried and n cells.
    """
    if np.ptp(cells.s) <= 2.0 * END * unit:
        return Breaks([], np.zeros(0), np.zeros(0))
    ring = RING * cells.grid.level
    trials = trials_of(cells, (ring, END * unit), (ring, APART * unit), unit)
    problem = problem_of(cells, fit, unit)
    chosen = chosen_of(problem, trials, unit)
    chosen.sort(key=lambda i: float(trials.heights[i]))
    gains = [
        gain_beside(problem, trials, i, chosen[:k] + chosen[k + 1 :]) for k, i in enumerate(chosen)
    ]
    kinks, leaps, steps, batters = [], [], [], []
    for i, gain in zip(chosen, gains, strict=True):
        s, size = float(trials.heights[i]), float(np.linalg.norm(gain.size[0]))
        kind = trials.kinds[i]
        if kind == "batter":
            batters.append((s, size))
        elif kind == "step":
            steps.append((s, size))
        elif kind == "offset":
            leaps += [s] * (size > LEAST_LEAP * unit)
        elif size > least_turn(fit, s, unit):
            azimuth, sigma = towards(cells, gain.size[0]), 1e3 * float(gain.sigma[0])
            kinks.append(Kink(height_of(cells, fit, s), 1e3 * size, azimuth, sigma))
    sudden = [s for s, size in steps if size > least_step(batters, s, unit)]
    return Breaks(kinks, np.array(leaps), np.array(sudden))


def offsets_of(cells: "Cells", fit: "Fit") -> list[Offset]:
    """Tell the offsets of an axis that leaps."""
    return [
        Offset(
            height_of(cells, fit, s),
            float(np.hypot(*size)),
            towards(cells, size),
            float(np.sqrt(np.mean(sigma**2))),
        )
        for s, size, sigma in zip(fit.model.axis.leaps, *fit.leaps(), strict=True)
    ]


def steps_of(cells: "Cells", fit: "Fit") -> list[RadiusStep]:
    """Tell the steps of a radius."""
    return [
        RadiusStep(height_of(cells, fit, s), float(size), float(sigma))
        for s, size, sigma in zip(fit.model.taper.leaps, *fit.steps(), strict=True)
    ]


def height_of(cells: "Cells", fit: "Fit", s: float) -> float:
    """Height z of the axis at a height of the frame."""
    place = np.array([[*fit.values(np.array([s]))[0, :2], s]])
    return float(cells.reference.frame.outwards(place)[0, 2])


def towards(cells: "Cells", change: "Floats") -> float:
    """Azimuth of a change of place or direction (2,), of the frame, in the cloud's coordinates."""
    return float(azimuth_of(*(change @ cells.reference.frame.turn[:2, :2])))


def least_turn(fit: "Fit", s: float, unit: float) -> float:
    """Change of direction that a kink at a height has at the least: less is a bend's."""
    near = s + NEAR * unit * np.array([-1.0, 1.0])
    return max(LEAST_KINK, SUDDEN * float(np.hypot(*np.diff(fit.slopes(near), axis=0)[0])))


def least_step(batters: list[tuple[float, float]], s: float, unit: float) -> float:
    """Step of the radius that there is at the least: less is a part of a turn of the batter."""
    turn = sum(turn for at, turn in batters if abs(at - s) <= APART * unit)
    return max(LEAST_LEAP, SUDDEN * NEAR * turn) * unit
