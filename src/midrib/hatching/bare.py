"""Bare stretches: where an edge of a slope has no stroke near it although there is room."""

from typing import NamedTuple

import numpy as np
import shapely
from shapely import Point

from midrib.hatching.chains import chain_of
from midrib.hatching.rule import Rule
from midrib.strip import Strip
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
    strip: Strip, rule: Rule, on_top: Floats, on_toe: Floats, least: float
) -> list[Bare]:
    """Stretches of both edges that are far from every whole stroke.

    Parameters
    ----------
    strip : Strip
    rule : Rule
    on_top, on_toe : (n, 2) ends of whole strokes
    least : length of the shortest whole stroke: where the slope is not as wide, it has no room

    Returns
    -------
    list of Bare
        Those longer than a gap at the next stroke. O(m log n) for m places on the edges.
    """
    if not len(on_top):
        return []
    width = np.hypot(*(on_toe - on_top).T)
    tree = shapely.STRtree(shapely.linestrings(np.stack([on_top, on_toe], axis=1)))
    found = []
    for name, edge, other in (
        ("top", strip.main, strip.auxiliary),
        ("toe", strip.auxiliary, strip.main),
    ):
        step = max(float(np.median(rule.gaps(width))) / STEPS_PER_GAP, edge.length / MOST_STEPS)
        at = np.arange(step / 2.0, edge.length, step)
        places = shapely.points(chain_of(edge).at(at))
        (_, nearest), away = tree.query_nearest(places, return_distance=True, all_matches=False)
        gap = rule.gaps(width[nearest])
        is_bare = away > FAR * gap
        is_bare[is_bare] = shapely.distance(places[is_bare], other) >= least
        for first, last in runs(is_bare):
            length = (last - first + 1) * step
            if length > gap[first : last + 1].min():
                found.append(Bare(places[(first + last) // 2], length, name))
    return found


def runs(flags: Bools) -> list[tuple[int, int]]:
    """First and last row of each run of true flags."""
    turn = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(np.int8)))
    return [(int(first), int(stop) - 1) for first, stop in turn.reshape(-1, 2)]
