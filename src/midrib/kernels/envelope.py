r"""The lower envelope of points that move on the auxiliary curve while P walks along one side.

t       where P is on its side a b of the main curve: 0 at a, 1 at b
u, v    ends of a side of the auxiliary curve, or of another boundary side with an end on it
n / m   where a moving point E is on it, at u + (n / m) (v - u); n and m are linear in t

    u ------E-----------F------- v     E   GRAZE: moves as a quotient of linear functions
             .          :              F   FOOT: moves linearly, as does LIMIT; VERTEX rests
              .  V      :
               .        :
    a -------- P -------P ------ b

So the squared distance |m (P - u) - n (v - u)|^2 / m^2 is a quotient of polynomials, and so is
the difference of two; where they tie is a root of a polynomial of degree six at most.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.bernstein import DEGREE, new_halves, roots_inside
from midrib.kernels.boxtree import FOOT, GRAZE, VERTEX
from midrib.kernels.chain import TIE_OF_COORDINATE, Chain
from midrib.kernels.jit import njit
from midrib.kernels.mesh import Mesh
from midrib.kernels.triangulation import next_side
from midrib.types import Floats, Ints

__all__ = [
    "Envelope",
    "Scene",
    "Walk",
    "farthest_between",
    "has_room",
    "is_same_motion",
    "lower_by",
    "new_envelope",
    "place_at",
    "scene_of",
    "squared_distance",
    "walk_along",
]

MOST_TIES = 16  # of two motions: six, and what rounding makes of double ones


class Scene(NamedTuple):
    """A mesh, and where the auxiliary curve lies on it: of ``Mesh``, ``Chain`` and ``Goal``."""

    tri: Ints
    twin: Ints
    x: Floats
    y: Floats
    segment: Ints  # for each half-edge the curve's segment on it, or -1
    place: Ints  # for each mesh vertex its place on the curve, or -1
    vertex: Ints
    arc: Floats
    scale_x: float
    scale_y: float
    tie: float
    extent: float  # no two points are farther apart


class Walk(NamedTuple):
    """P walks from vertex a to vertex b, the ends of one side; coordinates in lengths."""

    a: int
    b: int
    ax: float
    ay: float
    bx: float
    by: float


class Envelope(NamedTuple):
    """Pieces in order of t, and tables to work in that are kept from one side to the next.

    The tables of pieces have as many rows again for the next envelope.
    """

    piece: Floats  # (2 k, 7) from, to, n at 0 and 1, m at 0 and 1, square of the largest distance
    at: Ints  # (2 k, 3) side, kind, vertex: of a VERTEX itself, of a GRAZE the one that is grazed
    cuts: Floats
    halves: Floats
    vectors: Floats  # (3, 9) of one motion and of the other; the difference of their distances


@njit()
def scene_of(mesh: Mesh, chain: Chain, scale_x: float, scale_y: float) -> Scene:
    """Prepare to look for a curve; O(n)."""
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
        chain.vertex,
        chain.arc,
        scale_x,
        scale_y,
        TIE_OF_COORDINATE * largest,
        2.0 * (high - low),
    )


@njit()
def walk_along(scene: Scene, a: int, b: int) -> Walk:
    """Walk from vertex a to vertex b."""
    scale_x, scale_y = scene.scale_x, scene.scale_y
    return Walk(
        a, b,
        scene.x[a] * scale_x, scene.y[a] * scale_y, scene.x[b] * scale_x, scene.y[b] * scale_y,
    )  # fmt: skip


@njit()
def new_envelope(rows: int) -> Envelope:
    """Empty tables for so many pieces."""
    return Envelope(
        np.empty((2 * rows, 7)),
        np.empty((2 * rows, 3), np.intp),
        np.empty(MOST_TIES),
        new_halves(),
        np.empty((3, DEGREE + 3)),
    )


@njit(inline=True)
def has_room(envelope: Envelope, count: int) -> bool:
    """Whether the tables are large enough to lower so many pieces by another motion."""
    return 2 * (MOST_TIES + 4) * (count + 1) <= envelope.piece.shape[0]


# -- one moving point ------------------------------------------------------------------------------


@njit(inline=True)
def place_at(piece: Floats, t: float) -> float:
    """Where a moving point is on its side: 0 at u, 1 at v."""
    n, m = piece[2] + t * (piece[3] - piece[2]), piece[4] + t * (piece[5] - piece[4])
    return min(max(n / m, 0.0), 1.0)


@njit()
def vectors_of(
    scene: Scene, walk: Walk, piece: Floats, side: int, a: float, b: float, out: Floats
) -> bool:
    """Bernstein coefficients of m (P - u) - n (v - u) from a to b (six), and of m (two).

    Return whether m is one, so that the first two points are all there is: it is linear.
    """
    u, v = scene.tri[side], scene.tri[next_side(side)]
    ux, uy = scene.x[u] * scene.scale_x, scene.y[u] * scene.scale_y
    dx, dy = scene.x[v] * scene.scale_x - ux, scene.y[v] * scene.scale_y - uy
    from_x, from_y = walk.ax - ux, walk.ay - uy
    run_x, run_y = walk.bx - walk.ax, walk.by - walk.ay
    px, py, qx, qy = from_x + a * run_x, from_y + a * run_y, from_x + b * run_x, from_y + b * run_y
    n_a, n_b = piece[2] + a * (piece[3] - piece[2]), piece[2] + b * (piece[3] - piece[2])
    if piece[4] == 1.0 and piece[5] == 1.0:
        out[0], out[1] = px - n_a * dx, py - n_a * dy
        out[2], out[3] = qx - n_b * dx, qy - n_b * dy
        return True
    m_a, m_b = piece[4] + a * (piece[5] - piece[4]), piece[4] + b * (piece[5] - piece[4])
    n = (n_a + n_b) / 2.0
    out[0], out[1] = m_a * px - n_a * dx, m_a * py - n_a * dy
    out[2], out[3] = (m_a * qx + m_b * px) / 2.0 - n * dx, (m_a * qy + m_b * py) / 2.0 - n * dy
    out[4], out[5] = m_b * qx - n_b * dx, m_b * qy - n_b * dy
    out[6], out[7] = m_a, m_b
    return False


@njit()
def as_quadratic(w: Floats) -> None:
    """Raise the vectors of a plain point to those of one with m = 1."""
    w[4], w[5] = w[2], w[3]
    w[2], w[3] = (w[0] + w[4]) / 2.0, (w[1] + w[5]) / 2.0
    w[6] = w[7] = 1.0


@njit()
def squared_distance(scene: Scene, walk: Walk, piece: Floats, side: int, t: float) -> float:
    """Squared distance from P to a moving point."""
    u, v = scene.tri[side], scene.tri[next_side(side)]
    share = place_at(piece, t)
    ux, uy = scene.x[u] * scene.scale_x, scene.y[u] * scene.scale_y
    dx, dy = scene.x[v] * scene.scale_x - ux, scene.y[v] * scene.scale_y - uy
    ex = ux - walk.ax - t * (walk.bx - walk.ax) + share * dx
    ey = uy - walk.ay - t * (walk.by - walk.ay) + share * dy
    return ex * ex + ey * ey


@njit()
def bound_distance(scene: Scene, walk: Walk, piece: Floats, side: int) -> float:
    """Bound of the squared distance over the whole piece; it is reached unless the point grazes."""
    if piece[4] == 1.0 and piece[5] == 1.0:  # convex in t
        return max(
            squared_distance(scene, walk, piece, side, piece[0]),
            squared_distance(scene, walk, piece, side, piece[1]),
        )
    u, v = scene.tri[side], scene.tri[next_side(side)]
    most = 0.0
    for t in (piece[0], piece[1]):
        px, py = walk.ax + t * (walk.bx - walk.ax), walk.ay + t * (walk.by - walk.ay)
        for w in (u, v):
            dx, dy = scene.x[w] * scene.scale_x - px, scene.y[w] * scene.scale_y - py
            most = max(most, dx * dx + dy * dy)
    return most


# -- two of them -----------------------------------------------------------------------------------


@njit()
def is_same_motion(one: Floats, one_at: Ints, two: Floats, two_at: Ints) -> bool:
    """Whether two pieces are parts of one motion."""
    if one_at[1] != two_at[1]:
        return False
    if one_at[1] == VERTEX:
        return one_at[2] == two_at[2]
    if one_at[0] != two_at[0] or one_at[2] != two_at[2]:
        return False
    return one_at[1] == FOOT or one_at[1] == GRAZE or (one[2] == two[2] and one[3] == two[3])


@njit()
def always_nearer(scene: Scene, one_at: Ints, two_at: Ints) -> bool:
    """Whether the first is nearer without computing: a foot, and any point of the same side.

    They touch where the one becomes the other, and rounding would cut that to pieces.
    """
    if one_at[1] != FOOT:
        return False
    if two_at[1] == VERTEX:
        side, v = one_at[0], two_at[2]
        return scene.tri[side] == v or scene.tri[next_side(side)] == v
    return one_at[0] == two_at[0]


@njit()
def ties_between(
    scene: Scene, walk: Walk, envelope: Envelope, one: Floats, side: int, two: Floats,
    other_side: int, a: float, b: float,
) -> int:  # fmt: skip
    """Write the t from a to b at which two moving points tie in ``cuts``; their number."""
    w, z, c = envelope.vectors[0], envelope.vectors[1], envelope.vectors[2]
    is_plain = vectors_of(scene, walk, one, side, a, b, w)
    other_is_plain = vectors_of(scene, walk, two, other_side, a, b, z)
    degree = 2
    if is_plain and other_is_plain:
        c[0] = w[0] * w[0] + w[1] * w[1] - z[0] * z[0] - z[1] * z[1]
        c[1] = w[0] * w[2] + w[1] * w[3] - z[0] * z[2] - z[1] * z[3]
        c[2] = w[2] * w[2] + w[3] * w[3] - z[2] * z[2] - z[3] * z[3]
    else:
        degree = DEGREE
        if is_plain:
            as_quadratic(w)
        if other_is_plain:
            as_quadratic(z)
        for k in range(DEGREE + 1):
            c[k] = 0.0
        add_product(w, z[6], z[7], 1.0, c)
        add_product(z, w[6], w[7], -1.0, c)
    return roots_inside(c, degree, a, b, envelope.halves, envelope.cuts, 0)


@njit()
def add_product(w: Floats, m_a: float, m_b: float, sign: float, c: Floats) -> None:
    """Add the square of a quadratic vector times the square of a linear m to a polynomial."""
    s0 = w[0] * w[0] + w[1] * w[1]
    s1 = w[0] * w[2] + w[1] * w[3]
    s2 = (w[0] * w[4] + w[1] * w[5] + 2.0 * (w[2] * w[2] + w[3] * w[3])) / 3.0
    s3 = w[2] * w[4] + w[3] * w[5]
    s4 = w[4] * w[4] + w[5] * w[5]
    q0, q1, q2 = sign * m_a * m_a, sign * m_a * m_b, sign * m_b * m_b
    c[0] += s0 * q0
    c[1] += (4.0 * s1 * q0 + 2.0 * s0 * q1) / 6.0
    c[2] += (6.0 * s2 * q0 + 8.0 * s1 * q1 + s0 * q2) / 15.0
    c[3] += (4.0 * s3 * q0 + 12.0 * s2 * q1 + 4.0 * s1 * q2) / 20.0
    c[4] += (s4 * q0 + 8.0 * s3 * q1 + 6.0 * s2 * q2) / 15.0
    c[5] += (2.0 * s4 * q1 + 4.0 * s3 * q2) / 6.0
    c[6] += s4 * q2


# -- all of them -----------------------------------------------------------------------------------


@njit()
def farthest_between(piece: Floats, count: int, a: float, b: float) -> float:
    """Bound of the envelope's squared distance from a to b, inf where it has no piece."""
    reached, most = a, 0.0
    for k in range(count):
        if piece[k, 1] <= a:
            continue
        if piece[k, 0] > reached or reached >= b:
            break
        most, reached = max(most, piece[k, 6]), piece[k, 1]
    return most if reached >= b else np.inf


