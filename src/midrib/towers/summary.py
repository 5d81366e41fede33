"""An axis as a whole: best line, straightness, kinks.

kink      a height at which the mean direction of the REACH above and of the REACH below differ by
          more than chance explains, and more suddenly than the axis bends near by
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Kink", "Summary", "azimuth_of", "kinks_of", "summary_of"]

REACH = 5.0  # metres above and below a kink
CERTAIN = 4.0  # standard deviations
LEAST_KINK = 0.5  # mm per m that no bend explains
LEAST_LEVELS = 3  # on either side of a kink
SUDDEN = 0.25  # of a turn that no bend explains: 0.7 of a kink, 0.15 of bends at most


class Kink(NamedTuple):
    """A change of direction."""

    z: float
    turn: float  # mm per m
    azimuth: float  # degrees from y clockwise: where the axis turns to
    sigma: float  # mm per m


class Summary(NamedTuple):
    """Numbers about an axis; lengths in coordinate units, NaN where nothing is known."""

    slope: float  # of the best straight line, mm per m
    azimuth: float  # where it leans to, degrees from y clockwise
    straightness: float  # largest distance of a level from the best line
    straightness_z: float  # where that is
    deviation: float  # largest deviation from the vertical through the base
    deviation_z: float  # where that is
    top_deviation: float
    low: float  # lowest and highest level with a centre
    high: float


def azimuth_of(x: Any, y: Any) -> Any:
    """Direction in degrees from y (north), clockwise, 0 to 360."""
    return np.degrees(np.arctan2(x, y)) % 360.0


def summary_of(levels: Any, unit: float) -> Summary:
    """Sum up levels that have a centre; the best line weighs them by their uncertainty.

    Registration and levelling move all levels together, so they do not weigh.
    """
    if len(levels) < 2:
        return Summary(*[np.nan] * 9)
    z = levels["z"]
    sigma = np.hypot(levels["sigma_inner"], 1e-4 * unit)
    design = np.column_stack([np.ones(z.size), z - z[0]]) / sigma[:, None]
    values = np.column_stack([levels["x"], levels["y"]])
    line = np.linalg.lstsq(design, values / sigma[:, None], rcond=None)[0]
    off = np.hypot(*(values - line[0] - (z - z[0])[:, None] * line[1]).T)
    worst, most = int(np.argmax(off)), int(np.nanargmax(levels["deviation"]))
    return Summary(
        slope=1e3 * float(np.hypot(*line[1])),
        azimuth=float(azimuth_of(*line[1])),
        straightness=float(off[worst]),
        straightness_z=float(z[worst]),
        deviation=float(levels["deviation"][most]),
        deviation_z=float(z[most]),
        top_deviation=float(levels["deviation"][-1]),
        low=float(z[0]),
        high=float(z[-1]),
    )


def kinks_of(levels: Any, unit: float) -> list[Kink]:
    """Find changes of direction that are certain, and sudden: a smooth bend has none.

    A turn counts if the part of it that a cubic through the levels near by does not explain is
    certain, and no small part of it. Within ``REACH`` of either end nothing can be told.
    """
    z, reach = levels["z"], REACH * unit
    rows = []
    for at in z[(z >= z[0] + reach) & (z <= z[-1] - reach)] if z.size else z:
        near = levels[np.abs(z - at) <= reach]
        if min((near["z"] < at).sum(), (near["z"] > at).sum()) >= LEAST_LEVELS:
            turn, sigma = turn_at(near, at, 1)
            sudden, doubt = turn_at(near, at, 3)
            rows.append((at, *turn, sigma, np.hypot(*sudden), doubt))
    found = np.array(rows).reshape(-1, 6)
    size, sudden = np.hypot(found[:, 1], found[:, 2]), found[:, 4]
    sure = (sudden > CERTAIN * found[:, 5]) & (sudden > SUDDEN * size)
    sure &= (size > CERTAIN * found[:, 3]) & (sudden > LEAST_KINK * 1e-3)
    kinks: list[Kink] = []
    for i in np.flatnonzero(sure)[np.argsort(-sudden[sure])]:
        if all(abs(found[i, 0] - kink.z) >= reach for kink in kinks):
            azimuth = float(azimuth_of(found[i, 1], found[i, 2]))
            kinks.append(
                Kink(float(found[i, 0]), 1e3 * float(size[i]), azimuth, 1e3 * float(found[i, 3]))
            )
    return sorted(kinks)


def turn_at(near: Any, at: float, degree: int) -> "tuple[Floats, float]":
    """Change of slope (2,) of x and y at a height, beside a polynomial; its standard deviation.

    Of degree 1 these are two straight lines that meet there. Levels that are neighbours are not
    independent, so they count as the few that their reach has room for.
    """
    way = near["z"] - at
    scale = float(np.abs(way).max())
    share = way / scale
    design = np.column_stack([share**k for k in range(degree + 1)] + [np.maximum(share, 0.0)])
    values = np.column_stack([near["x"] - near["x"].mean(), near["y"] - near["y"].mean()])
    answer = np.linalg.lstsq(design, values, rcond=None)[0]
    inverse = np.linalg.inv(design.T @ design)
    together = max(1.0, way.size / 4.0)
    sigma = float(np.sqrt(inverse[-1, -1] * together) * np.mean(near["sigma_inner"]))
    turn: Floats = answer[-1] / scale
    return turn, sigma / scale
