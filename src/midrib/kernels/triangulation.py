r"""Constrained Delaunay triangulation of the inside of rings.

Vertices go in one at a time, each inserted near a ring neighbour that is already there; then the
ring segments are forced in; then the triangles to the left of a segment are kept.

half-edge e = 3 t + i    side i of triangle t, from tri[e] to the start of the next side;
                         every triangle turns left
twin[e]                  the same side seen from the other triangle; -1 where there is none
segment[e]               the ring segment that lies on e in the direction of e; FREE where none
                         does; BLOCKED where the segment runs the other way

            c                     a  b  c   a triangle
          / | \\                   d        the vertex across a-b
         /  |  \\
        a --+-- b     flip: the diagonal a-b becomes c-d
         \\  |  /
          \\ | /
            d

Source: C. L. Lawson, Software for C1 Surface Interpolation, 1977 (flips); S. W. Sloan, A Fast
Algorithm for Generating Constrained Delaunay Triangulations, Computers & Structures 47, 1993.
Signs are exact, so every ring that is simple and touches others in points only is triangulated.
"""

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.predicates import in_circle, orient
from midrib.kernels.tables import range_of, with_places
from midrib.types import Floats, Ints

__all__ = ["triangulate_rings"]

FREE, BLOCKED = -1, -2
REACH = 2.0**16  # the outer triangle lies so many extents away; it only has to hold every vertex
COARSE, BLOCK = 8, 1024  # vertices; the triangles of a block fit into the cache
DELAUNAY_PASSES = 6  # over the edges that constraints disturbed: quality, not correctness


@njit(borrows=True)
def next_side(e: int) -> int:
    """Next half-edge of the same triangle, turning left."""
    return e - 2 if e % 3 == 2 else e + 1


@njit(borrows=True)
def previous_side(e: int) -> int:
    """Previous half-edge of the same triangle."""
    return e + 2 if e % 3 == 0 else e - 1


@njit(borrows=True)
def join(e: int, f: int, twin: Ints) -> None:
    """Make e and f two sides of one edge; f may be -1."""
    twin[e] = f
    if f >= 0:
        twin[f] = e


@njit(borrows=True)
def write_triangle(e: int, a: int, b: int, c: int, tri: Ints, out: Ints) -> None:
    """Write a b c at the three half-edges from e; remember a half-edge that leaves each."""
    tri[e], tri[e + 1], tri[e + 2] = a, b, c
    out[a], out[b], out[c] = e, e + 1, e + 2


@njit(borrows=True)
def flip(e: int, tri: Ints, twin: Ints, segment: Ints, out: Ints) -> None:
    """Replace the diagonal e = a-b by c-d; c ends at the last place of both triangles."""
    f = twin[e]
    e_next, e_previous = next_side(e), previous_side(e)
    f_next, f_previous = next_side(f), previous_side(f)
    a, b, c, d = tri[e], tri[f], tri[e_previous], tri[f_previous]
    bc, ca, ad, db = twin[e_next], twin[e_previous], twin[f_next], twin[f_previous]
    on_bc, on_ca = segment[e_next], segment[e_previous]
    on_ad, on_db = segment[f_next], segment[f_previous]
    first, second = e - e % 3, f - f % 3
    write_triangle(first, a, d, c, tri, out)
    write_triangle(second, d, b, c, tri, out)
    join(first, ad, twin)
    join(first + 1, second + 2, twin)
    join(first + 2, ca, twin)
    join(second, db, twin)
    join(second + 1, bc, twin)
    segment[first], segment[first + 1], segment[first + 2] = on_ad, FREE, on_ca
    segment[second], segment[second + 1], segment[second + 2] = on_db, on_bc, FREE


@njit(borrows=True)
def locate(px: float, py: float, e: int, x: Floats, y: Floats, tri: Ints, twin: Ints) -> int:
    """Return a half-edge of the triangle that holds p: the side p lies on, or the first one.

    The walk leaves each triangle through a side that has p beyond it; the caller starts it near
    p. Which side is tried first is drawn anew in every triangle: in a fixed order the walk can
    go round in circles where flat triangles are Delaunay only up to rounding.
    Source: O. Devillers, S. Pion, M. Teillaud, Walking in a Triangulation, 2002.
    """
    e -= e % 3
    came_from = -1
    draw = 1
    for _ in range(4 * tri.size):
        moved = False
        on = -1
        draw = (draw * 1103515245 + 12345) & 0x7FFFFFFF
        for turn_of in range(3):
            side = e + (turn_of + (draw >> 16)) % 3
            if side == came_from:
                continue
            a, b = tri[side], tri[next_side(side)]
            turn = orient(x[a], y[a], x[b], y[b], px, py)
            if turn < 0.0:
                came_from = twin[side]
                e = came_from - came_from % 3
                moved = True
                break
            if turn == 0.0:
                on = side
        if not moved:
            return on if on >= 0 else e
    return -1


