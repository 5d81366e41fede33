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

from typing import NamedTuple

import numpy as np

from midrib.kernels.banks import (
    Banks,
    Lean,
    banks_of,
    is_level,
    lean_at,
    level_between,
    level_from,
    look_between,
    look_everywhere,
    way_from_nearer,
    way_to_level,
)
from midrib.kernels.chain import Chain
from midrib.kernels.islands import has_islands, loops_of, no_loops
from midrib.kernels.jit import njit
from midrib.kernels.joining import Joined, cut_all_loops, join_beads, string_beads
from midrib.kernels.landings import land, take_off
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.paths import (
    Beads,
    find_sleeve,
    locate_from,
    new_search,
    pull_tight,
    triangle_towards,
    walk,
)
from midrib.kernels.tables import with_places, with_rows
from midrib.kernels.triangulation import next_side
from midrib.kernels.visibility import ray_meets_side
from midrib.kernels.ways import Stops, is_of_main, level_beads, shores_outside, stops_on_way
from midrib.types import Floats, Ints

__all__ = ["APART", "SHARE_OF_SLACK", "ends_of", "trace", "trace_trunk"]

PROBES_PER_WIDTH = 4.0
MOST_PROBES = 16
SHARE_OF_SLACK = 2.0**-24  # of the tolerance: what points of the trunk may be off it
APART = 2.0**-4  # of the tolerance: points that are nearer to each other are one
DEPTH = 12  # halvings of the way between two radii
GLIDE = 2.0  # beads nearer to an end than so many times what it is off the trunk are left out
BACK = 0.25  # tangent of what is left of a half turn where a path comes back on itself
CROWDED = 2.0**-3  # of a way: a point so near to an end of it hardly divides it
TINY = 2.0**-1000
RAY = 4.0  # widths at a turn: how far the ray away from it looks for the trunk
NOWHERE = Lean(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class Ends(NamedTuple):
    """End points that the line has to reach, though they may be off the trunk; in lengths."""

    are_given: bool
    x0: float
    y0: float
    off_0: float
    reach_0: float
    x1: float
    y1: float
    off_1: float
    reach_1: float


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
    is_trimmed: bool,
    every_bead: bool,
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
    is_trimmed : whether the ends may lie farther in than the ends of the two banks
    every_bead : whether all points of radii are wanted on the trunk, past islands too
    tolerance : how far (in lengths) a probe may be from the trunk
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    Joined
        Every piece has been walked with exact signs, so the line does not leave the area. Where
        the straight way between two radii is blocked it bends around the obstacle, by the trunk
        if that can be seen from the turn of the shortest way, else by the wall itself.
    """
    beads = string_beads(points, at, end, end_origin, end_at)
    first, n = end.shape[0] // 2, beads.side.size
    slack, apart = SHARE_OF_SLACK * tolerance, APART * tolerance
    loops, kept = no_loops(), beads_in_order(points[:, 4], first, n)
    with_islands = has_islands(mesh, main, auxiliary)
    if with_islands:
        some = Beads(beads.point[kept], beads.origin[kept], beads.side[kept], beads.vertex[kept])
        path = join_beads(mesh, some, scale_x, scale_y).points
        loops = loops_of(mesh, main, auxiliary, path, scale_x, scale_y)
    banks = banks_of(mesh, main, auxiliary, loops, slack, scale_x, scale_y)
    near = np.zeros((beads.side.size, 2), np.intp)  # segments of both banks, nearest to each bead
    level_beads(banks, beads, near, points, first, every_bead or not with_islands, scale_x, scale_y)
    ends = ends_of(banks, beads, near, end.shape[0] > 0, apart, scale_x, scale_y)
    stops = Stops(beads.point[kept], kept, near[kept])
    if with_islands:
        shore = shores_outside(mesh, main, auxiliary, scale_x, scale_y)
        is_main = is_of_main(shore, mesh, loops)
        stops = stops_on_way(mesh, main, banks, beads, near, is_main, is_trimmed, scale_x, scale_y)
    before = np.full((2, 2), np.nan)
    if loops.wall_is_main.size > 0:
        banks, point, stop_at, before = land(
            mesh, main, auxiliary, banks, loops, beads, stops.point, stops.at, scale_x, scale_y
        )
        stops = Stops(point, stop_at, np.zeros((stop_at.size, 2), np.intp))  # no windows here
        ends = ends_of(banks, beads, near, end.shape[0] > 0, apart, scale_x, scale_y)
    path, source = trace(mesh, banks, beads, stops, ends, tolerance, apart, scale_x, scale_y)
    path, source = take_off(path, source, beads, before)
    return cut_all_loops(mesh, beads, path, source, scale_x, scale_y)


@njit()
def beads_in_order(arc: Floats, first: int, n: int) -> Ints:
    """Return the end beads and those of the most radii whose Q never travel back.

    Radii that do not travel back do not cross, and so have the trunk's points in order; the others
    come from bays. The longest sequence that does not descend, by patience sorting.
    """
    k = arc.size
    length_at, before = np.empty(k + 1, np.intp), np.full(k, -1, np.intp)
    longest = 0  # length_at[m]: the last one of a sequence of m + 1 that ends lowest
    for i in range(k):
        low, high = 0, longest
        while low < high:
            middle = (low + high) // 2
            if arc[length_at[middle]] <= arc[i]:
                low = middle + 1
            else:
                high = middle
        if low > 0:
            before[i] = length_at[low - 1]
        length_at[low] = i
        longest = max(longest, low + 1)
    ends = n - k
    kept = np.empty(longest + ends, np.intp)
    row = length_at[longest - 1] if longest > 0 else -1
    for m in range(longest - 1, -1, -1):
        kept[first + m] = first + row
        row = before[row]
    if ends > 0:
        kept[0], kept[longest + 1] = 0, n - 1
    return kept


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


@njit()
def trace(
    mesh: Mesh,
    banks: Banks,
    beads: Beads,
    stops: Stops,
    ends: Ends,
    tolerance: float,
    apart: float,
    scale_x: float,
    scale_y: float,
) -> tuple[Floats, Ints]:
    """Return the path from bead to bead, and the bead or (-1 - v) mesh vertex that each point is.

    One past the beads for a point between.
    """
    n = beads.side.size
    search = new_search(mesh, scale_x, scale_y)
    path, source = np.empty((4 * n + 16, 2)), np.empty(4 * n + 16, np.intp)
    # Of each point of the path its triangle, or -1, and the segments of its feet on both banks.
    inside, feet = np.empty(4 * n + 16, np.intp), np.empty((4 * n + 16, 2), np.intp)
    # Points still to be reached, the next one last: x, y; triangle, source, depth.
    goal, goal_at = np.empty((DEPTH + 4, 2)), np.empty((DEPTH + 4, 3), np.intp)
    goal_near, p_near = np.empty((DEPTH + 4, 2), np.intp), np.zeros(2, np.intp)
    count, t, none = 0, -1, np.empty(0, np.intp)
    px, py = 0.0, 0.0
    for k in range(stops.at.size):
        qx, qy, i = stops.point[k, 0], stops.point[k, 1], stops.at[k]
        if i < 0:
            end, i = -1 - i, n
        else:
            end, qx, qy = locate_from(
                mesh, beads.side[i], beads.vertex[i], beads.origin[i, 0], beads.origin[i, 1],
                qx, qy, t, search,
            )  # fmt: skip
        is_end = ends.are_given and i in (0, n - 1)
        is_repeat = t >= 0 and is_near(qx, qy, px, py, apart, scale_x, scale_y)
        hides = not is_end and (is_repeat or is_before_end(ends, qx * scale_x, qy * scale_y))
        if end < 0 or hides:
            continue
        goal[0, 0], goal[0, 1] = qx, qy
        goal_at[0, 0], goal_at[0, 1], goal_at[0, 2] = end, i, 0
        goal_near[0, 0], goal_near[0, 1] = stops.nearest[k, 0], stops.nearest[k, 1]
        waiting = 1
        while waiting > 0:
            # 1. A point between, if the way to the next one is not good enough.
            top = waiting - 1
            qx, qy, depth = goal[top, 0], goal[top, 1], goal_at[top, 2]
            turns = none
            if t >= 0:
                end, obstacle = walk(mesh, t, -1, px, py, qx, qy)
                between = -1
                mx, my = 0.0, 0.0
                if obstacle == -1:
                    if depth < DEPTH:
                        if ends.are_given and (count == 1 or goal_at[top, 1] == n - 1):
                            look_everywhere(banks)  # ends are off the trunk
                        else:
                            look_between(banks, p_near, goal_near[top])
                        between, mx, my = point_beside(
                            mesh, banks, ends, t, px, py, qx, qy, tolerance, scale_x, scale_y
                        )
                else:
                    before_wall, end = end, goal_at[top, 0]
                    sleeve = find_sleeve(mesh, t, end, px, py, qx, qy, search)
                    turns = pull_tight(mesh, sleeve, px, py, qx, qy)
                    look_everywhere(banks)
                    if depth < DEPTH:
                        between, mx, my = opposite_middle_turn(
                            mesh, banks, turns, px, py, qx, qy, scale_x, scale_y
                        )
                        if between < 0 and obstacle >= 0:
                            between, mx, my = opposite_wall(
                                mesh, banks, before_wall, obstacle, px, py, qx, qy, scale_x, scale_y
                            )
                is_old = is_near(mx, my, px, py, apart, scale_x, scale_y) or is_near(
                    mx, my, qx, qy, apart, scale_x, scale_y
                )
                if between >= 0 and not is_old:
                    goal_at[top, 2] = depth + 1
                    goal[waiting, 0], goal[waiting, 1] = mx, my
                    goal_at[waiting, 0], goal_at[waiting, 1] = between, n
                    goal_at[waiting, 2] = depth + 1
                    goal_near[waiting, 0], goal_near[waiting, 1] = banks.last[0], banks.last[1]
                    waiting += 1
                    continue
            else:
                end = goal_at[top, 0]
            # 2. Where the path comes back on itself, it had better not gone there: it goes on from
            #    the point before, and the way from there is probed anew.
            before = count - 2
            is_back = turns.size == 0 and turns_back(path, count, qx, qy, scale_x, scale_y)
            if is_back and inside[before] >= 0:
                x, y = path[before, 0], path[before, 1]
                _, obstacle = walk(mesh, inside[before], -1, x, y, qx, qy)
                if obstacle == -1:
                    count, t, px, py = count - 1, inside[before], x, y
                    p_near[0], p_near[1] = feet[before, 0], feet[before, 1]
                    goal_at[top, 2] = min(depth + 1, DEPTH)
                    is_last = ends.are_given and goal_at[top, 1] == n - 1
                    if not is_last and is_near(qx, qy, x, y, apart, scale_x, scale_y):
                        waiting -= 1
                    continue
            # 3. The point itself, by the turns at walls if there are any.
            waiting -= 1
            if count + turns.size + 1 > source.size:
                room = 2 * (count + turns.size + 1)
                path, source = with_rows(path, room), with_places(source, room)
                inside, feet = with_places(inside, room), with_rows(feet, room)
            for v in turns:
                if mesh.x[v] != path[count - 1, 0] or mesh.y[v] != path[count - 1, 1]:
                    path[count, 0], path[count, 1], source[count] = mesh.x[v], mesh.y[v], -1 - v
                    inside[count] = -1
                    count += 1
            if count == 0 or qx != path[count - 1, 0] or qy != path[count - 1, 1]:
                path[count, 0], path[count, 1], source[count] = qx, qy, goal_at[top, 1]
                feet[count, 0], feet[count, 1] = goal_near[top, 0], goal_near[top, 1]
                inside[count] = end
                count += 1
            t, px, py = end, qx, qy
            p_near[0], p_near[1] = goal_near[top, 0], goal_near[top, 1]
    return path[:count], source[:count]


@njit(borrows=True)
def turns_back(
    path: Floats, count: int, x: float, y: float, scale_x: float, scale_y: float
) -> bool:
    """Whether a path of so many points that goes on to (x, y) turns back at its last point."""
    if count < 2:
        return False
    ux, uy = path[count - 1, 0] - path[count - 2, 0], path[count - 1, 1] - path[count - 2, 1]
    vx, vy = x - path[count - 1, 0], y - path[count - 1, 1]
    ux, uy, vx, vy = ux * scale_x, uy * scale_y, vx * scale_x, vy * scale_y
    return abs(ux * vy - uy * vx) <= BACK * -(ux * vx + uy * vy)


@njit(borrows=True)
def ends_of(
    banks: Banks,
    beads: Beads,
    near: Ints,
    are_given: bool,
    apart: float,
    scale_x: float,
    scale_y: float,
) -> Ends:
    """Return the ends of a path, the first and the last bead if they are; note what is near."""
    n = beads.side.size
    x0, y0, x1, y1 = 0.0, 0.0, 0.0, 0.0
    off_0, off_1, reach_0, reach_1 = 0.0, 0.0, 0.0, 0.0
    if are_given:
        x0, y0 = beads.point[0, 0] * scale_x, beads.point[0, 1] * scale_y
        x1, y1 = beads.point[n - 1, 0] * scale_x, beads.point[n - 1, 1] * scale_y
        off_0, reach_0 = off_and_reach(banks, apart, x0, y0)
        near[0, 0], near[0, 1] = banks.last[0], banks.last[1]
        off_1, reach_1 = off_and_reach(banks, apart, x1, y1)
        near[n - 1, 0], near[n - 1, 1] = banks.last[0], banks.last[1]
    return Ends(are_given, x0, y0, off_0, reach_0, x1, y1, off_1, reach_1)


@njit(borrows=True)
def off_and_reach(banks: Banks, apart: float, x: float, y: float) -> tuple[float, float]:
    """How far an end is off the trunk, and how far from it the line may still be on its way."""
    lean = lean_at(banks, x, y)
    if is_level(lean, banks.slack):
        return 0.0, apart
    off = abs(lean.value) / 2.0
    return off, max(min(GLIDE * off, lean.to_main + lean.to_auxiliary), apart)


@njit(borrows=True)
def is_before_end(ends: Ends, x: float, y: float) -> bool:
    """Whether a point is so near to an end that the line has not come to the trunk yet."""
    return ends.are_given and (
        length(x - ends.x0, y - ends.y0) <= ends.reach_0
        or length(x - ends.x1, y - ends.y1) <= ends.reach_1
    )


@njit(borrows=True)
def allowance(ends: Ends, x: float, y: float) -> float:
    """How far off the trunk a point may be because an end is: less and less away from it."""
    if not ends.are_given:
        return 0.0
    first = 1.0 - length(x - ends.x0, y - ends.y0) / (2.0 * ends.reach_0 + TINY)
    last = 1.0 - length(x - ends.x1, y - ends.y1) / (2.0 * ends.reach_1 + TINY)
    return ends.off_0 * max(first, 0.0) + ends.off_1 * max(last, 0.0)


@njit(borrows=True)
def is_near(
    px: float, py: float, qx: float, qy: float, slack: float, scale_x: float, scale_y: float
) -> bool:
    """Whether two points are nearer than what the trunk's points may be off."""
    return length((qx - px) * scale_x, (qy - py) * scale_y) <= slack


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
) -> tuple[int, float, float]:
    """Return the triangle and place of a point of the trunk beside the way from p in t to q.

    It is where the way is farthest off, or where either half of it is, if that cannot be reached;
    -1 if the way is good enough or no point can be. Points that crowd p or q come last.
    """
    best, best_x, best_y, most = -1, 0.0, 0.0, 0.0
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
        hx, hy = ax + at * (bx - ax), ay + at * (by - ay)
        for is_away in (False, True):
            if at < 0.0:
                continue
            ux, uy, _ = way_to_level(lean, hx * scale_x, hy * scale_y)
            if is_away:
                ux, uy = way_from_nearer(lean, hx * scale_x, hy * scale_y)
            is_found, x, y = level_from(banks, lean, hx * scale_x, hy * scale_y, ux, uy)
            x, y = x / scale_x, y / scale_y
            end = walk_by(mesh, t, px, py, hx, hy, x, y) if is_found else -1
            to_p = length((x - px) * scale_x, (y - py) * scale_y)
            to_q = length((x - qx) * scale_x, (y - qy) * scale_y)
            if end >= 0 and min(to_p, to_q) >= enough:
                return end, x, y
            if end >= 0 and min(to_p, to_q) > most:
                best, best_x, best_y, most = end, x, y, min(to_p, to_q)
    if best >= 0:
        lean_at(banks, best_x * scale_x, best_y * scale_y)  # its feet are the last ones
    return best, best_x, best_y


@njit(borrows=True)
def worst_probe(
    banks: Banks, ends: Ends, px: float, py: float, qx: float, qy: float, tolerance: float
) -> tuple[float, Lean]:
    """Return where (0 at p, 1 at q) the way is farthest off the trunk, and how it leans there.

    -1 where no probe is off by more than is allowed.
    """
    span = length(qx - px, qy - py)
    probes, k = 1, 0
    worst, at, worst_lean = tolerance, -1.0, NOWHERE
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
        off -= allowance(ends, x, y)
        if off > worst:
            worst, at, worst_lean = off, share, lean
    return at, worst_lean


@njit(borrows=True)
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
