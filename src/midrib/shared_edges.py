"""Shared edges: where the boundaries of two areas run together.

 i's boundary   a---------------------b      Every vertex that lies on a segment of another area
 j's boundary   a------t--------------b      is made a vertex of that segment too; then two areas
                                             share the pieces that have the same two ends, and
                a======t==============b      a *shared edge* is a longest chain of such pieces.

*Near*: a vertex counts as on a segment, and two vertices as one, if they are not farther apart than
the rounding of the coordinates. Coordinates that are all multiples of one step (millimetres in a
file with three decimals) are rounded by up to 0.71 steps in the plane: near is 0.75 steps. A step
is believed if it is small beside the areas, so that round numbers are not taken for rounded ones;
otherwise near is what some computing in double precision leaves behind.
"""

from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from midrib.types import Bools, Floats, Ints

__all__ = ["SharedEdge", "SharedEdges", "find_shared_edges", "rounding_of"]

COMPUTED = 2.0**-46  # of the largest coordinate: 64 units in its last place
SMALL_STEP = 2.0**-10  # of the median size of an area
ROUNDED = 0.75  # of a step, a little more than half the diagonal of its square
SURE = 0.25  # of a step: how well multiples of it are told from what lies between


class SharedEdge(NamedTuple):
    """A chain that two areas have in common."""

    areas: tuple[int, int]  # ascending
    points: Floats  # (k, 2) from the end farther left, of two equally far left the lower one
    corners: tuple[Floats, Floats]  # (2, 2) each: its ends as either area has them
    is_closed: bool


class SharedEdges(NamedTuple):
    """Shared edges, and the areas with every end of one as a vertex."""

    edges: list[SharedEdge]
    areas: NDArray[np.object_]


class Nodes(NamedTuple):
    """Boundaries with the vertices of others on them, ring after ring."""

    vertex: Ints  # which distinct vertex each one is
    row: Ints  # of the coordinates: its own, or that of the segment's start
    share: Floats  # of the segment, 0 for vertices of the area's own
    area: Ints
    following: Ints  # the next node of the ring


def find_shared_edges(areas: NDArray[np.object_]) -> SharedEdges:
    """Find where boundaries run together.

    Parameters
    ----------
    areas : (n,) Polygons with finite coordinates

    Notes
    -----
    O(n log n) for n vertices, for areas that do not lie on each other in heaps. The edges are in
    an order of their own places, not of the areas.
    """
    if not areas.size:
        return SharedEdges([], areas)
    size = float(np.median(np.sqrt(shapely.area(areas))))
    near = rounding_of(shapely.get_coordinates(areas), size)
    close = with_close_bounds(areas, near)
    rings, owner = shapely.get_rings(areas[close], return_index=True)
    if not rings.size:
        return SharedEdges([], areas)
    coordinates = shapely.get_coordinates(rings) + 0.0  # so that there is one zero only
    ring = np.repeat(np.arange(rings.size), shapely.get_num_coordinates(rings))
    points, vertex = np.unique(coordinates, axis=0, return_inverse=True)
    vertex = merged(points, near)[vertex.ravel()]
    nodes = with_others(coordinates, ring, close[owner], points, vertex, near)
    edges, needed = chains(nodes, points, coordinates)
    return SharedEdges(edges, with_vertices(areas, close[owner][ring], nodes, needed))


def with_close_bounds(areas: NDArray[np.object_], near: float) -> Ints:
    """Return the areas whose bounds come near to those of another one."""
    low_x, low_y, high_x, high_y = shapely.bounds(areas).T
    boxes = shapely.box(low_x - near, low_y - near, high_x + near, high_y + near)
    one, two = shapely.STRtree(boxes).query(boxes)
    return np.unique(one[one != two])


def rounding_of(coordinates: Floats, size: float) -> float:
    """How near is near, for areas of a median size; see the head of this file."""
    noise = COMPUTED * float(np.abs(coordinates).max(initial=0.0))
    step = max(step_of(coordinates[:, 0], noise), step_of(coordinates[:, 1], noise))
    return max(ROUNDED * step, noise) if step <= SMALL_STEP * size else noise


