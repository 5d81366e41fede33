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
from midrib.kernels.places import FURTHEST, place
from midrib.kernels.predicates import in_circle, orient
from midrib.kernels.tables import range_of, with_places
from midrib.types import Floats, Ints, Places

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
def join(e: int, f: int, twin: Places) -> None:
    """Make e and f two sides of one edge; f may be -1."""
    twin[e] = f
    if f >= 0:
        twin[f] = e


@njit(borrows=True)
def write_triangle(e: int, a: int, b: int, c: int, tri: Places, out: Places) -> None:
    """Write a b c at the three half-edges from e; remember a half-edge that leaves each."""
    tri[e], tri[e + 1], tri[e + 2] = a, b, c
    out[a], out[b], out[c] = e, e + 1, e + 2


@njit(borrows=True)
def flip(e: int, tri: Places, twin: Places, segment: Places, out: Places) -> None:
    """Replace the diagonal e = a-b by c-d; c ends at the last place of both triangles."""
    e = place(e)
    f = place(twin[e])
    e_next, e_previous = next_side(e), previous_side(e)
    f_next, f_previous = next_side(f), previous_side(f)
    on_bc, on_ca = segment[e_next], segment[e_previous]
    on_ad, on_db = segment[f_next], segment[f_previous]
    first, second = e - e % 3, f - f % 3
    flip_free(e, tri, twin, out)
    segment[first], segment[first + 1], segment[first + 2] = on_ad, FREE, on_ca
    segment[second], segment[second + 1], segment[second + 2] = on_db, on_bc, FREE


@njit(borrows=True)
def flip_free(e: int, tri: Places, twin: Places, out: Places) -> None:
    """``flip`` where no segments are, as long as only vertices go in."""
    e = place(e)
    f = place(twin[e])
    e_next, e_previous = next_side(e), previous_side(e)
    f_next, f_previous = next_side(f), previous_side(f)
    a, b, c, d = tri[e], tri[f], tri[e_previous], tri[f_previous]
    bc, ca, ad, db = twin[e_next], twin[e_previous], twin[f_next], twin[f_previous]
    first, second = e - e % 3, f - f % 3
    write_triangle(first, a, d, c, tri, out)
    write_triangle(second, d, b, c, tri, out)
    join(first, ad, twin)
    join(first + 1, second + 2, twin)
    join(first + 2, ca, twin)
    join(second, db, twin)
    join(second + 1, bc, twin)


@njit(borrows=True)
def locate(
    px: float, py: float, e: int, x: Floats, y: Floats, tri: Places, twin: Places
) -> tuple[int, bool]:
    """Return a half-edge of the triangle that holds p: the side p lies on, or the first one.

    And whether p lies on it.

    The walk leaves each triangle through a side that has p beyond it; the caller starts it near
    p. Which side is tried first is drawn anew in every triangle: in a fixed order the walk can
    go round in circles where flat triangles are Delaunay only up to rounding.
    Source: O. Devillers, S. Pion, M. Teillaud, Walking in a Triangulation, 2002.
    """
    e = place(e)
    e -= e % 3
    came_from = -1
    draw = 1
    for _ in range(4 * tri.size):
        moved = False
        on = -1
        draw = (draw * 1103515245 + 12345) & 0x7FFFFFFF
        for turn_of in range(3):
            k = (turn_of + (draw >> 16)) % 3
            side = e + k
            if side == came_from:
                continue
            a, b = tri[side], tri[side + 1 if k < 2 else e]
            turn = orient(x[a], y[a], x[b], y[b], px, py)
            if turn < 0.0:
                came_from = place(twin[side])
                e = came_from - came_from % 3
                moved = True
                break
            if turn == 0.0:
                on = side
        if not moved:
            return (on, True) if on >= 0 else (e, False)
    return -1, False


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
    stack: Places,
    size: int,
    x: Floats,
    y: Floats,
    tri: Places,
    twin: Places,
    out: Places,
) -> None:
    """Flip the edges across from the new vertex p as long as one should be; p gets each."""
    while size > 0:
        size -= 1
        e = place(stack[place(size)])
        if twin[e] < 0:
            continue
        f = place(twin[e])
        a, b, d = tri[e], tri[f], tri[previous_side(f)]
        if should_flip(x[a], y[a], x[b], y[b], x[p], y[p], x[d], y[d]):
            stack[place(size)], stack[place(size + 1)] = e - e % 3, f - f % 3
            flip_free(e, tri, twin, out)
            size += 2


