r"""Points of the trunk opposite the walls that a way bends around.

     .  *  .            v   turn of the shortest way from a to b, a vertex of the wall
   .    :    .          *   where the ray away from it meets the trunk
  a-----v-----b
________|________
"""

import numpy as np

from midrib.kernels.banks import Banks
from midrib.kernels.jit import njit
from midrib.kernels.leaning import is_level, lean_at, level_between, level_from, way_to_level
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.paths import triangle_towards, walk
from midrib.kernels.triangulation import next_side
from midrib.kernels.visibility import ray_meets_side
from midrib.types import Ints

__all__ = ["opposite_middle_turn", "opposite_wall"]

RAY = 4.0  # widths at a turn: how far the ray away from it looks for the trunk


@njit(borrows=True)
def opposite_middle_turn(
    mesh: Mesh,
    banks: Banks,
    turns: Ints,
    px: float,
    py: float,
    qx: float,
    qy: float,
    scale_x: float,
    scale_y: float,
) -> tuple[int, float, float]:
    """Return ``opposite_turn`` for the middle one of the turns, if any, from p to q."""
    if turns.size == 0:
        return -1, 0.0, 0.0
    k = turns.size // 2
    if k > 0:
        px, py = mesh.x[turns[k - 1]], mesh.y[turns[k - 1]]
    if k + 1 < turns.size:
        qx, qy = mesh.x[turns[k + 1]], mesh.y[turns[k + 1]]
    return opposite_turn(mesh, banks, turns[k], px, py, qx, qy, scale_x, scale_y)


@njit(borrows=True)
def opposite_turn(
    mesh: Mesh,
    banks: Banks,
    v: int,
    ax: float,
    ay: float,
    bx: float,
    by: float,
    scale_x: float,
    scale_y: float,
) -> tuple[int, float, float]:
    """Return the triangle and place where the ray away from a turn meets the trunk; -1 if nowhere.

    ``v`` is the mesh vertex at which a way from a to b turns around a wall. The ray halves the
    turn on its outer side.
    """
    x, y = mesh.x[v], mesh.y[v]
    ux, uy, wx, wy = (ax - x) * scale_x, (ay - y) * scale_y, (bx - x) * scale_x, (by - y) * scale_y
    u, w = length(ux, uy), length(wx, wy)
    away_x, away_y = -(ux / u + wx / w), -(uy / u + wy / w)
    size = length(away_x, away_y)
    here = lean_at(banks, x * scale_x, y * scale_y)
    reach = RAY * (here.to_main + here.to_auxiliary)
    if not size > 0.0 or not reach > 0.0:
        return -1, 0.0, 0.0
    hx, hy = x + reach * (away_x / size) / scale_x, y + reach * (away_y / size) / scale_y
    t = triangle_towards(mesh, v, hx, hy)
    if t < 0:
        return -1, 0.0, 0.0
    _, side = walk(mesh, t, -1, x, y, hx, hy)
    if side >= 0:
        c, d = mesh.tri[side], mesh.tri[next_side(side)]
        share = ray_meets_side(x, y, hx, hy, mesh.x[c], mesh.y[c], mesh.x[d], mesh.y[d])
        if np.isnan(share):
            return -1, 0.0, 0.0
        hx = mesh.x[c] + share * (mesh.x[d] - mesh.x[c])
        hy = mesh.y[c] + share * (mesh.y[d] - mesh.y[c])
    there = lean_at(banks, hx * scale_x, hy * scale_y)
    if here.value < 0.0 and there.value > 0.0:
        mx, my, _ = level_between(banks, x * scale_x, y * scale_y, hx * scale_x, hy * scale_y, 0.5)
    elif here.value > 0.0 and there.value < 0.0:
        mx, my, _ = level_between(banks, hx * scale_x, hy * scale_y, x * scale_x, y * scale_y, 0.5)
    else:
        return -1, 0.0, 0.0
    mx, my = mx / scale_x, my / scale_y
    end, obstacle = walk(mesh, t, -1, x, y, mx, my)
    return end if obstacle == -1 else -1, mx, my


@njit(borrows=True)
def opposite_wall(
    mesh: Mesh,
    banks: Banks,
    t: int,
    wall: int,
    px: float,
    py: float,
    qx: float,
    qy: float,
    scale_x: float,
    scale_y: float,
) -> tuple[int, float, float]:
    """Return the triangle and place where the way from a wall to the other bank meets the trunk.

    ``wall`` is the boundary side of triangle t that stops the way from p to q; -1 if nowhere.
    The trunk passes on the wall's other side than the bank that it is of, where the shortest way
    may not: islands go with a bank.
    """
    a, b = mesh.tri[wall], mesh.tri[next_side(wall)]
    ax, ay, bx, by = mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b]
    share = ray_meets_side(px, py, qx, qy, ax, ay, bx, by)
    if not 0.0 <= share <= 1.0:
        return -1, 0.0, 0.0
    hx, hy = ax + share * (bx - ax), ay + share * (by - ay)
    lean = lean_at(banks, hx * scale_x, hy * scale_y)
    if is_level(lean, banks.slack):
        return -1, 0.0, 0.0
    ux, uy, _ = way_to_level(lean, hx * scale_x, hy * scale_y)
    is_found, x, y = level_from(banks, lean, hx * scale_x, hy * scale_y, ux, uy)
    x, y = x / scale_x, y / scale_y
    end, obstacle = walk(mesh, t, -1, hx, hy, x, y)
    return end if is_found and obstacle == -1 else -1, x, y