def step_of(values: Floats, noise: float) -> float:
    """Return the largest step of which all differences are multiples, 0 if there is none.

    Euclid's algorithm on all differences at once: each round leaves the remainders by the
    smallest. They are known to within ``noise`` times the multiple.
    """
    gaps = np.diff(np.unique(values))
    gaps = gaps[gaps > noise]
    while gaps.size:
        step = gaps.min()
        multiple = np.rint(gaps / step)
        if noise * multiple.max() > SURE * step:
            return 0.0
        rest = np.abs(gaps - multiple * step)
        rest = rest[rest > noise * (1.0 + multiple)]
        if not rest.size:
            return float(step)
        gaps = np.append(rest, step)
    return 0.0


def merged(points: Floats, near: float) -> Ints:
    """Return for each point the first of those it can be reached from in steps of ``near``."""
    first = np.arange(len(points))
    there = shapely.points(points)
    a, b = shapely.STRtree(there).query(there, predicate="dwithin", distance=near)
    a, b = a[b < a], b[b < a]
    while a.size:
        low = np.minimum(first[a], first[b])
        before = first.copy()
        np.minimum.at(first, a, low)
        np.minimum.at(first, b, low)
        if (first == before).all():
            break
    return first


def with_others(
    coordinates: Floats, ring: Ints, area_of_ring: Ints, points: Floats, vertex: Ints, near: float
) -> Nodes:
    """Put the vertices of others into the boundaries; drop repeats."""
    moves = (coordinates[:-1] != coordinates[1:]).any(axis=1)
    start = np.flatnonzero((ring[:-1] == ring[1:]) & moves)  # rows that a segment leaves
    a, b = coordinates[start], coordinates[start + 1]
    tree = shapely.STRtree(shapely.linestrings(np.stack([a, b], axis=1)))
    used = np.unique(vertex)
    p, s = tree.query(shapely.points(points[used]), predicate="dwithin", distance=near)
    p = used[p]
    along = b[s] - a[s]
    share = ((points[p] - a[s]) * along).sum(axis=1) / (along * along).sum(axis=1)
    is_end = (vertex[start[s]] == p) | (vertex[start[s] + 1] == p)
    inside = ~is_end & (share > 0.0) & (share < 1.0)
    p, s, share = p[inside], s[inside], share[inside]
    row = np.concatenate([start, start[s]])
    share = np.concatenate([np.zeros(start.size), share])
    nodes = np.concatenate([vertex[start], p])
    order = np.lexsort((share, row))
    row, share, nodes = row[order], share[order], nodes[order]
    kept, following = without_spikes(nodes, ring[row])
    row = row[kept]
    return Nodes(nodes[kept], row, share[kept], area_of_ring[ring[row]], following)


def without_spikes(vertex: Ints, ring: Ints) -> tuple[Ints, Ints]:
    """Return the nodes but for repeats and for spikes a, b, a; and the node after each of them.

    What is left of a notch as narrow as the rounding, once its sides have each other's vertices.
    """
    kept = np.arange(vertex.size)
    while True:
        v, r = vertex[kept], ring[kept]
        last = np.append(r[1:] != r[:-1], True)
        first = np.roll(last, 1)
        following, before = np.arange(1, r.size + 1), np.arange(-1, r.size - 1)
        following[last], before[first] = np.flatnonzero(first), np.flatnonzero(last)
        drop = (v == v[before]) | (v[before] == v[following])
        if not drop.any():
            return kept, following
        kept = kept[~drop]


def chains(nodes: Nodes, points: Floats, coordinates: Floats) -> tuple[list[SharedEdge], Bools]:
    """Shared edges, and which nodes that are no vertices of their area are ends of one."""
    mine, other = shared_pieces(nodes)
    row_of = {
        (int(e), int(nodes.area[f])): p for p, (e, f) in enumerate(zip(mine, other, strict=True))
    }
    after = [
        row_of.get((int(nodes.following[e]), int(nodes.area[f])), -1)
        for e, f in zip(mine, other, strict=True)
    ]
    has_before = np.zeros(mine.size, dtype=np.bool_)
    has_before[[p for p in after if p >= 0]] = True
    needed = np.zeros(nodes.row.size, dtype=np.bool_)
    done = np.zeros(mine.size, dtype=np.bool_)
    edges = []
    for head in [*np.flatnonzero(~has_before), *np.flatnonzero(has_before)]:
        if done[head]:
            continue
        run, p = [], int(head)
        while p >= 0 and not done[p]:
            done[p] = True
            run.append(p)
            p = after[p]
        walk = [*mine[run], nodes.following[mine[run[-1]]]]
        ends = [walk[0], walk[-1]]
        ends_beside = [same_node(nodes, int(other[run[i]]), int(ends[i])) for i in (0, -1)]
        needed[[*ends, *ends_beside]] = True
        edges.append(edge_of(nodes, points, coordinates, walk, ends_beside))
    edges.sort(key=lambda edge: (*edge.points.min(axis=0), *edge.points.ravel()))
    return edges, needed & (nodes.share > 0.0)


