r"""The mean of two sides whose kinks are paired: Rhino's mean curve.

main        ---------o                 Kinks of both sides are paired in their order, as many
\                as go together: near each other, turning the same way.
mean        =======o   \              From one pair to the next, points at the same share of
\   \             the way are averaged, so that the mean has a kink
auxiliary   -----o   \   \            between each two, mitred like a frame.
\
"""

import numpy as np
import shapely

from midrib.curves.joining import EndRule, Path, end_points, heights_of
from midrib.curves.radii import Radii
from midrib.errors import InvalidAreaError
from midrib.kernels.chain import Chain
from midrib.kernels.joining import join_beads
from midrib.kernels.paths import Beads
from midrib.layout import Layout
from midrib.types import Floats, Ints

__all__ = ["kink_mean", "kink_pairs"]

SHARP = np.radians(30.0)  # turns from which on a vertex is a kink
NEAR = 3.0  # mean widths between the kinks of a pair; those of two walls at 40 degrees are as far
SAME = 2.0**-40  # of a side's length: places that are not told apart


def kink_mean(layout: Layout, rule: EndRule, radii: Radii) -> Path:
    """Mean of the two sides of a strip from pair to pair of kinks, joined inside without loops.

    Parameters
    ----------
    layout : Layout
    rule : where it starts and ends, as in ``minimal_radii``
    radii : of the strip, which are no part of it

    Returns
    -------
    Path
        With a vertex for each one of either side. O(n log n) for sides of n vertices.
    """
    main, auxiliary, ends = layout.main, layout.auxiliary, end_points(layout, rule)
    at, beside = kink_pairs(layout)
    arc = np.union1d(main.arc, np.interp(auxiliary.arc, beside, at))
    arc = arc[np.append(True, np.diff(arc) > SAME * main.length)]
    points, height = halves(layout, main, arc)
    other, other_height = halves(layout, auxiliary, np.interp(arc, at, beside))
    points, height = points + other, height + other_height
    segment = np.clip(np.searchsorted(main.arc, arc, side="right") - 1, 0, main.side.size - 1)
    vertex = np.where(main.arc[segment] == arc, main.vertex[segment], -1)
    vertex[-1] = main.vertex[-1]
    origin = 2.0 * halves(layout, main, arc)[0]
    side = main.side[segment]
    if len(ends.point):
        rows = [0, -1]
        points[rows], origin[rows], height[rows] = ends.point, ends.origin, ends.height
        side[rows], vertex[rows] = ends.at[:, 0], ends.at[:, 1]
    joined, source, loops, _ = join_beads(
        layout.mesh, Beads(points, origin, side, vertex), *layout.scale
    )
    if len(joined) < 2:
        msg = "the mean of the two sides is one point; a line needs two"
        raise InvalidAreaError(msg)
    middles = (radii.points[:, :2] + radii.points[:, 2:4]) / 2.0
    z = heights_of(layout, joined, source, height)
    return Path(joined, z, np.full(len(joined), -1), middles, loops)


def kink_pairs(layout: Layout) -> tuple[Floats, Floats]:
    """Arc lengths along both sides of the kinks that are paired, with the starts and the ends.

    Of all ways to pair kinks in order, that with the largest sum of turns, each counting by how
    near its kinks are.
    """
    main, auxiliary = layout.main, layout.auxiliary
    places, turns = kinks_of(layout, main)
    other_places, other_turns = kinks_of(layout, auxiliary)
    within = NEAR * layout.mean_width
    points = chain_points(layout, main)[places] * layout.scale
    other_points = chain_points(layout, auxiliary)[other_places] * layout.scale
    tree = shapely.STRtree(shapely.points(other_points))
    one, other = tree.query(shapely.points(points), predicate="dwithin", distance=within)
    off = np.hypot(*(points[one] - other_points[other]).T)
    turn, other_turn = turns[one], other_turns[other]
    worth = np.minimum(np.abs(turn), np.abs(other_turn)) * (1.0 - off / within)
    worth = np.where(turn * other_turn > 0.0, worth, 0.0)
    chosen = best_chain(one, other, worth)
    at = main.arc[places[one[chosen]]]
    beside = auxiliary.arc[other_places[other[chosen]]]
    ends = np.array([0.0, main.length]), np.array([0.0, auxiliary.length])
    return np.insert(ends[0], 1, at), np.insert(ends[1], 1, beside)


def kinks_of(layout: Layout, chain: Chain) -> tuple[Ints, Floats]:
    """Places of the kinks of a side, and how far each turns to the left."""
    step = np.diff(chain_points(layout, chain) * layout.scale, axis=0)
    cross = step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0]
    turn = np.arctan2(cross, (step[:-1] * step[1:]).sum(axis=1))
    kinks = np.flatnonzero(np.abs(turn) >= SHARP)
    return kinks + 1, turn[kinks]


def chain_points(layout: Layout, chain: Chain) -> Floats:
    """Vertices of a side."""
    return np.column_stack([layout.mesh.x[chain.vertex], layout.mesh.y[chain.vertex]])


def halves(layout: Layout, chain: Chain, arc: Floats) -> tuple[Floats, Floats]:
    """Half the coordinates of points of a side, and half their Z, NaN without."""
    points = chain_points(layout, chain)
    z = np.full(len(points), np.nan) if layout.height is None else layout.height[chain.vertex]
    columns = [np.interp(arc, chain.arc, column) / 2.0 for column in (*points.T, z)]
    return np.column_stack(columns[:2]), columns[2]


def best_chain(one: Ints, other: Ints, worth: Floats) -> Ints:
    """Rows of the pairs with the largest total worth that both rise strictly.

    A tree of maxima over the second (Fenwick 1994) makes it O(k log k) for k pairs.
    """
    best = np.zeros(int(other.max(initial=0)) + 2)  # of chains that end in a range of seconds
    end = np.full(best.size, -1)
    before = np.full(one.size, -1)
    for row in np.lexsort([-other, one]):  # of one first, the later seconds come before
        if worth[row] <= 0.0:
            continue
        total, i = 0.0, int(other[row])
        while i > 0:
            if best[i] > total:
                total, before[row] = best[i], end[i]
            i -= i & -i
        total += worth[row]
        i = int(other[row]) + 1
        while i < best.size:
            if total > best[i]:
                best[i], end[i] = total, row
            i += i & -i
    row = int(end[np.argmax(best)]) if best.any() else -1
    chain = []
    while row >= 0:
        chain.append(row)
        row = int(before[row])
    return np.array(chain[::-1], dtype=np.intp)
