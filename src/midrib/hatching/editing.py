"""Changes of a hatching by hand: one stroke more, elsewhere, or less."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from midrib.checks import shown
from midrib.errors import ParameterError
from midrib.hatching.finishing import islands_of, lines_of
from midrib.hatching.hatch import Hatching, gaps_between
from midrib.hatching.laying import Ground
from midrib.kernels.chords import ON_TOE, ON_TOP
from midrib.kernels.crossings import meet
from midrib.kernels.ladder import TAU, THETA, draw_strokes, turn_rungs
from midrib.ragged import place_text
from midrib.strip import position

if TYPE_CHECKING:
    from midrib.strip import Position
    from midrib.types import Floats

__all__ = ["add_stroke", "delete_stroke", "move_stroke"]

HALVINGS = 60
ON_STROKE = 1e-6  # of a stroke's length: so near is on it
PAST_END = (
    0.01  # of it: so far past an edge is on it still, as clicks and the decimals of files are
)


def add_stroke(hatching: Hatching, at: "Position", *, is_long: bool = True) -> Hatching:
    """Add the stroke through a point of the slope.

    Parameters
    ----------
    hatching : Hatching
        By ``rule="matching"``.
    at : Point or pair of float
        A point on the top or in the slope. The stroke goes through it, in the direction that suits
        the place: between those of the strokes beside it.
    is_long : bool, default True
        Whether it reaches the toe.

    Returns
    -------
    Hatching
        A new one; the old one stays as it is.

    Raises
    ------
    ParameterError
        If no stroke leads through the point, or it would meet another stroke, an island of the
        slope or a zone that no stroke may enter.

    Examples
    --------
    >>> hatching = hatch(split(box(0, 0, 12, 4)), scale=500)
    >>> from midrib.hatching import add_stroke
    >>> add_stroke(hatching, (3, 1)).on_top[:, 0].round(6)
    array([ 2.,  3.,  4.,  6.,  8., 10.])
    """
    ground = as_drawn(hatching, ground_of(hatching))
    point = position(at, "at")
    station, on_top, on_toe = stroke_through(ground, point)
    share = 1.0 if is_long else hatching.rule.short_ratio
    line = lines_of(on_top[None], on_toe[None], np.array([share]))
    barred = [*islands_of(hatching.strip), *(() if hatching.zones is None else (hatching.zones,))]
    if shapely.intersects(line[0], np.array(barred, dtype=object)).any():
        msg = f"a stroke through {place_text(point)} would enter an island or an excluded zone"
        raise ParameterError(msg)
    segments = np.concatenate([ends_of(hatching), np.append(on_top, on_toe)[None]])
    n = len(hatching.strokes)
    hits = meet(segments, np.arange(n), np.full(n, n))
    hits |= shapely.distance(hatching.strokes, line[0]) <= ON_STROKE * hatching.width
    if hits.any():
        other = place_text(hatching.on_top[np.flatnonzero(hits)[0]])
        msg = f"a stroke through {place_text(point)} would meet the one from {other}"
        raise ParameterError(msg)
    place = row_of(hatching, ground, station)
    rows = {
        "strokes": line[0],
        "is_long": is_long,
        "width": float(np.hypot(*(on_toe - on_top))),
        "on_top": on_top,
        "on_toe": on_toe,
        "station": station,
        "share": share,
    }
    changed = {
        name: np.insert(getattr(hatching, name), place, value, axis=0)
        for name, value in rows.items()
    }
    return replace(hatching, spacing=gaps_between(changed["station"], ground), **changed)


def delete_stroke(hatching: Hatching, index: int) -> Hatching:
    """Delete a stroke.

    Parameters
    ----------
    hatching : Hatching
    index : int
        Which one, counted from 0 along the top, or from -1 back.

    Returns
    -------
    Hatching
        A new one; the other strokes stay what they are.

    Raises
    ------
    ParameterError
        If there is no such stroke.
    """
    check_index(hatching, index)
    names = ("strokes", "is_long", "width", "on_top", "on_toe", "station", "share")
    changed = {name: np.delete(getattr(hatching, name), index, axis=0) for name in names}
    return replace(hatching, spacing=gaps_between(changed["station"], hatching.ground), **changed)


def move_stroke(hatching: Hatching, index: int, to: "Position") -> Hatching:
    """Move a stroke so that it leads through a point; a long one stays long.

    Parameters
    ----------
    hatching : Hatching
        By ``rule="matching"``.
    index : int
        Which one, counted from 0 along the top, or from -1 back.
    to : Point or pair of float
        A point on the top or in the slope.

    Returns
    -------
    Hatching
        A new one.

    Raises
    ------
    ParameterError
        If there is no such stroke, or the moved one would meet another.
    """
    ground_of(hatching)
    check_index(hatching, index)
    is_long = bool(hatching.is_long[index])
    return add_stroke(delete_stroke(hatching, index), to, is_long=is_long)


def check_index(hatching: Hatching, index: Any) -> None:
    """Refuse an index of no stroke."""
    n = len(hatching.strokes)
    if isinstance(index, bool) or not isinstance(index, int | np.integer) or not -n <= index < n:
        msg = f"index is {shown(index)}, expected one of {n} strokes"
        raise ParameterError(msg)


def ground_of(hatching: Hatching) -> Ground:
    """Return what strokes are added to."""
    if hatching.ground is None:
        msg = "hatching is by rule='paper', expected one by rule='matching'"
        raise ParameterError(msg)
    return hatching.ground


def as_drawn(hatching: Hatching, ground: Ground) -> Ground:
    """Return the ground with directions that are those of the strokes, between them in proportion.

    Where strokes were mended or placed anew, the calm direction may lead across them.
    """
    order = np.argsort(hatching.station)
    if not order.size:
        return ground
    station, ladder = hatching.station[order], ground.ladder
    calm = draw_strokes(ladder, station, ground.spacing).chord
    (x, y), (u, v) = (calm[:, 4:6] - calm[:, 2:4]).T, (hatching.on_toe - hatching.on_top)[order].T
    turn = np.arctan2(x * v - y * u, x * u + y * v)
    tau = ladder.rungs[:, TAU]
    period = tau[-1] if ground.middle.is_closed else None
    theta = ladder.rungs[:, THETA] + np.interp(tau, station, turn, period=period)
    return ground._replace(ladder=turn_rungs(ladder, theta, ground.spacing))


def ends_of(hatching: Hatching) -> "Floats":
    """(n, 4) ends of the strokes as they are drawn."""
    end = hatching.on_top + hatching.share[:, None] * (hatching.on_toe - hatching.on_top)
    return np.concatenate([hatching.on_top, end], axis=1)


def stroke_through(ground: Ground, point: "Floats") -> tuple[float, "Floats", "Floats"]:
    """Station on the middle line and ends of the stroke through a point.

    Strokes sweep over the slope from one rung to the next, so the point passes from the left of
    the stroke to its right between two stations; these are halved.
    """
    tau = ground.ladder.rungs[:, 0]
    rungs = draw_strokes(ground.ladder, tau.copy(), ground.spacing)
    leads = (rungs.on == (ON_TOP, ON_TOE)).all(axis=1)
    side = np.array([side_of(row, point) for row in rungs.chord])
    turns = (side[:-1] <= 0.0) != (side[1:] <= 0.0)
    off = abs(np.hypot(*(rungs.pivot[:, 1:3] - point).T))
    pairs = np.flatnonzero(turns & (leads[:-1] | leads[1:]))
    if not pairs.size:
        msg = f"no stroke of the slope leads through {place_text(point)}"
        raise ParameterError(msg)
    k = int(pairs[np.argmin(off[pairs])])
    low, high = float(tau[k]), float(tau[k + 1])
    for _ in range(HALVINGS):
        half = (low + high) / 2.0
        chord = draw_strokes(ground.ladder, np.array([half]), ground.spacing).chord[0]
        if (side_of(chord, point) <= 0.0) == (side[k] <= 0.0):
            low = half
        else:
            high = half
    drawn = draw_strokes(ground.ladder, np.array([low]), ground.spacing)
    on_top, on_toe = drawn.chord[0, 2:4], drawn.chord[0, 4:6]
    t = float((point - on_top) @ (on_toe - on_top)) / float(drawn.chord[0, 6]) ** 2
    is_on_it = -PAST_END <= t <= 1.0 + PAST_END
    if tuple(drawn.on[0]) != (ON_TOP, ON_TOE) or not is_on_it:
        msg = f"no stroke of the slope leads through {place_text(point)}"
        raise ParameterError(msg)
    return low, on_top, on_toe


def side_of(chord: "Floats", point: "Floats") -> float:
    """Positive if a point is on the left of a chord, seen down from the top."""
    along, off = chord[4:6] - chord[2:4], point - chord[2:4]
    return float(along[0] * off[1] - along[1] * off[0])


def row_of(hatching: Hatching, ground: Ground, station: float) -> int:
    """Row before which a stroke at a station belongs."""
    way = -1.0 if ground.middle.is_turned else 1.0
    ahead = way * (hatching.station - station)
    if ground.middle.is_closed:
        return int(np.argmin(ahead % ground.ladder.rungs[-1, 0])) if ahead.size else 0
    return int(np.count_nonzero(ahead <= 0.0))
