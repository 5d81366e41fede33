r"""Ways: the triangles between the two banks of an area with islands, from end to end.

      o-------o     A side of the mesh is *mixed* if its ends are of different banks. A triangle
       \     / \    has two mixed sides or none, so they lead from the one end of the area to the
        \   /   \   other: one way, without a choice, whichever bank each island goes with. The
         \ /     \  trunk meets every mixed side.
main .... x-------x
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.banks import Banks
from midrib.kernels.chain import Chain
from midrib.kernels.islands import AUXILIARY, MAIN, Loops, owners, side_length
from midrib.kernels.jit import njit
from midrib.kernels.leaning import level_between
from midrib.kernels.lengths import length
from midrib.kernels.looking import look_beside, look_everywhere
from midrib.kernels.mesh import Mesh, next_boundary_side
from midrib.kernels.paths import Beads
from midrib.kernels.triangulation import next_side, previous_side
from midrib.types import Bools, Floats, Ints

__all__ = [
    "Stops",
    "is_of_main",
    "level_beads",
    "shores_outside",
    "stops_on_way",
]

CLOSE = 0.5  # widths: stops nearer to each other than that are as good as one
CLOSE_SIDES = 0.5  # the same, for the ends of sides: in a fan one end stays where it is


class Stops(NamedTuple):
    """Points that the trunk goes by, in order."""

    point: Floats  # (n, 2)
    at: Ints  # the bead that each is, or -1 - (the triangle it is in)
    nearest: Ints  # (n, 2) segments of the main and of the auxiliary bank


@njit(borrows=True)
def level_beads(
    banks: Banks,
    beads: Beads,
    near: Ints,
    points: Floats,
    at: Ints,
    first: int,
    every_one: bool,
    scale_x: float,
    scale_y: float,
) -> None:
    """Move all beads of radii, or the first and the last, onto the trunk; note what is near them.

    Past islands the trunk goes by the sides between the banks: only its ends may be beads.
    """
    step = 1 if every_one else max(points.shape[0] - 1, 1)
    for i in range(0, points.shape[0], step):
        px, py = points[i, 0] * scale_x, points[i, 1] * scale_y
        look_beside(banks, at[i, 3], px, py, points[i, 5])
        x, y, _ = level_between(banks, px, py, points[i, 2] * scale_x, points[i, 3] * scale_y, 0.5)
        beads.point[first + i, 0], beads.point[first + i, 1] = x / scale_x, y / scale_y
        near[first + i, 0], near[first + i, 1] = banks.last[0], banks.last[1]
    look_everywhere(banks)


@njit()
def shores_outside(
    mesh: Mesh, main: Chain, auxiliary: Chain, scale_x: float, scale_y: float
) -> Ints:
    """Return MAIN or AUXILIARY for each vertex of the outer boundary, -1 for those of islands.

    Of what lies between the two curves, half is the one's and half the other's.
    """
    owner = owners(mesh, main, auxiliary)
    shore = np.full(mesh.x.size, -1, np.intp)
    first = e = main.side[0]
    last, run = MAIN, np.empty(mesh.tri.size, np.intp)
    count = 0
    while True:
        e = next_boundary_side(mesh, e)
        if owner[e] >= 0:
            half, so_far = 0.0, 0.0
            for i in range(count):
                half += side_length(mesh, run[i], scale_x, scale_y) / 2.0
            for i in range(count - 1):
                so_far += side_length(mesh, run[i], scale_x, scale_y)
                shore[mesh.tri[next_side(run[i])]] = last if so_far <= half else owner[e]
            last, count = owner[e], 0
        else:
            run[count] = e
            count += 1
        if e == first:
            break
    for v in auxiliary.vertex:
        shore[v] = AUXILIARY
    for v in main.vertex:
        shore[v] = MAIN
    return shore


@njit()
def is_of_main(shore: Ints, mesh: Mesh, islands: Loops) -> Bools:
    """Whether each vertex is main's, those of islands as their loops are."""
    is_main = shore == MAIN
    for k in range(islands.is_main.size):
        for i in range(islands.start[k], islands.start[k + 1]):
            v = mesh.tri[islands.side[i]]
            if shore[v] < 0:
                is_main[v] = islands.is_main[k]
    return is_main


