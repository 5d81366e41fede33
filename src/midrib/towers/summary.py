"""An axis as a whole: best line, straightness, largest deviation."""

from typing import Any, NamedTuple

import numpy as np

__all__ = ["Summary", "azimuth_of", "summary_of"]


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
