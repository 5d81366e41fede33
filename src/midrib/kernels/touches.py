r"""Touches: where a hole meets the shell in a vertex, through which the inside does not lead.

  shell            Along the inside the boundary leads from the shell round the hole and back:
----->--v----->    the vertex is two places of it. An area that runs round such a hole from the
      ./ \.        one place to the other is an open ring; on the shell alone both of its ends
      /   \        are the same. There both curves are parts of the boundary of the inside, in
     ^ hole v      a mesh with a vertex for each place.
      \___/
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.ends import mean_width, propose_ends, shorter_bank
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh, boundary_size, doors, next_boundary_side
from midrib.kernels.triangulation import previous_side
from midrib.types import Bools, Floats, Ints

__all__ = ["Proposed", "propose_division"]

HALF = 0.5
LEAST_BANK = 0.25  # of the shorter bank along the inside: less of it on the shell is an open ring


class Proposed(NamedTuple):
    """A boundary to divide and where; see ``division``."""

    mesh: Mesh
    order: Ints
    side: Ints
    height: Floats
    places: Ints
    shares: Floats


@njit(entry=True)
def propose_division(
    mesh: Mesh,
    order: Ints,
    side: Ints,
    height: Floats,
    is_tree: bool,
    scale_x: float,
    scale_y: float,
) -> Proposed:
    """Where an area begins and ends, on its shell, or on the boundary of its inside.

    Parameters
    ----------
    mesh : the area
    order, side : (n,) shell vertices in order and the boundary side that leaves each
    height : Z of each mesh vertex, or empty
    is_tree : whether the area has no holes
    scale_x, scale_y : lengths of one unit of x and of y
    """
    walk = side if is_tree else walk_along(mesh, side[0])
    if walk.size == side.size:
        places, shares = propose_ends(mesh, order, -1, is_tree, scale_x, scale_y)
        return Proposed(mesh, order, side, height, places, shares)
    # 1. Ends on the boundary of the inside.
    apart, origin = taken_apart(mesh)
    inside = np.empty(walk.size, np.intp)
    for i in range(walk.size):
        inside[i] = apart.tri[walk[i]]
    is_simple = walk.size == boundary_size(mesh)
    places, shares = propose_ends(apart, inside, -1, is_simple, scale_x, scale_y)
    # 2. The same on the shell, if they divide it.
    place = np.full(mesh.tri.size, -1, np.intp)
    for k in range(side.size):
        place[side[k]] = k
    on_shell, is_on_shell = np.empty((2, 2), np.intp), True
    for i in range(2):
        for j in range(2):
            k = place[walk[places[i, j]]]
            if k < 0 and shares[i] == 0.0:
                before = place[walk[places[i, j] - 1]]
                k = (before + 1) % side.size if before >= 0 else -1
            on_shell[i, j] = k
            is_on_shell = is_on_shell and k >= 0
    if is_on_shell:
        bank = shorter_bank(arcs(mesh, order, scale_x, scale_y), on_shell, shares)
        whole = shorter_bank(arcs(apart, inside, scale_x, scale_y), places, shares)
        if bank >= LEAST_BANK * whole:
            return Proposed(mesh, order, side, height, on_shell, shares)
    # 3. A curve, or a line, that began and ended in one point would be a loop.
    for j in range(4):
        p, q = places[0, j % 2], places[1, j // 2]
        if max(shares) == 0.0 and origin[inside[p]] == origin[inside[q]]:
            places[0], places[1] = p, q
            for i in range(2):
                step_aside(apart, inside, place[walk] >= 0, i, places, shares, scale_x, scale_y)
    if height.size > 0:
        height = height[origin]
    return Proposed(apart, inside, walk, height, places, shares)


@njit()
def step_aside(
    mesh: Mesh,
    order: Ints,
    is_shell: Bools,
    i: int,
    places: Ints,
    shares: Floats,
    scale_x: float,
    scale_y: float,
) -> None:
    """Move end i half a mean width along the shell, away from the hole that it touches."""
    n, k = order.size, places[i, 0]
    x, y = mesh.x[order] * scale_x, mesh.y[order] * scale_y
    arc = arcs(mesh, order, scale_x, scale_y)
    step = mean_width(x, y, arc) / 2.0
    if is_shell[k]:
        shares[i] = min(step / (arc[k + 1] - arc[k]), HALF)
    else:
        k = (k - 1) % n
        shares[i] = 1.0 - min(step / (arc[k + 1] - arc[k]), HALF)
    places[i, 0] = places[i, 1] = k


@njit()
def walk_along(mesh: Mesh, first: int) -> Ints:
    """Boundary sides along the inside, from one of them until it comes again."""
    walk, count = np.empty(mesh.tri.size, np.intp), 0
    e = first
    while count == 0 or e != first:
        walk[count] = e
        count += 1
        e = next_boundary_side(mesh, e)
    return walk[:count]


@njit()
def taken_apart(mesh: Mesh) -> tuple[Mesh, Ints]:
    """Mesh with a vertex for each fan, and the old vertex of each."""
    n, fans = mesh.x.size, 0
    for v in range(n):
        door = mesh.door[v]
        while door >= 0:
            fans += 1
            door = mesh.other_door[door]
    tri, origin = mesh.tri.copy(), np.empty(n + fans, np.intp)
    for v in range(n):
        origin[v] = v
    count = n
    for v in range(n):
        door = mesh.other_door[mesh.door[v]] if mesh.door[v] >= 0 else -1
        while door >= 0:
            e = door
            while e >= 0:
                tri[e] = count
                e = mesh.twin[previous_side(e)]
            origin[count] = v
            count += 1
            door = mesh.other_door[door]
    origin = origin[:count]
    door, other_door = doors(count, tri, mesh.twin)
    return Mesh(mesh.x[origin], mesh.y[origin], tri, mesh.twin, door, other_door), origin


@njit()
def arcs(mesh: Mesh, order: Ints, scale_x: float, scale_y: float) -> Floats:
    """Arc lengths of a closed ring of vertices; one more than there are, the perimeter."""
    n = order.size
    arc = np.zeros(n + 1)
    for i in range(n):
        a, b = order[i], order[i + 1 if i + 1 < n else 0]
        dx, dy = (mesh.x[b] - mesh.x[a]) * scale_x, (mesh.y[b] - mesh.y[a]) * scale_y
        arc[i + 1] = arc[i] + length(dx, dy)
    return arc
