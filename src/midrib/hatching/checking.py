"""Checks of slopes before they are hatched, and of strokes that somebody has drawn."""

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from shapely import LineString, MultiLineString, Point

from midrib import interrupts
from midrib.errors import GeometryTypeError, InvalidAreaError
from midrib.hatching.draw import draw
from midrib.hatching.existing import crossings, outside
from midrib.hatching.finding import CHECK_OF, CHECKS, Finding
from midrib.hatching.keys import STROKED
from midrib.hatching.sharing import in_step
from midrib.hatching.slope import Slope, SlopeProblem
from midrib.hatching.standards import standard_for, standards_named

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from midrib.types import Floats

__all__ = ["check_slopes", "doubts", "falls"]

MOST_UNEQUAL = 4.0  # an edge over the other: 3.2 is the most in 134 slopes that surveyors measured
ON_BOUNDARY = 1e-9  # of the extent: what a file loses of a place


def check_slopes(
    slopes: Sequence[Slope],
    problems: Iterable[SlopeProblem] = (),
    *,
    strokes: Any = (),
    standard: Any = "pl-2021",
    scale: float = 500.0,
    metres_per_unit: float = 1.0,
) -> list[Finding]:
    """Look for what would spoil the hatching of slopes.

    Parameters
    ----------
    slopes : sequence of Slope
    problems : iterable of SlopeProblem, optional
        What ``midrib.read_slopes`` has found; it is listed with the rest.
    strokes : array_like of LineString, optional
        Strokes that are drawn already: those that cross, or lie on each other, are listed, each
        pair once, and what is outside of the slopes, if there are any. That they meet in an end is
        no fault.
    standard : str or Standard, default "pl-2021"
        A standard, a file of one, or the beginning of names: each slope is hatched by the one that
        is made for its kind, as ``midrib hatch`` does without options: what is amiss is listed.
    scale : float, default 500
        Of the map, 500 for 1:500.
    metres_per_unit : float, default 1
        Length of a coordinate unit.

    Returns
    -------
    list of Finding
        In the order of ``CHECKS``, then of the slopes.

    Raises
    ------
    GeometryTypeError
        If a stroke is no line.
    ParameterError
        If there is no such standard.

    Notes
    -----
    Heights: the top is interpolated between its points of known height, along itself, and compared
    with the toe's points beside it; a slope is swapped if the median difference is negative.
    Orientation: edges of lengths more unequal than 4 to 1 are doubtful, closed ones are not.
    Outside: a stroke belongs to the slope that holds most of it. Half the width of the standard's
    line is free, since that covers it; so is what runs along the boundaries of other slopes.
    O(n log n) for n strokes that few others meet.

    Examples
    --------
    >>> top, toe = LineString([(0, 2), (9, 2)]), LineString([(0, 0), (9, 0)])
    >>> heights = {"top_heights": np.array([[0, 2, 168]]), "toe_heights": np.array([[5, 0, 170]])}
    >>> slope = midrib.Slope("a", "other", box(0, 0, 9, 2), top, toe, "", **heights)
    >>> [(finding.check, finding.where.wkt) for finding in midrib.check_slopes([slope])]
    [('swapped', 'POINT (5 0)')]
    """
    found = [Finding(p.id, p.kind, p.reason, p.where) for p in problems]
    # An unknown standard is refused before any work is done.
    line = min(known.at(scale).stroke_width for known in standards_named(standard))
    half_a_line = 0.5 * line * scale / 1000.0 / metres_per_unit
    for slope, options in zip(slopes, in_step(slopes, {}, "meet"), strict=True):
        interrupts.check()
        off_ring = [*boundary(slope)]
        found += [*doubts(slope), *off_ring]
        if not off_ring:  # else edges and area do not go together
            at = {"scale": scale, "metres_per_unit": metres_per_unit}
            found += matching(slope, standard, at | options)
    drawn = lines_of(strokes)
    found += crossings(drawn, slopes)
    found += outside(drawn, slopes, half_a_line) if slopes else ()
    order = {check: k for k, check in enumerate(CHECKS)}
    return sorted(found, key=lambda finding: order[finding.check])