@njit(borrows=True)
def insert_vertex(
    p: int,
    near: int,
    count: int,
    stack: Places,
    x: Floats,
    y: Floats,
    tri: Places,
    twin: Places,
    out: Places,
) -> tuple[int, int]:
    """Insert p, walking from the half-edge ``near``.

    Return the number of triangles and the vertex already at that place, or p itself (-1: the
    walk did not end).
    """
    e, on_edge = locate(x[p], y[p], near, x, y, tri, twin)
    if e < 0:
        return count, -1
    e, count = place(e), place(count)
    a, b, c = tri[e], tri[next_side(e)], tri[previous_side(e)]
    for v in (a, b, c):
        if x[v] == x[p] and y[v] == y[p]:
            return count, v
    bc, ca, f = twin[next_side(e)], twin[previous_side(e)], twin[e]
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
        legalise(p, stack, 3, x, y, tri, twin, out)
        return count + 2, p
    f = place(f)
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
    legalise(p, stack, 4, x, y, tri, twin, out)
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
    n: int, x: Floats, y: Floats, tri: Places, twin: Places, out: Places, same: Ints
) -> int:
    """Insert the vertices 0..n-1; return the number of triangles, -1 on failure.

    Each starts from the nearest one before it along the ring that is there already.
    """
    stack = np.empty(6 * n + 16, np.uint32)
    write_triangle(0, n, n + 1, n + 2, tri, out)
    count, near = 1, 0
    order, stride = coarse_to_fine(n)
    for p in order:
        if p > 0:
            near = out[same[p - min(p & -p, stride)]]
        count, same[p] = insert_vertex(p, near, count, stack, x, y, tri, twin, out)
        if same[p] < 0:
            return -1
    return count


@njit(borrows=True)
def side_around(a: int, b: int, tri: Places, twin: Places, out: Places) -> int:
    """Return the half-edge from a to b, found by turning around a, or -1."""
    start = place(out[a])
    e = start
    for _ in range(tri.size):
        if tri[next_side(e)] == b:
            return e
        f = twin[previous_side(e)]
        if f == start or f < 0:
            break
        e = place(f)
    return -1


@njit(borrows=True)
def find_side(a: int, b: int, tri: Places, twin: Places, out: Places) -> int:
    """Return the half-edge from a to b, or -1.

    Around a corner of the outer triangle the turn may end too early; then b has it.
    """
    e = side_around(a, b, tri, twin, out)
    if e >= 0:
        return e
    f = side_around(b, a, tri, twin, out)
    return twin[f] if f >= 0 else -1


@njit(borrows=True)
def mark(e: int, k: int, twin: Places, segment: Places) -> bool:
    """Lay ring segment k on half-edge e; False if another segment lies there already."""
    if segment[e] != FREE:
        return False
    segment[e] = k
    segment[twin[e]] = BLOCKED
    return True


@njit(borrows=True)
def first_crossing(
    a: int, b: int, x: Floats, y: Floats, tri: Places, twin: Places, out: Places
) -> tuple[int, int]:
    """Where the segment a-b leaves the triangles around a.

    The half-edge it crosses, or a vertex on its way (-1, vertex).
    """
    start = place(out[a])
    e = start
    for _ in range(tri.size):
        u, v = tri[next_side(e)], tri[previous_side(e)]
        side_u = orient(x[a], y[a], x[b], y[b], x[u], y[u])
        if side_u == 0.0 and (x[u] - x[a]) * (x[b] - x[a]) + (y[u] - y[a]) * (y[b] - y[a]) > 0.0:
            return -1, u
        if side_u < 0.0 and orient(x[a], y[a], x[b], y[b], x[v], y[v]) > 0.0:
            return next_side(e), -1
        f = twin[previous_side(e)]
        if f == start or f < 0:
            break
        e = place(f)
    return -1, -1


