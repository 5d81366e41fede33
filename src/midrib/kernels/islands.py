r"""Islands: which of the two banks each hole of an area goes with.

A line that passes an island leaves it on one side, so there it runs in a channel between the
island and the bank on the other side: the island is part of the bank that it lies towards.

    auxiliary --------------------
                 __
      path ..   /__\  island  ..       the island lies between the path and the auxiliary curve,
             ..............            so it goes with that
    main      --------------------

A hole that touches a curve goes with it.

Where an island is nearer to the middle of a cap than the curves are, the channel there runs along
the cap, and each half of the cap goes with the curve that it meets.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.boxtree import DEPTH, LEAF, box_tree
from midrib.kernels.chain import Chain
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh, boundary_size, next_boundary_side
from midrib.kernels.predicates import orient
from midrib.kernels.tables import range_of
from midrib.kernels.triangulation import next_side
from midrib.kernels.visibility import squared_distance_to_side
from midrib.types import Bools, Floats, Ints

__all__ = [
    "AUXILIARY",
    "MAIN",
    "Loops",
    "distance_to_side",
    "has_islands",
    "loops_of",
    "no_loops",
    "owners",
    "side_length",
]

MAIN, AUXILIARY, NOBODY = 0, 1, 2  # whose sides are
HALF = 0.5
SAME = 2.0**-20  # of a side: a middle that is no farther from its end than this is its end
INTO = 2.0**-10  # of a side: how far inside its corner an island is looked at


class Loops(NamedTuple):
    """Boundary of the holes: sides, loop by loop, where each loop starts, whose each loop is."""

    side: Ints
    start: Ints  # (k + 1,)
    is_main: Bools  # (k,) else it is the auxiliary curve's
    wall: Floats  # (w, 4) pieces of caps along which a channel runs: from x, y to x, y
    wall_is_main: Bools  # (w,)
    wall_cap: Ints  # (w,) the cap that it is a piece of: 0 after the main curve, 1 before it


@njit()
def no_loops() -> Loops:
    """Return those of an area without holes."""
    none, nobody = np.empty(0, np.intp), np.empty(0, np.bool_)
    return Loops(none, np.zeros(1, np.intp), nobody, np.empty((0, 4)), nobody, none)


@njit(borrows=True)
def has_islands(mesh: Mesh, main: Chain, auxiliary: Chain) -> bool:
    """Whether there is boundary besides the two curves and the caps between them."""
    sides = boundary_size(mesh)
    known = main.side.size + auxiliary.side.size
    for chain, other in ((main, auxiliary), (auxiliary, main)):
        # From the last side of either curve on: a cap leads to the other curve, a hole back.
        is_forward = mesh.tri[chain.side[0]] == chain.vertex[0]
        e = next_boundary_side(mesh, chain.side[-1] if is_forward else chain.side[0])
        while e != other.side[0] and e != other.side[-1] and sides >= known:
            known += 1
            e = next_boundary_side(mesh, e)
    return sides > known


@njit()
def owners(mesh: Mesh, main: Chain, auxiliary: Chain) -> Ints:
    """Return MAIN or AUXILIARY for each side of the mesh that is a curve's, -1 for the others."""
    owner = np.full(mesh.tri.size, -1, np.intp)
    for e in main.side:
        owner[e] = MAIN
    for e in auxiliary.side:
        if e >= 0:
            owner[e] = AUXILIARY
    return owner


