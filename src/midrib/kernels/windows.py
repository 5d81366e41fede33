r"""What a point of the boundary sees: windows from triangle to triangle.

P looks out of its triangle. Through each open side goes a *window*, the part of the side that P
sees between two mesh vertices; behind it lies one more triangle, whose other two sides get what is
left of the window.

        left                        P        a point of the boundary
          \\      .                  window   the rays from P by ``right`` and ``left``
           \\   .   \\
            \\.......\\
           P --------- right ---

A table of windows has one row each: side, right, left.
"""

from typing import NamedTuple

from midrib.kernels.jit import njit
from midrib.kernels.mesh import Mesh, is_beyond, pull_inside
from midrib.kernels.tables import with_rows
from midrib.kernels.triangulation import next_side, previous_side
from midrib.types import Ints

__all__ = ["Spot", "add_window", "first_windows", "part_window", "spot_at", "with_room"]


class Spot(NamedTuple):
    """A point of the boundary: on a boundary side, at a mesh vertex or -1."""

    x: float
    y: float
    side: int
    vertex: int


@njit(borrows=True)
def spot_at(mesh: Mesh, x: float, y: float, side: int, vertex: int) -> Spot:
    """Return a point of the boundary to look from.

    Where rounding has put it outside of its side, the next point inside: from there a straight
    wall does not hide what lies along it.
    """
    if vertex < 0 and is_beyond(mesh, side, x, y):
        x, y, _ = pull_inside(mesh, side // 3, x, y)
    return Spot(x, y, side, vertex)


@njit()
def with_room(windows: Ints, count: int) -> Ints:
    """Return the table itself, or a copy twice as long where fewer than three rows are left."""
    if count + 3 <= windows.shape[0]:
        return windows
    return with_rows(windows, 2 * windows.shape[0])


@njit(inline=True, borrows=True)
def add_window(windows: Ints, count: int, side: int, right: int, left: int) -> int:
    """Append a window; return the new count."""
    windows[count, 0], windows[count, 1], windows[count, 2] = side, right, left
    return count + 1


@njit()
def first_windows(mesh: Mesh, spot: Spot, windows: Ints) -> tuple[Ints, int]:
    """Return the sides that a point of the boundary sees without looking through another one.

    Of a point on a side, those of its triangle; of a vertex, the rims and outer sides of its fans.
    In a triangle thinner than rounding the point may lie beyond a side; then it looks out of the
    triangle there.
    """
    count, side = 0, spot.side
    if spot.vertex < 0:
        count = add_window(windows, count, side, mesh.tri[side], mesh.tri[next_side(side)])
        for e in (next_side(side), previous_side(side)):
            if not is_beyond(mesh, e, spot.x, spot.y):
                count = add_window(windows, count, e, mesh.tri[e], mesh.tri[next_side(e)])
                continue
            f = mesh.twin[e]
            if f < 0:
                continue
            for g in (next_side(f), previous_side(f)):
                if not is_beyond(mesh, g, spot.x, spot.y):
                    count = add_window(windows, count, g, mesh.tri[g], mesh.tri[next_side(g)])
        return windows, count
    door = mesh.door[spot.vertex]
    while door >= 0:
        e = door
        count = add_window(windows, count, e, mesh.tri[e], mesh.tri[next_side(e)])
        while e >= 0:
            windows = with_room(windows, count)
            across, rim = next_side(e), previous_side(e)
            count = add_window(windows, count, across, mesh.tri[across], mesh.tri[rim])
            if mesh.twin[rim] < 0:
                count = add_window(windows, count, rim, mesh.tri[rim], spot.vertex)
            e = mesh.twin[rim]
        door = mesh.other_door[door]
        windows = with_room(windows, count)
    return windows, count


@njit(inline=True, borrows=True)
def part_window(
    e: int, w: int, right: int, left: int, by_right: float, by_left: float, windows: Ints
) -> int:
    """Part what a window shows among the two sides behind it. Return the number of new windows.

    ``e`` is the half-edge behind the window; it runs from left to right as P sees it, so its next
    side is the right one. ``w`` is the vertex across from it, and ``by_right`` and ``by_left`` are
    positive if w lies to the left of the ray by that end of the window.
    """
    count = 0
    if by_right >= 0.0:
        count = add_window(windows, count, next_side(e), right, w if by_left < 0.0 else left)
    if by_left <= 0.0:
        count = add_window(windows, count, previous_side(e), w if by_right > 0.0 else right, left)
    return count
