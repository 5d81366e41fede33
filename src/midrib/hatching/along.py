"""Symbols that stand along an object: ticks on its main edge, circles and templates on its axis.

c        middle of a figure, on the axis; then moved until it is equally far from both edges
m, a     feet of c on the main and on the auxiliary edge; its radius is |cm| = |ca|

    main       ------m--------------
                     |                 circles: large, small, large, … every second one is
    axis       - (   c   ) o (   )     tangent to both edges
                     |
    auxiliary  ------a--------------
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely
from shapely import LineString

from midrib.curves.minimal_radii import minimal_radii
from midrib.errors import ParameterError
from midrib.hatching import standards
from midrib.hatching.chains import Chain, chain_of
from midrib.hatching.drawn import CIRCLE, Figure, Pen, Placed, Symbols, drawing, edges_of
from midrib.hatching.keys import STROKED

if TYPE_CHECKING:
    from pathlib import Path

    from midrib.hatching.standard import Standard
    from midrib.strip import Strip
    from midrib.types import Bools, Floats

__all__ = ["symbols_along"]

SAMPLES = 1024  # of the width along the axis
STEPS = 32  # of moving a middle between the edges; each halves what is left, or better
BETWEEN = 0.5  # least -cos of the angle at which a point sees both edges: 120 degrees
CLEAR = 0.9  # of the gap between large circles, that a small one takes at the most
MOST = 100_000  # symbols of one object
NEARLY = 1e-6  # relative: what rounding may take off a width or a whole number
WITHIN = 1e-7  # of the extent: how far rounding may take a point out of its area


def symbols_along(
    strip: "Strip",
    standard: "str | Path | Standard",
    scale: float = 500.0,
    *,
    metres_per_unit: float = 1.0,
) -> Symbols:
    """Draw what stands along a wall, a conveyor, a gantry or a water gate.

    Parameters
    ----------
    strip : Strip
        The object; its main curve is the directional polyline.
    standard : str, Path or Standard
        One whose symbol is ``"ticks"``, ``"circles"`` or ``"template"``.
    scale : float, default 500
        Of the map, 500 for 1:500.
    metres_per_unit : float, default 1
        Length of a coordinate unit in metres.

    Returns
    -------
    Symbols
        In coordinate units.

    Raises
    ------
    ParameterError
        If the standard's symbol is made of strokes.

    Notes
    -----
    Ticks come in pairs at the standard's spacing, in the middle of the main curve, and reach from
    there to the other edge. Circles are on the curve of minimal radii, centred, from where one has
    room at one end to where one has at the other; their middles are a factor times the local width
    apart or a little more, so that their number is whole, and every second one is large, the first
    among them. A large circle that would overlap an earlier one is left out; a small one becomes
    as small as the gap needs.
    """
    known = standards.standard(standard).at(scale)
    if known.symbol in STROKED:
        msg = (
            f"standard {known.name!r} draws {known.symbol!r}, which takes the strokes of a hatching"
        )
        raise ParameterError(msg)
    millimetre = scale / 1000.0 / metres_per_unit
    edges = edges_of(strip.area, strip.main, known)
    if known.symbol == "ticks":
        return drawing(ticks(strip, known, millimetre), Pen(), (), edges, known)
    axis = axis_of(strip)
    if known.symbol == "circles":
        placed = circles(axis, known, millimetre)
    else:
        placed = in_the_middle(axis, Figure(known.name, tuple(map(np.array, known.template))))
    return drawing(Pen(), Pen(), placed, edges, known)


def ticks(strip: "Strip", known: "Standard", millimetre: float) -> Pen:
    """Draw ticks from the main curve across the area; one that would meet another is left out."""
    main = chain_of(strip.main)
    spacing = float(known.spacing_at(np.zeros(1))[0])
    pairs = evenly(main, spacing * millimetre, known.pair * millimetre)
    halves = 0.5 * known.pair * millimetre * np.array([-1.0, 1.0] if known.pair else [0.0])
    stations = (pairs[:, None] + halves).ravel()
    ring = np.concatenate([main.points, shapely.get_coordinates(strip.auxiliary)[::-1]])
    is_left = shapely.is_ccw(shapely.linearrings(ring))
    tilt = np.radians(known.angle if is_left else -known.angle)
    turn = np.array([[np.cos(tilt), np.sin(tilt)], [-np.sin(tilt), np.cos(tilt)]])
    starts, ways = main.at(stations), main.directions(stations) @ turn
    low_x, low_y, high_x, high_y = strip.area.bounds
    extent = float(np.hypot(high_x - low_x, high_y - low_y))
    rays = shapely.linestrings(np.stack([starts, starts + extent * ways], axis=1))
    ticks, number = [], []
    for i, (start, ray) in enumerate(zip(shapely.points(starts), rays, strict=True)):
        pieces = shapely.get_parts(shapely.intersection(ray, strip.area))
        pieces = pieces[shapely.get_dimensions(pieces) == 1]
        pieces = pieces[shapely.distance(pieces, start) <= WITHIN * extent]
        tick = max(pieces, key=shapely.length, default=None)  # rounding may split off a crumb
        if tick is not None:
            ticks.append(tick)
            number.append(i // len(halves))
    pen = Pen()
    met, by = shapely.STRtree(ticks).query(np.array(ticks, dtype=object), predicate="intersects")
    before: dict[int, list[int]] = {}
    for i, j in zip(met[by < met].tolist(), by[by < met].tolist(), strict=True):
        before.setdefault(i, []).append(j)
    drawn: set[int] = set()
    for i, tick in enumerate(ticks):
        if not drawn.intersection(before.get(i, ())):
            drawn.add(i)
            pen.add(tick, number[i])
    return pen


def evenly(chain: Chain, spacing: float, room: float) -> "Floats":
    """Stations at a spacing, as many as have room, in the middle of a chain or round it."""
    if chain.is_closed:
        count = max(1, round(chain.length / spacing))
        return np.linspace(0.0, chain.length, count, endpoint=False)
    wanted = max(chain.length - room, 0.0) / spacing * (1.0 + NEARLY)
    if wanted > MOST:
        msg = (
            f"a spacing of {spacing:.3g} makes more than {MOST} symbols on an object that is "
            f"{chain.length:.3g} long; scale or spacing is too small"
        )
        raise ParameterError(msg)
    count = 1 + int(wanted)
    return 0.5 * chain.length + spacing * np.linspace(-0.5, 0.5, count) * (count - 1)


class Axis(NamedTuple):
    """The axis of an object and its edges."""

    chain: Chain
    main: LineString
    auxiliary: LineString
    boundary: LineString

    def middles(self, stations: "Floats") -> "Floats":
        """Points (n, 2) near the axis at stations, equally far from both edges."""
        points = self.chain.at(stations)
        for _ in range(STEPS):
            to_main, to_auxiliary = self.feet(points) - points
            near, far = np.hypot(*to_main.T), np.hypot(*to_auxiliary.T)
            ratio = np.divide(far, near, out=np.ones_like(far), where=near > 0.0)  # 1 in a tip
            points = points - to_main * (0.5 * (ratio - 1.0))[:, None]
        return points

    def feet(self, points: "Floats") -> "Floats":
        """Nearest points (2, n, 2) of the main and of the auxiliary edge."""
        there = shapely.points(points)
        return np.stack(
            [
                shapely.get_coordinates(edge.interpolate(edge.project(there)))
                for edge in (self.main, self.auxiliary)
            ]
        )

    def widths(self, points: "Floats") -> "Floats":
        """Distances from points to both edges, added up."""
        widths: Floats = np.hypot(*(self.feet(points) - points).transpose(2, 0, 1)).sum(axis=0)
        return widths


def axis_of(strip: "Strip") -> Axis:
    """Axis of a strip: its curve of minimal radii, centred."""
    line = minimal_radii(strip, ends="caps", centring="centred", end_clearance=None).line
    main, auxiliary = map(shapely.force_2d, (strip.main, strip.auxiliary))
    return Axis(chain_of(line), main, auxiliary, shapely.boundary(strip.area))


def circles(axis: Axis, known: "Standard", millimetre: float) -> tuple[Placed, ...]:
    """Place large and small circles in turn."""
    start, stop = room(axis, 2.0 * known.stroke_width * millimetre)
    samples = np.linspace(start, stop, SAMPLES + 1)
    widths = axis.widths(axis.chain.at(samples))
    apart = np.maximum(known.spacing_at(widths / millimetre), 2.0 * known.stroke_width) * millimetre
    steps = np.diff(samples) * 0.5 * (1.0 / apart[1:] + 1.0 / apart[:-1])
    number = np.concatenate([[0.0], np.cumsum(steps)])
    count = 1 + int(number[-1] * (1.0 + NEARLY))
    stations = np.interp(np.linspace(0.0, number[-1], count), number, samples)
    at = axis.middles(stations)
    radius = shapely.distance(shapely.points(at), axis.boundary)
    is_large = np.arange(count) % 2 == 0
    is_large[::2] = apart_from_earlier(at[::2], radius[::2])
    is_small = np.arange(count) % 2 == 1
    free = free_between(at, np.where(is_large, radius, 0.0))
    radius = np.where(is_small, np.minimum(known.small_ratio * radius, CLEAR * free), radius)
    shown = (is_large | is_small) & (radius > 0.0)
    number_of = np.arange(count)[shown]
    return (Placed(CIRCLE, at[shown], 2.0 * radius[shown], np.zeros(shown.sum()), number_of),)


def room(axis: Axis, narrowest: float) -> tuple[float, float]:
    """Stations between which circles have room: clear of the caps, in no too narrow tip.

    Caps may belong to an edge, as registers have it: there the axis leads into the corners, and
    does not lie between the edges.
    """

    def has_room(stations: "Floats") -> "Bools":
        points = axis.middles(stations)
        widths = axis.widths(points)
        free = 2.0 * shapely.distance(shapely.points(points), axis.boundary)
        to_main, to_auxiliary = axis.feet(points) - points
        across = -(to_main * to_auxiliary).sum(axis=1) >= BETWEEN * (0.5 * widths) ** 2
        is_free: Bools = (free >= (1.0 - NEARLY) * widths) & (widths >= narrowest) & across
        return is_free

    samples = np.linspace(0.0, axis.chain.length, SAMPLES + 1)
    known = np.flatnonzero(has_room(samples))
    if not known.size:
        widest = samples[np.argmax(axis.widths(axis.chain.at(samples)))]
        return float(widest), float(widest)
    good = samples[known[[0, -1]]]
    bad = samples[[max(known[0] - 1, 0), min(known[-1] + 1, SAMPLES)]]
    for _ in range(STEPS):
        middle = 0.5 * (good + bad)
        is_good = has_room(middle)
        good, bad = np.where(is_good, middle, good), np.where(is_good, bad, middle)
    return float(good[0]), float(good[1])


def apart_from_earlier(at: "Floats", radius: "Floats") -> "Bools":
    """Which circles, in their order, do not overlap one before them that is kept."""
    keep = np.zeros(len(at), dtype=np.bool_)
    for i in range(len(at)):
        away = np.hypot(*(at[:i] - at[i]).T)
        keep[i] = not (keep[:i] & (away < radius[:i] + radius[i])).any()
    return keep


def free_between(at: "Floats", radius: "Floats") -> "Floats":
    """Distance from each point to the circles of the points beside it."""
    away = np.hypot(*np.diff(at, axis=0).T)
    before = np.concatenate([[np.inf], away - radius[:-1]])
    after = np.concatenate([away - radius[1:], [np.inf]])
    free: Floats = np.minimum(before, after)
    return free


def in_the_middle(axis: Axis, figure: Figure) -> tuple[Placed, ...]:
    """Place a figure in the middle of the axis, as large as the object is wide there."""
    half = np.array([0.5 * axis.chain.length])
    at = axis.middles(half)
    ((x, y),) = np.subtract(*axis.feet(at))  # across, from the auxiliary to the main edge
    along = np.array([y, -x])
    if along @ axis.chain.directions(half)[0] < 0.0:
        along = -along
    angle = np.degrees(np.arctan2(along[1:], along[:1]))
    return (Placed(figure, at, axis.widths(at), angle, np.zeros(1, dtype=np.intp)),)
