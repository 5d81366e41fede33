r"""A glance along one side of the main curve: what is nearest at all, and whether P sees it.

What is nearest regardless of sights takes a search of a few boxes; what is nearest of all that is
seen takes a walk through every window. Mostly both are the same, and two sights prove it:

    Q0 ---.              an auxiliary curve
     .     \\___ Q1      Q moves along it without a jump while P walks from P0 to P1
     .   .   .
    P0 ---- P1           the main curve; Q is on its left

The loop P0 P1 Q1 Q0 consists of boundary and of two sights. If these are free, it lies in the area;
so does all that it winds around, unless that holds a hole. That is where the sights between are:
P walks with Q on its left, and Q rests or is P's foot, so each point of the sight crosses it to
the same side, or rests. The sights sweep the plane without turning back, and the loop winds once
or more around each point that they come through. Thus Q is seen; and nothing at all is nearer.

Where Q jumps from one segment to the next, around a corner, it might as well walk there while P
waits: in the same sense as before. Where it jumps otherwise, one loop ends and one begins. A hole
that a loop winds around lies within its reach, with sides that are on neither curve: for the hole
of a curve itself is on the wrong side of P, or of Q.

Where a sight is not free or along P's own wall, where limits cut what is near or a hole may be in
between, the answer is left to ``look_along``: it is the same, but takes longer.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.boxtree import FOOT, LEAF, VERTEX, box_tree, squared_distance_to_box
from midrib.kernels.chain import Chain, Goal, slack_of
from midrib.kernels.clearance import nearest_of
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
from midrib.kernels.outlook import Outlook
from midrib.kernels.predicates import orient
from midrib.kernels.triangulation import next_side
from midrib.kernels.visibility import sees, squared_distance_to_side
from midrib.kernels.windows import spot_at
from midrib.types import Bools, Floats, Ints

__all__ = ["UNSURE", "Others", "glance_along", "is_without_holes", "others_of"]

UNSURE = -2
A_BIT_FARTHER = 1.0 + 2.0**-20  # of a squared distance: more than what rounding does to it


class Others(NamedTuple):
    """Boundary sides that are on neither curve, with links between them; see ``clearance``."""

    x: Floats  # in lengths, as y and boxes
    y: Floats
    goes_on: Bools  # whether a segment is a side, not a link
    boxes: Floats


@njit()
def others_of(mesh: Mesh, main: Chain, goal: Goal) -> Others:
    """Prepare to look for holes; none where there are none. O(n)."""
    is_main = np.zeros(mesh.tri.size, np.bool_)
    for e in main.side:
        is_main[e] = True
    x, y, count = np.empty(mesh.tri.size + 2), np.empty(mesh.tri.size + 2), 0
    if not is_without_holes(mesh):
        for v in range(mesh.x.size):
            e = mesh.door[v]
            while e >= 0:
                if goal.segment[e] < 0 and not is_main[e]:
                    w = mesh.tri[next_side(e)]
                    x[count], y[count] = mesh.x[v] * goal.scale_x, mesh.y[v] * goal.scale_y
                    x[count + 1], y[count + 1] = mesh.x[w] * goal.scale_x, mesh.y[w] * goal.scale_y
                    count += 2
                e = mesh.other_door[e]
    x, y = x[:count], y[:count]
    if count == 0:
        return Others(x, y, np.zeros(0, np.bool_), np.empty((0, 4)))
    goes_on = np.zeros(count, np.bool_)
    for i in range(0, count, 2):
        goes_on[i] = True
    return Others(x, y, goes_on, box_tree(x, y))


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
    others: Others,
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
    """As ``look_along``; ``UNSURE`` where that has to look.

    ``hint`` is a segment of the curve near the answer. ``seen`` holds Q of a sight from the start
    that is known to be free, if any, else NaN; then that from the stop. O(log n) near the hint.
    """
    count = lowest_along(goal, mesh, walk, start, stop, limit, hint, outlook, stack)
    if count > 0 and not (
        is_apart(others, walk, start, stop, outlook, count, stack)
        and is_seen(mesh, goal, walk, side, seen, outlook, count)
    ):
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
    x, y, boxes, arc = goal.x, goal.y, goal.boxes, goal.chain.arc
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
            offers = offer_segment(goal, mesh, walk, j, start, stop, row, at, first)
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
def is_apart(
    others: Others,
    walk: Walk,
    start: float,
    stop: float,
    outlook: Outlook,
    count: int,
    stack: Ints,
) -> bool:
    """Whether no hole is within the reach of sights."""
    if others.x.size == 0:
        return True
    middle, half = (start + stop) / 2.0, (stop - start) / 2.0
    px, py = walk.ax + middle * (walk.bx - walk.ax), walk.ay + middle * (walk.by - walk.ay)
    reach = half * length(walk.bx - walk.ax, walk.by - walk.ay)
    reach += np.sqrt(farthest_between(outlook.motions.row, count, start, stop))
    x, y, goes_on, boxes = others
    _, _, squared = nearest_of(px, py, x, y, goes_on, boxes, 0, stack)
    return squared > reach * reach * A_BIT_FARTHER


@njit(borrows=True)
def feet_on(goal: Goal, walk: Walk, j: int) -> tuple[float, float]:
    """Shares of P's foot on the line of a segment of the curve, for P at 0 and at 1."""
    ux, uy = goal.x[j], goal.y[j]
    dx, dy = goal.x[j + 1] - ux, goal.y[j + 1] - uy
    squared = dx * dx + dy * dy
    if squared == 0.0:
        return 0.0, 0.0
    return (
        ((walk.ax - ux) * dx + (walk.ay - uy) * dy) / squared,
        ((walk.bx - ux) * dx + (walk.by - uy) * dy) / squared,
    )


