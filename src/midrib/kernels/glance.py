r"""A glance along one side of the main curve: what is nearest at all, and whether P sees it.

What is nearest regardless of sights takes a search of a few boxes; what is nearest of all that is
seen takes a walk through every window. Mostly both are the same, and two sights prove it:

    Q0 ---.              an auxiliary curve
     .     \\___ Q1      Q moves along it without a jump while P walks from P0 to P1
     .   .   .
    P0 ---- P1           the main curve; Q is on its left

The loop P0 P1 Q1 Q0 consists of boundary and of two sights. If these are free, it lies in the area;
so does, in an area without holes, all that it winds around. That is where the sights between are:
each point of a sight moves to the left or rests as P does, between P and a Q that either rests or
is P's foot; so the sights sweep the plane in one sense of rotation, and the loop winds once or
more around each point that they come through. (Where P walks towards Q, sights are parts of the
sight from the other end.) Thus Q is seen, and since nothing at all is nearer, no more is to prove.

Where Q jumps, one loop ends and one begins. Where a sight is not free, or it is in doubt, where
limits cut what is near, the answer is left to ``look_along``: it is the same, but takes longer.
"""

import numpy as np

from midrib.kernels.boxtree import LEAF, squared_distance_to_box
from midrib.kernels.chain import Goal, slack_of
from midrib.kernels.envelope import (
    Walk,
    farthest_between,
    has_room,
    is_idle,
    lower_by,
    place_at,
    squared_distance,
)
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.outlook import Outlook, offer_side
from midrib.kernels.predicates import orient
from midrib.kernels.triangulation import next_side
from midrib.kernels.visibility import sees, squared_distance_to_side
from midrib.kernels.windows import spot_at
from midrib.types import Floats, Ints

__all__ = ["UNSURE", "glance_along", "is_without_holes"]

UNSURE = -2
A_BIT_FARTHER = 1.0 + 2.0**-20  # of a squared distance: more than what rounding does to it


@njit(borrows=True)
def is_without_holes(mesh: Mesh) -> bool:
    """Whether an area has no hole, not even one that touches: by Euler's formula.

    All vertices are on the boundary, so there are 3 f / 2 + b / 2 sides for f triangles.
    """
    vertices, boundary = 0, 0
    for v in range(mesh.door.size):
        if mesh.door[v] >= 0:
            vertices += 1
    for e in range(mesh.twin.size):
        if mesh.twin[e] < 0:
            boundary += 1
    return 2 * vertices - mesh.tri.size // 3 - boundary == 2


@njit(borrows=True)
def glance_along(
    mesh: Mesh,
    goal: Goal,
    walk: Walk,
    side: int,
    start: float,
    stop: float,
    limit: Floats,
    hint: int,
    seen: Floats,
    outlook: Outlook,
    stack: Ints,
) -> int:
    """As ``look_along``, in an area without holes; ``UNSURE`` where that has to look.

    ``hint`` is a segment of the curve near the answer. ``seen`` holds Q of a sight from the start
    that is known to be free, if any, else NaN; then that from the stop. O(log n) near the hint.
    """
    count = lowest_along(goal, mesh, walk, start, stop, limit, hint, outlook, stack)
    if count > 0 and not is_seen(mesh, goal, walk, side, seen, outlook, count):
        count = UNSURE
    if count <= 0:
        seen[0] = seen[1] = np.nan
    return count


