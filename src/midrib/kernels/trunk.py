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

from midrib.kernels.banks import Banks, banks_of, look_between, look_everywhere
from midrib.kernels.chain import Chain
from midrib.kernels.glide import Ends, ends_of, is_before_end
from midrib.kernels.islands import has_islands, loops_of, no_loops
from midrib.kernels.jit import njit
from midrib.kernels.joining import Joined, cut_all_loops, join_beads, string_beads
from midrib.kernels.landings import land, take_off
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.paths import (
    FARTHER,
    Beads,
    find_sleeve,
    locate_beside,
    locate_from,
    new_search,
    pull_tight,
    walk,
)
from midrib.kernels.probes import apart_of, is_between_lines, point_beside
from midrib.kernels.tables import with_places, with_rows
from midrib.kernels.turns import opposite_middle_turn, opposite_wall
from midrib.kernels.ways import Stops, is_of_main, level_beads, shores_outside, stops_on_way
from midrib.types import Floats, Ints

__all__ = ["SHARE_OF_SLACK", "trace", "trace_trunk"]

SHARE_OF_SLACK = 2.0**-24  # of the tolerance: what points of the trunk may be off it
DEPTH = 16  # halvings of the way between two radii
BACK = 0.25  # tangent of what is left of a half turn where a path comes back on itself


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
    tolerance : how far (in lengths) a probe may be from the trunk; 0 for exact straight stretches
        with their kinks as vertices, and arcs to a 10,000th of the width
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
    slack = SHARE_OF_SLACK * tolerance
    loops, kept = no_loops(), beads_in_order(points[:, 4], first, n)
    with_islands = has_islands(mesh, main, auxiliary)
    if with_islands:
        some = Beads(beads.point[kept], beads.origin[kept], beads.side[kept], beads.vertex[kept])
        path = join_beads(mesh, some, scale_x, scale_y).points
        loops = loops_of(mesh, main, auxiliary, path, scale_x, scale_y)
    banks = banks_of(mesh, main, auxiliary, loops, slack, scale_x, scale_y)
    apart = apart_of(banks, tolerance)
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
    # Fields taken out once: each access to one of a tuple counts references.
    stop_point, stop_at, stop_near = stops.point, stops.at, stops.nearest
    origin, side, vertex, latest = beads.origin, beads.side, beads.vertex, banks.last
    for k in range(stop_at.size):
        qx, qy, i = stop_point[k, 0], stop_point[k, 1], stop_at[k]
        if i < 0:
            end, i = -1 - i, n
        else:
            ox, oy = origin[i, 0], origin[i, 1]
            end, qx, qy = locate_beside(mesh, side[i], vertex[i], ox, oy, qx, qy, t)
            if end == FARTHER:
                end, qx, qy = locate_from(mesh, side[i], ox, oy, qx, qy, search)
        is_end = ends.are_given and i in (0, n - 1)
        is_repeat = t >= 0 and is_near(qx, qy, px, py, apart, scale_x, scale_y)
        hides = not is_end and (is_repeat or is_before_end(ends, qx * scale_x, qy * scale_y))
        if end < 0 or hides:
            continue
        goal[0, 0], goal[0, 1] = qx, qy
        goal_at[0, 0], goal_at[0, 1], goal_at[0, 2] = end, i, 0
        goal_near[0, 0], goal_near[0, 1] = stop_near[k, 0], stop_near[k, 1]
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
                        if not is_between_lines(
                            banks, p_near, goal_near[top], px * scale_x, py * scale_y,
                            qx * scale_x, qy * scale_y, tolerance,
                        ):  # fmt: skip
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
                    goal_near[waiting, 0], goal_near[waiting, 1] = latest[0], latest[1]
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
def is_near(
    px: float, py: float, qx: float, qy: float, slack: float, scale_x: float, scale_y: float
) -> bool:
    """Whether two points are nearer than what the trunk's points may be off."""
    return length((qx - px) * scale_x, (qy - py) * scale_y) <= slack
