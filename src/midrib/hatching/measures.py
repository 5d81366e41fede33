"""How good a hatching is, in numbers."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import LineString

from midrib.kernels.crossings import meet

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from midrib.hatching.hatch import Hatching
    from midrib.hatching.rule import Rule
    from midrib.strip import Strip
    from midrib.types import Bools, Floats

__all__ = ["Measures", "crossings", "measure", "measure_strokes"]

LEAST_TURN = 20.0  # degrees: so much neighbours may turn anyway
STRAIGHT = 10.0  # degrees: an edge that turns less within two widths has no corner there
ON_EDGE, ROUNDING = 1e-9, 2.0**-48  # of the extent, and of the coordinates


@dataclass(frozen=True)
class Measures:
    """Numbers about one hatching.

    Attributes
    ----------
    strokes : int
    crossings : int
        Pairs of strokes that have a point in common, by exact signs.
    outside : float
        Length of what lies outside the slope by more than rounding, over the mean length of
        strokes; 0 where the slope covers every stroke by exact signs.
    short_of_edge : int
        Whole strokes of which an end is on no edge.
    spacing : (k,) array
        Distances between neighbours where they cross the middle line, over the gap that the rule
        asks for at their mean length, over the mean of these ratios: what stretching to a whole
        count makes of it is the same everywhere.
    stretch : float
        That mean.
    top_gap, toe_gap : float
        Largest distance along either edge between neighbours, in gaps that the rule asks for.
    end_gap : float
        Largest distance along the middle line from its ends to the next stroke, in gaps; 0 if
        closed.
    least_foot : float
        Smallest distance along the edges between ends of strokes that are drawn there, in gaps.
    turns : (k,) array
        Degrees between neighbours.
    allowed : (k,) array
        Degrees that they may turn: 20, or where the middle line turns by A within 1.5 w on either
        side, A b over the length of that stretch, if that is more.
    tilts : (m,) array
        Degrees between a stroke and the normal of the top, where both edges are straight for two
        widths to either side and parallel, but for 10 degrees.
    """

    strokes: int
    crossings: int
    outside: float
    short_of_edge: int
    spacing: "Floats"
    stretch: float
    top_gap: float
    toe_gap: float
    end_gap: float
    least_foot: float
    turns: "Floats"
    allowed: "Floats"
    tilts: "Floats"


def measure(hatching: "Hatching") -> Measures:
    """Measure a hatching; see ``Measures``."""
    from midrib.hatching.middle import middle_of

    middle = middle_of(hatching.strip) if hatching.ground is None else hatching.ground.middle
    return measure_strokes(
        hatching.strip,
        hatching.rule,
        LineString(middle.line),
        hatching.strokes,
        hatching.is_long,
        hatching.on_top,
        hatching.on_toe,
    )


def measure_strokes(
    strip: "Strip",
    rule: "Rule",
    middle: LineString,
    strokes: "NDArray[np.object_]",
    is_long: "Bools",
    on_top: "Floats",
    on_toe: "Floats",
) -> Measures:
    """Measure strokes, whoever drew them, in order along the top."""
    main, auxiliary, closed = strip.main, strip.auxiliary, strip.is_closed
    width = np.hypot(*(on_toe - on_top).T)
    asked = rule.gaps(width)
    whole = shapely.linestrings(np.stack([on_top, on_toe], axis=1))
    station = stations_on(middle, whole)
    between = (asked + np.roll(asked, -1)) / 2.0
    steps = ahead(station, middle.length if closed else 0.0)
    count = len(steps)
    ratios = steps / between[:count]
    mean = float(ratios.mean()) if count else 1.0
    bounds = np.array(strip.area.bounds)
    reach = ON_EDGE * float(np.hypot(*(bounds[2:] - bounds[:2]))) + ROUNDING * abs(bounds).max()
    outside = 0.0
    if len(strokes) and not shapely.covers(strip.area, strokes).all():
        near = strip.area.buffer(reach)  # what runs along the boundary is not outside
        outside = float(shapely.length(shapely.difference(strokes, near)).sum())
    off = np.maximum(
        shapely.distance(shapely.points(on_top), main),
        shapely.distance(shapely.get_point(strokes, -1), auxiliary),
    )
    every = np.ones(len(width), dtype=np.bool_)
    top_steps = steps_on(main, on_top, asked, every, closed)
    toe_steps = steps_on(auxiliary, on_toe, asked, every, closed)
    feet = np.append(top_steps, steps_on(auxiliary, on_toe, asked, is_long, closed))
    angle = np.unwrap(np.arctan2(*(on_toe - on_top).T[::-1]))
    turns = abs(np.diff(np.append(angle, angle[:1]) if closed else angle))
    turns = np.degrees(np.minimum(turns % (2 * np.pi), -turns % (2 * np.pi)))
    return Measures(
        strokes=len(strokes),
        crossings=crossings(strokes),
        outside=outside / float(width.mean()) if len(width) else 0.0,
        short_of_edge=int(np.count_nonzero(is_long & (off > reach))),
        spacing=ratios / mean,
        stretch=mean,
        top_gap=float(top_steps.max(initial=0.0)),
        toe_gap=float(toe_steps.max(initial=0.0)),
        end_gap=0.0 if closed else end_gap(station, asked, middle.length),
        least_foot=float(feet.min(initial=np.inf)),
        turns=turns,
        allowed=turn_allowed(middle, station, width, asked, closed)[: len(turns)],
        tilts=tilts_of(strip, on_top, on_toe, width),
    )


def crossings(strokes: "NDArray[np.object_]") -> int:
    """Count pairs of strokes that have a point in common, by exact signs."""
    segments = shapely.get_coordinates(strokes).reshape(-1, 4)
    first, second = shapely.STRtree(strokes).query(strokes)
    pairs = first < second
    return int(np.count_nonzero(meet(segments, first[pairs], second[pairs])))


def stations_on(middle: LineString, whole: "NDArray[np.object_]") -> "Floats":
    """Where whole strokes cross the middle line; the nearest place if they do not."""
    points = shapely.get_coordinates(shapely.get_point(shapely.shortest_line(middle, whole), 0))
    stations: Floats = shapely.line_locate_point(middle, shapely.points(points))
    return stations


def ahead(stations: "Floats", period: float) -> "Floats":
    """Distances between neighbours along a curve; on a closed one from last to first too."""
    if period <= 0.0:
        steps: Floats = abs(np.diff(stations))
        return steps
    forth = (np.roll(stations, -1) - stations) % period
    return np.minimum(forth, period - forth) if len(stations) > 1 else np.empty(0)


def steps_on(
    edge: LineString, ends: "Floats", asked: "Floats", chosen: "Bools", closed: bool
) -> "Floats":
    """Distances along an edge between ends of chosen strokes, in gaps."""
    at = shapely.line_locate_point(edge, shapely.points(ends[chosen]))
    steps = ahead(at, edge.length if closed else 0.0)
    between = (asked[chosen] + np.roll(asked[chosen], -1)) / 2.0
    return steps / between[: len(steps)]


def end_gap(station: "Floats", asked: "Floats", length: float) -> float:
    """Largest distance from the ends of the middle line to the next stroke, in gaps."""
    if not len(station):
        return np.inf
    first, last = int(np.argmin(station)), int(np.argmax(station))
    return float(max(station[first] / asked[first], (length - station[last]) / asked[last]))


def turn_allowed(
    middle: LineString, station: "Floats", width: "Floats", asked: "Floats", closed: bool
) -> "Floats":
    """Degrees that neighbours may turn; see ``Measures``."""
    reach = 1.5 * np.maximum(width, np.roll(width, -1))
    at = (station + np.roll(station, -1)) / 2.0
    total = middle.length
    low, high = at - reach, at + reach
    if not closed:
        low, high = np.maximum(low, 0.0), np.minimum(high, total)
    arc = np.append(0.0, np.cumsum(np.hypot(*np.diff(np.array(middle.coords), axis=0).T)))
    direction = np.unwrap(np.arctan2(*np.diff(np.array(middle.coords), axis=0).T[::-1]))
    half = (arc[1:] + arc[:-1]) / 2.0
    if closed:
        turn = np.round((direction[-1] - direction[0]) / (2 * np.pi)) * 2 * np.pi
        half = np.concatenate([half - total, half, half + total])
        direction = np.concatenate([direction - turn, direction, direction + turn])
    theta = np.degrees(abs(np.interp(high, half, direction) - np.interp(low, half, direction)))
    gap = (asked + np.roll(asked, -1)) / 2.0
    allowed: Floats = np.maximum(LEAST_TURN, theta * gap / np.maximum(high - low, gap))
    return allowed


def tilts_of(strip: "Strip", on_top: "Floats", on_toe: "Floats", width: "Floats") -> "Floats":
    """Degrees between strokes and the normals of the top, away from corners; see ``Measures``."""
    top = directions(strip.main, on_top, width)
    toe = directions(strip.auxiliary, on_toe, width)
    across = np.degrees(np.arctan2(*(on_toe - on_top).T[::-1]))
    calm = (spread(top) <= STRAIGHT) & (spread(toe) <= STRAIGHT)
    calm &= abs(folded(top[:, 2] - toe[:, 2], 360.0)) <= STRAIGHT
    tilt: Floats = abs(folded(across - top[:, 2] - 90.0, 180.0))[calm]
    return tilt


def directions(edge: LineString, points: "Floats", width: "Floats") -> "Floats":
    """(n, 5) directions of an edge in degrees, each over a width, from 2 widths before to after."""
    at = shapely.line_locate_point(edge, shapely.points(points))
    places = at[:, None] + width[:, None] * np.array([-1.5, -0.75, 0.0, 0.75, 1.5])
    ends = [
        shapely.get_coordinates(
            shapely.line_interpolate_point(
                edge, np.clip(places + half * width[:, None], 0.0, edge.length).ravel()
            )
        )
        for half in (-0.5, 0.5)
    ]
    step = (ends[1] - ends[0]).reshape(*places.shape, 2)
    result: Floats = np.degrees(np.arctan2(step[..., 1], step[..., 0]))
    return result


def spread(directions: "Floats") -> "Floats":
    """Largest difference of directions from the middle one, in degrees."""
    off: Floats = abs(folded(directions - directions[:, 2:3], 360.0)).max(axis=1)
    return off


def folded(degrees: "Floats", period: float) -> "Floats":
    """Angles brought to between minus and plus half a period."""
    result: Floats = degrees - period * np.round(degrees / period)
    return result
