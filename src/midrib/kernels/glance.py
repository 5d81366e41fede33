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
that a loop winds around lies in the box around the loop, with vertices whose sides are on neither
curve: for the hole of a curve itself is on the wrong side of P, or of Q.

Where a sight is not free or along P's own wall, where limits cut what is near or a hole may be in
between, the answer is left to ``look_along``: it is the same, but takes longer.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.boxtree import FOOT, LEAF, VERTEX, box_tree
from midrib.kernels.chain import Chain, Goal, slack_of
from midrib.kernels.envelope import (
    Walk,
    farthest_between,
    has_room,
    is_lower,
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
from midrib.types import Floats, Ints

__all__ = ["UNSURE", "Others", "glance_along", "is_without_holes", "others_of"]

UNSURE = -2
A_BIT_FARTHER = 1.0 + 2.0**-20  # of a squared distance: more than what rounding does to it


class Others(NamedTuple):
    """Vertices with a boundary side that is on neither curve, and boxes over runs of them."""

    x: Floats
    y: Floats
    boxes: Floats


@njit()
def others_of(mesh: Mesh, main: Chain, goal: Goal) -> Others:
    """Prepare to look for holes; none where there are none. O(n)."""
    is_main = np.zeros(mesh.tri.size, np.bool_)
    for e in main.side:
        is_main[e] = True
    x, y, count = np.empty(mesh.x.size + 1), np.empty(mesh.x.size + 1), 0
    if not is_without_holes(mesh):
        for v in range(mesh.x.size):
            e = mesh.door[v]
            while e >= 0:
                if goal.segment[e] < 0 and not is_main[e]:
                    x[count], y[count] = mesh.x[v], mesh.y[v]
                    count += 1
                    break
                e = mesh.other_door[e]
    if count == 0:
        return Others(x[:0], y[:0], np.empty((0, 4)))
    x[count], y[count] = x[count - 1], y[count - 1]  # of a single one boxes have a side too
    x, y = x[: count + 1], y[: count + 1]
    return Others(x, y, box_tree(x, y))


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


@njit(inline=True, borrows=True)
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
    count = lowest_along(goal, mesh, walk, start, stop, limit, hint, seen, outlook, stack)
    if count > 0 and not is_seen(mesh, goal, others, walk, side, seen, outlook, count, stack):
        count = UNSURE
    if count <= 0:
        seen[0] = seen[1] = np.nan
    return count


@njit(inline=True, borrows=True)
def lowest_along(
    goal: Goal,
    mesh: Mesh,
    walk: Walk,
    start: float,
    stop: float,
    limit: Floats,
    hint: int,
    seen: Floats,
    outlook: Outlook,
    stack: Ints,
) -> int:
    """Write the envelope of the whole curve, seen or not; the number of pieces."""
    row, at, work, base = outlook.motions
    x, y, boxes, arc, sides = goal.x, goal.y, goal.boxes, goal.chain.arc, goal.chain.side
    low, high = max(limit[0], limit[1]), min(limit[2], limit[3])
    run_x, run_y = walk.bx - walk.ax, walk.by - walk.ay
    px, py = walk.ax + start * run_x, walk.ay + start * run_y
    qx, qy = walk.ax + stop * run_x, walk.ay + stop * run_y
    leaves, first, last = boxes.shape[0] // 2, 2 * base, x.size - 2
    # 1. Nothing that matters is farther than what is known from the start, and the way.
    bound, step = np.inf, length(qx - px, qy - py)
    if seen[0] == seen[0]:
        off = length(seen[0] * goal.scale_x - px, seen[1] * goal.scale_y - py)
        bound = (off + step + goal.tie) ** 2 * A_BIT_FARTHER
    # 2. Up the tree of boxes from the hint, and down where something can be nearer.
    count, depth, top = 0, 1, leaves + hint // LEAF
    stack[0] = top
    while depth > 0 or top > 1:
        if depth == 0:
            stack[0], depth = top ^ 1, 1
            top //= 2
        depth -= 1
        node = stack[depth]
        if squared_gap(px, py, qx, qy, boxes, node) > bound:
            continue
        if node < leaves:
            left = squared_gap(px, py, qx, qy, boxes, 2 * node)
            right = squared_gap(px, py, qx, qy, boxes, 2 * node + 1)
            nearer = 2 * node if left <= right else 2 * node + 1
            stack[depth], stack[depth + 1] = 4 * node + 1 - nearer, nearer
            depth += 2
            continue
        # 3. A segment offers P's foot, and its start where the feet on both sides are beyond it.
        begin = (node - leaves) * LEAF
        _, _, before_a, before_b = feet_on(x, y, walk, max(begin - 1, 0))
        most_before = max(between(before_a, before_b, start), between(before_a, before_b, stop))
        for j in range(begin, min(begin + LEAF, last + 1)):
            if sides[j] < 0 or arc[j] < low or arc[j + 1] > high:
                off = squared_distance_to_side(
                    (px + qx) / 2.0, (py + qy) / 2.0, x[j], y[j], x[j + 1], y[j + 1], 1.0, 1.0
                )
                if np.sqrt(off) <= np.sqrt(bound) + step:
                    return UNSURE
            foot_a, foot_b, beyond_a, beyond_b = feet_on(x, y, walk, j)
            foot = min(between(foot_a, foot_b, start), between(foot_a, foot_b, stop))
            most = max(between(foot_a, foot_b, start), between(foot_a, foot_b, stop))
            beyond = min(between(beyond_a, beyond_b, start), between(beyond_a, beyond_b, stop))
            for k in range(3):
                if k == 0:
                    if most <= 0.0 or beyond >= 0.0:
                        continue
                    from_t, to_t = below(-foot_a, -foot_b, start, stop)
                    from_t, to_t = below(beyond_a, beyond_b, from_t, to_t)
                elif k == 1:
                    if foot > 0.0 or (j > 0 and most_before < 0.0):
                        continue
                    from_t, to_t = below(foot_a, foot_b, start, stop)
                    if j > 0:
                        from_t, to_t = below(-before_a, -before_b, from_t, to_t)
                elif j == last:
                    from_t, to_t = below(-beyond_a, -beyond_b, start, stop)
                else:
                    break
                if not from_t < to_t:
                    continue
                write_offer(mesh, goal, j, k, from_t, to_t, foot_a, foot_b, row, at, first)
                if not is_lower(walk, row, work, count, first):
                    continue
                if not has_room(base, count):
                    return -1
                count = lower_by(walk, row, at, work, base, count, first)
                bound = np.sqrt(farthest_between(row, count, start, stop)) + goal.tie
                bound *= bound * A_BIT_FARTHER
            before_a, before_b = beyond_a, beyond_b
            most_before = max(between(beyond_a, beyond_b, start), between(beyond_a, beyond_b, stop))
    return count if count > 0 and bound < np.inf else UNSURE  # rounding may leave a crack


@njit(borrows=True)
def squared_gap(px: float, py: float, qx: float, qy: float, boxes: Floats, node: int) -> float:
    """Squared distance from the box around p q to a node's box, inf for an empty one."""
    dx = max(boxes[node, 0] - max(px, qx), min(px, qx) - boxes[node, 2], 0.0)
    dy = max(boxes[node, 1] - max(py, qy), min(py, qy) - boxes[node, 3], 0.0)
    return dx * dx + dy * dy


@njit(borrows=True)
def feet_on(x: Floats, y: Floats, walk: Walk, j: int) -> tuple[float, float, float, float]:
    """How far P's foot on a segment is from its start, and beyond its end, for P at 0 and at 1.

    Times the segment's length.
    """
    dx, dy = x[j + 1] - x[j], y[j + 1] - y[j]
    squared = dx * dx + dy * dy
    foot_a = (walk.ax - x[j]) * dx + (walk.ay - y[j]) * dy
    foot_b = (walk.bx - x[j]) * dx + (walk.by - y[j]) * dy
    return foot_a, foot_b, foot_a - squared, foot_b - squared


@njit(borrows=True)
def between(at_a: float, at_b: float, t: float) -> float:
    """Value of a linear function."""
    return at_a + t * (at_b - at_a)


@njit(borrows=True)
def below(at_a: float, at_b: float, least: float, most: float) -> tuple[float, float]:
    """Return the part of an interval in which a linear function is not positive."""
    at_least, at_most = between(at_a, at_b, least), between(at_a, at_b, most)
    if at_least <= 0.0 and at_most <= 0.0:
        return least, most
    if at_least > 0.0 and at_most > 0.0:
        return most, most
    root = min(max(at_a / (at_a - at_b), least), most)
    return (least, root) if at_least <= 0.0 else (root, most)


@njit(inline=True, borrows=True)
def write_offer(
    mesh: Mesh,
    goal: Goal,
    j: int,
    k: int,
    from_t: float,
    to_t: float,
    foot_a: float,
    foot_b: float,
    row: Floats,
    at: Ints,
    new: int,
) -> None:
    """Write as row ``new`` P's foot on a segment (k = 0), its start (1) or its end (2)."""
    e = goal.chain.side[j]
    u, v = mesh.tri[e], mesh.tri[next_side(e)]
    is_forward = u == goal.chain.vertex[j]
    row[new, 0], row[new, 1], row[new, 4], row[new, 5] = from_t, to_t, 1.0, 1.0
    at[new, 0], at[new, 3], at[new, 4] = e, u, v
    if k == 0:
        at[new, 1], at[new, 2] = FOOT, -1
        dx, dy = goal.x[j + 1] - goal.x[j], goal.y[j + 1] - goal.y[j]
        squared = dx * dx + dy * dy
        share_a, share_b = foot_a / squared, foot_b / squared
        row[new, 2] = share_a if is_forward else 1.0 - share_a
        row[new, 3] = share_b if is_forward else 1.0 - share_b
    else:
        at[new, 1], at[new, 2] = VERTEX, u if (k == 1) == is_forward else v
        row[new, 2] = row[new, 3] = 0.0 if (k == 1) == is_forward else 1.0
    at_u, at_v = (j, j + 1) if is_forward else (j + 1, j)
    row[new, 6], row[new, 7] = goal.x[at_u], goal.y[at_u]
    row[new, 8], row[new, 9] = goal.x[at_v] - goal.x[at_u], goal.y[at_v] - goal.y[at_u]


@njit(inline=True, borrows=True)
def is_seen(
    mesh: Mesh,
    goal: Goal,
    others: Others,
    walk: Walk,
    side: int,
    seen: Floats,
    outlook: Outlook,
    count: int,
    stack: Ints,
) -> bool:
    """Whether P sees Q all along an envelope: the sights from its ends and where Q jumps are free.

    And no hole is in between. ``seen`` as ``glance_along`` has it.
    """
    row, at = outlook.motions.row, outlook.motions.at
    qx, qy = seen[0], seen[1]
    a, b = mesh.tri[side], mesh.tri[next_side(side)]
    low_x, high_x = min(mesh.x[a], mesh.x[b]), max(mesh.x[a], mesh.x[b])
    low_y, high_y = min(mesh.y[a], mesh.y[b]), max(mesh.y[a], mesh.y[b])
    for k in range(count):
        for end in range(2):
            # 1. Q stays on the side's left, where the area is, and off its line.
            t, e = row[k, end], at[k, 0]
            from_x, from_y = qx, qy
            qx, qy = point_on(mesh, e, place_at(row, k, t))
            if orient(mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b], qx, qy) <= 0.0:
                return False
            low_x, high_x = min(low_x, qx), max(high_x, qx)
            low_y, high_y = min(low_y, qy), max(high_y, qy)
            # 2. Where it does not go on from where it was, both sights have to be free.
            if end == 0:
                off = length((qx - from_x) * goal.scale_x, (qy - from_y) * goal.scale_y)
                if off <= slack_of(goal.tie, np.sqrt(squared_distance(walk, row, k, t))):
                    continue
                if k > 0:
                    v = turns_on(mesh, goal, walk, side, outlook, k)
                    if v >= 0:
                        low_x, high_x = min(low_x, mesh.x[v]), max(high_x, mesh.x[v])
                        low_y, high_y = min(low_y, mesh.y[v]), max(high_y, mesh.y[v])
                        continue
                    if not is_free(mesh, walk, side, t, at[k - 1, 0], from_x, from_y):
                        return False
            elif k < count - 1:
                continue
            if not is_free(mesh, walk, side, t, e, qx, qy):
                return False
    seen[0], seen[1] = qx, qy
    return is_empty(others, low_x, low_y, high_x, high_y, stack)


