r"""Tracing: the path from stop to stop along the trunk, with points between where they are needed.

A stop, or a point between, is a *goal*; goals wait on a stack, the next one on top. Where the way
to it is free and good enough the path arrives there; if not, a point of the trunk between becomes
the next goal. All that goes on without an array being made: the rest, turns at walls and searches
for what lies outside by rounding, is left to ``trace``.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.banks import Banks
from midrib.kernels.glide import Ends, is_before_end
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.looking import look_between, look_everywhere
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
from midrib.kernels.probes import is_between_lines, point_beside
from midrib.kernels.tables import with_places, with_rows
from midrib.kernels.turns import opposite_middle_turn, opposite_wall
from midrib.kernels.ways import Stops
from midrib.types import Floats, Ints

__all__ = ["trace"]

DEPTH = 16  # halvings of the way between two radii
BACK = 0.25  # tangent of what is left of a half turn where a path comes back on itself
# What a path that goes on is to do, or what it waits for.
GO_ON, ARRIVE, ARRIVE_BY_TURNS, ALL_DONE, LOST, BLOCKED, FULL = range(7)


class Track(NamedTuple):
    """The path so far."""

    point: Floats  # (m, 2)
    source: Ints  # the bead that each point is, one past them for a point between; -1 - v
    inside: Ints  # its triangle, or -1
    feet: Ints  # (m, 2) the segments of its feet on both banks


class Goals(NamedTuple):
    """Points that wait to be reached, the next one last."""

    point: Floats  # (k, 2)
    at: Ints  # (k, 4) triangle, source, depth, whether the way there is known to be free
    near: Ints  # (k, 2) segments of both banks


@njit()
def new_track(size: int) -> Track:
    """Room for so many points."""
    return Track(
        np.empty((size, 2)),
        np.empty(size, np.intp),
        np.empty(size, np.intp),
        np.empty((size, 2), np.intp),
    )


@njit()
def longer_track(track: Track, size: int) -> Track:
    """Return the same with room for so many points."""
    return Track(
        with_rows(track.point, size),
        with_places(track.source, size),
        with_places(track.inside, size),
        with_rows(track.feet, size),
    )


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
    track = new_track(4 * n + 16)
    goals = Goals(
        np.empty((DEPTH + 4, 2)),
        np.empty((DEPTH + 4, 4), np.intp),
        np.empty((DEPTH + 4, 2), np.intp),
    )
    p_near = np.zeros(2, np.intp)
    status, k, waiting, count, t, px, py = GO_ON, -1, 0, 0, -1, 0.0, 0.0
    while status != ALL_DONE:
        status, k, waiting, count, t, px, py = advance(
            mesh, banks, beads, stops, ends, track, goals, p_near,
            status, k, waiting, count, t, px, py, tolerance, apart, scale_x, scale_y,
        )  # fmt: skip
        if status == FULL:
            track, status = longer_track(track, 2 * count + 16), GO_ON
        elif status == LOST:
            i, status = stops.at[k], GO_ON
            end, qx, qy = locate_from(
                mesh, beads.side[i], beads.origin[i, 0], beads.origin[i, 1],
                stops.point[k, 0], stops.point[k, 1], search,
            )  # fmt: skip
            is_end = ends.are_given and i in (0, n - 1)
            if aims_at(ends, end, is_end, t, px, py, qx, qy, apart, scale_x, scale_y):
                waiting = add_goal(goals, 0, end, i, 0, False, qx, qy, stops.nearest[k])
        elif status == BLOCKED:
            top = waiting - 1
            qx, qy, depth = goals.point[top, 0], goals.point[top, 1], goals.at[top, 2]
            before_wall, obstacle = walk(mesh, t, -1, px, py, qx, qy)
            sleeve = find_sleeve(mesh, t, goals.at[top, 0], px, py, qx, qy, search)
            turns = pull_tight(mesh, sleeve, px, py, qx, qy)
            look_everywhere(banks)
            between, mx, my = -1, 0.0, 0.0
            if depth < DEPTH:
                between, mx, my = opposite_middle_turn(
                    mesh, banks, turns, px, py, qx, qy, scale_x, scale_y
                )
                if between < 0 and obstacle >= 0:
                    between, mx, my = opposite_wall(
                        mesh, banks, before_wall, obstacle, px, py, qx, qy, scale_x, scale_y
                    )
            if between >= 0 and is_new(mx, my, px, py, qx, qy, apart, scale_x, scale_y):
                goals.at[top, 2], status = depth + 1, GO_ON
                waiting = add_goal(goals, waiting, between, n, depth + 1, False, mx, my, banks.last)
            else:
                if count + turns.size >= track.source.size:
                    track = longer_track(track, 2 * (count + turns.size + 1))
                count = add_turns(mesh, turns, track, count)
                status = ARRIVE_BY_TURNS if turns.size > 0 else ARRIVE
    return track.point[:count], track.source[:count]


@njit(inline=True, borrows=True)
def advance(
    mesh: Mesh,
    banks: Banks,
    beads: Beads,
    stops: Stops,
    ends: Ends,
    track: Track,
    goals: Goals,
    p_near: Ints,
    status: int,
    k: int,
    waiting: int,
    count: int,
    t: int,
    px: float,
    py: float,
    tolerance: float,
    apart: float,
    scale_x: float,
    scale_y: float,
) -> tuple[int, int, int, int, int, float, float]:
    """Go on as far as no array need be made: to the last stop, or to where the way is blocked.

    From p in triangle t, to stop k, with so many goals that wait and points of the path; return
    the same, as far as it came.
    """
    n, path = beads.side.size, track.point
    while True:
        # 1. The next stop, if it is not hidden.
        if waiting == 0:
            k += 1
            if k == stops.at.size:
                return ALL_DONE, k, waiting, count, t, px, py
            qx, qy, i = stops.point[k, 0], stops.point[k, 1], stops.at[k]
            end, obstacle = -1, -2
            if t >= 0:
                end, obstacle = walk(mesh, t, -1, px, py, qx, qy)
            if i < 0:
                end, i = -1 - i, n
            elif obstacle != -1:
                ox, oy = beads.origin[i, 0], beads.origin[i, 1]
                end, qx, qy = locate_beside(mesh, beads.side[i], beads.vertex[i], ox, oy, qx, qy, t)
                if end == FARTHER:
                    return LOST, k, waiting, count, t, px, py
            is_end = ends.are_given and i in (0, n - 1)
            if aims_at(ends, end, is_end, t, px, py, qx, qy, apart, scale_x, scale_y):
                is_free = obstacle == -1
                waiting = add_goal(goals, 0, end, i, 0, is_free, qx, qy, stops.nearest[k])
            continue
        if count == track.source.size:
            return FULL, k, waiting, count, t, px, py
        # 2. A point between, if the way to the goal is not good enough.
        top = waiting - 1
        qx, qy, depth = goals.point[top, 0], goals.point[top, 1], goals.at[top, 2]
        end, is_free = goals.at[top, 0], goals.at[top, 3] != 0
        if t >= 0 and status == GO_ON:
            if not is_free:
                end, obstacle = walk(mesh, t, -1, px, py, qx, qy)
                if obstacle != -1:
                    return BLOCKED, k, waiting, count, t, px, py
            goals.at[top, 3] = 0  # from where the path is next nobody knows
            between, mx, my, is_seen = -1, 0.0, 0.0, False
            if depth < DEPTH:
                if ends.are_given and (count == 1 or goals.at[top, 1] == n - 1):
                    look_everywhere(banks)  # ends are off the trunk
                else:
                    look_between(
                        banks, p_near, goals.near[top],
                        px * scale_x, py * scale_y, qx * scale_x, qy * scale_y,
                    )  # fmt: skip
                if not is_between_lines(
                    banks, p_near, goals.near[top], px * scale_x, py * scale_y,
                    qx * scale_x, qy * scale_y, tolerance,
                ):  # fmt: skip
                    between, mx, my, is_seen = point_beside(
                        mesh, banks, ends, t, px, py, qx, qy, tolerance, scale_x, scale_y
                    )
            if between >= 0 and is_new(mx, my, px, py, qx, qy, apart, scale_x, scale_y):
                goals.at[top, 0], goals.at[top, 2] = end, depth + 1
                waiting = add_goal(
                    goals, waiting, between, n, depth + 1, is_seen, mx, my, banks.last
                )
                continue
        # 3. Where the path comes back on itself, it had better not gone there: it goes on from
        #    the point before, and the way from there is probed anew.
        before, by_turns = count - 2, status == ARRIVE_BY_TURNS
        status = GO_ON
        is_back = not by_turns and turns_back(path, count, qx, qy, scale_x, scale_y)
        if is_back and track.inside[before] >= 0:
            x, y = path[before, 0], path[before, 1]
            _, obstacle = walk(mesh, track.inside[before], -1, x, y, qx, qy)
            if obstacle == -1:
                count, t, px, py = count - 1, track.inside[before], x, y
                p_near[0], p_near[1] = track.feet[before, 0], track.feet[before, 1]
                goals.at[top, 2], goals.at[top, 3] = min(depth + 1, DEPTH), 1
                is_last = ends.are_given and goals.at[top, 1] == n - 1
                if not is_last and is_near(qx, qy, x, y, apart, scale_x, scale_y):
                    waiting -= 1
                continue
        # 4. The goal itself.
        waiting -= 1
        p_near[0], p_near[1] = goals.near[top, 0], goals.near[top, 1]
        if count == 0 or qx != path[count - 1, 0] or qy != path[count - 1, 1]:
            path[count, 0], path[count, 1] = qx, qy
            track.source[count], track.inside[count] = goals.at[top, 1], end
            track.feet[count, 0], track.feet[count, 1] = p_near[0], p_near[1]
            count += 1
        t, px, py = end, qx, qy


@njit(borrows=True)
def aims_at(
    ends: Ends,
    end: int,
    is_end: bool,
    t: int,
    px: float,
    py: float,
    qx: float,
    qy: float,
    apart: float,
    scale_x: float,
    scale_y: float,
) -> bool:
    """Whether a path in p goes to a stop q: not if it is there, nor if an end hides the stop."""
    if end < 0 or is_end:
        return end >= 0
    is_repeat = t >= 0 and is_near(qx, qy, px, py, apart, scale_x, scale_y)
    return not (is_repeat or is_before_end(ends, qx * scale_x, qy * scale_y))


@njit(borrows=True)
def add_goal(
    goals: Goals,
    waiting: int,
    t: int,
    source: int,
    depth: int,
    is_free: bool,
    x: float,
    y: float,
    near: Ints,
) -> int:
    """Put a goal on top; the new number of them."""
    goals.point[waiting, 0], goals.point[waiting, 1] = x, y
    goals.at[waiting, 0], goals.at[waiting, 1], goals.at[waiting, 2] = t, source, depth
    goals.at[waiting, 3] = is_free
    goals.near[waiting, 0], goals.near[waiting, 1] = near[0], near[1]
    return waiting + 1


@njit(borrows=True)
def add_turns(mesh: Mesh, turns: Ints, track: Track, count: int) -> int:
    """Append the vertices at which a path turns; the new number of its points."""
    path = track.point
    for v in turns:
        if mesh.x[v] != path[count - 1, 0] or mesh.y[v] != path[count - 1, 1]:
            path[count, 0], path[count, 1] = mesh.x[v], mesh.y[v]
            track.source[count], track.inside[count] = -1 - v, -1
            count += 1
    return count


@njit(borrows=True)
def is_new(
    x: float,
    y: float,
    px: float,
    py: float,
    qx: float,
    qy: float,
    apart: float,
    scale_x: float,
    scale_y: float,
) -> bool:
    """Whether a point is neither p nor q."""
    return not (
        is_near(x, y, px, py, apart, scale_x, scale_y)
        or is_near(x, y, qx, qy, apart, scale_x, scale_y)
    )


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