@njit(inline=True, borrows=True)
def should_flip(
    ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float
) -> bool:
    """Whether c-d is the better diagonal of the quadrilateral a d b c, of which a-b is an edge.

    Four vertices of one straight bank lie on a circle up to rounding. Left alone, slivers as long
    as the bank would stay, and walks through them make the whole quadratic: there a much shorter
    diagonal is taken, if it lies inside.
    """
    inside = in_circle(ax, ay, bx, by, cx, cy, dx, dy)
    if inside != 0.0:
        return inside > 0.0
    old = (ax - bx) * (ax - bx) + (ay - by) * (ay - by)
    new = (cx - dx) * (cx - dx) + (cy - dy) * (cy - dy)
    return 2.0 * new < old and is_convex(ax, ay, bx, by, cx, cy, dx, dy)


@njit(borrows=True)
def is_convex(
    ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float
) -> bool:
    """Whether a and b lie strictly on either side of c-d, the diagonal across the edge a-b."""
    return orient(ax, ay, dx, dy, cx, cy) > 0.0 and orient(dx, dy, bx, by, cx, cy) > 0.0


@njit(borrows=True)
def legalise(
    p: int,
    stack: Ints,
    size: int,
    x: Floats,
    y: Floats,
    tri: Ints,
    twin: Ints,
    segment: Ints,
    out: Ints,
) -> None:
    """Flip the edges across from the new vertex p as long as one should be; p gets each."""
    while size > 0:
        size -= 1
        e = stack[size]
        f = twin[e]
        if f < 0:
            continue
        a, b, d = tri[e], tri[f], tri[previous_side(f)]
        if should_flip(x[a], y[a], x[b], y[b], x[p], y[p], x[d], y[d]):
            first, second = e - e % 3, f - f % 3
            flip(e, tri, twin, segment, out)
            stack[size], stack[size + 1] = first, second
            size += 2


@njit(borrows=True)
def insert_vertex(
    p: int,
    near: int,
    count: int,
    stack: Ints,
    x: Floats,
    y: Floats,
    tri: Ints,
    twin: Ints,
    segment: Ints,
    out: Ints,
) -> tuple[int, int]:
    """Insert p, walking from the half-edge ``near``.

    Return the number of triangles and the vertex already at that place, or p itself (-1: the
    walk did not end).
    """
    e = locate(x[p], y[p], near, x, y, tri, twin)
    if e < 0:
        return count, -1
    for side in range(e - e % 3, e - e % 3 + 3):
        v = tri[side]
        if x[v] == x[p] and y[v] == y[p]:
            return count, v
    a, b, c = tri[e], tri[next_side(e)], tri[previous_side(e)]
    bc, ca, f = twin[next_side(e)], twin[previous_side(e)], twin[e]
    on_edge = orient(x[a], y[a], x[b], y[b], x[p], y[p]) == 0.0
    first = e - e % 3
    if not on_edge:
        second, third = 3 * count, 3 * count + 3
        write_triangle(first, a, b, p, tri, out)
        write_triangle(second, b, c, p, tri, out)
        write_triangle(third, c, a, p, tri, out)
        join(first, f, twin)
        join(second, bc, twin)
        join(third, ca, twin)
        join(first + 1, second + 2, twin)
        join(second + 1, third + 2, twin)
        join(third + 1, first + 2, twin)
        stack[0], stack[1], stack[2] = first, second, third
        legalise(p, stack, 3, x, y, tri, twin, segment, out)
        return count + 2, p
    d = tri[previous_side(f)]
    ad, db = twin[next_side(f)], twin[previous_side(f)]
    second, third, fourth = f - f % 3, 3 * count, 3 * count + 3
    write_triangle(first, b, c, p, tri, out)
    write_triangle(third, c, a, p, tri, out)
    write_triangle(second, a, d, p, tri, out)
    write_triangle(fourth, d, b, p, tri, out)
    join(first, bc, twin)
    join(third, ca, twin)
    join(second, ad, twin)
    join(fourth, db, twin)
    join(first + 1, third + 2, twin)
    join(third + 1, second + 2, twin)
    join(second + 1, fourth + 2, twin)
    join(fourth + 1, first + 2, twin)
    stack[0], stack[1], stack[2], stack[3] = first, second, third, fourth
    legalise(p, stack, 4, x, y, tri, twin, segment, out)
    return count + 2, p


