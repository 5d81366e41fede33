r"""How far a line is from a known axis, place by place, in widths of the place.

    e0 :. . . . . . . . axis . . . . . . . . : e1
       |    ___/offset\____ line ______      |
        <-w->                           <-w->     the ends, reported apart

Both ways count: from places on the line to the axis, and from places on the axis to the line, so
that branches and missing stretches show. Of both ways the larger figure is the one.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import KDTree
from shapely import LineString
from shapely.geometry.base import BaseGeometry

from families import Case, Floats
from midrib.measures.chains import distances, vertices
from score import ends_of, places_on

__all__ = ["MEASURES", "P95", "STEPS_PER_WIDTH", "Known", "Offsets", "offsets_of"]

STEPS_PER_WIDTH = 25  # places at which offsets are measured
MOST = 20_000  # of them on one axis: a stream of thousands of widths gets longer steps
P95 = 95
OUTSIDE = 1e-9  # length of a rival's line outside that is rounding, in widths

MEASURES = ("median", "p95", "ends")


@dataclass(frozen=True, eq=False)
class Known:
    """The axis of an area and the width along it."""

    points: Floats  # (k, 2) from end to end
    width: Floats  # (k,)


@dataclass(frozen=True)
class Offsets:
    """What was measured for one line."""

    median: float  # away from the ends, in widths of the place
    p95: float
    ends: float  # p95 within a width of the ends, in average widths as the next one
    from_ends: float  # the farther of the line's ends from the axis' end
    is_one_line: bool  # a LineString that nowhere meets itself
    is_inside: bool
    place: tuple[float, float]  # the worst away from the ends, and near to them
    end_place: tuple[float, float]


def offsets_of(case: Case, known: Known, line: BaseGeometry, *, is_exact: bool) -> Offsets:
    """Hold a line against a known axis; ``is_exact`` forgives no rounding outside the area."""
    w = case.width
    axis = LineString(known.points)
    step = max(w / STEPS_PER_WIDTH, axis.length / MOST)
    on_axis, on_line = places_on(axis, step), places_on(line, step)
    at = np.linspace(0.0, axis.length, len(on_axis))
    arc = np.append(0.0, np.cumsum(np.hypot(*np.diff(known.points, axis=0).T)))
    width = np.interp(at, arc, known.width)
    beside = KDTree(on_axis).query(on_line)[1]
    ways = (
        (beside, distances_to(on_line, axis)),
        (np.arange(len(at)), distances_to(on_axis, line)),
    )
    points = np.concatenate([on_line, on_axis])
    margin = min(w, axis.length / 4.0)
    is_inner = (at > margin) & (at < axis.length - margin)
    inner = [off[is_inner[k]] / width[k[is_inner[k]]] for k, off in ways]
    outer = [off[~is_inner[k]] / w for k, off in ways]
    index, off = (np.concatenate(both) for both in zip(*ways, strict=True))
    is_away = is_inner[index]
    tips = ends_of(line, known.points[[0, -1]])
    return Offsets(
        median=larger(inner, 50),
        p95=larger(inner, P95),
        ends=larger(outer, P95),
        from_ends=float(np.hypot(*(tips - known.points[[0, -1]]).T).max() / w),
        is_one_line=isinstance(line, LineString) and bool(line.is_simple),
        is_inside=bool(case.area.covers(line))
        or (not is_exact and line.difference(case.area).length <= OUTSIDE * w),
        place=place_of_largest(
            points, np.where(is_away, off / np.maximum(width[index], 1e-9 * w), -1.0)
        ),
        end_place=place_of_largest(points, np.where(is_away, -1.0, off)),
    )


def place_of_largest(points: Floats, figures: Floats) -> tuple[float, float]:
    """Return the point that has the largest figure."""
    x, y = points[np.argmax(figures)]
    return float(x), float(y)


def distances_to(points: Floats, line: BaseGeometry) -> Floats:
    """Distance of each point to a line of any number of parts."""
    chains = vertices(np.array([line], dtype=object))
    return distances(points, np.zeros(len(points), dtype=np.intp), chains, np.ones((1, 2)))


def larger(ways: list[Floats], percent: float) -> float:
    """Percentile of both ways, the larger."""
    return max((float(np.percentile(way, percent)) for way in ways if way.size), default=np.nan)