@njit()
def loops_of(
    mesh: Mesh, main: Chain, auxiliary: Chain, path: Floats, scale_x: float, scale_y: float
) -> Loops:
    """Return the islands and touching holes of an area, by the bank that each goes with.

    O(n log n) for islands that are small against the area.
    """
    owner = owners(mesh, main, auxiliary)
    side, start = np.empty(mesh.tri.size, np.intp), np.zeros(mesh.tri.size, np.intp)
    is_main = np.empty(mesh.tri.size, np.bool_)
    count, loops = 0, 0
    # 1. Along the shell: what lies between two sides of one curve is a hole that touches it; what
    #    lies between the two curves is a cap.
    first = e = main.side[0]
    last = MAIN
    cap, cap_start = np.empty(mesh.tri.size, np.intp), np.zeros(3, np.intp)
    is_inner = mesh.twin < 0
    caps = 0
    while True:
        e = next_boundary_side(mesh, e)
        is_inner[e] = False
        if owner[e] == MAIN or owner[e] == AUXILIARY:
            if owner[e] != last:
                caps, run = caps + 1, count - start[loops]
                cap_start[caps] = cap_start[caps - 1] + run
                for k in range(run):
                    cap[cap_start[caps - 1] + k] = side[start[loops] + k]
                count = start[loops]
            elif count > start[loops]:
                is_main[loops], start[loops + 1] = last == MAIN, count
                loops += 1
            last = owner[e]
        else:
            side[count], owner[e] = e, NOBODY
            count += 1
        if e == first:
            break
    count = start[loops]
    # 2. Rings of their own.
    ring_x, ring_y = ring_beside(mesh, path, auxiliary)
    boxes = box_tree(ring_x, ring_y)
    (low_x, high_x), (low_y, high_y) = range_of(ring_x), range_of(ring_y)
    is_long_in_x = high_x - low_x >= high_y - low_y
    stack = np.empty(DEPTH, np.intp)
    for v in range(mesh.x.size):  # in order along the area, so that boxes over runs are small
        e = mesh.door[v]
        while e >= 0:
            f = e
            while owner[f] < 0:
                side[count], owner[f] = f, NOBODY
                count += 1
                f = next_boundary_side(mesh, f)
            if count > start[loops]:
                x, y = point_of_hole(mesh, side[start[loops] : count])
                is_main[loops] = not is_around(x, y, ring_x, ring_y, boxes, is_long_in_x, stack)
                loops += 1
                start[loops] = count
            e = mesh.other_door[e]
    walls = walls_of_caps(mesh, cap, cap_start, is_inner, scale_x, scale_y)
    return Loops(side[:count], start[: loops + 1], is_main[:loops], *walls)


@njit()
def walls_of_caps(
    mesh: Mesh, cap: Ints, cap_start: Ints, is_inner: Bools, scale_x: float, scale_y: float
) -> tuple[Floats, Bools, Ints]:
    """Return the halves of the caps that islands face, in pieces, whose each is, and of which cap.

    ``is_inner`` marks the sides of islands. ``cap`` holds the sides of the cap after the main
    curve, seen along the boundary, and from ``cap_start[1]`` on those of the cap before it. Halves
    are walls only if an island is nearer to the middle of the cap than the curves are.
    """
    most = cap_start[2] + 2
    wall, is_main, of = np.empty((most, 4)), np.empty(most, np.bool_), np.empty(most, np.intp)
    count = 0
    for k in range(2):
        half, so_far, before = 0.0, 0.0, count
        for e in cap[cap_start[k] : cap_start[k + 1]]:
            half += side_length(mesh, e, scale_x, scale_y) / 2.0
        mx, my = 0.0, 0.0
        for e in cap[cap_start[k] : cap_start[k + 1]]:
            a, b = mesh.tri[e], mesh.tri[next_side(e)]
            x0, y0, x1, y1 = mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b]
            step = side_length(mesh, e, scale_x, scale_y)
            share = (half - so_far) / step
            if SAME < share < 1.0 - SAME:
                mx, my = x0 + share * (x1 - x0), y0 + share * (y1 - y0)
                wall[count, 0], wall[count, 1], wall[count, 2], wall[count, 3] = x0, y0, mx, my
                is_main[count], of[count] = k == 0, k
                count, x0, y0, share = count + 1, mx, my, 0.0
            elif SAME >= share > -SAME:
                mx, my = x0, y0
            wall[count, 0], wall[count, 1], wall[count, 2], wall[count, 3] = x0, y0, x1, y1
            is_main[count], of[count] = (k == 0) == (share > HALF), k
            so_far += step
            count += 1
        if not is_faced(mesh, is_inner, mx, my, half, scale_x, scale_y):
            count = before
    return wall[:count], is_main[:count], of[:count]


@njit(borrows=True)
def is_faced(
    mesh: Mesh, is_inner: Bools, x: float, y: float, within: float, scale_x: float, scale_y: float
) -> bool:
    """Whether a marked side is nearer than so much to a point."""
    for e in range(is_inner.size):
        if is_inner[e] and distance_to_side(mesh, x, y, e, scale_x, scale_y) < within:
            return True
    return False


