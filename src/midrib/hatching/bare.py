"""Bare stretches: where an edge of a slope has no stroke near it although there is room."""

from typing import NamedTuple

import numpy as np
import shapely
from shapely import LineString, Point

from midrib.hatching.chains import Chain
from midrib.hatching.rule import Rule
from midrib.types import Bools, Floats

__all__ = ["Bare", "bare_stretches"]

FAR = 2.5  # gaps from the next stroke: more than at any corner, and than at ends
STEPS_PER_GAP = 2.0
MOST_STEPS = 100_000


class Bare(NamedTuple):
    """A stretch of an edge without strokes."""

    where: Point  # its middle
    length: float
    edge: str


def bare_stretches(
    edges: tuple[Chain, Chain],
    rule: Rule,
    on_top: Floats,
    on_toe: Floats,
    feet: Floats,
    least: float,
) -> list[Bare]:
    """Stretches of both edges that are far from every whole stroke.

    Parameters
    ----------
    edges : top and toe
    rule : Rule
    on_top, on_toe : (n, 2) ends of whole strokes
    feet : (n, 2) their stations on top and toe
    least : length of the shortest whole stroke: where the slope is not as wide, it has no room

    Returns
    -------
    list of Bare
        Those longer than a gap at the next stroke. O(n log n), and O(m log n) for m places where
        the next foot along the edge is far: another stroke may be near there all the same.
    """
    if not len(on_top):
        return []
    gap = rule.gaps(np.hypot(*(on_toe - on_top).T))
    step = float(np.median(gap)) / STEPS_PER_GAP
    lines = shapely.linestrings(np.stack([on_top, on_toe], axis=1))
    found = []
    for name, edge, other, at in zip(("top", "toe"), edges, edges[::-1], feet.T, strict=True):
        for low, high in far_from_feet(edge, at, gap):
            count = int(np.ceil((high - low) / max(step, edge.length / MOST_STEPS)))
            places = low + (high - low) * (np.arange(count) + 0.5) / count
            points = shapely.points(edge.at(places))
            tree = shapely.STRtree(lines)
            (_, nearest), away = tree.query_nearest(points, return_distance=True, all_matches=False)
            is_bare = away > FAR * gap[nearest]
            is_bare &= shapely.distance(points, LineString(other.points)) >= least
            for first, last in runs(is_bare):
                length = (last - first + 1) * (high - low) / count
                if length > gap[nearest[first : last + 1]].min():
                    found.append(Bare(points[(first + last) // 2], length, name))
    return found


def far_from_feet(edge: Chain, at: Floats, gap: Floats) -> list[tuple[float, float]]:
    """Stretches of an edge between feet, and at its ends, that are far from both along it."""
    order = np.argsort(at)
    at, reach = at[order], FAR * gap[order]
    low, high = np.append(0.0, at + reach), np.append(at - reach, edge.length)
    if edge.is_closed:
        low, high = (at + reach), np.append(at[1:], at[0] + edge.length) - np.roll(reach, -1)
    return [(a, b) for a, b in zip(low.tolist(), high.tolist(), strict=True) if a < b]


def runs(flags: Bools) -> list[tuple[int, int]]:
    """First and last row of each run of true flags."""
    turn = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(np.int8)))
    return [(int(first), int(stop) - 1) for first, stop in turn.reshape(-1, 2)]
