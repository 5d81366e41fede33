"""How good a hatching is, in numbers."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import LineString, Polygon
from shapely.geometry.base import BaseGeometry

from midrib.hatching.bounds import Curves, Excess, Laid, excesses, far_ends
from midrib.hatching.chains import chain_of
from midrib.hatching.rule import LEAST_LENGTH
from midrib.kernels.crossings import meet
from midrib.kernels.gauging import ALLOWED, LEAN, MOST_TILT, STEP, TOE, TOP, TURN

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from midrib.hatching.hatch import Hatching
    from midrib.hatching.rule import Rule
    from midrib.strip import Strip
    from midrib.types import Bools, Floats, Ints

__all__ = [
    "Measures",
    "crossings",
    "measure",
    "measure_strokes",
    "outside_of",
    "rounding_of",
    "untold",
]

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
        Smallest distance between neighbouring ends of strokes that are drawn on an edge, in gaps.
    turns : (k,) array
        Degrees between neighbours.
    allowed : (k,) array
        Degrees that they may turn: 20, or where the middle line turns by A within 1.5 w on either
        side, A b over the length of that stretch, if that is more.
    tilts : (m,) array
        Degrees between a stroke and the normal of the top, where that is straight for two widths
        to either side, but for 10 degrees.
    beyond : list of Excess
        Places where a bound of ``midrib.hatching.bounds`` is exceeded.
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
    beyond: list[Excess]


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
    reach = rounding_of(strip.area)
    outside = float(shapely.length(outside_of(strokes, strip.area, reach)[0]).sum())
    off = np.maximum(
        shapely.distance(shapely.points(on_top), strip.main),
        shapely.distance(shapely.get_point(strokes, -1), strip.auxiliary),
    )
    laid = laid_of(strip, rule, middle, is_long & (off <= reach), on_top, on_toe)
    width, steps = np.hypot(*(on_toe - on_top).T), laid.between(STEP)
    mean = float(steps.mean()) if len(steps) else 1.0
    tilts = laid.tilts
    return Measures(
        strokes=len(strokes),
        crossings=crossings(strokes),
        outside=outside / float(width.mean()) if len(width) else 0.0,
        short_of_edge=int(np.count_nonzero(is_long & (off > reach))),
        spacing=steps / mean,
        stretch=mean,
        top_gap=float(laid.between(TOP).max(initial=0.0)),
        toe_gap=float(laid.between(TOE).max(initial=0.0)),
        end_gap=0.0 if strip.is_closed else float(laid.end_gaps.max()),
        least_foot=laid.feet_apart,
        turns=np.degrees(laid.between(TURN)),
        allowed=np.degrees(laid.between(ALLOWED)),
        tilts=tilts[laid.gauged[:, LEAN] == MOST_TILT],
        beyond=excesses(laid) + far_ends(laid, least=LEAST_LENGTH * rule.least_gap),
    )


def rounding_of(geometry: BaseGeometry) -> float:
    """How far places may be off by rounding, and by what a file loses of them."""
    bounds = np.array(geometry.bounds)
    return float(ON_EDGE * np.hypot(*(bounds[2:] - bounds[:2])) + ROUNDING * abs(bounds).max())


def outside_of(
    strokes: "NDArray[np.object_]", area: Polygon, reach: float
) -> "tuple[NDArray[np.object_], Ints]":
    """Parts of strokes that are outside an area, and the row of each.

    What is no farther from the area than a reach, as what runs along its boundary, is not outside.
    """
    rows = np.flatnonzero(~shapely.covers(area, strokes))
    if not rows.size:
        return np.empty(0, dtype=object), rows
    grown = area.buffer(reach)
    shapely.prepare(grown)
    rows = rows[~shapely.covers(grown, strokes[rows])]
    parts, of = shapely.get_parts(shapely.difference(strokes[rows], area), return_index=True)
    is_far = ~shapely.covers(grown, parts)
    return parts[is_far], rows[of[is_far]]


def untold(hatching: "Hatching", found: Measures) -> list[Excess]:
    """Places where strokes are beyond a bound and no problem of the hatching says so there.

    There is between the two strokes, or at the one, but for a tenth of a gap.
    """
    n, told = len(hatching.strokes), shapely.MultiPoint([p.where for p in hatching.problems])
    places = []
    for one in found.beyond:
        rows = [one.row, (one.row + 1) % n]
        corners = [*hatching.on_top[rows], *hatching.on_toe[rows], one.where.coords[0]]
        near = 0.1 * float(hatching.rule.gaps(hatching.width[rows]).min())
        if not shapely.dwithin(shapely.MultiPoint(corners).convex_hull, told, near):
            places.append(one)
    return places


def laid_of(
    strip: "Strip",
    rule: "Rule",
    middle: LineString,
    on_edge: "Bools",
    on_top: "Floats",
    on_toe: "Floats",
) -> Laid:
    """Whole strokes where they are found on the curves, whoever drew them."""
    whole = shapely.linestrings(np.stack([on_top, on_toe], axis=1))
    edges = [strip.main, strip.auxiliary]
    if is_right_of(strip.main, on_top, on_toe):  # gauging has the slope on the left
        middle, *edges = shapely.reverse([middle, *edges])
    feet = [
        shapely.line_locate_point(edge, shapely.points(ends))
        for edge, ends in zip(edges, (on_top, on_toe), strict=True)
    ]
    curves = Curves(chain_of(middle), chain_of(edges[0]), chain_of(edges[1]))
    station = stations_on(middle, whole)
    pivots = shapely.line_interpolate_point(middle, station)
    local = 2.0 * np.maximum(*(shapely.distance(pivots, edge) for edge in edges))
    ends, asked = (
        np.column_stack([on_top, on_toe]),
        rule.gaps(np.hypot(*(on_toe - on_top).T), local),
    )
    return Laid(curves, station, np.column_stack(feet), ends, asked, local, on_edge)


def is_right_of(top: LineString, on_top: "Floats", on_toe: "Floats") -> bool:
    """Whether most strokes go to the right of a top."""
    corners = shapely.get_coordinates(top)
    at = shapely.line_locate_point(top, shapely.points(on_top))
    arc = np.append(0.0, np.cumsum(np.hypot(*np.diff(corners, axis=0).T)))
    along = np.diff(corners, axis=0)[np.clip(np.searchsorted(arc, at) - 1, 0, len(corners) - 2)]
    down = on_toe - on_top
    return bool(np.sign(along[:, 0] * down[:, 1] - along[:, 1] * down[:, 0]).sum() < 0.0)


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