@njit(borrows=True)
def below(at_a: float, at_b: float, least: float, most: float) -> tuple[float, float]:
    """Return the part of an interval in which a linear function is not positive."""
    at_least, at_most = at_a + least * (at_b - at_a), at_a + most * (at_b - at_a)
    if at_least <= 0.0 and at_most <= 0.0:
        return least, most
    if at_least > 0.0 and at_most > 0.0:
        return most, most
    root = min(max(at_a / (at_a - at_b), least), most)
    return (least, root) if at_least <= 0.0 else (root, most)


@njit(borrows=True)
def offer_segment(
    goal: Goal,
    mesh: Mesh,
    walk: Walk,
    j: int,
    start: float,
    stop: float,
    row: Floats,
    at: Ints,
    i: int,
) -> int:
    """Write where P's foot is on a segment, and where it rests in its start, from row i on.

    A vertex is the nearest only where the feet on both of its segments are beyond it. Of the last
    segment the end is offered too. Return the number of offers.
    """
    e = goal.chain.side[j]
    u, v = mesh.tri[e], mesh.tri[next_side(e)]
    is_forward = u == goal.chain.vertex[j]
    by_a, by_b = feet_on(goal, walk, j)
    offers, last = 0, goal.x.size - 2
    for k in range(3):
        if k == 0:
            low, high = below(-by_a, -by_b, start, stop)
            low, high = below(by_a - 1.0, by_b - 1.0, low, high)
        elif k == 1:
            low, high = below(by_a, by_b, start, stop)
            if j > 0 and low < high:
                before_a, before_b = feet_on(goal, walk, j - 1)
                low, high = below(1.0 - before_a, 1.0 - before_b, low, high)
        elif j == last:
            low, high = below(1.0 - by_a, 1.0 - by_b, start, stop)
        else:
            break
        if not low < high:
            continue
        new = i + offers
        row[new, 0], row[new, 1], row[new, 4], row[new, 5] = low, high, 1.0, 1.0
        at[new, 0], at[new, 3], at[new, 4] = e, u, v
        if k == 0:
            at[new, 1], at[new, 2] = FOOT, -1
            row[new, 2] = by_a if is_forward else 1.0 - by_a
            row[new, 3] = by_b if is_forward else 1.0 - by_b
        else:
            at[new, 1], at[new, 2] = VERTEX, u if (k == 1) == is_forward else v
            row[new, 2] = row[new, 3] = 0.0 if (k == 1) == is_forward else 1.0
        at_u, at_v = (j, j + 1) if is_forward else (j + 1, j)
        row[new, 6], row[new, 7] = goal.x[at_u], goal.y[at_u]
        row[new, 8], row[new, 9] = goal.x[at_v] - goal.x[at_u], goal.y[at_v] - goal.y[at_u]
        offers += 1
    return offers


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
            # 1. Q stays on the side's left, where the area is, and off its line.
            t, e = row[k, end], at[k, 0]
            from_x, from_y = qx, qy
            qx, qy = point_on(mesh, e, place_at(row, k, t))
            if orient(mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b], qx, qy) <= 0.0:
                return False
            # 2. Where it does not go on from where it was, both sights have to be free.
            if end == 0:
                off = length((qx - from_x) * goal.scale_x, (qy - from_y) * goal.scale_y)
                if off <= slack_of(goal.tie, np.sqrt(squared_distance(walk, row, k, t))):
                    continue
                if k > 0 and turns_on(mesh, goal, walk, side, outlook, k):
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
def turns_on(mesh: Mesh, goal: Goal, walk: Walk, side: int, outlook: Outlook, k: int) -> bool:
    """Whether Q jumps around the corner of two segments, and forwards, where piece k begins."""
    row, at = outlook.motions.row, outlook.motions.at
    e, f, t = at[k - 1, 0], at[k, 0], row[k, 0]
    i, j = goal.segment[e], goal.segment[f]
    if abs(i - j) != 1:
        return False
    v = goal.chain.vertex[max(i, j)]
    px, py, _ = point_of(mesh, walk, t)
    qx, qy = point_on(mesh, e, place_at(row, k - 1, t))
    to_x, to_y = point_on(mesh, f, place_at(row, k, t))
    first = orient(px, py, qx, qy, mesh.x[v], mesh.y[v])
    second = orient(px, py, mesh.x[v], mesh.y[v], to_x, to_y)
    # With Q on the left of the way ahead, what moves on turns to the right around P.
    if mesh.tri[side] == walk.a:
        return first < 0.0 and second < 0.0
    return first > 0.0 and second > 0.0


