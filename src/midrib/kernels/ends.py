r"""The two ends of an area: where a person would say that it begins and ends.

1. *Far pair*: the two shell vertices with the longest way between them through the triangles.
2. *Shape of an end*, around each of them:

     CAP  p------q   a straight run that both banks meet at 35 to 145 degrees: the end is its
          |      |   middle, and the run belongs to neither curve; a run longer than two mean
          |      |   widths only if they meet it alike and the area behind it is about half as deep
          |      |   as it is long, or deeper; and no other such run beside it that is as long
     TIP    /\\      two straight-ish banks that meet at less than 60 degrees: the end is the
                    vertex, or the middle of the short run that cuts it off
     POINT (    )    anything else: the end is the point of the boundary from which equal ways
           |    |    along both banks come out level

Lengths are in the metric scale_x dx, scale_y dy, which the caller has applied to rings.
"""

import numpy as np

from midrib.kernels.heap import pop, push
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.places import place
from midrib.kernels.triangulation import next_side, previous_side
from midrib.types import Floats, Ints

__all__ = [
    "CAP",
    "POINT",
    "TIP",
    "far_pair",
    "mean_width",
    "propose_ends",
    "shape_of_end",
    "shorter_bank",
]

CAP, TIP, POINT = 0, 1, 2
STRAIGHT = 2.0**-20  # a run is straight if it bends by less than this share of its length
LEAST_CORNER = np.cos(np.radians(35.0))  # banks meet a cap at 35 to 145 degrees
ASKEW = 1.0  # sum of the cosines at which two banks meet a run: 30 degrees off square on average
LEAST_CAP = 0.25  # of the mean width
LEAST_BLUNT = 2.0**-12  # of the mean width: what cuts a tip off
AS_LONG = 0.5  # of a run: a lid beside it that is longer is a part of the same end
FACETS = 3  # shorter runs between two that make an end
ALONG = 0.5  # cosine: banks that differ by less than 60 degrees hold one end between them
LONG_CAP = 2.0  # mean widths: the cap of a wedge is no longer
LEAST_DEPTH = 0.45  # of a long cap: real flanks have less behind their middles, waists more
TIP_CHORD = 1.0  # chord over arm at 60 degrees
LEVELLINGS = 8
LEAST_ADVANCE = 0.125  # of an arm: middles that are nearer to each other have no direction
LEAST_BANK = 0.25  # of the shorter way between the two far vertices along the shell


@njit(borrows=True)
def middle_of(mesh: Mesh, e: int) -> tuple[float, float]:
    """Middle of a side."""
    e = place(e)
    a, b = place(mesh.tri[e]), place(mesh.tri[next_side(e)])
    return (mesh.x[a] + mesh.x[b]) / 2.0, (mesh.y[a] + mesh.y[b]) / 2.0


