"""Labels beside the points of a curve, none of which lies on another or on the curve."""

from typing import TYPE_CHECKING

import numpy as np

from midrib.figures.paper import FONT, TEXT

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from midrib.types import Bools, Floats, Ints

__all__ = ["label_curve"]

# Lengths in points.
SIZE = FONT - 1.5  # of the font
CHARACTER = 0.65 * SIZE
BESIDE = 4.0, 10.0, 18.0  # from a point to its label; farther ones have a leader
CLEAR = 2.5  # between a label and the curve with its marks
STEP = 1.0  # between places of the curve that labels are held against
DIRECTIONS = np.radians([-45.0, 45.0, 135.0, -135.0, 0.0, 180.0, 90.0, -90.0])  # the best first


def label_curve(
    axes: "Axes", corners: "Floats", rows: "Ints", texts: list[str], least: float
) -> "Ints":
    """Label those corners (n, 2), NaN where the curve is broken, that there is room for.

    Limits and aspect of the axes have to be final. Of ``rows`` those that come first have the first
    choice, and labelled corners are ``least`` apart, in units of the data.

    Returns
    -------
    (k,) the rows that are labelled.
    """
    axes.apply_aspect()
    to_points = 72.0 / axes.figure.dpi
    places = axes.transData.transform(corners) * to_points
    curve, frame = filled(places), np.reshape(axes.bbox.extents, (2, 2)) * to_points
    taken = np.zeros((0, 2, 2))
    kept: list[int] = []
    for row, text in zip(rows, texts, strict=True):
        if kept and np.hypot(*(corners[kept] - corners[row]).T).min() < least:
            continue
        half = np.array([CHARACTER * len(text), SIZE]) / 2.0
        for away in BESIDE:
            middles = places[row] + spread(half, away)
            boxes = np.stack([middles - half, middles + half], axis=1)
            free = np.flatnonzero(are_free(boxes, taken, curve, frame))
            if free.size:
                break
        else:
            continue
        middle = middles[free[0]]
        taken = np.concatenate([taken, boxes[free[:1]]])
        kept.append(int(row))
        leader = {"arrowstyle": "-", "lw": 0.3, "color": TEXT, "shrinkA": 1.0, "shrinkB": 1.0}
        axes.annotate(text, corners[row], xytext=middle - places[row], textcoords="offset points",
                      fontsize=SIZE, color=TEXT, ha="center", va="center",
                      bbox={"pad": 0.0, "fc": "none", "ec": "none"},
                      arrowprops=leader if away > BESIDE[0] else None)  # fmt: skip
    return np.array(kept, dtype=np.intp)


def spread(half: "Floats", away: float) -> "Floats":
    """Middles (m, 2) of boxes round a point, each so far from it as their directions have it."""
    ways = np.column_stack([np.cos(DIRECTIONS), np.sin(DIRECTIONS)])
    found: Floats = ways * away + np.sign(np.round(ways, 9)) * half
    return found


def are_free(boxes: "Floats", taken: "Floats", curve: "Floats", frame: "Floats") -> "Bools":
    """(m,) which boxes (m, 2, 2) are within a frame, clear of the curve and of boxes taken."""
    low, high = boxes[:, None, 0], boxes[:, None, 1]
    on_curve = np.any(np.all((curve > low - CLEAR) & (curve < high + CLEAR), axis=2), axis=1)
    on_box = np.any(np.all((taken[:, 1] > low) & (taken[:, 0] < high), axis=2), axis=1)
    inside = ((boxes[:, 0] >= frame[0]) & (boxes[:, 1] <= frame[1])).all(axis=1)
    found: Bools = inside & ~on_curve & ~on_box
    return found


def filled(places: "Floats") -> "Floats":
    """Places of a curve, with more between those that are far apart; without its breaks."""
    apart = np.nan_to_num(np.hypot(*np.diff(places, axis=0).T))
    run = np.concatenate([[0.0], np.cumsum(apart)])
    at = np.linspace(0.0, run[-1], int(run[-1] / STEP) + 2)
    known = np.isfinite(places[:, 0])
    more = np.column_stack([np.interp(at, run[known], column[known]) for column in places.T])
    return np.concatenate([places[known], more])
