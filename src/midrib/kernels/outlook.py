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
from midrib.kernels.envelope import (
    Envelope,
    Scene,
    Walk,
    farthest_between,
    has_room,
    lower_by,
    new_envelope,
)
from midrib.kernels.jit import njit
from midrib.kernels.predicates import orient
from midrib.kernels.triangulation import next_side, previous_side
from midrib.kernels.visibility import WINDOWS_PER_SIDE, squared_distance_to_side
from midrib.types import Floats, Ints

__all__ = ["Outlook", "look_along", "new_outlook"]

FIRST, LAST, AT_FOOT, LOW, HIGH = 0, 1, 2, 3, 4
NO_LIMIT = 2.0**500  # infinite shares could not be compared
MOST_OFFERS = 64


class Outlook(NamedTuple):
    """Tables that are kept from one side to the next."""

    envelope: Envelope
    window: Ints  # (k, 3) side, right, left
    span: Floats  # (k, 2) from, to
    motion: Floats  # (MOST_OFFERS, 7) rows as the envelope's
    motion_at: Ints
    share: Floats  # (6, 4) n and m at 0 and 1 of the ends, the foot and the limits; coefficients
    cuts: Floats


@njit()
def new_outlook(windows: int, pieces: int) -> Outlook:
    """Empty tables for so many windows that wait and so many pieces."""
    return Outlook(
        new_envelope(pieces),
        np.empty((windows, 3), np.intp),
        np.empty((windows, 2)),
        np.empty((MOST_OFFERS, 7)),
        np.empty((MOST_OFFERS, 3), np.intp),
        np.empty((6, 4)),
        np.empty(MOST_OFFERS - 1),
    )


@njit()
def look_along(
    scene: Scene,
    walk: Walk,
    side: int,
    start: float,
    stop: float,
    limit: Floats,
    bound: float,
    outlook: Outlook,
) -> int:
    """Write the envelope of what P sees from start to stop; the number of pieces.

    ``limit`` holds the least arc length that counts, at 0 and at 1, and the greatest. What is
    farther than ``bound`` may be missing. Negative if the tables are too small.
    """
    window, span, envelope = outlook.window, outlook.span, outlook.envelope
    motion, motion_at = outlook.motion, outlook.motion_at
    tri, twin, x, y = scene.tri, scene.twin, scene.x, scene.y
    middle, half = (start + stop) / 2.0, (stop - start) / 2.0
    px, py = walk.ax + middle * (walk.bx - walk.ax), walk.ay + middle * (walk.by - walk.ay)
    reach = half * np.sqrt((walk.bx - walk.ax) ** 2 + (walk.by - walk.ay) ** 2)
    px, py = px / scene.scale_x, py / scene.scale_y
    # 1. The side itself, for its ends, and the other two of its triangle.
    u, v, w = tri[side], tri[next_side(side)], tri[previous_side(side)]
    depth = add_window(window, span, 0, side, u, v, start, stop)
    depth = add_window(window, span, depth, previous_side(side), w, u, start, stop)
    depth = add_window(window, span, depth, next_side(side), v, w, start, stop)
    count, left_to_do = 0, WINDOWS_PER_SIDE * tri.size
    while depth > 0 and left_to_do > 0:
        depth, left_to_do = depth - 1, left_to_do - 1
        e, right, left = window[depth, 0], window[depth, 1], window[depth, 2]
        low, high = span[depth, 0], span[depth, 1]
        # 2. What cannot be nearer than what is known is left out.
        u, v = tri[e], tri[next_side(e)]
        near = squared_distance_to_side(
            px, py, x[u], y[u], x[v], y[v], scene.scale_x, scene.scale_y
        )
        near = max(np.sqrt(near) - reach, 0.0)
        if near > bound or near * near > farthest_between(envelope.piece, count, low, high):
            continue
        # 3. An open side is parted, boundary makes its offers.
        if twin[e] >= 0:
            if depth + 6 > window.shape[0]:
                return -1
            depth = part(scene, walk, twin[e], right, left, low, high, window, span, depth)
            continue
        if scene.segment[e] >= 0:
            offers = offer_side(scene, walk, e, right, left, low, high, limit, outlook)
        else:
            offers = offer_ends(scene, walk, e, right, left, low, high, limit, outlook)
        for i in range(offers):
            if not has_room(envelope, count):
                return -1
            count = lower_by(scene, walk, envelope, count, motion[i], motion_at[i])
    return count


@njit(inline=True)
def add_window(
    window: Ints, span: Floats, depth: int, e: int, right: int, left: int, a: float, b: float
) -> int:
    """Append a window; return the new number of them."""
    window[depth, 0], window[depth, 1], window[depth, 2] = e, right, left
    span[depth, 0], span[depth, 1] = a, b
    return depth + 1


