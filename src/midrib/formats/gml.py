"""GML that GDAL loses geometries of: features one at a time, areas, lines, points and arcs.

Source: OGC 07-036 (GML 3.2.1), sections 10 and 11. References by ``xlink:href`` are not followed.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from lxml import etree
from shapely import LineString, Polygon

from midrib.errors import InvalidAreaError, ParameterError
from midrib.formats.crs import System, system_of

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = [
    "areas_in",
    "chains_in",
    "child",
    "features",
    "identifier",
    "is_told",
    "leaves",
    "line_in",
    "lines_in",
    "local",
    "namespaces",
    "point_in",
    "system_in",
]

MEMBERS = ("featureMember", "member", "cityObjectMember")
ALL_MEMBERS, ENVELOPE = "featureMembers", "Envelope"
AREAS = ("Polygon", "PolygonPatch", "Rectangle", "Triangle")
GEOMETRIES = (
    *AREAS,
    "Point",
    "LineString",
    "Curve",
    "Surface",
    "CompositeCurve",
    "CompositeSurface",
)
COLLECTIONS = ("MultiCurve", "MultiLineString")
ROUND = ("Arc", "ArcString", "Circle")
ARC_DEVIATION = 1e-3  # of the radius: what a chord is off its arc at most
SAFE: dict[str, bool] = {
    "resolve_entities": False,
    "no_network": True,
    "load_dtd": False,
    "huge_tree": False,
    "remove_comments": True,
    "remove_pis": True,
}


def local(element: etree._Element) -> str:
    """Name of an element without its namespace."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""


def namespaces(path: Path) -> list[str]:
    """Namespaces that the first element of a file declares; none if it is no XML."""
    try:
        with path.open("rb") as file:
            for _, root in etree.iterparse(file, events=("start",), **SAFE):
                return [uri for uri in root.nsmap.values() if uri]
    except etree.XMLSyntaxError:
        return []
    return []


def features(path: Path) -> Iterator[etree._Element]:
    """Features of a collection in turn; those before the one at hand are dropped.

    Raises
    ------
    ParameterError
        If the file is not well-formed XML, or declares entities of its own.
    """
    tags = [f"{{*}}{name}" for name in (*MEMBERS, ALL_MEMBERS, ENVELOPE)]
    with path.open("rb") as file:
        context = etree.iterparse(file, events=("end",), tag=tags, **SAFE)
        try:
            for _, member in context:
                if member.getroottree().docinfo.internalDTD is not None:
                    msg = f"IN {str(path)!r} has a document type of its own, expected plain GML"
                    raise ParameterError(msg)
                if local(member) == ENVELOPE:  # what has no system of its own has this one
                    root = member.getroottree().getroot()
                    if member.getparent().getparent() is root and member.get("srsName"):
                        root.set("srsName", member.get("srsName"))
                    continue
                yield from member.iterchildren(tag=etree.Element)
                while member.getprevious() is not None:
                    del member.getparent()[0]
        except etree.XMLSyntaxError as error:
            msg = f"IN {str(path)!r} cannot be read to its end: {error.msg}"
            raise ParameterError(msg) from error


def child(element: etree._Element, name: str) -> etree._Element | None:
    """First child of a name, in whatever namespace, that has anything in it."""
    return next((one for one in element if local(one) == name and is_told(one)), None)


def is_told(element: etree._Element) -> bool:
    """Whether an element has anything in it; registers write empty ones for what is not known."""
    return len(element) > 0 or bool(element.text and element.text.strip())


def identifier(feature: etree._Element) -> str:
    """``gml:id`` of a feature, empty if it has none."""
    return next((value for key, value in feature.attrib.items() if key.endswith("}id")), "")


def leaves(feature: etree._Element) -> dict[str, object]:
    """Texts of a feature by the names of their elements, the first of each; no geometries."""
    found: dict[str, object] = {}
    below: etree._Element | None = None  # a geometry: what it is made of says nothing else
    for element in feature.iterdescendants():
        if below is not None and below in element.iterancestors():
            continue
        below = element if local(element) in GEOMETRIES else None
        if below is None and len(element) == 0 and is_told(element):
            found.setdefault(local(element), element.text.strip())
    return found


def system_in(element: etree._Element) -> System:
    """Coordinate reference system of a geometry or of what is around it."""
    named = next((e for e in [element, *element.iterdescendants()] if e.get("srsName")), None)
    if named is None:
        named = next((e for e in element.iterancestors() if e.get("srsName")), None)
    system = None if named is None else system_of(named.get("srsName"))
    return system or System(None, is_north_first=False)


def areas_in(element: etree._Element) -> list[Polygon]:
    """Areas in an element, in their order.

    Raises
    ------
    InvalidAreaError
        If a ring has fewer than three points or cannot be read.
    """
    system, found = system_in(element), []
    for area in element.iter("{*}Polygon", "{*}PolygonPatch", "{*}Rectangle", "{*}Triangle"):
        rings = [
            chain(ring, system)
            for side in ("exterior", "interior", "outerBoundaryIs", "innerBoundaryIs")
            for ring in area.iterchildren(f"{{*}}{side}")
        ]
        for ring in rings:
            if len(np.unique(ring, axis=0)) < 3:
                msg = "a ring has fewer than three points"
                raise InvalidAreaError(msg)
        if rings:
            found.append(Polygon(rings[0], rings[1:]))
    return found