@njit()
def coarse_to_fine(n: int) -> tuple[Ints, int]:
    """Order in which to insert the vertices 0..n-1, and the stride of the first ones.

    Every 2^k-th vertex comes before those between: in plain order a bend of growing curvature
    makes every new vertex flip all the old ones. The last few halvings are done block by block,
    so that the triangles there stay in the cache: a sixth of the time for 100,000 vertices.
    """
    order, count, stride = np.empty(n, np.intp), 0, 1
    while stride * 4 < n:
        stride *= 2
    for p in range(0, n, stride):
        order[count] = p
        count += 1
    for size, most, least in ((n, stride // 2, COARSE), (BLOCK, COARSE // 2, 1)):
        for start in range(0, n, size):
            step = min(most, stride // 2)
            while step >= least:
                for p in range(start + step, min(start + size, n), 2 * step):
                    order[count] = p
                    count += 1
                step //= 2
    return order, stride


@njit()
def insert_all(
    n: int, x: Floats, y: Floats, tri: Ints, twin: Ints, segment: Ints, out: Ints, same: Ints
) -> int:
    """Insert the vertices 0..n-1; return the number of triangles, -1 on failure.

    Each starts from the nearest one before it along the ring that is there already.
    """
    stack = np.empty(6 * n + 16, np.intp)
    write_triangle(0, n, n + 1, n + 2, tri, out)
    count, near = 1, 0
    order, stride = coarse_to_fine(n)
    for p in order:
        if p > 0:
            near = out[same[p - min(p & -p, stride)]]
        count, same[p] = insert_vertex(p, near, count, stack, x, y, tri, twin, segment, out)
        if same[p] < 0:
            return -1
    return count


@njit(borrows=True)
def side_around(a: int, b: int, tri: Ints, twin: Ints, out: Ints) -> int:
    """Return the half-edge from a to b, found by turning around a, or -1."""
    start = out[a]
    e = start
    for _ in range(tri.size):
        if tri[next_side(e)] == b:
            return e
        e = twin[previous_side(e)]
        if e == start or e < 0:
            break
    return -1


@njit(borrows=True)
def find_side(a: int, b: int, tri: Ints, twin: Ints, out: Ints) -> int:
    """Return the half-edge from a to b, or -1.

    Around a corner of the outer triangle the turn may end too early; then b has it.
    """
    e = side_around(a, b, tri, twin, out)
    if e >= 0:
        return e
    f = side_around(b, a, tri, twin, out)
    return twin[f] if f >= 0 else -1


@njit(borrows=True)
def mark(e: int, k: int, twin: Ints, segment: Ints) -> bool:
    """Lay ring segment k on half-edge e; False if another segment lies there already."""
    if segment[e] != FREE:
        return False
    segment[e] = k
    segment[twin[e]] = BLOCKED
    return True


@njit(borrows=True)
def first_crossing(
    a: int, b: int, x: Floats, y: Floats, tri: Ints, twin: Ints, out: Ints
) -> tuple[int, int]:
    """Where the segment a-b leaves the triangles around a.

    The half-edge it crosses, or a vertex on its way (-1, vertex).
    """
    start = out[a]
    e = start
    for _ in range(tri.size):
        u, v = tri[next_side(e)], tri[previous_side(e)]
        side_u = orient(x[a], y[a], x[b], y[b], x[u], y[u])
        if side_u == 0.0 and (x[u] - x[a]) * (x[b] - x[a]) + (y[u] - y[a]) * (y[b] - y[a]) > 0.0:
            return -1, u
        if side_u < 0.0 and orient(x[a], y[a], x[b], y[b], x[v], y[v]) > 0.0:
            return next_side(e), -1
        e = twin[previous_side(e)]
        if e == start or e < 0:
            break
    return -1, -1


@njit(borrows=True)
def crossed_edges(
    a: int,
    b: int,
    e: int,
    crossed: Ints,
    x: Floats,
    y: Floats,
    tri: Ints,
    twin: Ints,
    segment: Ints,
) -> tuple[int, int]:
    """Collect the edges (as vertex pairs) that a-b crosses from half-edge e on.

    Return their number and -1, or the first vertex found exactly on a-b, or -2 where another
    segment is crossed.
    """
    count = 0
    for _ in range(tri.size):
        if segment[e] != FREE:
            break
        crossed[2 * count], crossed[2 * count + 1] = tri[e], tri[next_side(e)]
        count += 1
        f = twin[e]
        w = tri[previous_side(f)]
        if w == b:
            return count, -1
        side = orient(x[a], y[a], x[b], y[b], x[w], y[w])
        if side == 0.0:
            return count, w
        # f runs from left to right and w closes its triangle: the next crossing is between w and
        # whichever end of f lies across a-b from it.
        e = next_side(f) if side > 0.0 else previous_side(f)
    return count, -2


@njit(borrows=True)
def force_segment(
    a: int,
    b: int,
    crossed: Ints,
    count: int,
    made: Ints,
    x: Floats,
    y: Floats,
    tri: Ints,
    twin: Ints,
    segment: Ints,
    out: Ints,
) -> int:
    """Flip the ``count`` crossed edges until a-b is an edge; return how many edges were made.

    An edge whose two triangles form no convex quadrilateral waits for its neighbours. The edges
    are gone through back and forth as long as that helps: along a straight bank each waits for the
    one after it, which going one way only would make quadratic. -1 if it does not end.
    """
    n_made, forward = 0, True
    for _ in range(2 * count + 16):
        kept = 0
        for i in range(count):
            at = i if forward else count - 1 - i
            put = kept if forward else count - 1 - kept
            u, v = crossed[2 * at], crossed[2 * at + 1]
            e = find_side(u, v, tri, twin, out)
            c, d = tri[previous_side(e)], tri[previous_side(twin[e])]
            if is_convex(x[u], y[u], x[v], y[v], x[c], y[c], x[d], y[d]):
                flip(e, tri, twin, segment, out)
                ends_meet = c in (a, b) or d in (a, b)
                side_c = orient(x[a], y[a], x[b], y[b], x[c], y[c])
                side_d = orient(x[a], y[a], x[b], y[b], x[d], y[d])
                if ends_meet or (side_c > 0.0) == (side_d > 0.0):
                    made[2 * n_made], made[2 * n_made + 1] = c, d
                    n_made += 1
                    continue
                u, v = c, d
            crossed[2 * put], crossed[2 * put + 1] = u, v
            kept += 1
        if not forward:
            for i in range(kept):
                at = count - kept + i
                crossed[2 * i], crossed[2 * i + 1] = crossed[2 * at], crossed[2 * at + 1]
        forward = not forward if kept < count else True
        count = kept
        if count == 0:
            return n_made
    return -1


@njit(borrows=True)
def restore_delaunay(
    made: Ints,
    n_made: int,
    x: Floats,
    y: Floats,
    tri: Ints,
    twin: Ints,
    segment: Ints,
    out: Ints,
) -> None:
    """Flip the edges that forcing a segment made, where a circle test asks for it."""
    for _ in range(DELAUNAY_PASSES):
        calm = True
        for i in range(n_made):
            e = find_side(made[2 * i], made[2 * i + 1], tri, twin, out)
            if e < 0 or segment[e] != FREE or twin[e] < 0:
                continue
            a, b, c = tri[e], tri[next_side(e)], tri[previous_side(e)]
            d = tri[previous_side(twin[e])]
            if should_flip(x[a], y[a], x[b], y[b], x[c], y[c], x[d], y[d]):
                flip(e, tri, twin, segment, out)
                made[2 * i], made[2 * i + 1] = c, d
                calm = False
        if calm:
            return


@njit()
def insert_segments(
    ring_next: Ints,
    same: Ints,
    touches: Ints,
    x: Floats,
    y: Floats,
    tri: Ints,
    twin: Ints,
    segment: Ints,
    out: Ints,
) -> int:
    """Force every ring segment k, from vertex k to ring_next[k], into the triangulation.

    ``touches[k]`` becomes a vertex that lies inside segment k, where there is one. Return 0, or
    1 + k for a segment that crosses or repeats another.
    """
    n = ring_next.size
    crossed = np.empty(2 * tri.size, np.intp)
    made = np.empty(2 * tri.size, np.intp)
    for k in range(n):
        a, b = same[k], same[ring_next[k]]
        e = find_side(a, b, tri, twin, out)
        if e < 0:
            start, on_way = first_crossing(a, b, x, y, tri, twin, out)
            if on_way >= 0:
                touches[k] = on_way
                continue
            if start < 0:
                return 1 + k
            count, on_way = crossed_edges(a, b, start, crossed, x, y, tri, twin, segment)
            if on_way >= 0:
                touches[k] = on_way
                continue
            if on_way == -2:
                return 1 + k
            n_made = force_segment(a, b, crossed, count, made, x, y, tri, twin, segment, out)
            if n_made < 0:
                return 1 + k
            e = find_side(a, b, tri, twin, out)
            if not mark(e, k, twin, segment):
                return 1 + k
            restore_delaunay(made, n_made, x, y, tri, twin, segment, out)
        elif not mark(e, k, twin, segment):
            return 1 + k
    return 0


@njit()
def keep_inside(
    count: int, n_segments: int, tri: Ints, twin: Ints, segment: Ints
) -> tuple[Ints, Ints, Ints, Ints]:
    """Keep the triangles that can be reached from the left of a segment without crossing one.

    Return tri, twin and segment of the kept triangles and the half-edge of each segment; sides
    on a segment have no twin any more.
    """
    place = np.full(count, -1, np.intp)
    stack = np.empty(count, np.intp)
    kept, size = 0, 0
    for e in range(3 * count):
        if segment[e] >= 0 and place[e // 3] < 0:
            place[e // 3] = kept
            stack[kept] = e // 3
            kept += 1
    while size < kept:
        t = stack[size]
        size += 1
        for e in range(3 * t, 3 * t + 3):
            f = twin[e]
            if segment[e] == FREE and f >= 0 and place[f // 3] < 0:
                place[f // 3] = kept
                stack[kept] = f // 3
                kept += 1
    new_tri = np.empty(3 * kept, np.intp)
    new_twin = np.full(3 * kept, -1, np.intp)
    new_segment = np.full(3 * kept, FREE, np.intp)
    side_of_segment = np.full(n_segments, -1, np.intp)
    for i in range(kept):
        for side in range(3):
            e, new = 3 * stack[i] + side, 3 * i + side
            new_tri[new] = tri[e]
            if segment[e] >= 0:
                new_segment[new] = segment[e]
                side_of_segment[segment[e]] = new
            elif segment[e] == FREE and twin[e] >= 0:
                new_twin[new] = 3 * place[twin[e] // 3] + twin[e] % 3
    return new_tri, new_twin, new_segment, side_of_segment


@njit(entry=True)
def triangulate_rings(
    x: Floats, y: Floats, ring_next: Ints
) -> tuple[int, Ints, Ints, Ints, Ints, Ints, Ints]:
    """Triangulate what lies to the left of the rings.

    Parameters
    ----------
    x, y : (n,) vertices of all rings, no ring closed by a repeated vertex
    ring_next : (n,) the vertex after each one, so that segment k runs from k to ring_next[k]

    Returns
    -------
    status : 0; 1 + k if segment k crosses or repeats another; -1 if a walk did not end
    tri, twin, segment : (3 m,) half-edges as drawn above, of the m triangles inside
    side_of_segment : (n,) the half-edge that ring segment k lies on
    same : (n,) the first vertex with the same coordinates
    touches : (n,) a vertex that lies inside segment k, or -1. Where there is one, nothing else
        is valid: insert it into the ring and call again

    Notes
    -----
    O(n log n) expected for rings of any shape.
    """
    n = x.size
    all_x, all_y = with_places(x, n + 3), with_places(y, n + 3)
    (left, right), (low, high) = range_of(x), range_of(y)
    middle_x, middle_y = (left + right) / 2.0, (low + high) / 2.0
    far = REACH * max(right - left, high - low)
    all_x[n], all_y[n] = middle_x - 2.0 * far, middle_y - far
    all_x[n + 1], all_y[n + 1] = middle_x + 2.0 * far, middle_y - far
    all_x[n + 2], all_y[n + 2] = middle_x, middle_y + 2.0 * far
    size = 3 * (2 * n + 1)
    tri, twin = np.full(size, -1, np.intp), np.full(size, -1, np.intp)
    segment, out = np.full(size, FREE, np.intp), np.zeros(n + 3, np.intp)
    same, touches = np.full(n, -1, np.intp), np.full(n, -1, np.intp)
    nothing = np.empty(0, np.intp)
    count = insert_all(n, all_x, all_y, tri, twin, segment, out, same)
    if count < 0:
        return -1, nothing, nothing, nothing, nothing, same, touches
    status = insert_segments(ring_next, same, touches, all_x, all_y, tri, twin, segment, out)
    if status != 0 or range_of(touches)[1] >= 0:
        return status, nothing, nothing, nothing, nothing, same, touches
    tri, twin, segment, side_of_segment = keep_inside(count, n, tri, twin, segment)
    return 0, tri, twin, segment, side_of_segment, same, touches
