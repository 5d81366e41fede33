r"""The trunk of an area: the line on which both banks are equally far, from end to end.

It is the medial axis of the two banks without branches. Every radius PQ crosses it: at P the main
bank is nearer, at Q the auxiliary one. Between two of its points the straight way is probed; the
probe that is farthest off is moved onto the trunk and becomes a point of the line.

    auxiliary ---------------
               .  *  .         p, q   points of the trunk
          p-----+-----+-----q  +      probes on the straight way
                               *      the worst one, moved
    main ------\   /---------
                \_/
"""

import numpy as np

from midrib.kernels.banks import (
    Banks,
    Lean,
    banks_of,
    lean_at,
    level_between,
    level_from,
    way_to_level,
)
from midrib.kernels.chain import Chain
from midrib.kernels.islands import Loops, has_islands, loops_of
from midrib.kernels.jit import njit
from midrib.kernels.joining import Joined, cut_all_loops, string_beads
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.paths import (
    Beads,
    find_sleeve,
    join_points,
    locate_from,
    new_search,
    pull_tight,
    walk,
)
from midrib.kernels.triangulation import next_side
from midrib.types import Floats, Ints

__all__ = ["trace_trunk"]

PROBES_PER_WIDTH = 4.0
MOST_PROBES = 16
SHARE_OF_SLACK = 2.0**-4  # of the tolerance: what points of the trunk may be off it
DEPTH = 12  # halvings of the way between two radii
NOWHERE = Lean(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@njit(entry=True)
def trace_trunk(
    mesh: Mesh,
    main: Chain,
    auxiliary: Chain,
    points: Floats,
    at: Ints,
    end: Floats,
    end_origin: Floats,
    end_at: Ints,
    tolerance: float,
    scale_x: float,
    scale_y: float,
) -> Joined:
    """Trunk of an area from the one end point to the other; loops are cut.

    Parameters
    ----------
    mesh : the area
    main, auxiliary : the two banks
    points, at : radii, as ``draw_radii`` returns them
    end, end_origin, end_at : end points, as in ``join_middles``
    tolerance : how far (in lengths) a probe may be from the trunk
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    Joined
        Every piece has been walked with exact signs, so the line does not leave the area. Where
        the straight way between two radii is blocked it bends around the obstacle, by the trunk
        if that can be reached from the middle of a door of the sleeve, else by the wall itself.
    """
    beads = string_beads(points, at, end, end_origin, end_at)
    loops = Loops(np.empty(0, np.intp), np.zeros(1, np.intp), np.empty(0, np.bool_))
    if has_islands(mesh, main, auxiliary):
        path, _ = join_points(mesh, beads, scale_x, scale_y)
        loops = loops_of(mesh, main, auxiliary, path)
    slack = SHARE_OF_SLACK * tolerance
    banks = banks_of(mesh, main, auxiliary, loops, slack, scale_x, scale_y)
    first = end.shape[0] // 2
    for i in range(points.shape[0]):
        x, y = level_between(
            banks,
            points[i, 0] * scale_x,
            points[i, 1] * scale_y,
            points[i, 2] * scale_x,
            points[i, 3] * scale_y,
            0.5,
        )
        beads.point[first + i, 0], beads.point[first + i, 1] = x / scale_x, y / scale_y
    path, source = trace(mesh, banks, beads, tolerance, scale_x, scale_y)
    return cut_all_loops(mesh, beads, path, source, scale_x, scale_y)


@njit()
def trace(
    mesh: Mesh, banks: Banks, beads: Beads, tolerance: float, scale_x: float, scale_y: float
) -> tuple[Floats, Ints]:
    """Return the path from bead to bead, and the bead or (-1 - v) mesh vertex that each point is.

    One past the beads for a point between.
    """
    n = beads.side.size
    search = new_search(mesh, scale_x, scale_y)
    path, source = np.empty((4 * n + 16, 2)), np.empty(4 * n + 16, np.intp)
    # Points still to be reached, the next one last: x, y; triangle, source, depth.
    goal, goal_at = np.empty((DEPTH + 4, 2)), np.empty((DEPTH + 4, 3), np.intp)
    count, t = 0, -1
    px, py = 0.0, 0.0
    for i in range(n):
        qx, qy = beads.point[i, 0], beads.point[i, 1]
        end, qx, qy = locate_from(
            mesh, beads.side[i], beads.vertex[i], beads.origin[i, 0], beads.origin[i, 1],
            qx, qy, t, search,
        )  # fmt: skip
        near_last = i < n - 1 and is_near(
            qx, qy, beads.point[n - 1, 0], beads.point[n - 1, 1], banks.slack, scale_x, scale_y
        )
        near_path = i < n - 1 and is_near(qx, qy, px, py, banks.slack, scale_x, scale_y)
        if end < 0 or near_last or (t >= 0 and near_path):
            continue
        goal[0, 0], goal[0, 1] = qx, qy
        goal_at[0, 0], goal_at[0, 1], goal_at[0, 2] = end, i, 0
        waiting = 1
        while waiting > 0:
            # 1. A point between, if the way to the next one is not good enough.
            top = waiting - 1
            qx, qy, depth = goal[top, 0], goal[top, 1], goal_at[top, 2]
            turns = np.empty(0, np.intp)
            if t >= 0:
                end, obstacle = walk(mesh, t, -1, px, py, qx, qy)
                between = -1
                mx, my = 0.0, 0.0
                if obstacle == -1:
                    if depth < DEPTH:
                        at, mx, my = worst_probe(
                            banks,
                            px * scale_x,
                            py * scale_y,
                            qx * scale_x,
                            qy * scale_y,
                            tolerance,
                        )
                        mx, my = mx / scale_x, my / scale_y
                        if at > 0.0:
                            between = walk_by(
                                mesh, t, px, py, px + at * (qx - px), py + at * (qy - py), mx, my
                            )
                else:
                    end = goal_at[top, 0]
                    sleeve = find_sleeve(mesh, t, end, px, py, qx, qy, search)
                    turns = pull_tight(mesh, sleeve, px, py, qx, qy)
                    if depth < DEPTH and turns.size > 0:
                        between, mx, my = middle_of_door(
                            mesh, banks, sleeve, turns, scale_x, scale_y
                        )
                is_old = is_near(mx, my, px, py, banks.slack, scale_x, scale_y) or is_near(
                    mx, my, qx, qy, banks.slack, scale_x, scale_y
                )
                if between >= 0 and not is_old:
                    goal_at[top, 2] = depth + 1
                    goal[waiting, 0], goal[waiting, 1] = mx, my
                    goal_at[waiting, 0], goal_at[waiting, 1] = between, n
                    goal_at[waiting, 2] = depth + 1
                    waiting += 1
                    continue
            else:
                end = goal_at[top, 0]
            # 2. The point itself, by the turns at walls if there are any.
            waiting -= 1
            if count + turns.size + 1 > source.size:
                path, source = with_rows(path, source, 2 * (count + turns.size + 1))
            for v in turns:
                if mesh.x[v] != path[count - 1, 0] or mesh.y[v] != path[count - 1, 1]:
                    path[count, 0], path[count, 1], source[count] = mesh.x[v], mesh.y[v], -1 - v
                    count += 1
            if count == 0 or qx != path[count - 1, 0] or qy != path[count - 1, 1]:
                path[count, 0], path[count, 1], source[count] = qx, qy, goal_at[top, 1]
                count += 1
            t, px, py = end, qx, qy
    return path[:count], source[:count]


@njit()
def is_near(
    px: float, py: float, qx: float, qy: float, slack: float, scale_x: float, scale_y: float
) -> bool:
    """Whether two points are nearer than what the trunk's points may be off."""
    return length((qx - px) * scale_x, (qy - py) * scale_y) <= slack


@njit()
def with_rows(path: Floats, source: Ints, rows: int) -> tuple[Floats, Ints]:
    """Return copies of a path and its sources with room for so many rows."""
    n = source.size
    longer_path, longer_source = np.empty((rows, 2)), np.empty(rows, np.intp)
    longer_path[:n], longer_source[:n] = path, source
    return longer_path, longer_source


@njit()
def worst_probe(
    banks: Banks, px: float, py: float, qx: float, qy: float, tolerance: float
) -> tuple[float, float, float]:
    """Return where (0 at p, 1 at q) the way is farthest off the trunk, and the trunk's point there.

    Where no probe is off by more than the tolerance, or the worst cannot be moved: -1.
    """
    span = length(qx - px, qy - py)
    probes, k = 1, 0
    worst, at = tolerance, -1.0
    wx, wy, worst_lean = 0.0, 0.0, NOWHERE
    while k < probes:
        share = (k + 1.0) / (probes + 1.0)
        x, y = px + share * (qx - px), py + share * (qy - py)
        lean = lean_at(banks, x, y)
        k += 1
        if probes == 1:
            # The first probe, in the middle, says how many it takes.
            wanted = np.ceil(PROBES_PER_WIDTH * span / (lean.to_main + lean.to_auxiliary))
            if wanted > 1.0:
                probes, k = int(min(wanted, MOST_PROBES)), 0
        if abs(lean.value) <= tolerance:
            continue
        _, _, off = way_to_level(lean, x, y)
        if off > worst:
            worst, at, wx, wy, worst_lean = off, share, x, y, lean
    if at > 0.0:
        is_found, wx, wy = level_from(banks, worst_lean, wx, wy)
        at = at if is_found else -1.0
    return at, wx, wy


@njit()
def walk_by(
    mesh: Mesh, t: int, px: float, py: float, x: float, y: float, qx: float, qy: float
) -> int:
    """Return the triangle in which the way from p in t straight to x and on to q ends; -1 if none.

    Islands are in nobody's way between the banks; here they are.
    """
    end, obstacle = walk(mesh, t, -1, px, py, x, y)
    if obstacle == -1:
        end, obstacle = walk(mesh, end, -1, x, y, qx, qy)
    return end if obstacle == -1 else -1


@njit()
def middle_of_door(
    mesh: Mesh, banks: Banks, sleeve: Ints, turns: Ints, scale_x: float, scale_y: float
) -> tuple[int, float, float]:
    """Return the triangle and place of the middle of a door, moved onto the trunk; -1 if not.

    The door is the longest of those that the middle one of the turns is a post of.
    """
    post = turns[turns.size // 2]
    door, longest = -1, -1.0
    for e in sleeve:
        a, b = mesh.tri[e], mesh.tri[next_side(e)]
        if post not in (a, b):
            continue
        span = length((mesh.x[a] - mesh.x[b]) * scale_x, (mesh.y[a] - mesh.y[b]) * scale_y)
        if span > longest:
            door, longest = e, span
    if door < 0:
        return -1, 0.0, 0.0
    a, b = mesh.tri[door], mesh.tri[next_side(door)]
    x, y = (mesh.x[a] + mesh.x[b]) / 2.0, (mesh.y[a] + mesh.y[b]) / 2.0
    lean = lean_at(banks, x * scale_x, y * scale_y)
    is_found, mx, my = level_from(banks, lean, x * scale_x, y * scale_y)
    if not is_found:
        return -1, 0.0, 0.0
    mx, my = mx / scale_x, my / scale_y
    end, obstacle = walk(mesh, door // 3, -1, x, y, mx, my)
    return end if obstacle == -1 else -1, mx, my
