r"""How good a centre line is: six questions, each with a number behind it.

    boundary  o--------------------------------------o
              |     line  ___                        |
           e0 |:.....____/...\___......trunk.........:| e1
              |:         offset                     :|
              o--------------------------------------o
               <- w ->                        <- w ->      not looked at for the offset

w        average width of the area
trunk    medial axis from one expected end to the other, see ``reference``
offset   distance between line and trunk, from each to the other, farther from the ends than w, or
         than a quarter of the trunk where that is less
"""

from dataclasses import dataclass

import numpy as np
import shapely
from shapely import LineString
from shapely.geometry.base import BaseGeometry
from shapely.ops import substring

from families import Case, Floats
from reference import Axis

__all__ = ["COLUMNS", "Score", "score_of"]

OUTSIDE = 1e-9  # length of line outside that is rounding, in coordinate units
OFFSET = 0.1  # mean offset that is still "in the middle", in widths
COVERED = 0.95  # part of the trunk that is "the whole trunk"
ON_BOUNDARY = 0.02  # distance of an end from the boundary, in widths
IN_THE_MIDDLE = 0.25  # distance of an end from the expected one, in widths: half-way to a corner
STEPS_PER_WIDTH = 50  # places at which offsets are measured

COLUMNS = (
    "one line",
    "inside",
    "within .1 w",
    "whole trunk",
    "ends on boundary",
    "ends in the middle",
)


@dataclass(frozen=True)
class Score:
    """What was measured for one line; lengths in widths unless they say otherwise."""

    is_one_line: bool  # a LineString that nowhere meets itself
    is_covered: bool  # by exact predicates
    outside: float  # length outside the area, in coordinate units
    offset: float  # mean; of line to trunk and trunk to line the larger, here and below
    offset_p95: float
    offset_max: float
    covered: float  # part of the trunk, half a width less at both ends, with the line w / 2 near
    from_boundary: tuple[float, float]  # how far the two ends are from the boundary
    from_ends: tuple[float, float]  # and from the expected ends
    stretch: float  # length over the trunk's length: above 1, detours; far above 1, zigzags
    is_exact: bool  # whether the line must be covered exactly, not but for rounding

    @property
    def answers(self) -> tuple[bool, ...]:
        """Answers to the questions of ``COLUMNS``."""
        return (
            self.is_one_line,
            self.is_covered if self.is_exact else self.outside <= OUTSIDE,
            self.offset <= OFFSET,
            self.covered >= COVERED,
            max(self.from_boundary) <= ON_BOUNDARY,
            max(self.from_ends) <= IN_THE_MIDDLE,
        )

    @property
    def is_clean(self) -> bool:
        """Whether all answers are yes."""
        return all(self.answers)


NOTHING = Score(
    is_one_line=False,
    is_covered=False,
    outside=np.inf,
    offset=np.inf,
    offset_p95=np.inf,
    offset_max=np.inf,
    covered=0.0,
    from_boundary=(np.inf, np.inf),
    from_ends=(np.inf, np.inf),
    stretch=0.0,
    is_exact=False,
)


def score_of(case: Case, axis: Axis, line: BaseGeometry | None, *, is_exact: bool) -> Score:
    """Hold a line against the trunk of its area."""
    if line is None or line.is_empty:
        return NOTHING
    w, trunk = case.width, axis.trunk(line)
    ways = offsets(line, trunk, w)
    first, last = ends_of(line, case.ends)
    to_boundary = shapely.distance(shapely.points([first, last]), case.area.boundary) / w
    to_ends = np.hypot(*(np.array([first, last]) - case.ends).T) / w
    return Score(
        is_one_line=isinstance(line, LineString) and bool(line.is_simple),
        is_covered=bool(case.area.covers(line)),
        outside=float(line.difference(case.area).length),
        offset=max(float(way.mean()) for way in ways),
        offset_p95=max(float(np.percentile(way, 95)) for way in ways),
        offset_max=max(float(way.max()) for way in ways),
        covered=covered(line, trunk, w),
        from_boundary=(float(to_boundary[0]), float(to_boundary[1])),
        from_ends=(float(to_ends[0]), float(to_ends[1])),
        stretch=float(line.length / trunk.length),
        is_exact=is_exact,
    )


def places_on(line: BaseGeometry, step: float) -> Floats:
    """Points along a line, or along every part of one, at equal steps."""
    places = []
    for part in shapely.get_parts(line):
        points = shapely.get_coordinates(part)
        arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
        at = np.linspace(0.0, arc[-1], max(2, int(np.ceil(arc[-1] / step)) + 1))
        places.append(np.column_stack([np.interp(at, arc, column) for column in points.T]))
    return np.concatenate(places)


def offsets(line: BaseGeometry, trunk: LineString, w: float) -> list[Floats]:
    """Distances in widths from places on the line to the trunk, and the other way round."""
    margin = min(w, trunk.length / 4)
    on_line = shapely.points(places_on(line, w / STEPS_PER_WIDTH))
    at = shapely.line_locate_point(trunk, on_line)
    inner = on_line[(at > margin) & (at < trunk.length - margin)]
    on_trunk = shapely.points(places_on(middle_of(trunk, margin), w / STEPS_PER_WIDTH))
    ways = (shapely.distance(inner, trunk), shapely.distance(on_trunk, line))
    return [way / w for way in ways if way.size]


def covered(line: BaseGeometry, trunk: LineString, w: float) -> float:
    """Part of the trunk, half a width less at both ends, from which the line is at most w / 2."""
    middle = middle_of(trunk, min(w / 2, trunk.length / 4))
    on_trunk = shapely.points(places_on(middle, w / STEPS_PER_WIDTH))
    return float(np.mean(shapely.distance(on_trunk, line) <= w / 2))


def middle_of(trunk: LineString, margin: float) -> LineString:
    """Trunk without a margin at both ends."""
    return substring(trunk, margin, trunk.length - margin)


def ends_of(line: BaseGeometry, expected: Floats) -> Floats:
    """Both ends of a line in the order of the expected ones; of several lines, the nearest."""
    tips = np.concatenate(
        [shapely.get_coordinates(part)[[0, -1]] for part in shapely.get_parts(line)]
    )
    off = np.hypot(*(tips[:, None] - expected[None]).transpose(2, 0, 1))
    if len(tips) == 2:  # both ends of one line count, whatever they are near to
        return tips if off[0, 0] + off[1, 1] <= off[0, 1] + off[1, 0] else tips[::-1]
    nearest: Floats = tips[off.argmin(axis=0)]
    return nearest