@njit()
def turns(scene: Scene, walk: Walk, v: int, w: int) -> tuple[float, float]:
    """How far w is to the left of the ray from P by v, seen from a and from b: linear between."""
    x, y, a, b = scene.x, scene.y, walk.a, walk.b
    at_a = orient(x[a], y[a], x[v], y[v], x[w], y[w])
    return at_a, orient(x[b], y[b], x[v], y[v], x[w], y[w])


@njit(inline=True)
def value_at(at_a: float, at_b: float, t: float) -> float:
    """Value of a linear function; its sign is that of its ends where they agree."""
    return (1.0 - t) * at_a + t * at_b


@njit(inline=True)
def root_of(at_a: float, at_b: float) -> float:
    """Where a linear function is zero, or 0 if it does not change its sign."""
    changes = (at_a > 0.0 and at_b < 0.0) or (at_a < 0.0 and at_b > 0.0)
    return at_a / (at_a - at_b) if changes else 0.0


@njit()
def part(
    scene: Scene, walk: Walk, f: int, right: int, left: int, low: float, high: float,
    window: Ints, span: Floats, depth: int,
) -> int:  # fmt: skip
    """Part a window among the two sides behind it, interval by interval; new number of windows.

    ``f`` is the half-edge behind the window. Along the line a b a window has no width, but is open.
    """
    w = scene.tri[previous_side(f)]
    right_a, right_b = turns(scene, walk, right, w)
    left_a, left_b = turns(scene, walk, left, w)
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


@njit()
def is_cut(scene: Scene, walk: Walk, ray: int, end: int, t: float) -> float:
    """How far the ray by a vertex passes an end of a side on the left; 0 where it is the end."""
    if ray == end:
        return 0.0
    at_a, at_b = turns(scene, walk, ray, end)
    return value_at(at_a, at_b, t)


@njit()
def write_graze(scene: Scene, walk: Walk, ray: int, u: int, v: int, share: Floats) -> None:
    """Write where the ray from P by a vertex meets the side u v."""
    u_a, u_b = turns(scene, walk, ray, u)
    v_a, v_b = turns(scene, walk, ray, v)
    m_a, m_b = u_a - v_a, u_b - v_b
    if ray == walk.a:  # the ray runs along P's own side
        u_a, m_a = u_b, m_b
    elif ray == walk.b:
        u_b, m_b = u_a, m_a
    unit = m_a if abs(m_a) > abs(m_b) else m_b
    share[0], share[1], share[2], share[3] = u_a / unit, u_b / unit, m_a / unit, m_b / unit


@njit(inline=True)
def write_constant(share: Floats, value: float) -> None:
    """Write a share that does not change."""
    share[0] = share[1] = value
    share[2] = share[3] = 1.0


@njit(inline=True)
def share_at(share: Floats, t: float) -> float:
    """Share at t."""
    n, m = share[0] + t * (share[1] - share[0]), share[2] + t * (share[3] - share[2])
    return n / m


@njit()
def cut_by_order(outlook: Outlook, used: int, low: float, high: float) -> int:
    """Put the t at which two of the shares in use are equal in ``cuts``, in order; their number."""
    share, c, count = outlook.share, outlook.share[5], 0
    for i in range(used):
        for j in range(i):
            n_a = share[i, 0] + low * (share[i, 1] - share[i, 0])
            n_b = share[i, 0] + high * (share[i, 1] - share[i, 0])
            m_a = share[i, 2] + low * (share[i, 3] - share[i, 2])
            m_b = share[i, 2] + high * (share[i, 3] - share[i, 2])
            k_a = share[j, 0] + low * (share[j, 1] - share[j, 0])
            k_b = share[j, 0] + high * (share[j, 1] - share[j, 0])
            l_a = share[j, 2] + low * (share[j, 3] - share[j, 2])
            l_b = share[j, 2] + high * (share[j, 3] - share[j, 2])
            c[0], c[2] = n_a * l_a - k_a * m_a, n_b * l_b - k_b * m_b
            c[1] = (n_a * l_b + n_b * l_a - k_a * m_b - k_b * m_a) / 2.0
            halves = outlook.envelope.halves
            count = roots_inside(c, 2, low, high, halves, outlook.cuts, count)
    cuts = outlook.cuts
    for i in range(1, count):
        j, cut = i, cuts[i]
        while j > 0 and cuts[j - 1] > cut:
            cuts[j] = cuts[j - 1]
            j -= 1
        cuts[j] = cut
    return count