def lines_of(strokes: Any) -> "NDArray[np.object_]":
    """Return strokes as an array of lines, None among them.

    Raises
    ------
    GeometryTypeError
        If one is something else.
    """
    lines = np.asarray(strokes, dtype=object).ravel()
    for row, line in enumerate(lines):
        if line is not None and not isinstance(line, LineString | MultiLineString):
            kind = getattr(line, "geom_type", type(line).__name__)
            msg = f"strokes[{row}] is a {kind}, expected a LineString"
            raise GeometryTypeError(msg)
    return lines


def doubts(slope: Slope) -> Iterator[Finding]:
    """Find what makes it doubtful that the top of a slope is its top."""
    yield from heights(slope)
    yield from lengths(slope)


def falls(slope: Slope) -> "Floats":
    """How much lower each point of the toe is than the top beside it.

    Returns
    -------
    ndarray of float64, shape (n, 3)
        x and y of the points of the toe whose height is known, and the fall there; none where no
        height of either edge is known. Points that both edges share tell nothing.
    """
    if slope.top_heights is None or slope.toe_heights is None:
        return np.empty((0, 3))
    top, toe = slope.top_heights, slope.toe_heights
    on_toe = shapely.points(toe[:, :2])
    is_shared = shapely.distance(on_toe, slope.top) <= ON_BOUNDARY * extent(slope)
    on_toe, toe = on_toe[~is_shared], toe[~is_shared]
    station = slope.top.line_locate_point(shapely.points(top[:, :2]))
    order = np.argsort(station)
    period = slope.top.length if slope.top.is_closed else None
    beside = slope.top.line_locate_point(on_toe)
    above = np.interp(beside, station[order], top[order, 2], period=period)
    return np.column_stack([toe[:, :2], above - toe[:, 2]])


def heights(slope: Slope) -> Iterator[Finding]:
    """Find a top that is lower than its toe."""
    fall = falls(slope)
    if len(fall) and np.median(fall[:, 2]) < 0.0:
        worst = fall[np.argmin(fall[:, 2])]
        reason = (
            f"the top is up to {-worst[2]:.3g} lower than the toe, by {len(fall)} known heights: "
            "the two may be swapped"
        )
        yield Finding(slope.id, "swapped", reason, Point(worst[:2]))


def boundary(slope: Slope) -> Iterator[Finding]:
    """Find edges that are off the boundary of the area, or do not divide it."""
    near = ON_BOUNDARY * extent(slope)
    for name, edge in (("top", slope.top), ("toe", slope.toe)):
        corners = shapely.get_coordinates(edge)
        places = np.concatenate([corners, (corners[1:] + corners[:-1]) / 2.0])
        off = shapely.distance(shapely.points(places), slope.area.boundary)
        worst = int(np.argmax(off))
        if off[worst] > near:
            reason = f"the {name} is {off[worst]:.3g} off the boundary"
            yield Finding(slope.id, "off-ring", reason, Point(places[worst]))
            return
    if not slope.top.is_closed:
        try:
            slope.strip()
        except InvalidAreaError as error:
            yield Finding(slope.id, "off-ring", str(error), Point(slope.top.coords[0][:2]))


def lengths(slope: Slope) -> Iterator[Finding]:
    """Find edges so unequal that strokes would run along the slope, not down it."""
    top, toe = slope.top.length, slope.toe.length
    if not slope.top.is_closed and max(top, toe) > MOST_UNEQUAL * min(top, toe):
        reason = f"the top is {top:.3g} long and the toe {toe:.3g}, expected {MOST_UNEQUAL:g} to 1"
        middle = slope.top.interpolate(0.5, normalized=True)
        yield Finding(slope.id, "orientation", f"{reason} at most", Point(middle.x, middle.y))


def matching(slope: Slope, standard: Any, options: dict[str, Any]) -> Iterator[Finding]:
    """Find places where a slope is not hatched as it should be, if its kind is hatched at all."""
    known = standard_for(standard, slope.kind)
    if known is None or known.symbol not in STROKED:
        return
    try:
        done = draw(slope.strip(), known, drop=slope.drop, **options).hatching
    except InvalidAreaError as error:
        middle = slope.top.interpolate(0.5, normalized=True)
        yield Finding(slope.id, "unmatched", str(error), Point(middle.x, middle.y))
        return
    for problem in [] if done is None else done.problems:
        yield Finding(slope.id, CHECK_OF[problem.kind], problem.reason, problem.where)


def extent(slope: Slope) -> float:
    """Longer side of the bounds of a slope's area."""
    x_low, y_low, x_high, y_high = slope.area.bounds
    return float(max(x_high - x_low, y_high - y_low))