@njit()
def mixed_sides(mesh: Mesh, main: Chain, is_main: Bools) -> Ints:
    """Return the mixed sides, the two on the boundary left out, in main's direction."""
    way, count = np.empty(mesh.tri.size, np.intp), 0
    # Along the boundary the first mixed side is the one at main's end, seen in this direction.
    e = main.side[0]
    for _ in range(mesh.tri.size):
        if is_main[mesh.tri[e]] != is_main[mesh.tri[next_side(e)]]:
            break
        e = next_boundary_side(mesh, e)
    while count < way.size:
        other = next_side(e)
        if is_main[mesh.tri[other]] == is_main[mesh.tri[next_side(other)]]:
            other = previous_side(e)
        e = mesh.twin[other]
        if e < 0:
            break
        way[count] = e
        count += 1
    is_forward = mesh.tri[main.side[0]] == main.vertex[0]
    return way[:count][::-1].copy() if is_forward else way[:count]


@njit()
def stops_on_way(
    mesh: Mesh,
    main: Chain,
    banks: Banks,
    beads: Beads,
    near: Ints,
    is_main: Bools,
    is_trimmed: bool,
    scale_x: float,
    scale_y: float,
) -> Stops:
    """Return points of the trunk on mixed sides, between the first and the last bead.

    One at least every half width: nearer ones would only make vertices.
    """
    way = mixed_sides(mesh, main, is_main)
    n, last = 0, beads.side.size - 1
    point, at = np.empty((way.size + 2, 2)), np.empty(way.size + 2, np.intp)
    nearest = np.empty((way.size + 2, 2), np.intp)
    before_x, before_y = np.inf, np.inf
    side, wide = (np.inf, np.inf, np.inf, np.inf), 0.0  # the last side that was looked at
    for e in way:
        p, q = mesh.tri[e], mesh.tri[next_side(e)]
        if not is_main[p]:
            p, q = q, p
        px, py, qx, qy = mesh.x[p], mesh.y[p], mesh.x[q], mesh.y[q]
        px, py, qx, qy = px * scale_x, py * scale_y, qx * scale_x, qy * scale_y
        moved_p, moved_q = length(px - side[0], py - side[1]), length(qx - side[2], qy - side[3])
        if max(moved_p, moved_q) < CLOSE_SIDES * wide:
            continue
        x, y, wide = level_between(banks, px, py, qx, qy, 0.5)
        side = px, py, qx, qy
        if length(x - before_x, y - before_y) < CLOSE * wide:
            continue
        before_x, before_y, n = x, y, n + 1
        point[n, 0], point[n, 1], at[n] = x / scale_x, y / scale_y, -1 - e // 3
        nearest[n, 0], nearest[n, 1] = banks.last[0], banks.last[1]
    low, high = 1, n + 1
    if is_trimmed and n > 0:
        low = nearest_step(point[1 : n + 1], beads.point[0], scale_x, scale_y) + 2
        high = nearest_step(point[1 : n + 1], beads.point[last], scale_x, scale_y) + 2
        high = max(low, high)
    for row, bead in ((low - 1, 0), (high, last)):
        at[row] = bead
        for k in range(2):
            point[row, k], nearest[row, k] = beads.point[bead, k], near[bead, k]
    return Stops(point[low - 1 : high + 1], at[low - 1 : high + 1], nearest[low - 1 : high + 1])


@njit(borrows=True)
def nearest_step(points: Floats, p: Floats, scale_x: float, scale_y: float) -> int:
    """Which step of a chain of points is nearest to p: that from point k to the next; -1 before."""
    best, nearest = np.inf, -1
    for k in range(points.shape[0]):
        d = length((points[k, 0] - p[0]) * scale_x, (points[k, 1] - p[1]) * scale_y)
        if d < best:
            best, nearest = d, k
    before, beyond = max(nearest - 1, 0), min(nearest + 1, points.shape[0] - 1)
    ux = (points[beyond, 0] - points[before, 0]) * scale_x
    uy = (points[beyond, 1] - points[before, 1]) * scale_y
    ahead = (p[0] - points[nearest, 0]) * scale_x * ux + (p[1] - points[nearest, 1]) * scale_y * uy
    return nearest if ahead > 0.0 else nearest - 1