@njit(borrows=True)
def point_of(mesh: Mesh, walk: Walk, t: float) -> tuple[float, float, int]:
    """P, and the mesh vertex that it is or -1."""
    a, b = walk.a, walk.b
    if t == 0.0:
        return mesh.x[a], mesh.y[a], a
    if t == 1.0:
        return mesh.x[b], mesh.y[b], b
    x, y = mesh.x[a] + t * (mesh.x[b] - mesh.x[a]), mesh.y[a] + t * (mesh.y[b] - mesh.y[a])
    return x, y, -1


@njit(borrows=True)
def point_on(mesh: Mesh, e: int, share: float) -> tuple[float, float]:
    """Return the point at a share of a side."""
    u, v = mesh.tri[e], mesh.tri[next_side(e)]
    if share == 1.0:
        return mesh.x[v], mesh.y[v]
    return mesh.x[u] + share * (mesh.x[v] - mesh.x[u]), mesh.y[u] + share * (mesh.y[v] - mesh.y[u])


@njit(borrows=True)
def is_free(mesh: Mesh, walk: Walk, side: int, t: float, e: int, qx: float, qy: float) -> bool:
    """Whether the sight from P to Q on side e is free."""
    px, py, vertex = point_of(mesh, walk, t)
    return sees(mesh, spot_at(mesh, px, py, side, vertex), e, qx, qy)