def line_in(element: etree._Element) -> LineString | None:
    """Line of an element, its pieces in one; None if it has fewer than two points."""
    points = chain(element, system_in(element))
    return LineString(points) if len(np.unique(points, axis=0)) > 1 else None


def chains_in(element: etree._Element) -> list[LineString]:
    """Lines of an element: each member of a collection for itself, all else in one."""
    names = (f"{{*}}{name}" for name in ("curveMember", "curveMembers", "lineStringMember"))
    members = [e for e in element.iter(*names) if local(e.getparent()) in COLLECTIONS]
    lines = (line_in(one) for e in members or [[element]] for one in e)
    return [line for line in lines if line is not None]


def lines_in(element: etree._Element) -> list[LineString]:
    """Lines in an element, each for itself."""
    lines = (line_in(one) for one in element.iter("{*}LineString", "{*}Curve"))
    return [line for line in lines if line is not None]


def point_in(element: etree._Element) -> "Floats | None":
    """Coordinates of the one point of an element, of a geometry or as plain text."""
    points = chain(element, system_in(element))
    if len(points) == 0 and element.text and is_told(element):
        points = rows(element.text, 2, system_in(element))
    return points[0] if len(points) == 1 else None


def chain(element: etree._Element, system: System) -> "Floats":
    """Points of all that is in an element in a row, arcs as chords, joints once."""
    runs = list(pieces(element, system))
    if not runs:
        return np.empty((0, 2))
    points = np.concatenate(runs)
    keep = np.ones(len(points), dtype=np.bool_)
    keep[1:] = (points[1:] != points[:-1]).any(axis=1)
    return points[keep]


def pieces(element: etree._Element, system: System) -> Iterator["Floats"]:
    """Points of the segments of an element, each in its order."""
    name = local(element)
    if name in {"posList", "pos"}:
        yield rows(element.text, dimension(element), system)
    elif name == "coordinates":
        text = element.text or ""
        yield rows(text.replace(",", " "), len(text.split()[0].split(",")), system)
    elif name in ROUND:
        points = np.concatenate([run for one in element for run in pieces(one, system)])
        yield along_arcs(points)
        if name == "Circle" and len(points) == 3:  # and on from its last point to its first
            yield arc(points[2], points[0], points[1])[0]
    else:
        runs = [run for one in element for run in pieces(one, system)]
        is_reversed = name == "OrientableCurve" and element.get("orientation") == "-"
        yield from (run[::-1] for run in reversed(runs)) if is_reversed else runs


def rows(text: str | None, size: int, system: System) -> "Floats":
    """Coordinates of a text, east first.

    Raises
    ------
    InvalidAreaError
        If it is not numbers, or too few or too many.
    """
    try:
        numbers = np.array((text or "").split(), dtype=np.float64)
        points = numbers.reshape(-1, size)
    except ValueError:
        beginning = " ".join((text or "").split())[:40]
        msg = f"the coordinates {beginning!r} are not rows of {size} numbers"
        raise InvalidAreaError(msg) from None
    if not np.isfinite(points).all():
        msg = "a coordinate is not finite"
        raise InvalidAreaError(msg)
    return points[:, [1, 0, *range(2, size)]] if system.is_north_first else points


def dimension(element: etree._Element) -> int:
    """Numbers that each point of a list has; 2 unless something around the list says otherwise."""
    if local(element) == "pos" and element.get("srsDimension") is None:
        return len((element.text or "").split()) or 2
    for one in [element, *element.iterancestors()]:
        given = one.get("srsDimension")
        if given is not None and given.isdecimal() and int(given) > 1:
            return int(given)
    return 2


def along_arcs(points: "Floats") -> "Floats":
    """Chords of the arcs through points 0, 1, 2, then 2, 3, 4 and so on; all points are on them.

    A chord is off its arc by a thousandth of the radius at most.
    """
    runs = [points[:1]]
    for k in range(0, len(points) - 2, 2):
        a, b, c = points[k : k + 3]
        runs += [*arc(a, b, c)]
    return np.concatenate(runs)


def arc(a: "Floats", b: "Floats", c: "Floats") -> tuple["Floats", "Floats"]:
    r"""Points after a of the arc from a through b to c: those up to b, those up to c.

         b
      .     .
    a    m    c        m is the centre: as far from a as from b and from c
    """
    u, v = b[:2] - a[:2], c[:2] - a[:2]
    cross = u[0] * v[1] - u[1] * v[0]
    if cross == 0.0:  # on a line
        return b[None, :], c[None, :]
    uu, vv = u @ u, v @ v
    m = np.array([v[1] * uu - u[1] * vv, u[0] * vv - v[0] * uu]) / (2.0 * cross)  # from a
    angles = [np.arctan2(*(w - m)[::-1]) for w in (np.zeros(2), u, v)]
    widest = 2.0 * np.arccos(1.0 - ARC_DEVIATION)
    halves = []
    for (p, q), (begin, stop) in (((a, b), angles[:2]), ((b, c), angles[1:])):
        turn = np.copysign((np.copysign(1.0, cross) * (stop - begin)) % (2.0 * np.pi), cross)
        n = max(int(np.ceil(abs(turn) / widest)), 1)
        share = np.arange(1, n)[:, None] / n
        around = begin + share * turn
        radius = np.hypot(*m)
        on_arc = p + share * (q - p)  # heights evenly
        on_arc[:, :2] = a[:2] + m + radius * np.hstack([np.cos(around), np.sin(around)])
        halves.append(np.vstack([on_arc, q]))
    return halves[0], halves[1]
