"""Cuts across an area where it changes between narrow and wide, and the pieces they leave.

         c
    -----o                       p       the change: a point of the skeleton, its disc as wide as
         |`.                             is asked for
     ....x..p....  wide          c, c'   where the disc touches the sides next to p's narrow edge
         |.'                     cut     from c to c'; it has a vertex x where the skeleton crosses
    -----o                               it, at which a line of the narrow part ends
         c'

No two cuts cross: the ends of each are on a disc that has none of the others inside, and so they
are sides of one Delaunay triangulation of all ends.
"""

from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.curves.graphs import Graph
from midrib.layout import Scale
from midrib.types import Floats, Ints

__all__ = ["Beside", "Crossing", "Cut", "Edge", "beside_of", "cut_across", "edge_of", "pieces_of"]

SEEN = 1.5  # times the radius: where contacts are looked for; the nearest one on either side counts
AT_VERTEX = 2.0**-36  # of the extent: a contact this near to a vertex is the vertex
ROUNDING = 2.0**-46  # of the coordinates: a point so near to a cut is on it
INWARDS = (0.0, 1.0, 4.0, 16.0, 64.0)  # roundings of a coordinate, to come inside


Beside: TypeAlias = list[list[tuple[int, int]]]


class Edge(NamedTuple):
    """The boundary of an area."""

    area: Polygon  # prepared
    first: Floats  # (m, 2) start of each segment
    last: Floats
    tree: shapely.STRtree  # of the segments in lengths
    scale: Floats
    extent: float


class Contact(NamedTuple):
    """Where a disc touches the boundary."""

    segment: int
    share: float  # of the segment
    point: Floats  # (2,)


class Crossing(NamedTuple):
    """Where a narrow edge crosses a cut."""

    edge: int
    beyond: int  # its point behind the cut
    share: float  # of the edge before the cut
    point: Floats  # (2,) a vertex of the cut, the end of a line


class Cut(NamedTuple):
    """A cut from contact to contact."""

    contacts: tuple[Contact, Contact]
    path: Floats  # (2 + k, 2) from one over the crossings to the other
    crossings: list[Crossing]
    before: Ints  # narrow points between the change and the cut


def edge_of(area: Polygon, scale: Scale) -> Edge:
    """Boundary of an area."""
    area = shapely.force_2d(area)  # a copy, since it will be prepared
    shapely.prepare(area)
    points, ring = shapely.get_coordinates(shapely.get_rings(area), return_index=True)
    start = np.flatnonzero(ring[:-1] == ring[1:])
    first, last = points[start], points[start + 1]
    lengths = np.array(scale)
    tree = shapely.STRtree(shapely.linestrings(np.stack([first, last], axis=1) * lengths))
    low, high = np.array(area.bounds[:2]), np.array(area.bounds[2:])
    return Edge(area, first, last, tree, lengths, float(np.hypot(*((high - low) * lengths))))


def beside_of(graph: Graph) -> Beside:
    """Edges of each point of a graph, each with the point at its other end."""
    ends = graph.edges.T.ravel()
    order = np.argsort(ends, kind="stable")
    first = np.searchsorted(ends[order], np.arange(len(graph.points) + 1))
    edge = (order % len(graph.edges)).tolist()
    other = graph.edges[:, ::-1].T.ravel()[order].tolist()
    both = list(zip(edge, other, strict=True))
    return [both[a:b] for a, b in pairwise(first)]


