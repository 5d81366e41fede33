"""Where edges of a hatched slope are bare: told from drawn strokes by plain distances.

It shares nothing with the engine: no middle line, no stations, no gaps of strokes. At places along
an edge the local width is the distance to the other edge, and the gap is what the rule asks for
there. The way along the edge to the nearest stroke's end, in such gaps, tells how bare it is. Where
the nearest point of the other edge is next to its end, one of both is a side of the slope, if it is
short: no stroke belongs there. Near the end of an edge the gap is that of a place within its own.
Runs shorter than their own gap are none.

edge   --x-----x----o    o    o----x-----     x  ends of strokes
                    |<- bare ->|              o  places farther than ``FAR`` gaps from all of them
"""

from typing import NamedTuple

import numpy as np
import shapely
import shapely.ops
from numpy.typing import NDArray
from shapely import LineString, Point

from midrib.hatching import Hatching

__all__ = ["FAR", "BareRun", "bare_runs", "unexplained"]

Floats = NDArray[np.float64]
FAR = 1.75  # gaps along an edge from a place to the next stroke: twice what bounds on gaps allow
STEPS = 4.0  # places for each least gap
MOST_PLACES = 20_000
LEAST_WIDTH = 0.5  # least gaps: where slopes are narrower there is hardly room for a stroke
SIDE = 0.58  # of the width: if the nearest place of the other edge is as near to its end
LONGEST_SIDE = 2.0  # mean widths
NEAR = 1.0  # local gaps between a bare run and a problem that explains it


class BareRun(NamedTuple):
    """A run of places on an edge that are far from every stroke."""

    edge: str
    line: LineString
    worst: float  # gaps from the nearest stroke
    gap: float  # that the rule asks for at the worst place

    @property
    def where(self) -> Point:
        """Middle of the run."""
        return self.line.interpolate(0.5, normalized=True)


def bare_runs(hatching: Hatching) -> list[BareRun]:
    """Bare runs of both edges; places where there is no room for the shortest stroke are none."""
    strip, rule = hatching.strip, hatching.rule
    found = []
    for name, edge, other, ends in (
        ("top", strip.main, strip.auxiliary, hatching.on_top),
        ("toe", strip.auxiliary, strip.main, hatching.on_toe),
    ):
        count = int(min(edge.length / (rule.least_gap / STEPS), MOST_PLACES)) + 2
        at = np.linspace(0.0, edge.length, count)
        places = shapely.line_interpolate_point(edge, at)
        width = shapely.distance(places, other)
        gap = widened(rule.gaps(width), at)
        feet = np.sort(shapely.line_locate_point(edge, shapely.points(ends)))
        away = ways_to(feet, at, edge.length, strip.is_closed)
        is_bare = (away > FAR * gap) & (width >= LEAST_WIDTH * rule.least_gap)
        if not strip.is_closed:
            on = shapely.line_locate_point(other, places)
            is_side = np.minimum(on, other.length - on) <= SIDE * width
            longest = 2.0 * LONGEST_SIDE * strip.area.area / (edge.length + other.length)
            is_bare &= ~is_side | (np.minimum(at, edge.length - at) > longest)
        turn = np.flatnonzero(np.diff(np.concatenate([[0], is_bare, [0]])))
        for low, high in turn.reshape(-1, 2).tolist():
            if (high - low) * (at[1] - at[0]) < gap[low:high].min():
                continue
            worst = low + int(np.argmax((away / gap)[low:high]))
            stop = max(at[high - 1], at[low] + edge.length / (10.0 * count))
            line = shapely.ops.substring(edge, at[low], stop)
            found.append(BareRun(name, line, float(away[worst] / gap[worst]), float(gap[worst])))
    return found


def ways_to(feet: Floats, at: Floats, length: float, is_closed: bool) -> Floats:
    """Distances along an edge to the nearest foot."""
    if not feet.size:
        return np.full(at.size, np.inf)
    if is_closed:
        feet = np.concatenate([feet - length, feet, feet + length])
    after = np.clip(np.searchsorted(feet, at), 1, max(feet.size - 1, 1))
    before = after - 1
    away: Floats = np.minimum(abs(at - feet[before]), abs(at - feet[min(1, feet.size - 1) * after]))
    return away


def widened(gap: Floats, at: Floats) -> Floats:
    """Gap at each place, or the widest of those at places that are within their own gap of it."""
    found, step = gap.copy(), at[1] - at[0]
    for k in range(1, int(gap.max() / step) + 1):
        reaches = np.where(gap >= k * step, gap, 0.0)
        np.maximum(found[k:], reaches[:-k], out=found[k:])
        np.maximum(found[:-k], reaches[k:], out=found[:-k])
    return found


def unexplained(hatching: Hatching) -> list[BareRun]:
    """Bare runs that have no problem within a gap."""
    places = shapely.MultiPoint([problem.where for problem in hatching.problems])
    return [
        run for run in bare_runs(hatching) if not shapely.dwithin(run.line, places, NEAR * run.gap)
    ]
