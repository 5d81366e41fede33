"""Cuts across an area where it changes between narrow and wide, and the pieces they leave.

         c
    -----o                       p       the change: a point of the skeleton, its disc as wide as
         |`.                             is asked for
     ....x..p....  wide          c, c'   where the disc touches the sides next to p's narrow edge
         |.'                     cut     from c to c'; it has a vertex x where the skeleton crosses
    -----o                               it, at which the line of the narrow part ends
         c'

No two cuts cross: the ends of each are on a disc that has none of the others inside, and so they
are sides of one Delaunay triangulation of all ends.
"""

from typing import NamedTuple

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.layout import Scale
from midrib.types import Floats

__all__ = ["Cut", "Edge", "cut_across", "edge_of", "pieces_of"]

SEEN = 1.5  # times the radius: where contacts are looked for; the nearest one on either side counts
AT_VERTEX = 2.0**-36  # of the extent: a contact this near to a vertex is the vertex
ROUNDING = 2.0**-46  # of the coordinates: a vertex so little beyond a cut is on it
INWARDS = (0.0, 1.0, 4.0, 16.0, 64.0)  # roundings of a coordinate, to come inside


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


class Cut(NamedTuple):
    """A cut from contact to contact."""

    contacts: tuple[Contact, Contact]
    crossing: Floats  # (2,) vertex on it, the end of the line
    kept: int  # points of the way into the narrow part, from its far end, that are beyond


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


def cut_across(edge: Edge, way: Floats, radius: float) -> Cut | None:
    """Cut an area at the first point of a way into a narrow part; None if that is not possible.

    Parameters
    ----------
    edge : Edge
    way : (n, 2) points of the skeleton from the change on
    radius : of the disc around it, in lengths
    """
    contacts = contacts_beside(edge, way[0], way[1] - way[0], radius)
    if contacts is None:
        return None
    ends = np.stack([contact.point for contact in contacts])
    chord, line = LineString(ends), LineString(way)
    met = shapely.get_coordinates(chord.intersection(line))
    crossing, kept = way[0], len(way) - 1  # by the two radii, where the way does not get so far
    if len(met):
        along = shapely.line_locate_point(line, shapely.points(met))
        at = float(along.min())
        reached = np.append(0.0, np.cumsum(np.hypot(*np.diff(way, axis=0).T)))
        rounding = ROUNDING * (at + np.abs(way).max())
        beyond = int(np.count_nonzero(reached > at + rounding))
        if beyond:
            crossing, kept = met[np.argmin(along)], beyond
    if not edge.area.covers(LineString([ends[0], crossing, ends[1]])):
        return None
    return Cut(contacts, crossing, kept)


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
    across = [
        step
        for cut in cuts
        for step in (
            (cut.contacts[0].point, cut.crossing),
            (cut.crossing, cut.contacts[1].point),
        )
    ]
    segments = np.concatenate([np.stack([start, stop], axis=1), np.array(across).reshape(-1, 2, 2)])
    distinct = (segments[:, 0] != segments[:, 1]).any(axis=1)
    faces = shapely.get_parts(shapely.polygonize(shapely.linestrings(segments[distinct])))
    inside = shapely.point_on_surface(faces)
    return list(faces[shapely.contains(edge.area, inside)])