@njit(borrows=True)
def side_length(mesh: Mesh, e: int, scale_x: float, scale_y: float) -> float:
    """Length of a side."""
    a, b = mesh.tri[e], mesh.tri[next_side(e)]
    return length((mesh.x[b] - mesh.x[a]) * scale_x, (mesh.y[b] - mesh.y[a]) * scale_y)


@njit(borrows=True)
def distance_to_side(
    mesh: Mesh, x: float, y: float, e: int, scale_x: float, scale_y: float
) -> float:
    """Distance of a point to a side."""
    a, b = mesh.tri[e], mesh.tri[next_side(e)]
    return np.sqrt(
        squared_distance_to_side(x, y, mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b], scale_x, scale_y)
    )


@njit()
def ring_beside(mesh: Mesh, path: Floats, auxiliary: Chain) -> tuple[Floats, Floats]:
    """Return the closed ring along the path and back along the auxiliary curve."""
    n, m = path.shape[0], auxiliary.vertex.size
    x, y = np.empty(n + m + 1), np.empty(n + m + 1)
    for i in range(n):
        x[i], y[i] = path[i, 0], path[i, 1]
    for i in range(m):
        v = auxiliary.vertex[m - 1 - i]
        x[n + i], y[n + i] = mesh.x[v], mesh.y[v]
    x[n + m], y[n + m] = x[0], y[0]
    return x, y


@njit(borrows=True)
def point_of_hole(mesh: Mesh, side: Ints) -> tuple[float, float]:
    """Return a point of the hole that these sides bound, just inside its leftmost vertex."""
    n, at = side.size, 0
    for i in range(n):
        v, w = mesh.tri[side[i]], mesh.tri[side[at]]
        if mesh.x[v] < mesh.x[w] or (mesh.x[v] == mesh.x[w] and mesh.y[v] < mesh.y[w]):
            at = i
    v, a, b = mesh.tri[side[at]], mesh.tri[next_side(side[at])], mesh.tri[side[at - 1]]
    # As far along both sides as the shorter one allows, so that the angle is halved, about.
    u = max(abs(mesh.x[a] - mesh.x[v]), abs(mesh.y[a] - mesh.y[v]))
    w = max(abs(mesh.x[b] - mesh.x[v]), abs(mesh.y[b] - mesh.y[v]))
    s, t = INTO * min(u, w) / u, INTO * min(u, w) / w
    x = mesh.x[v] + (s * (mesh.x[a] - mesh.x[v]) + t * (mesh.x[b] - mesh.x[v]))
    return x, mesh.y[v] + (s * (mesh.y[a] - mesh.y[v]) + t * (mesh.y[b] - mesh.y[v]))


@njit()
def is_around(
    px: float, py: float, x: Floats, y: Floats, boxes: Floats, is_long_in_x: bool, stack: Ints
) -> bool:
    """Whether a closed ring winds around p, by the crossings of a ray across its longer axis."""
    leaves, m = boxes.shape[0] // 2, x.size - 1
    is_inside, depth = False, 1
    stack[0] = 1
    along = 0 if is_long_in_x else 1
    at, over = (px, py) if is_long_in_x else (py, px)
    while depth > 0:
        depth -= 1
        node = stack[depth]
        if boxes[node, along] > at or boxes[node, along + 2] < at:
            continue
        if boxes[node, 3 - along] < over:
            continue
        if node < leaves:
            stack[depth], stack[depth + 1] = 2 * node, 2 * node + 1
            depth += 2
            continue
        for j in range((node - leaves) * LEAF, min((node - leaves) * LEAF + LEAF, m)):
            a, b = (x[j], x[j + 1]) if is_long_in_x else (y[j], y[j + 1])
            if (a <= at) == (b <= at):
                continue
            turn = orient(x[j], y[j], x[j + 1], y[j + 1], px, py)
            # The ray meets the segment if p lies on its near side.
            if (turn < 0.0) == ((a < b) == is_long_in_x):
                is_inside = not is_inside
    return is_inside