@njit(borrows=True)
def is_empty(
    others: Others, low_x: float, low_y: float, high_x: float, high_y: float, stack: Ints
) -> bool:
    """Whether no vertex of the others is in a box."""
    x, y, boxes = others
    leaves, depth = boxes.shape[0] // 2, 0
    if x.size > 0:
        stack[0], depth = 1, 1
    while depth > 0:
        depth -= 1
        node = stack[depth]
        if squared_gap(low_x, low_y, high_x, high_y, boxes, node) > 0.0:
            continue
        if node < leaves:
            stack[depth], stack[depth + 1] = 2 * node, 2 * node + 1
            depth += 2
            continue
        begin = (node - leaves) * LEAF
        for j in range(begin, min(begin + LEAF + 1, x.size)):
            if low_x <= x[j] <= high_x and low_y <= y[j] <= high_y:
                return False
    return True


@njit(borrows=True)
def turns_on(mesh: Mesh, goal: Goal, walk: Walk, side: int, outlook: Outlook, k: int) -> int:
    """Return the corner of two segments around which Q jumps, and forwards, where piece k begins.

    -1 if it jumps otherwise.
    """
    row, at = outlook.motions.row, outlook.motions.at
    e, f, t = at[k - 1, 0], at[k, 0], row[k, 0]
    i, j = goal.segment[e], goal.segment[f]
    if abs(i - j) != 1:
        return -1
    v = goal.chain.vertex[max(i, j)]
    px, py, _ = point_of(mesh, walk, t)
    qx, qy = point_on(mesh, e, place_at(row, k - 1, t))
    to_x, to_y = point_on(mesh, f, place_at(row, k, t))
    first = orient(px, py, qx, qy, mesh.x[v], mesh.y[v])
    second = orient(px, py, mesh.x[v], mesh.y[v], to_x, to_y)
    # With Q on the left of the way ahead, what moves on turns to the right around P.
    if mesh.tri[side] == walk.a:
        return v if first < 0.0 and second < 0.0 else -1
    return v if first > 0.0 and second > 0.0 else -1


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