def same_node(nodes: Nodes, piece: int, node: int) -> int:
    """Return the end of a piece that is the same vertex as a node of another boundary."""
    ends = piece, int(nodes.following[piece])
    return ends[0] if nodes.vertex[ends[0]] == nodes.vertex[node] else ends[1]


def shared_pieces(nodes: Nodes) -> tuple[Ints, Ints]:
    """Pairs of pieces with the same two ends, by the nodes they leave; the lower area first."""
    one, two = nodes.vertex, nodes.vertex[nodes.following]
    key = np.minimum(one, two) * (nodes.vertex.max() + 1) + np.maximum(one, two)
    order = np.argsort(key, kind="stable")
    ranked = key[order]
    mine, other = [np.empty(0, dtype=np.intp)], [np.empty(0, dtype=np.intp)]
    lag = 1
    while (same := np.flatnonzero(ranked[lag:] == ranked[:-lag])).size:
        mine.append(order[same])
        other.append(order[same + lag])
        lag += 1
    a, b = np.concatenate(mine), np.concatenate(other)
    swap = nodes.area[a] > nodes.area[b]
    a, b = np.where(swap, b, a), np.where(swap, a, b)
    apart = (nodes.area[a] != nodes.area[b]) & (one[a] != two[a])
    a, b = a[apart], b[apart]
    order = np.argsort(a, kind="stable")
    return a[order], b[order]


def edge_of(
    nodes: Nodes, points: Floats, coordinates: Floats, walk: list[int], ends_beside: list[int]
) -> SharedEdge:
    """Shared edge along a walk over nodes of one area, in its direction of reference."""
    chain = points[nodes.vertex[walk]]
    ends = [walk[0], walk[-1]]
    is_closed = bool(nodes.vertex[ends[0]] == nodes.vertex[ends[1]])
    corners = [
        places(nodes.row[both], nodes.share[both], coordinates) for both in (ends, ends_beside)
    ]
    pair = int(nodes.area[ends[0]]), int(nodes.area[ends_beside[0]])
    if is_closed:
        chain = np.roll(chain[:-1], -int(np.lexsort(chain[:-1].T[::-1])[0]), axis=0)
        chain = np.vstack([chain, chain[:1]])
        if tuple(chain[1]) > tuple(chain[-2]):
            chain = chain[::-1]
    if tuple(chain[0]) > tuple(chain[-1]):
        chain, corners = chain[::-1], [c[::-1] for c in corners]
    return SharedEdge(pair, chain, (corners[0], corners[1]), is_closed)


def places(at: Ints, share: Floats, rows: Floats) -> Floats:
    """Coordinates of nodes on their own boundary: a vertex, or the foot of another's vertex."""
    place: Floats = rows[at].copy()
    inside = share > 0.0
    at = at[inside]
    place[inside] += share[inside][:, None] * (rows[at + 1] - rows[at])
    return place


def with_vertices(
    areas: NDArray[np.object_], area_of_row: Ints, nodes: Nodes, needed: Bools
) -> NDArray[np.object_]:
    """Areas with the needed nodes as vertices; a Z is interpolated."""
    changed = areas.copy()
    extra = np.flatnonzero(needed)
    for i in np.unique(nodes.area[extra]):
        mine = extra[nodes.area[extra] == i]
        first, rings = int(np.searchsorted(area_of_row, i)), []
        for ring in shapely.get_rings(areas[i]):
            rows = shapely.get_coordinates(ring, include_z=areas[i].has_z)
            here = mine[(nodes.row[mine] >= first) & (nodes.row[mine] < first + len(rows))]
            at = nodes.row[here] - first
            new = places(at, nodes.share[here], rows)
            rings.append(np.insert(rows, at + 1, new, axis=0))
            first += len(rows)
        area = shapely.Polygon(rings[0], rings[1:])
        if area.is_valid:  # a notch as narrow as the rounding may close on itself
            changed[i] = area
    return changed