def cut_across(edge: Edge, narrow: Graph, beside: Beside, start: int, radius: float) -> Cut | None:
    """Cut an area at a tip of the narrow part of its skeleton; None if that is not possible.

    Parameters
    ----------
    edge : Edge
    narrow : the narrow part of a skeleton
    beside : its edges and points beside each point
    start : the tip, where the skeleton changes
    radius : of the disc around it, in lengths

    Notes
    -----
    The disc holds the triangle p c c', and all of the skeleton in it is narrow: nearer to c or to
    c' than p is. It leaves over the cut, in one way or, if there is a junction before, in several.
    """
    ((_, ahead),) = beside[start]
    along = narrow.points[ahead] - narrow.points[start]
    contacts = contacts_beside(edge, narrow.points[start], along, radius)
    if contacts is None:
        return None
    first, last = (contact.point for contact in contacts)
    chord = last - first
    normal = np.array([-chord[1], chord[0]]) / max(np.hypot(*chord), np.finfo(float).tiny)
    normal *= 1.0 if normal @ along > 0.0 else -1.0
    rounding = ROUNDING * np.abs([first, last]).max()

    def beyond(row: int) -> float:
        """How far a point is beyond the cut; 0 if rounding cannot tell."""
        far = float(normal @ (narrow.points[row] - first))
        return far if abs(far) > rounding else 0.0

    place = {start: min(beyond(start), 0.0)}
    stack, crossings = [start], []
    while stack:
        here = stack.pop()
        for k, there in beside[here]:
            if there in place:
                continue
            far = beyond(there)
            if place[here] < 0.0 and far <= 0.0:
                place[there] = far
                stack.append(there)
                continue
            share = 0.0 if place[here] == 0.0 else place[here] / (place[here] - far)
            step = narrow.points[there] - narrow.points[here]
            crossings.append(Crossing(k, there, share, narrow.points[here] + share * step))
    crossings.sort(key=lambda crossing: float(chord @ (crossing.point - first)))
    path = np.array([first, *(crossing.point for crossing in crossings), last])
    if not edge.area.covers(LineString(path)):
        return None
    return Cut(contacts, path, crossings, np.fromiter(place, dtype=np.intp))


def contacts_beside(
    edge: Edge, point: Floats, along: Floats, radius: float
) -> tuple[Contact, Contact] | None:
    """Nearest points of the boundary to the left and to the right of a way."""
    at, ahead = point * edge.scale, along * edge.scale
    near = edge.tree.query(shapely.Point(at), predicate="dwithin", distance=SEEN * radius)
    a, b = edge.first[near] * edge.scale, edge.last[near] * edge.scale
    side = b - a
    share = np.clip(((at - a) * side).sum(axis=1) / (side * side).sum(axis=1), 0.0, 1.0)
    foot = a + share[:, None] * side
    off = foot - at
    away = np.hypot(*off.T)
    turn = ahead[0] * off[:, 1] - ahead[1] * off[:, 0]
    found = []
    for is_side in (turn > 0.0, turn < 0.0):
        rows = np.flatnonzero(is_side)
        if rows.size == 0:
            return None
        k = rows[np.argmin(away[rows])]
        contact = contact_at(edge, int(near[k]), float(share[k]), point)
        if contact is None:
            return None
        found.append(contact)
    return found[0], found[1]


def contact_at(edge: Edge, segment: int, share: float, inside: Floats) -> Contact | None:
    """Contact on a segment: a vertex if one is that near, else a point that is not outside."""
    a, b = edge.first[segment], edge.last[segment]
    length = np.hypot(*((b - a) * edge.scale))
    for end, vertex in ((0.0, a), (1.0, b)):
        if abs(share - end) * length <= AT_VERTEX * edge.extent:
            return Contact(segment, end, vertex)
    foot = a + share * (b - a)
    inwards = (inside - foot) / max(np.hypot(*(inside - foot)), np.finfo(float).tiny)
    rounding = np.spacing(np.abs([a, b]).max())
    for much in INWARDS:
        there = foot + much * rounding * inwards
        if edge.area.covers(LineString([a, there, b])):
            return Contact(segment, share, there)
    return None


def pieces_of(edge: Edge, cuts: list[Cut]) -> list[Polygon]:
    """Pieces that cuts leave of an area."""
    contacts = [contact for cut in cuts for contact in cut.contacts]
    inner = [c for c in contacts if 0.0 < c.share < 1.0]
    segment = np.array([c.segment for c in inner], dtype=np.intp)
    share = np.array([c.share for c in inner])
    order = np.lexsort([share, segment])
    segment = segment[order]
    placed = np.array([c.point for c in inner]).reshape(-1, 2)[order]
    # Each segment from its start over its contacts to its end.
    start = np.insert(edge.first, segment + 1, placed, axis=0)
    stop = np.insert(edge.last, segment, placed, axis=0)
    across = [np.stack([cut.path[:-1], cut.path[1:]], axis=1) for cut in cuts]
    segments = np.concatenate([np.stack([start, stop], axis=1), *across])
    distinct = (segments[:, 0] != segments[:, 1]).any(axis=1)
    faces = shapely.get_parts(shapely.polygonize(shapely.linestrings(segments[distinct])))
    inside = shapely.point_on_surface(faces)
    return list(faces[shapely.contains(edge.area, inside)])
