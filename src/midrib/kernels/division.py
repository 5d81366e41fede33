"""A shell divided at two ends: the vertices, sides and arc lengths of the two curves.

 start.place             stop.other         An end is a pair of places in the shell's order:
     o-----------<-----------o              before and after its cap, or the same place twice.
cap  |                       |  cap         The shell turns left, so the lower curve here runs
     o----------->-----------o              with it; the upper one is turned to run beside it.
 start.other             stop.place
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.chain import Chain
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh, pull_inside, split_side
from midrib.kernels.tables import longer, longer_ints
from midrib.kernels.triangulation import next_side
from midrib.types import Floats, Ints

__all__ = ["AGAINST", "LONGER", "WITH", "Divided", "divide_shell"]

LONGER, WITH, AGAINST = 0, 1, 2
HALF = 0.5


class Divided(NamedTuple):
    """A shell divided at two ends."""

    is_divided: bool  # False if the ends are one point
    mesh: Mesh  # with the ends inside segments as vertices, as height
    height: Floats
    middle: Floats  # (2, 3) x, y and Z of the middles of the ends
    middle_at: Ints  # (2, 2) the boundary side each is on, and the mesh vertex it is or -1
    main: Chain
    auxiliary: Chain
    mean_width: float  # area between the curves over their mean length


@njit()
def place_point(
    mesh: Mesh, order: Ints, side: Ints, height: Floats, k: int, share: float
) -> tuple[Mesh, Ints, Ints, Floats, int]:
    """Make the point ``share`` of the way along shell segment k a vertex.

    Return mesh, order, sides and heights with it and its place in the order; a point that cannot
    be told from an end of the segment is that end.
    """
    n = order.size
    a, b = order[k], order[(k + 1) % n]
    x = mesh.x[a] + share * (mesh.x[b] - mesh.x[a])
    y = mesh.y[a] + share * (mesh.y[b] - mesh.y[a])
    split, new = split_side(mesh, side[k], x, y)
    if new < 0:
        return mesh, order, side, height, k if share <= HALF else (k + 1) % n
    # The triangle's next side has moved to the new triangle, where it follows the new side.
    moved = next_side(side[k])
    sides = longer_ints(side, k + 1, (new,))
    for i in range(sides.size):
        if sides[i] == moved:
            sides[i] = new + 1
    if height.size > 0:
        height = longer(height, height[a] + share * (height[b] - height[a]))
    return split, longer_ints(order, k + 1, (split.x.size - 1,)), sides, height, k + 1


@njit(borrows=True)
def middle_of_cap(
    mesh: Mesh, order: Ints, place: int, other: int, scale_x: float, scale_y: float
) -> tuple[int, float]:
    """Segment and share of the point halfway along the shell from ``place`` on to ``other``."""
    n = order.size
    total = 0.0
    for round_ in range(2):
        half, so_far = total / 2.0, 0.0
        k = place
        while k != other:
            a, b = order[k], order[(k + 1) % n]
            step = length((mesh.x[b] - mesh.x[a]) * scale_x, (mesh.y[b] - mesh.y[a]) * scale_y)
            if round_ == 1 and so_far + step >= half:
                share = (half - so_far) / step
                return (k, share) if share < 1.0 else ((k + 1) % n, 0.0)
            so_far += step
            k = (k + 1) % n
        total = so_far
    return place, 0.0


@njit()
def chain(
    mesh: Mesh,
    order: Ints,
    side: Ints,
    start: int,
    stop: int,
    is_backward: bool,
    scale_x: float,
    scale_y: float,
) -> Chain:
    """Return the shell from ``start`` on to ``stop``, or back."""
    n = order.size
    m = (stop - start) % n
    vertex, sides, arc = np.empty(m + 1, np.intp), np.empty(m, np.intp), np.zeros(m + 1)
    place = start % n
    for i in range(m + 1):
        to = m - i if is_backward else i
        vertex[to] = order[place]
        if i < m:
            sides[to - 1 if is_backward else to] = side[place]
        place = place + 1 if place + 1 < n else 0
    for i in range(m):
        a, b = vertex[i], vertex[i + 1]
        dx, dy = (mesh.x[b] - mesh.x[a]) * scale_x, (mesh.y[b] - mesh.y[a]) * scale_y
        arc[i + 1] = arc[i] + length(dx, dy)
    return Chain(vertex, sides, arc)


@njit(borrows=True)
def doubled_area(mesh: Mesh, main: Ints, auxiliary: Ints, scale_x: float, scale_y: float) -> float:
    """Twice the area between two chains that run alongside."""
    total = 0.0
    x0, y0 = mesh.x[main[0]], mesh.y[main[0]]
    m, n = main.size, main.size + auxiliary.size
    for i in range(n):
        j = (i + 1) % n
        a = main[i] if i < m else auxiliary[n - 1 - i]
        b = main[j] if j < m else auxiliary[n - 1 - j]
        total += (mesh.x[a] - x0) * (mesh.y[b] - y0) - (mesh.x[b] - x0) * (mesh.y[a] - y0)
    return abs(total) * scale_x * scale_y


@njit(entry=True)
def divide_shell(
    mesh: Mesh,
    order: Ints,
    side: Ints,
    height: Floats,
    places: Ints,
    shares: Floats,
    rule: int,
    scale_x: float,
    scale_y: float,
) -> Divided:
    """Divide a shell at two ends.

    Parameters
    ----------
    mesh : the area
    order, side : (n,) shell vertices in order and the boundary side that leaves each
    height : Z of each mesh vertex, or empty
    places : (2, 2) the two ends as drawn above
    shares : (2,) how far along the segment that leaves its place an end lies that is no cap
    rule : which part is the main curve: the one that runs WITH the shell from start to stop, the
        one AGAINST it, or the LONGER
    scale_x, scale_y : lengths of one unit of x and of y
    """
    ends = places.copy()
    # The later place first, so that inserting one does not move the other.
    is_later = places[0, 0] > places[1, 0] or (
        places[0, 0] == places[1, 0] and shares[0] > shares[1]
    )
    shares = shares.copy()
    if places[0, 0] == places[1, 0] and min(shares) > 0.0 and shares[0] != shares[1]:
        # Of two ends inside one segment the earlier one's share is of what the later one leaves.
        earlier = 1 if is_later else 0
        shares[earlier] /= shares[1 - earlier]
    for i in (0, 1) if is_later else (1, 0):
        size = order.size
        if shares[i] > 0.0:
            mesh, order, side, height, place = place_point(
                mesh, order, side, height, ends[i, 0], shares[i]
            )
            if order.size > size:
                for j in range(2):
                    for k in range(2):
                        if ends[j, k] >= place:
                            ends[j, k] += 1
            ends[i, 0] = ends[i, 1] = place
    middle, middle_at = np.full((2, 3), np.nan), np.empty((2, 2), np.intp)
    for i in range(2):
        k, share = middle_of_cap(mesh, order, ends[i, 0], ends[i, 1], scale_x, scale_y)
        a, b = order[k], order[(k + 1) % order.size]
        middle_at[i, 0], middle_at[i, 1] = side[k], -1 if share > 0.0 else a
        x = mesh.x[a] + share * (mesh.x[b] - mesh.x[a])
        y = mesh.y[a] + share * (mesh.y[b] - mesh.y[a])
        middle[i, 0], middle[i, 1], _ = pull_inside(mesh, side[k] // 3, x, y)
        if height.size > 0:
            middle[i, 2] = height[a] + share * (height[b] - height[a])
    is_divided = ends[0, 1] != ends[1, 0] and ends[1, 1] != ends[0, 0]
    main = chain(mesh, order, side, ends[0, 1], ends[1, 0], False, scale_x, scale_y)
    auxiliary = chain(mesh, order, side, ends[1, 1], ends[0, 0], True, scale_x, scale_y)
    if rule == AGAINST or (rule == LONGER and auxiliary.arc[-1] > main.arc[-1]):
        main, auxiliary = auxiliary, main
    doubled = doubled_area(mesh, main.vertex, auxiliary.vertex, scale_x, scale_y)
    width = doubled / (main.arc[-1] + auxiliary.arc[-1])
    return Divided(is_divided, mesh, height, middle, middle_at, main, auxiliary, width)
