r"""What a point sees of the auxiliary curve while it walks along one side of the main curve.

Windows, as in ``windows``, but each is open for an interval of t only: where P passes the line of
two vertices, what they hide from each other changes. That line is passed once, and where is the
root of a linear function whose signs at the two ends are exact.

                 w          a window shows w while P is between the lines by ``right`` and ``left``
         left.       . right
             \\  .  .  /
              \\   .  /      there it is parted; before and behind, one of the two sides beyond gets
          a ---\\-.--/--- b  all of it
                P

A boundary side in view offers its point nearest to P. Which kind of point that is changes where
the shares of foot, ends, grazes and limits along the side change their order.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.bernstein import roots_inside
from midrib.kernels.boxtree import FOOT, GRAZE, LIMIT, VERTEX
from midrib.kernels.chain import TIE_OF_COORDINATE, Chain
from midrib.kernels.envelope import (
    Motions,
    Walk,
    farthest_between,
    has_room,
    is_lower,
    lower_by,
    new_motions,
    where_farther,
)
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.predicates import orient
from midrib.kernels.triangulation import next_side, previous_side
from midrib.kernels.visibility import WINDOWS_PER_SIDE, squared_distance_to_side
from midrib.types import Floats, Ints

__all__ = ["Outlook", "Scene", "look_along", "new_outlook", "scene_of", "walk_along"]

FRESH = 6
FIRST, LAST, AT_FOOT, LOW, HIGH = 0, 1, 2, 3, 4
NO_LIMIT = 2.0**500  # infinite shares could not be compared
BUCKETS = 256  # of windows about equally near: eight for each doubling of the squared distance
FREE = BUCKETS


class Scene(NamedTuple):
    """A mesh, and where the auxiliary curve lies on it: of ``Mesh``, ``Chain`` and ``Goal``."""

    tri: Ints
    twin: Ints
    x: Floats
    y: Floats
    segment: Ints  # for each half-edge the curve's segment on it, or -1
    place: Ints  # for each mesh vertex its place on the curve, or -1
    main_place: Ints  # for each one inside the main curve its place, with the boundary; or -1
    vertex: Ints
    arc: Floats
    scale_x: float
    scale_y: float
    tie: float
    extent: float  # no two points are farther apart


class Outlook(NamedTuple):
    """Tables that are kept from one side to the next."""

    motions: Motions
    window: Ints  # (k, 3) side, right, left; the first FRESH rows are those of the latest parting
    span: Floats  # (k, 2) from, to
    near: Floats  # (k,) square of the distance to the side from the middle of the walk
    queue: Ints  # (BUCKETS + 1,) of each bucket, nearest first, a row that waits, or -1; a free row
    link: Ints  # (k,) the next row in the same bucket, or the next free one, or -1
    share: Floats  # (5, 4) n and m at 0 and 1 of the ends, the foot and the limits


@njit()
def scene_of(mesh: Mesh, main: Chain, chain: Chain, scale_x: float, scale_y: float) -> Scene:
    """Prepare to look from the main curve for the other one; O(n)."""
    segment, place = np.full(mesh.tri.size, -1, np.intp), np.full(mesh.x.size, -1, np.intp)
    for i in range(chain.vertex.size):
        place[chain.vertex[i]] = i
    for i in range(chain.side.size):
        segment[chain.side[i]] = i
    largest, low, high = 0.0, np.inf, -np.inf
    for v in range(mesh.x.size):
        x, y = mesh.x[v] * scale_x, mesh.y[v] * scale_y
        largest = max(largest, abs(x), abs(y))
        low, high = min(low, x, y), max(high, x, y)
    return Scene(
        mesh.tri,
        mesh.twin,
        mesh.x,
        mesh.y,
        segment,
        place,
        main_places(mesh, main, chain, place),
        chain.vertex,
        chain.arc,
        scale_x,
        scale_y,
        TIE_OF_COORDINATE * largest,
        2.0 * (high - low),
    )


@njit()
def main_places(mesh: Mesh, main: Chain, chain: Chain, place: Ints) -> Ints:
    """Places of vertices inside the main curve; none where the curves meet there, or bridges lead.

    A side from one of them to a later one cuts off a pocket, whose only boundary outside of holes
    is the part of the main curve in between.
    """
    found, last = np.full(mesh.x.size, -1, np.intp), main.side.size
    is_with = mesh.tri[main.side[0]] == main.vertex[0]
    is_apart = np.all(chain.side >= 0)
    for i in range(1, last):
        is_apart = is_apart and place[main.vertex[i]] < 0
    for i in range(1, last if is_apart else 0):
        found[main.vertex[i]] = i if is_with else last - i
    return found


@njit(borrows=True)
def walk_along(scene: Scene, a: int, b: int) -> Walk:
    """Walk from vertex a to vertex b."""
    ax, ay = scene.x[a] * scene.scale_x, scene.y[a] * scene.scale_y
    return Walk(a, b, ax, ay, scene.x[b] * scene.scale_x, scene.y[b] * scene.scale_y)


@njit()
def new_outlook(windows: int, pieces: int) -> Outlook:
    """Empty tables for so many windows that wait and so many pieces."""
    return Outlook(
        new_motions(pieces),
        np.empty((windows, 3), np.intp),
        np.empty((windows, 2)),
        np.empty(windows),
        np.empty(BUCKETS + 1, np.intp),
        np.empty(windows, np.intp),
        np.empty((5, 4)),
    )


@njit(borrows=True)
def look_along(
    scene: Scene,
    walk: Walk,
    side: int,
    start: float,
    stop: float,
    limit: Floats,
    outlook: Outlook,
) -> int:
    """Write the envelope of what P sees from start to stop; the number of pieces.

    ``limit`` holds the least arc length that counts, at 0 and at 1, and the greatest. Negative if
    the tables are too small.
    """
    window, span, share = outlook.window, outlook.span, outlook.share
    near, queue, link = outlook.near, outlook.queue, outlook.link
    row, at, work, base = outlook.motions
    tri, twin, x, y, segment, place = (
        scene.tri, scene.twin, scene.x, scene.y, scene.segment, scene.place,
    )  # fmt: skip
    scale_x, scale_y = scene.scale_x, scene.scale_y
    has_limits = limit[0] > -np.inf or limit[2] < np.inf
    middle, half = (start + stop) / 2.0, (stop - start) / 2.0
    px, py = walk.ax + middle * (walk.bx - walk.ax), walk.ay + middle * (walk.by - walk.ay)
    reach = half * length(walk.bx - walk.ax, walk.by - walk.ay)
    px, py = px / scale_x, py / scale_y
    for i in range(BUCKETS + 1):
        queue[i] = -1
    # 1. The side itself, for its ends, and the other two of its triangle.
    u, v, w = tri[side], tri[next_side(side)], tri[previous_side(side)]
    fresh = add_window(window, span, 0, side, u, v, start, stop)
    fresh = add_window(window, span, fresh, previous_side(side), w, u, start, stop)
    fresh = add_window(window, span, fresh, next_side(side), v, w, start, stop)
    bound, count = np.inf, 0
    first, used = let_wait(scene, px, py, bound, fresh, BUCKETS, FRESH, outlook)
    for _ in range(WINDOWS_PER_SIDE * tri.size):
        while first < BUCKETS and queue[first] < 0:
            first += 1
        if first == BUCKETS:
            break
        k = queue[first]
        queue[first], link[k], queue[FREE] = link[k], queue[FREE], k
        e, right, left = window[k, 0], window[k, 1], window[k, 2]
        # 2. What cannot be nearer than what is known is left out.
        u, v = tri[e], tri[next_side(e)]
        least = max(np.sqrt(near[k]) - reach, 0.0)
        low, high = where_farther(row, count, span[k, 0], span[k, 1], least * least)
        if not low < high:
            continue
        # 3. An open side is parted, boundary makes its offers.
        if twin[e] >= 0:
            if used + FRESH > window.shape[0]:
                return -1
            w = tri[previous_side(twin[e])]
            fresh = part(x, y, walk.a, walk.b, twin[e], w, right, left, low, high, window, span, 0)
            first, used = let_wait(scene, px, py, bound, fresh, first, used, outlook)
            continue
        new = 2 * base
        if segment[e] >= 0:
            row[new, 6], row[new, 7] = x[u] * scale_x, y[u] * scale_y
            row[new, 8], row[new, 9] = (x[v] - x[u]) * scale_x, (y[v] - y[u]) * scale_y
            if has_limits:
                write_limits(scene, e, u, limit, share)
            offers = offer_side(
                x, y, walk, e, u, v, right, left, low, high, has_limits, row, at, work, share, new
            )
        elif place[u] >= 0 or place[v] >= 0:
            offers = offer_ends(scene, walk, e, right, left, low, high, limit, row, at, new)
        else:
            offers = 0
        for i in range(offers):
            if not is_lower(walk, row, work, count, new + i):
                continue
            if not has_room(base, count):
                return -1
            count = lower_by(walk, row, at, work, base, count, new + i)
            bound = np.sqrt(farthest_between(row, count, start, stop)) + reach
    return count


@njit(inline=True, borrows=True)
def add_window(
    window: Ints, span: Floats, depth: int, e: int, right: int, left: int, a: float, b: float
) -> int:
    """Append a window; return the new number of them."""
    window[depth, 0], window[depth, 1], window[depth, 2] = e, right, left
    span[depth, 0], span[depth, 1] = a, b
    return depth + 1


@njit(borrows=True)
def let_wait(
    scene: Scene,
    px: float,
    py: float,
    bound: float,
    fresh: int,
    first: int,
    used: int,
    outlook: Outlook,
) -> tuple[int, int]:
    """Put fresh windows in the queue, but for those farther than ``bound`` or with nothing behind.

    The nearest are looked through first, so hardly any that is farther than the answer: in a star
    of 1,000 vertices a quarter of what a depth first search looks through. With a heap instead of
    buckets the search took nearly twice as long. Return the first bucket with a window, and the
    number of rows that have been in use.
    """
    window, span, queue, link = outlook.window, outlook.span, outlook.queue, outlook.link
    x, y, last = scene.x, scene.y, bits_of(scene.extent * scene.extent) + 1
    for i in range(fresh):
        e = window[i, 0]
        u, v = scene.tri[e], scene.tri[next_side(e)]
        if scene.twin[e] >= 0:
            if 0 <= scene.main_place[u] < scene.main_place[v]:
                continue
        elif scene.place[u] < 0 and scene.place[v] < 0:
            continue
        squared = squared_distance_to_side(
            px, py, x[u], y[u], x[v], y[v], scene.scale_x, scene.scale_y
        )
        if squared > bound * bound:
            continue
        k = queue[FREE]
        if k >= 0:
            queue[FREE] = link[k]
        else:
            k, used = used, used + 1
        add_window(window, span, k, e, window[i, 1], window[i, 2], span[i, 0], span[i, 1])
        outlook.near[k] = squared
        bucket = max(BUCKETS - 1 - max(last - bits_of(squared), 0), 0)
        link[k], queue[bucket] = queue[bucket], k
        first = min(first, bucket)
    return first, used


@njit(inline=True, borrows=True)
def bits_of(squared: float) -> int:
    """Return the exponent of a number and the first three of its other bits, as one number."""
    return int(np.float64(squared).view(np.int64)) >> 49


@njit(inline=True, borrows=True)
def turn(x: Floats, y: Floats, p: int, v: int, w: int) -> float:
    """How far w is to the left of the ray from p by v; linear in p."""
    return orient(x[p], y[p], x[v], y[v], x[w], y[w])


@njit(inline=True, borrows=True)
def value_at(at_a: float, at_b: float, t: float) -> float:
    """Value of a linear function; its sign is that of its ends where they agree."""
    return (1.0 - t) * at_a + t * at_b


@njit(inline=True, borrows=True)
def root_of(at_a: float, at_b: float) -> float:
    """Where a linear function is zero, or 0 if it does not change its sign."""
    changes = (at_a > 0.0 and at_b < 0.0) or (at_a < 0.0 and at_b > 0.0)
    return at_a / (at_a - at_b) if changes else 0.0


@njit(borrows=True)
def part(
    x: Floats,
    y: Floats,
    a: int,
    b: int,
    f: int,
    w: int,
    right: int,
    left: int,
    low: float,
    high: float,
    window: Ints,
    span: Floats,
    depth: int,
) -> int:
    """Part a window among the two sides behind it, interval by interval; new number of windows.

    ``f`` is the half-edge behind the window, w the vertex across from it. Along the line a b a
    window has no width, but is open.
    """
    right_a, right_b = turn(x, y, a, right, w), turn(x, y, b, right, w)
    left_a, left_b = turn(x, y, a, left, w), turn(x, y, b, left, w)
    first, second = root_of(right_a, right_b), root_of(left_a, left_b)
    first, second = min(first, second), max(first, second)
    first, second = min(max(first, low), high), min(max(second, low), high)
    start = low
    for k in range(3):
        stop = first if k == 0 else second if k == 1 else high
        if not start < stop:
            continue
        t = (start + stop) / 2.0
        by_right, by_left = value_at(right_a, right_b, t), value_at(left_a, left_b, t)
        if by_left <= 0.0:
            end = w if by_right > 0.0 else right
            depth = add_window(window, span, depth, previous_side(f), end, left, start, stop)
        if by_right >= 0.0:
            end = w if by_left < 0.0 else left
            depth = add_window(window, span, depth, next_side(f), right, end, start, stop)
        start = stop
    return depth


# -- offers ----------------------------------------------------------------------------------------


@njit(borrows=True)
def cut_off(x: Floats, y: Floats, a: int, b: int, ray: int, end: int, t: float) -> float:
    """How far the ray by a vertex passes an end of a side on the left; 0 where it is the end."""
    if ray == end:
        return 0.0
    return value_at(turn(x, y, a, ray, end), turn(x, y, b, ray, end), t)


@njit(borrows=True)
def write_graze(
    x: Floats, y: Floats, a: int, b: int, ray: int, u: int, v: int, share: Floats, i: int
) -> None:
    """Write where the ray from P by a vertex meets the side u v, as row i."""
    u_a, u_b = turn(x, y, a, ray, u), turn(x, y, b, ray, u)
    m_a, m_b = u_a - turn(x, y, a, ray, v), u_b - turn(x, y, b, ray, v)
    if ray == a:  # the ray runs along P's own side
        u_a, m_a = u_b, m_b
    elif ray == b:
        u_b, m_b = u_a, m_a
    unit = m_a if abs(m_a) > abs(m_b) else m_b
    share[i, 0], share[i, 1] = u_a / unit, u_b / unit
    share[i, 2], share[i, 3] = m_a / unit, m_b / unit


@njit(inline=True, borrows=True)
def write_linear(share: Floats, i: int, at_a: float, at_b: float) -> None:
    """Write a share that is linear in t."""
    share[i, 0], share[i, 1], share[i, 2], share[i, 3] = at_a, at_b, 1.0, 1.0


@njit(borrows=True)
def quotient_at(share: Floats, i: int, t: float) -> tuple[float, float]:
    """Return n and m of a share at t."""
    n = share[i, 0] + t * (share[i, 1] - share[i, 0])
    return n, share[i, 2] + t * (share[i, 3] - share[i, 2])


@njit(borrows=True)
def share_at(share: Floats, i: int, t: float) -> float:
    """Share at t."""
    n, m = quotient_at(share, i, t)
    return n / m


@njit(borrows=True)
def cut_by_order(share: Floats, work: Floats, used: int, low: float, high: float) -> int:
    """Write the t at which two of the shares in use are equal as row 3, in order; their number.

    The ends of a window never are.
    """
    count = 0
    for i in range(AT_FOOT, used):
        n_a, m_a = quotient_at(share, i, low)
        n_b, m_b = quotient_at(share, i, high)
        for j in range(i):
            k_a, l_a = quotient_at(share, j, low)
            k_b, l_b = quotient_at(share, j, high)
            work[2, 0], work[2, 2] = n_a * l_a - k_a * m_a, n_b * l_b - k_b * m_b
            work[2, 1] = (n_a * l_b + n_b * l_a - k_a * m_b - k_b * m_a) / 2.0
            count = roots_inside(work, 2, 2, low, high, 3, count)
    for i in range(1, count):
        j, cut = i, work[3, i]
        while j > 0 and work[3, j - 1] > cut:
            work[3, j] = work[3, j - 1]
            j -= 1
        work[3, j] = cut
    return count


@njit(borrows=True)
def offer_side(
    x: Floats,
    y: Floats,
    walk: Walk,
    e: int,
    u: int,
    v: int,
    right: int,
    left: int,
    low: float,
    high: float,
    has_limits: bool,
    row: Floats,
    at: Ints,
    work: Floats,
    share: Floats,
    i: int,
) -> int:
    """Write the nearest point of what a window shows of a side on the curve, from row i on.

    Row i holds the side, ``share`` the limits if there are any. Return the number of offers.
    """
    middle = (low + high) / 2.0
    # 1. Ends, or where the view cuts them off.
    at_first, at_last, used = u, v, 3
    write_linear(share, FIRST, 0.0, 0.0)
    write_linear(share, LAST, 1.0, 1.0)
    if cut_off(x, y, walk.a, walk.b, right, u, middle) < 0.0:
        at_first = right
        write_graze(x, y, walk.a, walk.b, right, u, v, share, FIRST)
    if cut_off(x, y, walk.a, walk.b, left, v, middle) > 0.0:
        at_last = left
        write_graze(x, y, walk.a, walk.b, left, u, v, share, LAST)
    # 2. The foot.
    ux, uy, dx, dy = row[i, 6], row[i, 7], row[i, 8], row[i, 9]
    squared, foot_a, foot_b = dx * dx + dy * dy, 0.0, 0.0
    if squared > 0.0:
        foot_a = ((walk.ax - ux) * dx + (walk.ay - uy) * dy) / squared
        foot_b = ((walk.bx - ux) * dx + (walk.by - uy) * dy) / squared
    write_linear(share, AT_FOOT, foot_a, foot_b)
    if has_limits:
        used = 5
    # 3. Between two changes of their order the foot, or the end next to it, is the nearest.
    cuts = cut_by_order(share, work, used, low, high)
    start, offers = low, 0
    for k in range(cuts + 1):
        stop = work[3, k] if k < cuts else high
        if not start < stop:
            continue
        t = (start + stop) / 2.0
        first, last = FIRST, LAST
        if has_limits and share_at(share, LOW, t) > share_at(share, FIRST, t):
            first = LOW
        if has_limits and share_at(share, HIGH, t) < share_at(share, LAST, t):
            last = HIGH
        from_share, to_share = share_at(share, first, t), share_at(share, last, t)
        new = i + offers
        row[new, 0], row[new, 1] = start, stop
        start = stop
        if has_limits and from_share > to_share:  # else the window has no width, but for rounding
            continue
        foot = share_at(share, AT_FOOT, t)
        nearest = first if foot <= from_share else last if foot >= to_share else AT_FOOT
        at[new, 0], at[new, 1], at[new, 2], at[new, 3], at[new, 4] = e, FOOT, -1, u, v
        if nearest == FIRST:
            at[new, 1], at[new, 2] = VERTEX if at_first == u else GRAZE, at_first
        elif nearest == LAST:
            at[new, 1], at[new, 2] = VERTEX if at_last == v else GRAZE, at_last
        elif nearest != AT_FOOT:
            at[new, 1] = LIMIT
        for m in range(4):
            row[new, 2 + m] = share[nearest, m]
        row[new, 6], row[new, 7], row[new, 8], row[new, 9] = ux, uy, dx, dy
        offers += 1
    return offers


@njit(borrows=True)
def write_limits(scene: Scene, e: int, u: int, limit: Floats, share: Floats) -> None:
    """Write where the least and the greatest arc length that counts are on a side."""
    j = scene.segment[e]
    arc, length = scene.arc[j], scene.arc[j + 1] - scene.arc[j]
    is_forward = scene.vertex[j] == u
    for i in range(2):
        least = max((limit[i] - arc) / length, -NO_LIMIT)
        greatest = min((limit[2 + i] - arc) / length, NO_LIMIT)
        share[LOW, i] = least if is_forward else 1.0 - greatest
        share[HIGH, i] = greatest if is_forward else 1.0 - least
        share[LOW, 2 + i] = share[HIGH, 2 + i] = 1.0


@njit(borrows=True)
def offer_ends(
    scene: Scene,
    walk: Walk,
    e: int,
    right: int,
    left: int,
    low: float,
    high: float,
    limit: Floats,
    row: Floats,
    at: Ints,
    i: int,
) -> int:
    """Write the ends of a side that is not on the curve, if they are, from row i on; how many."""
    offers, x, y = 0, scene.x, scene.y
    for end in range(2):
        v = scene.tri[e if end == 0 else next_side(e)]
        if scene.place[v] < 0:
            continue
        ray = right if end == 0 else left
        cut = cut_off(x, y, walk.a, walk.b, ray, v, (low + high) / 2.0)
        if cut < 0.0 if end == 0 else cut > 0.0:
            continue
        # The interval in which its arc length counts: the limits are linear.
        arc, start, stop = scene.arc[scene.place[v]], low, high
        for bound in range(2):
            if np.isinf(limit[2 * bound]):
                continue
            at_a, at_b = limit[2 * bound] - arc, limit[2 * bound + 1] - arc
            if bound == 1:
                at_a, at_b = -at_a, -at_b
            is_late, is_early = value_at(at_a, at_b, low) > 0.0, value_at(at_a, at_b, high) > 0.0
            if is_late and is_early:
                start = stop
            elif is_late or is_early:
                root = min(max(at_a / (at_a - at_b), start), stop)
                start, stop = (root, stop) if is_late else (start, root)
        new = i + offers
        row[new, 0], row[new, 1] = start, stop
        row[new, 2] = row[new, 3] = float(end)
        row[new, 8] = row[new, 9] = 0.0  # it stays where it is
        row[new, 4] = row[new, 5] = 1.0
        row[new, 6], row[new, 7] = x[v] * scene.scale_x, y[v] * scene.scale_y
        at[new, 0], at[new, 1], at[new, 2] = e, VERTEX, v
        at[new, 3] = at[new, 4] = v
        if start < stop:
            offers += 1
    return offers