@njit(borrows=True)
def sweep(
    mesh: Mesh,
    order: Ints,
    source: int,
    scale_x: float,
    scale_y: float,
    is_tree: bool,
    entered: Ints,
    cost: Floats,
    way: Floats,
    frontier: Ints,
) -> int:
    """Return the vertex of ``order`` with the longest way from ``source``.

    A way goes from middle of side to middle of side, or along vertices where that is shorter: the
    middles alone would go into a long side's triangle and back to reach a vertex next to it.
    Without holes the triangles form a tree and any order of visits will do; with holes the
    nearest side comes first (Dijkstra).
    """
    for triangle in range(entered.size):
        entered[triangle] = 0
    for vertex in range(way.size):
        way[vertex] = np.inf
    way[source] = 0.0
    size = 0
    sx, sy = mesh.x[source], mesh.y[source]
    door = mesh.door[source]
    while door >= 0:
        e = door
        while e >= 0:
            entered[e // 3] = 1
            across = next_side(e)
            for v in (mesh.tri[across], mesh.tri[previous_side(e)]):
                way[v] = length((mesh.x[v] - sx) * scale_x, (mesh.y[v] - sy) * scale_y)
            if mesh.twin[across] >= 0:
                mx, my = middle_of(mesh, across)
                cost[across] = length((mx - sx) * scale_x, (my - sy) * scale_y)
                frontier[size] = across
                size = size + 1 if is_tree else push(frontier, cost, size, across)
            e = mesh.twin[previous_side(e)]
        door = mesh.other_door[door]
    while size > 0:
        e = place(frontier[place(size - 1)] if is_tree else pop(frontier, cost, size))
        size -= 1
        f = place(mesh.twin[e])
        if entered[f // 3] != 0:
            continue
        entered[f // 3] = 1
        u, v, w = place(mesh.tri[e]), place(mesh.tri[f]), place(mesh.tri[previous_side(f)])
        mx, my = middle_of(mesh, e)
        to_m = length((mesh.x[w] - mx) * scale_x, (mesh.y[w] - my) * scale_y)
        to_u = length((mesh.x[w] - mesh.x[u]) * scale_x, (mesh.y[w] - mesh.y[u]) * scale_y)
        to_v = length((mesh.x[w] - mesh.x[v]) * scale_x, (mesh.y[w] - mesh.y[v]) * scale_y)
        way[w] = min(way[w], cost[e] + to_m, way[u] + to_u, way[v] + to_v)
        # From middle to middle it is half the third side, from a vertex to a middle half its own.
        by_u = min(cost[e] + to_v / 2.0, min(way[u], way[w]) + to_u / 2.0)
        by_v = min(cost[e] + to_u / 2.0, min(way[v], way[w]) + to_v / 2.0)
        for side, to_side in ((next_side(f), by_u), (previous_side(f), by_v)):
            if mesh.twin[side] < 0 or entered[place(mesh.twin[side]) // 3] != 0:
                continue
            cost[side] = to_side
            frontier[place(size)] = side
            size = size + 1 if is_tree else push(frontier, cost, size, side)
    farthest = source
    for v in order:
        if way[v] > way[farthest] and way[v] < np.inf:
            farthest = v
    return farthest


@njit()
def far_pair(
    mesh: Mesh, order: Ints, source: int, scale_x: float, scale_y: float, is_tree: bool
) -> Ints:
    """Two vertices of ``order``, the shell's, with the longest way between them.

    One of them is ``source``, unless that is -1: then it is the farthest vertex from anywhere, and
    the other is the farthest from that: exact on a tree, a good guess with holes. O(n) without
    holes, O(n log n) with them.
    """
    m = mesh.tri.size
    entered, cost, frontier = np.empty(m // 3, np.intp), np.empty(m), np.empty(m, np.intp)
    way = np.empty(mesh.x.size)
    pair = np.empty(2, np.intp)
    pair[0] = source
    if source < 0:
        pair[0] = sweep(
            mesh, order, order[0], scale_x, scale_y, is_tree, entered, cost, way, frontier
        )
    pair[1] = sweep(mesh, order, pair[0], scale_x, scale_y, is_tree, entered, cost, way, frontier)
    return pair


@njit(borrows=True)
def point_at(x: Floats, y: Floats, arc: Floats, s: float) -> tuple[float, float, int, float]:
    """Return the point of a closed ring at arc length s, its segment and the share of it.

    ``arc`` has one entry more than the ring: the perimeter.
    """
    n = x.size
    perimeter = arc[n]
    s -= np.floor(s / perimeter) * perimeter
    k, above = 0, n
    while above - k > 1:
        middle = (k + above) // 2
        if arc[middle] <= s:
            k = middle
        else:
            above = middle
    span = arc[k + 1] - arc[k]
    share = (s - arc[k]) / span if span > 0.0 else 0.0
    j = k + 1 if k + 1 < n else 0
    return x[k] + share * (x[j] - x[k]), y[k] + share * (y[j] - y[k]), k, share


@njit(borrows=True)
def straight_run(x: Floats, y: Floats, start: int, step: int) -> int:
    """Return the last vertex of the straight run from vertex ``start`` in direction ``step``."""
    n = x.size
    end = (start + step) % n
    while True:
        beyond = (end + step) % n
        if beyond == start:
            return end
        dx, dy = x[beyond] - x[start], y[beyond] - y[start]
        ex, ey = x[end] - x[start], y[end] - y[start]
        bends = abs(dx * ey - dy * ex) > STRAIGHT * (dx * dx + dy * dy)
        if bends or dx * ex + dy * ey < ex * ex + ey * ey:
            return end
        end = beyond


@njit(borrows=True)
def is_cap(x: Floats, y: Floats, arc: Floats, p: int, q: int, width: float) -> bool:
    """Whether the straight run from vertex p on to vertex q closes two banks like a lid.

    The banks' directions are taken over half the length of the run, so that roughness finer than
    that does not matter. A run much longer than the area is wide may also be a flank of a wider
    end: the banks meet it askew, or the area is shallow behind it in the direction of both.
    """
    perimeter = arc[-1]
    cx, cy = x[q] - x[p], y[q] - y[p]
    span = length(cx, cy)
    if span <= 0.0 or 3.0 * span > perimeter:
        return False
    ax, ay, _, _ = point_at(x, y, arc, arc[p] - span / 2.0)
    bx, by, _, _ = point_at(x, y, arc, arc[q] + span / 2.0)
    ux, uy, vx, vy = x[p] - ax, y[p] - ay, x[q] - bx, y[q] - by
    u, v = length(ux, uy), length(vx, vy)
    if u <= 0.0 or v <= 0.0:
        return False
    at_p, at_q = (ux * cx + uy * cy) / (u * span), (vx * cx + vy * cy) / (v * span)
    outward_p = ux * cy - uy * cx > 0.0  # the shell turns left, so the bank comes from the right
    outward_q = vx * cy - vy * cx > 0.0
    if max(abs(at_p), abs(at_q)) > LEAST_CORNER or not (outward_p and outward_q):
        return False
    if span <= LONG_CAP * width:
        return True
    inward_x, inward_y = -(ux / u + vx / v), -(uy / u + vy / v)
    is_deep = depth_behind(x, y, p, q, inward_x, inward_y) >= LEAST_DEPTH * span
    return is_deep and abs(at_p + at_q) <= ASKEW


@njit(borrows=True)
def is_facet(x: Floats, y: Floats, arc: Floats, p: int, q: int, width: float) -> bool:
    """Whether the lid from vertex p on to vertex q is only one facet of an end, as of a gable.

    Then there is a lid beside it, hardly shorter or longer, and the banks beyond both run alike.
    """
    least = AS_LONG * length(x[q] - x[p], y[q] - y[p])
    for step in (-1, 1):
        near = p if step < 0 else q
        far = straight_run(x, y, near, step)
        for _ in range(FACETS):  # past shorter ones
            if length(x[far] - x[near], y[far] - y[near]) >= least:
                break
            near, far = far, straight_run(x, y, far, step)
        first, last = (far, near) if step < 0 else (near, far)
        is_long = length(x[far] - x[near], y[far] - y[near]) >= least
        if not (is_long and is_cap(x, y, arc, first, last, width)):
            continue
        first, last = (far, q) if step < 0 else (p, far)
        arm = length(x[last] - x[first], y[last] - y[first]) / 2.0
        ax, ay, _, _ = point_at(x, y, arc, arc[first] - arm)
        bx, by, _, _ = point_at(x, y, arc, arc[last] + arm)
        ux, uy, vx, vy = x[first] - ax, y[first] - ay, x[last] - bx, y[last] - by
        if ux * vx + uy * vy >= ALONG * length(ux, uy) * length(vx, vy):
            return True
    return False


@njit(borrows=True)
def depth_behind(x: Floats, y: Floats, p: int, q: int, ux: float, uy: float) -> float:
    """How far along u from the middle of a run, vertex p to vertex q, the shell comes again."""
    n, depth = x.size, np.inf
    mx, my, size = (x[p] + x[q]) / 2.0, (y[p] + y[q]) / 2.0, length(ux, uy)
    least = STRAIGHT * length(x[q] - x[p], y[q] - y[p])  # nearer is the run itself
    for i in range(n):
        j = i + 1 if i + 1 < n else 0
        at_i = (x[i] - mx) * uy - (y[i] - my) * ux
        at_j = (x[j] - mx) * uy - (y[j] - my) * ux
        if (at_i < 0.0) == (at_j < 0.0):
            continue
        t = at_i / (at_i - at_j)
        hx, hy = x[i] + t * (x[j] - x[i]) - mx, y[i] + t * (y[j] - y[i]) - my
        way = (hx * ux + hy * uy) / size
        if way > least:
            depth = min(depth, way)
    return depth


@njit(borrows=True)
def find_cap(
    x: Floats, y: Floats, arc: Floats, vertex: int, width: float, least: float, reach: float
) -> tuple[int, int]:
    """Return the corners of the cap at a vertex, -1 if there is none.

    Of two caps at the vertex the shorter one; else the nearest within ``reach`` of it along the
    shell. Teeth of the banks are shorter than ``least``.
    """
    # The vertex may lie inside a straight run; a part of a run is no cap.
    backward, forward = vertex, vertex
    behind = straight_run(x, y, vertex, -1)
    through = straight_run(x, y, behind, 1)
    if through != vertex:
        backward, forward = behind, through
        span = length(x[forward] - x[backward], y[forward] - y[backward])
        is_lid = least <= span and is_cap(x, y, arc, backward, forward, width)
        if is_lid and not is_facet(x, y, arc, backward, forward, width):
            return backward, forward
    nearest, shortest, cap_p, cap_q = reach, np.inf, -1, -1
    for step in (1, -1):
        near, way = (forward if step == 1 else backward), 0.0
        while way <= nearest:
            far = straight_run(x, y, near, step)
            span = length(x[far] - x[near], y[far] - y[near])
            p, q = (near, far) if step == 1 else (far, near)
            is_better = way < nearest or span < shortest
            is_lid = least <= span and is_better and is_cap(x, y, arc, p, q, width)
            if is_lid and not is_facet(x, y, arc, p, q, width):
                nearest, shortest, cap_p, cap_q = way, span, p, q
                break
            near, way = far, way + span
    return cap_p, cap_q


@njit(borrows=True)
def between(x: Floats, y: Floats, arc: Floats, s: float, arm: float) -> tuple[float, float]:
    """Middle between the points one arm before and after the arc length s."""
    ax, ay, _, _ = point_at(x, y, arc, s - arm)
    bx, by, _, _ = point_at(x, y, arc, s + arm)
    return (ax + bx) / 2.0, (ay + by) / 2.0


@njit(borrows=True)
def levelled(x: Floats, y: Floats, arc: Floats, s: float, arm: float) -> float:
    """Shift the arc length s until the points one arm before and after it are level.

    Level means: equally far in the direction of the middles between the banks, from two arms over
    one and a half to one, turned on as much again.
    """
    shift_limit = arm
    for _ in range(LEVELLINGS):
        nx, ny = between(x, y, arc, s, arm)
        mx, my = between(x, y, arc, s, 1.5 * arm)
        fx, fy = between(x, y, arc, s, 2.0 * arm)
        ux, uy, vx, vy = nx - mx, ny - my, mx - fx, my - fy
        u, v = length(ux, uy), length(vx, vy)
        if min(u, v) <= LEAST_ADVANCE * arm:
            return s
        ux, uy = 2.0 * ux / u - vx / v, 2.0 * uy / u - vy / v
        ax, ay, _, _ = point_at(x, y, arc, s - arm)
        ahead = 2.0 * ((ax - nx) * ux + (ay - ny) * uy) / length(ux, uy)
        shift = min(max(ahead / 2.0, -shift_limit), shift_limit)
        s -= shift
        shift_limit /= 2.0
    return s


@njit(borrows=True)
def shape_of_end(
    x: Floats, y: Floats, arc: Floats, vertex: int, width: float
) -> tuple[int, int, int, float]:
    """Return what the end of an area looks like around one of its far vertices.

    Parameters
    ----------
    x, y, arc : the shell, turning left, in lengths: (n,) vertices, (n + 1,) arc lengths
    vertex : index of the far vertex
    width : mean width of the area; roughness much finer than it is overlooked

    Returns
    -------
    kind, i, j, share
        CAP: the corners i and j, in the shell's direction; TIP: vertex i; POINT: ``share`` of the
        way along segment i.
    """
    # 1. A lid at the vertex or next to it.
    cap_p, cap_q = find_cap(x, y, arc, vertex, width, LEAST_CAP * width, width)
    if cap_p >= 0:
        return CAP, cap_p, cap_q, 0.0
    # 2. Arms along both banks, long enough that roughness does not matter.
    arm = width / 2.0
    s = arc[vertex]
    ax, ay, _, _ = point_at(x, y, arc, s - arm)
    bx, by, _, _ = point_at(x, y, arc, s + arm)
    if length(ax - bx, ay - by) < TIP_CHORD * arm:
        cap_p, cap_q = find_cap(x, y, arc, vertex, width, LEAST_BLUNT * width, 0.0)
        return (CAP, cap_p, cap_q, 0.0) if cap_p >= 0 else (TIP, vertex, vertex, 0.0)
    # 3. Neither: the point that leaves the banks level.
    s = levelled(x, y, arc, s, min(width, arc[-1] / 8.0))
    _, _, k, share = point_at(x, y, arc, s)
    return POINT, k, k, share


@njit(borrows=True)
def mean_width(x: Floats, y: Floats, arc: Floats) -> float:
    """Width of the rectangle with a shell's area and perimeter, or of the square with its area."""
    doubled = 0.0
    for i in range(1, x.size - 1):
        dx, dy = x[i] - x[0], y[i] - y[0]
        doubled += dx * (y[i + 1] - y[0]) - (x[i + 1] - x[0]) * dy
    area, half = abs(doubled) / 2.0, arc[-1] / 2.0
    root = (half / 2.0) ** 2 - area
    return area / (half / 2.0 + np.sqrt(root)) if root > 0.0 else np.sqrt(area)


@njit()
def shorter_bank(arc: Floats, places: Ints, shares: Floats) -> float:
    """Length of the shorter of the two banks that two ends leave of a shell; negative if none."""
    n = arc.size - 1
    at = np.empty((2, 2))
    for i in range(2):
        for j in range(2):
            k = places[i, j]
            at[i, j] = arc[k] + shares[i] * (arc[k + 1] - arc[k])
    perimeter, is_cap = arc[n], np.zeros(2, np.bool_)
    caps = 0.0
    for i in range(2):
        is_cap[i] = places[i, 0] != places[i, 1]
        if is_cap[i]:
            caps += (at[i, 1] - at[i, 0]) % perimeter
    first, second = (at[1, 0] - at[0, 1]) % perimeter, (at[0, 0] - at[1, 1]) % perimeter
    # Where caps overlap the two banks are longer than what is left.
    if abs(first + second + caps - perimeter) > 0.5 * perimeter:
        return -1.0
    return min(first, second)


@njit(entry=True)
def propose_ends(
    mesh: Mesh,
    order: Ints,
    source: int,
    is_tree: bool,
    scale_x: float,
    scale_y: float,
) -> tuple[Ints, Floats]:
    """Where an area begins and ends.

    Parameters
    ----------
    mesh : the area
    order : (n,) shell vertices in order, each once
    source : a mesh vertex to keep as the first end, or -1
    is_tree : whether the area has no holes
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    places, shares : (2, 2) and (2,); see ``division``. The first end is the one farther left.
    """
    n = order.size
    x, y, arc = np.empty(n), np.empty(n), np.zeros(n + 1)
    place_of = np.zeros(mesh.x.size, np.intp)
    for i in range(n):
        place_of[order[i]] = i
        x[i], y[i] = mesh.x[order[i]] * scale_x, mesh.y[order[i]] * scale_y
    for i in range(n):
        j = i + 1 if i + 1 < n else 0
        arc[i + 1] = arc[i] + length(x[j] - x[i], y[j] - y[i])
    pair = far_pair(mesh, order, source, scale_x, scale_y, is_tree)
    a, b = pair[0], pair[1]
    a_is_right = mesh.x[a] > mesh.x[b] or (mesh.x[a] == mesh.x[b] and mesh.y[a] > mesh.y[b])
    if source < 0 and a_is_right:
        pair[0], pair[1] = b, a
    width = mean_width(x, y, arc)
    far, shaped = np.empty((2, 2), np.intp), np.empty((2, 2), np.intp)
    no_shares, shares = np.zeros(2), np.zeros(2)
    for i in range(2):
        far[i, 0] = far[i, 1] = shaped[i, 0] = shaped[i, 1] = place_of[pair[i]]
        if source < 0 or i == 1:
            kind, p, q, share = shape_of_end(x, y, arc, place_of[pair[i]], width)
            shaped[i, 0], shaped[i, 1] = p, q
            shares[i] = share if kind == POINT else 0.0
    # Where the shapes of both leave hardly a bank between them, one of them is only its vertex.
    least = LEAST_BANK * shorter_bank(arc, far, no_shares)
    for which in range(3):
        places, at = shaped.copy(), shares.copy()
        if which > 0:
            places[2 - which, 0], places[2 - which, 1] = far[2 - which, 0], far[2 - which, 1]
            at[2 - which] = 0.0
        if shorter_bank(arc, places, at) >= least:
            return places, at
    return far, no_shares