@njit(borrows=True)
def lowest_along(
    goal: Goal,
    mesh: Mesh,
    walk: Walk,
    start: float,
    stop: float,
    limit: Floats,
    hint: int,
    outlook: Outlook,
    stack: Ints,
) -> int:
    """Write the envelope of the whole curve, seen or not; the number of pieces."""
    row, at, work, base = outlook.motions
    share, x, y, boxes, arc = outlook.share, goal.x, goal.y, goal.boxes, goal.chain.arc
    low, high = max(limit[0], limit[1]), min(limit[2], limit[3])
    middle, half = (start + stop) / 2.0, (stop - start) / 2.0
    px, py = walk.ax + middle * (walk.bx - walk.ax), walk.ay + middle * (walk.by - walk.ay)
    reach = half * length(walk.bx - walk.ax, walk.by - walk.ay)
    leaves, first = boxes.shape[0] // 2, 2 * base
    # Up the tree of boxes from the hint, and down where something can be nearer: P is at most
    # ``reach`` from the middle, so that much nearer than seen from there.
    count, bound, depth, top = 0, np.inf, 1, leaves + hint // LEAF
    stack[0] = top
    while depth > 0 or top > 1:
        if depth == 0:
            stack[0], depth = top ^ 1, 1
            top //= 2
        depth -= 1
        node = stack[depth]
        if squared_distance_to_box(px, py, boxes, node) > bound:
            continue
        if node < leaves:
            left = squared_distance_to_box(px, py, boxes, 2 * node)
            right = squared_distance_to_box(px, py, boxes, 2 * node + 1)
            nearer = 2 * node if left <= right else 2 * node + 1
            stack[depth], stack[depth + 1] = 4 * node + 1 - nearer, nearer
            depth += 2
            continue
        begin = (node - leaves) * LEAF
        for j in range(begin, min(begin + LEAF, x.size - 1)):
            ux, uy, vx, vy = x[j], y[j], x[j + 1], y[j + 1]
            if squared_distance_to_side(px, py, ux, uy, vx, vy, 1.0, 1.0) > bound:
                continue
            e = goal.chain.side[j]
            if e < 0 or arc[j] < low or arc[j + 1] > high:
                return UNSURE
            u, v = mesh.tri[e], mesh.tri[next_side(e)]
            if u != goal.chain.vertex[j]:
                ux, uy, vx, vy = vx, vy, ux, uy
            row[first, 6], row[first, 7], row[first, 8], row[first, 9] = ux, uy, vx - ux, vy - uy
            offers = offer_side(
                mesh.x, mesh.y, walk, e, u, v, u, v, start, stop, False,
                row, at, work, share, first,
            )  # fmt: skip
            for i in range(first, first + offers):
                if is_idle(walk, row, work, count, i):
                    continue
                if not has_room(base, count):
                    return -1
                count = lower_by(walk, row, at, work, base, count, i)
            bound = np.sqrt(farthest_between(row, count, start, stop)) + reach
            bound *= bound * A_BIT_FARTHER
    return count


@njit(borrows=True)
def is_seen(
    mesh: Mesh,
    goal: Goal,
    walk: Walk,
    side: int,
    seen: Floats,
    outlook: Outlook,
    count: int,
) -> bool:
    """Whether P sees Q all along an envelope: the sights from its ends and where Q jumps are free.

    ``seen`` as ``glance_along`` has it.
    """
    row, at = outlook.motions.row, outlook.motions.at
    qx, qy = seen[0], seen[1]
    a, b = mesh.tri[side], mesh.tri[next_side(side)]
    for k in range(count):
        for end in range(2):
            # 1. Q stays on the side's left, where the area is.
            t, e = row[k, end], at[k, 0]
            from_x, from_y = qx, qy
            qx, qy = point_on(mesh, e, place_at(row, k, t))
            if orient(mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b], qx, qy) < 0.0:
                return False
            # 2. Where it does not go on from where it was, both sights have to be free.
            if end == 0:
                off = length((qx - from_x) * goal.scale_x, (qy - from_y) * goal.scale_y)
                if off <= slack_of(goal.tie, np.sqrt(squared_distance(walk, row, k, t))):
                    continue
                if k > 0 and not is_free(mesh, walk, side, t, at[k - 1, 0], from_x, from_y):
                    return False
            elif k < count - 1:
                continue
            if not is_free(mesh, walk, side, t, e, qx, qy):
                return False
    seen[0], seen[1] = qx, qy
    return True


@njit(borrows=True)
def point_on(mesh: Mesh, e: int, share: float) -> tuple[float, float]:
    """Return the point at a share of a side."""
    u, v = mesh.tri[e], mesh.tri[next_side(e)]
    if share == 1.0:
        return mesh.x[v], mesh.y[v]
    return mesh.x[u] + share * (mesh.x[v] - mesh.x[u]), mesh.y[u] + share * (mesh.y[v] - mesh.y[u])


@njit(borrows=True)
def is_free(
    mesh: Mesh, walk: Walk, side: int, t: float, e: int, qx: float, qy: float
) -> bool:
    """Whether the sight from P to Q on side e is free."""
    a, b = walk.a, walk.b
    if t == 0.0:
        px, py, vertex = mesh.x[a], mesh.y[a], a
    elif t == 1.0:
        px, py, vertex = mesh.x[b], mesh.y[b], b
    else:
        px, py = mesh.x[a] + t * (mesh.x[b] - mesh.x[a]), mesh.y[a] + t * (mesh.y[b] - mesh.y[a])
        vertex = -1
    return sees(mesh, spot_at(mesh, px, py, side, vertex), e, qx, qy)
