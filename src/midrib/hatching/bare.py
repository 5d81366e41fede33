"""Bare stretches: where an edge of a slope has no stroke near it although there is room.

At a place on an edge the local width is the distance to the other edge. The gap there is what the
rule asks for, or asks for at another place that is within its own gap: near the end of an edge,
where the other one is near because it begins there, the slope is as wide as beside it.
"""

from typing import NamedTuple

import numpy as np
import shapely
from shapely import LineString, Point

from midrib.hatching.chains import Chain
from midrib.hatching.rule import Rule
from midrib.types import Bools, Floats

__all__ = ["Bare", "bare_stretches"]

FAR = 1.75  # gaps along the edge from the next stroke: more than at any corner, and than at ends
AT_END = 0.75  # gaps from the end of an edge to the first stroke: beyond that it is looked at
STEPS_PER_GAP = 4.0
MOST_STEPS = 100_000
SIDE = 0.58  # cotangent of 60 degrees: at such an end of an edge and wider the other is a side


class Bare(NamedTuple):
    """A stretch of an edge without strokes."""

    where: Point  # its middle
    length: float
    edge: str


def bare_stretches(
    edges: tuple[Chain, Chain], rule: Rule, feet: Floats, gap: Floats, least: float, side: float
) -> list[Bare]:
    """Stretches of both edges that are far from every whole stroke.

    Parameters
    ----------
    edges : top and toe
    rule : Rule
    feet : (n, 2) stations of strokes on top and toe
    gap : (n,) that the rule asks for at each
    least : length of the shortest whole stroke: where the slope is not as wide, it has no room
    side : how long a side of the slope may be

    Returns
    -------
    list of Bare
        O(n log n) where no stretch may be bare, and O(m k) for m places on those that may be and an
        edge of k vertices. Where the nearest point of the other edge is next to its end, one of
        both is a side of the slope, or runs on past the other: no stroke belongs there. Shorter
        stretches than the rule's own gap are none.
    """
    if not len(feet):
        return []
    step = max(rule.least_gap, float(np.median(gap)) / STEPS_PER_GAP) / STEPS_PER_GAP
    found = []
    for name, edge, other, at in zip(("top", "toe"), edges, edges[::-1], feet.T, strict=True):
        facing = LineString(other.points)
        for low, high in doubtful(edge, at, gap):
            count = int((high - low) / max(step, edge.length / MOST_STEPS))
            places = np.linspace(low, high, count + 2)
            away = np.minimum(
                np.where(low in at or edge.is_closed, places - low, np.inf),
                np.where(high in at or edge.is_closed, high - places, np.inf),
            )
            if not (away > FAR * rule.least_gap).any():
                continue
            points, apart = shapely.points(edge.at(places)), places[1] - places[0]
            width = shapely.distance(points, facing)
            asked = widened(rule.gaps(width), apart)
            is_bare = (away > FAR * asked) & (width >= least)
            if not edge.is_closed and is_bare.any():
                on = shapely.line_locate_point(facing, points)
                is_side = np.minimum(on, facing.length - on) <= SIDE * width
                is_bare &= ~is_side | (np.minimum(places, edge.length - places) > side)
            for first, last in runs(is_bare):
                length = (last - first + 1) * apart
                if length >= asked[first : last + 1].min():
                    found.append(Bare(points[(first + last) // 2], length, name))
    return found


def doubtful(edge: Chain, at: Floats, gap: Floats) -> list[tuple[float, float]]:
    """Stretches of an edge between neighbouring feet, and to its ends, that may be bare."""
    order = np.argsort(at)
    at, gap = at[order], gap[order]
    low, high = np.append(0.0, at), np.append(at, edge.length)
    most = np.concatenate([AT_END * gap[:1], FAR * (gap[1:] + gap[:-1]) / 2.0, AT_END * gap[-1:]])
    if edge.is_closed:
        low, high = at, np.append(at[1:], at[0] + edge.length)
        most = FAR * (gap + np.roll(gap, -1)) / 2.0
    is_long = high - low > most
    return list(zip(low[is_long].tolist(), high[is_long].tolist(), strict=True))


def widened(gap: Floats, step: float) -> Floats:
    """Gap at each place, or the widest of those at places that are within their own gap of it."""
    found = gap.copy()
    for k in range(1, int(min(gap.max() / step, gap.size - 1)) + 1):
        reaches = np.where(gap >= k * step, gap, 0.0)
        np.maximum(found[k:], reaches[:-k], out=found[k:])
        np.maximum(found[:-k], reaches[k:], out=found[:-k])
    return found


def runs(flags: Bools) -> list[tuple[int, int]]:
    """First and last row of each run of true flags."""
    turn = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(np.int8)))
    return [(int(first), int(stop) - 1) for first, stop in turn.reshape(-1, 2)]