@njit()
def offer_side(
    scene: Scene, walk: Walk, e: int, right: int, left: int, low: float, high: float,
    limit: Floats, outlook: Outlook,
) -> int:  # fmt: skip
    """Write the nearest point of what a window shows of a side on the curve; number of offers."""
    u, v, middle = scene.tri[e], scene.tri[next_side(e)], (low + high) / 2.0
    share, offers = outlook.share, 0
    # 1. Ends, or where the view cuts them off.
    at_first, at_last, used = u, v, 3
    write_constant(share[FIRST], 0.0)
    write_constant(share[LAST], 1.0)
    if is_cut(scene, walk, right, u, middle) < 0.0:
        at_first = right
        write_graze(scene, walk, right, u, v, share[FIRST])
    if is_cut(scene, walk, left, v, middle) > 0.0:
        at_last = left
        write_graze(scene, walk, left, u, v, share[LAST])
    # 2. The foot, and the limits where they lie on this side.
    dx, dy = (scene.x[v] - scene.x[u]) * scene.scale_x, (scene.y[v] - scene.y[u]) * scene.scale_y
    ux, uy = scene.x[u] * scene.scale_x, scene.y[u] * scene.scale_y
    squared = dx * dx + dy * dy
    write_constant(share[AT_FOOT], 0.0)
    if squared > 0.0:
        share[AT_FOOT, 0] = ((walk.ax - ux) * dx + (walk.ay - uy) * dy) / squared
        share[AT_FOOT, 1] = ((walk.bx - ux) * dx + (walk.by - uy) * dy) / squared
    if limit[0] > -np.inf or limit[2] < np.inf:
        used = 5
        write_limits(scene, e, u, limit, share)
    # 3. Between two changes of their order the foot, or the end next to it, is the nearest.
    cuts = cut_by_order(outlook, used, low, high)
    start = low
    for k in range(cuts + 1):
        stop = outlook.cuts[k] if k < cuts else high
        if not start < stop:
            continue
        t = (start + stop) / 2.0
        first, last = FIRST, LAST
        if used == 5 and share_at(share[LOW], t) > share_at(share[FIRST], t):
            first = LOW
        if used == 5 and share_at(share[HIGH], t) < share_at(share[LAST], t):
            last = HIGH
        from_share, to_share = share_at(share[first], t), share_at(share[last], t)
        motion, at = outlook.motion[offers], outlook.motion_at[offers]
        motion[0], motion[1] = start, stop
        start = stop
        if used == 5 and from_share > to_share:  # else the window has no width, but for rounding
            continue
        foot = share_at(share[AT_FOOT], t)
        nearest = first if foot <= from_share else last if foot >= to_share else AT_FOOT
        at[0], at[1], at[2] = e, FOOT, -1
        if nearest == FIRST:
            at[1], at[2] = VERTEX if at_first == u else GRAZE, at_first
        elif nearest == LAST:
            at[1], at[2] = VERTEX if at_last == v else GRAZE, at_last
        elif nearest != AT_FOOT:
            at[1] = LIMIT
        for i in range(4):
            motion[2 + i] = share[nearest, i]
        offers += 1
    return offers


@njit()
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


@njit()
def offer_ends(
    scene: Scene, walk: Walk, e: int, right: int, left: int, low: float, high: float,
    limit: Floats, outlook: Outlook,
) -> int:  # fmt: skip
    """Write the ends of a side that is not on the curve, if they are; the number of offers."""
    offers = 0
    for end in range(2):
        v = scene.tri[e if end == 0 else next_side(e)]
        i = scene.place[v]
        if i < 0:
            continue
        cut = is_cut(scene, walk, right if end == 0 else left, v, (low + high) / 2.0)
        if cut < 0.0 if end == 0 else cut > 0.0:
            continue
        # The interval in which its arc length counts: the limits are linear.
        arc, start, stop = scene.arc[i], low, high
        if limit[0] > -np.inf or limit[2] < np.inf:
            for bound in range(2):
                at_a, at_b = limit[2 * bound] - arc, limit[2 * bound + 1] - arc
                if bound == 1:
                    at_a, at_b = -at_a, -at_b
                if value_at(at_a, at_b, low) <= 0.0 and value_at(at_a, at_b, high) <= 0.0:
                    continue
                root = min(max(root_of(at_a, at_b), start), stop)
                if value_at(at_a, at_b, low) > 0.0:
                    start = root if value_at(at_a, at_b, high) <= 0.0 else stop
                else:
                    stop = root
        motion, at = outlook.motion[offers], outlook.motion_at[offers]
        motion[0], motion[1] = start, stop
        motion[2] = motion[3] = float(end)
        motion[4] = motion[5] = 1.0
        at[0], at[1], at[2] = e, VERTEX, v
        if start < stop:
            offers += 1
    return offers