@njit()
def put(
    scene: Scene, walk: Walk, envelope: Envelope, count: int, a: float, b: float,
    motion: Floats, motion_at: Ints,
) -> int:  # fmt: skip
    """Append a part of a motion to the next envelope, or lengthen its last piece; the new count."""
    if not a < b:
        return count
    piece, at = envelope.piece, envelope.at
    last = count - 1
    goes_on = 2 * count > piece.shape[0] and piece[last, 1] == a
    if goes_on and is_same_motion(piece[last], at[last], motion, motion_at):
        piece[last, 1] = b
        piece[last, 6] = bound_distance(scene, walk, piece[last], at[last, 0])
        return count
    row = piece[count]
    row[0], row[1] = a, b
    for k in range(2, 6):
        row[k] = motion[k]
    for k in range(3):
        at[count, k] = motion_at[k]
    row[6] = bound_distance(scene, walk, row, motion_at[0])
    return count + 1


@njit()
def lower_by(
    scene: Scene, walk: Walk, envelope: Envelope, count: int, motion: Floats, motion_at: Ints
) -> int:
    """Lower the envelope by a moving point from ``motion[0]`` to ``motion[1]``; the new count."""
    piece, at = envelope.piece, envelope.at
    base = piece.shape[0] // 2
    low, high, total = motion[0], motion[1], base
    for k in range(count + 1):
        # 1. Pieces before and behind stay; what nothing covers is new.
        a, b = (piece[k, 0], piece[k, 1]) if k < count else (high, high)
        if b > low:
            total = put(scene, walk, envelope, total, low, min(a, high), motion, motion_at)
        if k == count:
            break
        total = put(scene, walk, envelope, total, a, min(b, max(a, low)), piece[k], at[k])
        # 2. Where both are there, the nearer one stays, from tie to tie.
        start, stop = max(a, low), min(b, high)
        if start < stop:
            total = put_nearer(
                scene, walk, envelope, total, start, stop, piece[k], at[k], motion, motion_at
            )
        total = put(scene, walk, envelope, total, max(a, min(b, stop)), b, piece[k], at[k])
        low = max(low, stop)
    for k in range(total - base):
        for column in range(7):
            piece[k, column] = piece[base + k, column]
        for column in range(3):
            at[k, column] = at[base + k, column]
    return total - base


@njit()
def put_nearer(
    scene: Scene, walk: Walk, envelope: Envelope, total: int, start: float, stop: float,
    one: Floats, one_at: Ints, two: Floats, two_at: Ints,
) -> int:  # fmt: skip
    """Append the nearer of two motions, from tie to tie; the new count."""
    cuts, ties = envelope.cuts, 0
    is_first = is_same_motion(one, one_at, two, two_at) or always_nearer(scene, one_at, two_at)
    is_second = not is_first and always_nearer(scene, two_at, one_at)
    is_decided = is_first or is_second
    if not is_decided:
        ties = ties_between(scene, walk, envelope, one, one_at[0], two, two_at[0], start, stop)
    a = start
    for i in range(ties + 1):
        b = cuts[i] if i < ties else stop
        if not a < b:
            continue
        if not is_decided:
            middle = (a + b) / 2.0
            is_first = squared_distance(scene, walk, one, one_at[0], middle) <= squared_distance(
                scene, walk, two, two_at[0], middle
            )
        motion, at = (one, one_at) if is_first else (two, two_at)
        total = put(scene, walk, envelope, total, a, b, motion, at)
        a = b
    return total