@njit(borrows=True)
def crossed_edges(
    a: int,
    b: int,
    e: int,
    crossed: Places,
    x: Floats,
    y: Floats,
    tri: Places,
    twin: Places,
    segment: Places,
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
    crossed: Places,
    count: int,
    made: Places,
    x: Floats,
    y: Floats,
    tri: Places,
    twin: Places,
    segment: Places,
    out: Places,
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
    made: Places,
    n_made: int,
    x: Floats,
    y: Floats,
    tri: Places,
    twin: Places,
    segment: Places,
    out: Places,
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
    tri: Places,
    twin: Places,
    segment: Places,
    out: Places,
) -> int:
    """Force every ring segment k, from vertex k to ring_next[k], into the triangulation.

    ``touches[k]`` becomes a vertex that lies inside segment k, where there is one. Return 0, or
    1 + k for a segment that crosses or repeats another.
    """
    n = ring_next.size
    crossed = np.empty(2 * tri.size, np.uint32)
    made = np.empty(2 * tri.size, np.uint32)
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
    count: int, n_segments: int, tri: Places, twin: Places, segment: Places
) -> tuple[Ints, Ints, Ints, bool]:
    """Keep the triangles that can be reached from the left of a segment without crossing one.

    Return tri and twin of the kept triangles and the half-edge of each segment; sides
    on a segment have no twin any more. And whether nothing on the right of a segment is kept, nor
    a corner of the outer triangle: then every hole is in the shell and in no other hole.
    """
    count = place(count)
    row, stack = np.full(count, -1, np.int32), np.empty(count, np.uint32)
    kept, size = 0, 0
    for t in range(count):
        e = 3 * place(t)
        if max(segment[e], segment[e + 1], segment[e + 2]) >= 0:
            row[t], stack[kept] = kept, t
            kept += 1
    while size < kept:
        e = 3 * place(stack[size])
        size += 1
        for side in range(3):
            f = twin[e + side]
            if segment[e + side] == FREE and f >= 0:
                t = place(f) // 3
                if row[t] < 0:
                    row[t], stack[kept] = kept, t
                    kept += 1
    new_tri, new_twin = np.empty(3 * kept, np.intp), np.empty(3 * kept, np.intp)
    side_of_segment, is_one_sided = np.full(n_segments, -1, np.intp), True
    for i in range(kept):
        e, new = 3 * place(stack[i]), 3 * place(i)
        for side in range(3):
            new_tri[new + side] = v = tri[e + side]
            on, f = segment[e + side], twin[e + side]
            is_one_sided = is_one_sided and on != BLOCKED and v < n_segments
            if on >= 0:
                side_of_segment[on] = new + side
            is_open = on == FREE and f >= 0
            new_twin[new + side] = 3 * row[place(f) // 3] + place(f) % 3 if is_open else -1
    return new_tri, new_twin, side_of_segment, is_one_sided


@njit(entry=True)
def triangulate_rings(
    x: Floats, y: Floats, ring_next: Ints
) -> tuple[int, Ints, Ints, Ints, Ints, Ints, bool]:
    """Triangulate what lies to the left of the rings.

    Parameters
    ----------
    x, y : (n,) vertices of all rings, no ring closed by a repeated vertex
    ring_next : (n,) the vertex after each one, so that segment k runs from k to ring_next[k]

    Returns
    -------
    status : 0; 1 + k if segment k crosses or repeats another; -1 if a walk did not end
    tri, twin : (3 m,) half-edges as drawn above, of the m triangles inside
    side_of_segment : (n,) the half-edge that ring segment k lies on
    same : (n,) the first vertex with the same coordinates
    touches : (n,) a vertex that lies inside segment k, or -1. Where there is one, nothing else
        is valid: insert it into the ring and call again
    is_valid : whether the rings are those of a valid area, with none that touch. They are simple
        and apart, as each segment is a side of triangles that do not overlap, and holes are in the
        shell only. False may be valid too

    Notes
    -----
    O(n log n) expected for rings of any shape.
    """
    n = x.size
    same, touches = np.full(n, -1, np.intp), np.full(n, -1, np.intp)
    nothing = np.empty(0, np.intp)
    all_x, all_y = with_places(x, n + 3), with_places(y, n + 3)
    (low_x, high_x), (low_y, high_y) = range_of(x), range_of(y)
    middle_x, middle_y = (low_x + high_x) / 2.0, (low_y + high_y) / 2.0
    far = REACH * max(high_x - low_x, high_y - low_y)
    all_x[n], all_y[n] = middle_x - 2.0 * far, middle_y - far
    all_x[n + 1], all_y[n + 1] = middle_x + 2.0 * far, middle_y - far
    all_x[n + 2], all_y[n + 2] = middle_x, middle_y + 2.0 * far
    size = 3 * (2 * n + 1)
    if size > FURTHEST:
        return -1, nothing, nothing, nothing, same, touches, False
    tri, twin = np.empty(size, np.uint32), np.full(size, -1, np.int32)
    segment, out = np.full(size, FREE, np.int32), np.zeros(n + 3, np.uint32)
    count = insert_all(n, all_x, all_y, tri, twin, out, same)
    if count < 0:
        return -1, nothing, nothing, nothing, same, touches, False
    status = insert_segments(ring_next, same, touches, all_x, all_y, tri, twin, segment, out)
    is_touched = False
    for k in range(n):
        is_touched = is_touched or touches[k] >= 0
    if status != 0 or is_touched:
        return status, nothing, nothing, nothing, same, touches, False
    kept = keep_inside(count, n, tri, twin, segment)
    is_valid = kept[3]
    for k in range(n):
        is_valid = is_valid and same[k] == k
    return 0, kept[0], kept[1], kept[2], same, touches, is_valid
