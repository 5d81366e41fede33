"""Probes on the straight way between two points of the trunk, and the point to add between them."""

import numpy as np

from midrib.kernels.banks import Banks
from midrib.kernels.glide import Ends, allowance
from midrib.kernels.jit import njit
from midrib.kernels.leaning import (
    LEVEL,
    Lean,
    is_level,
    is_straight,
    lean_at,
    level_from,
    level_where_straight,
    way_from_nearer,
    way_to_level,
)
from midrib.kernels.lengths import length
from midrib.kernels.looking import is_looking_between, look_everywhere
from midrib.kernels.mesh import Mesh
from midrib.kernels.paths import walk
from midrib.types import Ints

__all__ = ["apart_of", "is_between_lines", "point_beside"]

PROBES_PER_WIDTH = 4.0
MOST_PROBES = 16
APART = 2.0**-4  # of the tolerance: points that are nearer to each other are one
SAME = 16.0  # times what level points may be off: as far off, and as far apart, is rounding
ARC = 1e-4  # of the width: how far from arcs the line may be where it is to be exact
BESIDE = 2.0**-6  # of a way: how far from its ends the level line is looked at
CROWDED = 2.0**-3  # of a way: a point so near to an end of it hardly divides it
TIED = 2.0**-20  # relative: a probe that is farther off by less is no farther but for rounding
SURELY = 0.5  # of the tolerance: what is off by less stays so whatever is rounded
NOWHERE = Lean(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@njit(borrows=True)
def apart_of(banks: Banks, tolerance: float) -> float:
    """How near to each other two points of the trunk are one."""
    return APART * tolerance if tolerance > 0.0 else SAME * banks.slack


@njit(borrows=True)
def is_between_lines(
    banks: Banks,
    first: Ints,
    last: Ints,
    px: float,
    py: float,
    qx: float,
    qy: float,
    tolerance: float,
) -> bool:
    """Whether the straight way from p to q is level because it runs between the same two segments.

    With both feet inside one segment of either bank, so has all that lies between p and q: the
    lean is linear, and where it is next to none at p and at q no probe can be off. A third of all
    probes need not be made in areas of 100 vertices.
    """
    if not is_looking_between(banks) or first[0] != last[0] or first[1] != last[1]:
        return False
    lean_p, lean_q = 0.0, 0.0
    for k in range(2):
        j, bank = first[k], banks.main if k == 0 else banks.auxiliary
        ax, ay = bank.x[j], bank.y[j]
        dx, dy = bank.x[j + 1] - ax, bank.y[j + 1] - ay
        squared = dx * dx + dy * dy
        along_p, along_q = (px - ax) * dx + (py - ay) * dy, (qx - ax) * dx + (qy - ay) * dy
        off_p, off_q = (px - ax) * dy - (py - ay) * dx, (qx - ax) * dy - (qy - ay) * dx
        is_inside = min(along_p, along_q) > 0.0 and max(along_p, along_q) < squared
        if not (is_inside and off_p * off_q > 0.0):
            return False
        sign = 1.0 if k == 0 else -1.0
        lean_p += sign * abs(off_p) / np.sqrt(squared)
        lean_q += sign * abs(off_q) / np.sqrt(squared)
    return max(abs(lean_p), abs(lean_q)) < SURELY * tolerance


@njit(borrows=True)
def point_beside(
    mesh: Mesh,
    banks: Banks,
    ends: Ends,
    t: int,
    px: float,
    py: float,
    qx: float,
    qy: float,
    tolerance: float,
    scale_x: float,
    scale_y: float,
) -> tuple[int, float, float, bool]:
    """Return the triangle and place of a point of the trunk beside the way from p in t to q.

    And whether it can be seen from p.

    It is where the way is farthest off, or where either half of it is, if that cannot be reached;
    -1 if the way is good enough or no point can be. Points that crowd p or q come last. Of a line
    that is to be exact it is the kink, if there is one between two straight stretches.
    """
    best, best_x, best_y, best_is_seen, most = -1, 0.0, 0.0, False, 0.0
    enough = CROWDED * length((qx - px) * scale_x, (qy - py) * scale_y)
    for k in range(3):
        low, high = (0.0, 1.0) if k == 0 else (0.0, 0.5) if k == 1 else (0.5, 1.0)
        ax, ay = px + low * (qx - px), py + low * (qy - py)
        bx, by = px + high * (qx - px), py + high * (qy - py)
        at, lean = worst_probe(
            banks, ends, ax * scale_x, ay * scale_y, bx * scale_x, by * scale_y, tolerance
        )
        if at < 0.0 and k == 0:
            break
        if tolerance == 0.0 and k == 0:
            end, x, y, is_seen = kink_beside(mesh, banks, t, px, py, qx, qy, scale_x, scale_y)
            to_p = length((x - px) * scale_x, (y - py) * scale_y)
            to_q = length((x - qx) * scale_x, (y - qy) * scale_y)
            if end >= 0 and min(to_p, to_q) > apart_of(banks, tolerance):  # else it is p or q
                return end, x, y, is_seen
        hx, hy = ax + at * (bx - ax), ay + at * (by - ay)
        for is_away in (False, True):
            if at < 0.0:
                continue
            ux, uy, _ = way_to_level(lean, hx * scale_x, hy * scale_y)
            if is_away:
                ux, uy = way_from_nearer(lean, hx * scale_x, hy * scale_y)
            is_found, x, y = level_from(banks, lean, hx * scale_x, hy * scale_y, ux, uy)
            x, y = x / scale_x, y / scale_y
            end, is_seen = -1, False
            if is_found:
                end, is_seen = walk_past(mesh, t, px, py, hx, hy, x, y)
            to_p = length((x - px) * scale_x, (y - py) * scale_y)
            to_q = length((x - qx) * scale_x, (y - qy) * scale_y)
            if end >= 0 and min(to_p, to_q) >= enough:
                return end, x, y, is_seen
            if end >= 0 and min(to_p, to_q) > most:
                best, best_x, best_y, best_is_seen, most = end, x, y, is_seen, min(to_p, to_q)
    if best >= 0:
        lean_at(banks, best_x * scale_x, best_y * scale_y)  # its feet are the last ones
    return best, best_x, best_y, best_is_seen


@njit(borrows=True)
def kink_beside(
    mesh: Mesh,
    banks: Banks,
    t: int,
    px: float,
    py: float,
    qx: float,
    qy: float,
    scale_x: float,
    scale_y: float,
) -> tuple[int, float, float, bool]:
    """Return the triangle and place of the kink between p in t and q; -1 if it is not the only one.

    And whether it can be seen from p.

    Level points next to p and q say how the level line goes on from there: p and q may be kinks
    themselves.
    """
    dx, dy = BESIDE * (qx - px), BESIDE * (qy - py)
    at_p, ax, ay = level_at(banks, (px + dx) * scale_x, (py + dy) * scale_y)
    at_q, bx, by = level_at(banks, (qx - dx) * scale_x, (qy - dy) * scale_y)
    if not (at_p and at_q):
        return -1, 0.0, 0.0, False
    is_kink, x, y = level_where_straight(banks, ax, ay, bx, by)
    look_everywhere(banks)  # it need not lie between the radii of p and q
    dx, dy = (bx - ax), (by - ay)
    is_between = 0.0 < (x - ax) * dx + (y - ay) * dy < dx * dx + dy * dy
    if not (is_kink and is_between and is_level(lean_at(banks, x, y), banks.slack)):
        return -1, 0.0, 0.0, False
    hx, hy, x, y = ax / scale_x, ay / scale_y, x / scale_x, y / scale_y
    end, is_seen = walk_past(mesh, t, px, py, hx, hy, x, y)
    return end, x, y, is_seen


@njit(borrows=True)
def level_at(banks: Banks, x: float, y: float) -> tuple[bool, float, float]:
    """Return the level point that a point comes to; whether it does."""
    lean = lean_at(banks, x, y)
    ux, uy, _ = way_to_level(lean, x, y)
    return level_from(banks, lean, x, y, ux, uy)


@njit(borrows=True)
def worst_probe(
    banks: Banks, ends: Ends, px: float, py: float, qx: float, qy: float, tolerance: float
) -> tuple[float, Lean]:
    """Return where (0 at p, 1 at q) the way is farthest off the trunk, and how it leans there.

    -1 where no probe is off by more than is allowed: the tolerance or, if that is 0, rounding
    where the trunk is straight and next to nothing where it is an arc.
    """
    span = length(qx - px, qy - py)
    probes, k = 1, 0
    worst, at, worst_lean = tolerance, -1.0, NOWHERE
    beside = 2 if tolerance == 0.0 else 0  # a kink next to an end shows there
    while k < probes + beside:
        share = (k + 1.0) / (probes + 1.0)
        if k >= probes:
            share = BESIDE if k == probes else 1.0 - BESIDE
        x, y = px + share * (qx - px), py + share * (qy - py)
        k += 1
        if 2 * k == probes + 1 > 2:
            continue  # the first one has been there
        lean = lean_at(banks, x, y)
        if k == probes == 1:
            # The first probe, in the middle, says how many it takes.
            wanted = np.ceil(PROBES_PER_WIDTH * span / (lean.to_main + lean.to_auxiliary))
            if wanted > 1.0:
                probes, k = int(min(wanted, MOST_PROBES)), 0
        width = lean.to_main + lean.to_auxiliary
        allowed = tolerance
        if tolerance == 0.0:
            is_exact = abs(lean.value) <= SAME * max(banks.slack, LEVEL * width)
            allowed = ARC * width if is_exact or not is_straight(banks, lean) else 0.0
        if abs(lean.value) <= allowed:
            continue
        _, _, off = way_to_level(lean, x, y)
        off -= allowance(ends, x, y)
        if off > max((1.0 + TIED) * worst, allowed):  # of those that tie the first one
            worst, at, worst_lean = off, share, lean
    return at, worst_lean


@njit(borrows=True)
def walk_past(
    mesh: Mesh, t: int, px: float, py: float, x: float, y: float, qx: float, qy: float
) -> tuple[int, bool]:
    """Return the triangle of q, which p in t sees, or sees from (x, y) on; -1 if it does not.

    And whether it does from p: mostly it does, and the path will go straight. Islands are in
    nobody's way between the banks; here they are.
    """
    end, obstacle = walk(mesh, t, -1, px, py, qx, qy)
    if obstacle == -1:
        return end, True
    end, obstacle = walk(mesh, t, -1, px, py, x, y)
    if obstacle == -1:
        end, obstacle = walk(mesh, end, -1, x, y, qx, qy)
    return (end if obstacle == -1 else -1), False
