"""BDOT500, the Polish database of topographic objects: slopes of its models of 2015 and 2021.

A slope has an area and two points of its boundary, the start and the end of its top, which leads
forward in the order the ring is stored in; the model of 2021 has two more for the other side of a
dyke. Walls, stairs, roads and other areas have a directional polyline along one edge.

Sources: the files themselves (C-GEO 8.15 and 8.18); names of kinds in the model of 2015 from the
public QGIS style for ``rodzajBudZiemn``, codes of the model of 2021 from those of QMapa 2.0.
"""

from fnmatch import fnmatchcase
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.errors import ParameterError
from midrib.formats import gml
from midrib.formats.gathering import Gathered, Top, is_height
from midrib.hatching.slope import Slope, SlopeError, SlopeKind, SlopeProblem

if TYPE_CHECKING:
    from lxml.etree import _Element

    from midrib.hatching.edges import Edges
    from midrib.types import Floats

__all__ = ["BASIC_MODEL", "DATABASES", "kind_of", "read_bdot500", "read_drawn"]

# In the namespaces of both models; stairs are in the land and building register too.
DATABASES = ("bazaDanychObiektowTopograficznych500", "ewidencjaGruntow")
BASIC_MODEL, DRAWN = "modelPodstawowy", "geometriaKarto"  # of cartographic objects, 2015
MODEL_2015 = "urn:"  # how the older namespaces begin
KINDS_BY_WORD: dict[str, SlopeKind] = {  # model of 2015
    "nasyp": "embankment",
    "grobla": "dyke",
    "walPrzeciwpowodziowy": "dyke",
    "wykop": "cutting",
    "skarpaNieumocniona": "slope-unreinforced",
    "skarpaUmocniona": "slope-reinforced",
    "scianaOporowa": "wall",
    "murekOporowy": "wall",
    "schody": "stairs",
    "tasmociag": "conveyor",
}
KINDS_BY_CODE: dict[tuple[str, str], SlopeKind] = {  # model of 2021: class and code
    ("OT_Skarpa", "k"): "slope-unreinforced",
    ("OT_Skarpa", "u"): "slope-reinforced",
    ("OT_Wody", "w"): "dyke",
    ("OT_Wody", "g"): "dyke",
    ("OT_Budowle", "n"): "wall",
    ("OT_Komunikacja", "s"): "stairs",
    ("OT_ObiektTrwaleZwiazanyZBudynkami", "s"): "stairs",
    ("EGB_ObiektTrwaleZwiazanyZBudynkiem", "s"): "stairs",
}
SLOPES = ("BDZ_BudowlaZiemna", "OT_Skarpa")  # classes whose objects all need a top
TOPS = (  # names of the points: the first side, the other side of a dyke
    ("poczatekGorySkarpy", "koniecGorySkarpy"),
    ("poczatekGoryKolejnejSkarpy", "koniecGoryKolejnejSkarpy"),
)
ALONG = "poliliniaKierunkowa"
ENDED = {"koniecObiekt", "koniecWersjiObiektu", "koniecWersjaObiekt"}
POINTS = {"BDZ_PunktOOkreslonejWysokosci": "rzednaGory", "OT_Rzedna": "rzedna"}  # of the ground
OF_TOP, OF_TOE = "rzednaGory", "rzednaDolu"  # heights that an object with an area gives its edges


def read_bdot500(path: Path, *, history: bool = False) -> tuple[list[Slope], list[SlopeProblem]]:
    """Read the slopes of a GML file, and what is wrong with some.

    Objects that have ended are left out unless ``history`` is true.
    """
    found = Gathered()
    for feature in gml.features(path):
        name = gml.local(feature)
        ends = (e for e in feature.iterdescendants() if gml.local(e) in ENDED)
        if not history and any(map(gml.is_told, ends)):
            continue
        with found.refusing(gml.identifier(feature)):
            if name in POINTS:
                add_height(found, feature, POINTS[name])
            else:
                add_slopes(found, feature)
    return found.result()


def read_drawn(path: Path, code: str) -> list[LineString]:
    """Read the lines of cartographic objects; ``code`` is theirs, with wildcards.

    Raises
    ------
    ParameterError
        If there is none.
    """
    lines: list[LineString] = []
    for feature in gml.features(path):
        drawn = gml.child(feature, DRAWN)
        if drawn is not None and fnmatchcase(str(gml.leaves(feature).get("kodKarto")), code):
            lines += gml.lines_in(drawn)
    if not lines:
        msg = f"{str(path)!r} has no cartographic object with lines and the code {code}"
        raise ParameterError(msg)
    return lines


def add_height(found: Gathered, feature: "_Element", name: str) -> None:
    """Keep a point of the ground if its height is known."""
    height, place = number(gml.leaves(feature), name), gml.child(feature, "geometria")
    point = None if place is None else gml.point_in(place)
    if height is not None and point is not None:
        found.heights.append((float(point[0]), float(point[1]), height))


def add_slopes(found: Gathered, feature: "_Element") -> None:
    """Keep the slopes of an object, one for each side that has a top.

    Raises
    ------
    InvalidAreaError
        If a top or an area is missing that has to be there, or cannot be read.
    """
    try:
        tops = tops_of(feature)
    except SlopeError as error:
        raise SlopeError(str(error), place_of(areas_of(feature))) from error
    is_slope = gml.local(feature) in SLOPES
    if not tops and not is_slope:
        return
    areas = areas_of(feature)
    if not tops or not areas:
        if is_slope:
            wanted = "a polygon" if tops else f"{TOPS[0][0]} and {TOPS[0][1]}, or {ALONG}"
            msg = f"it has no {'area' if tops else 'top'}, expected {wanted}"
            raise SlopeError(msg, place_of(areas))
        return
    model = "2015" if feature.tag.startswith(f"{{{MODEL_2015}") else "2021"
    name, said = gml.local(feature), {"gml_id": gml.identifier(feature)} | gml.leaves(feature)
    kind, crs = kind_of(name, said), gml.system_in(feature).crs
    if kind == "other" and not is_slope:
        kind = "directed"

    def slope(identifier: str, area: Polygon, edges: "Edges") -> Slope:
        return Slope(
            identifier,
            kind,
            area,
            edges.top,
            edges.toe,
            f"BDOT500 {model}, {name}",
            said,
            own_height(edges.top, said, OF_TOP),
            own_height(edges.toe, said, OF_TOE),
            crs,
        )

    found.add_sides(gml.identifier(feature), areas, tops, slope)


def areas_of(feature: "_Element") -> list[Polygon]:
    """Areas of an object.

    Raises
    ------
    InvalidAreaError
        If one cannot be read.
    """
    return [area for e in feature if gml.local(e) == "geometria" for area in gml.areas_in(e)]


def place_of(areas: list[Polygon]) -> "Floats | None":
    """Return where an object is that is refused, None if it has no area."""
    return shapely.get_coordinates(areas)[0] if areas else None


def tops_of(feature: "_Element") -> list[Top]:
    """Tops of an object: those with start and end, else the line along one.

    Raises
    ------
    InvalidAreaError
        If one cannot be read.
    """
    tops: list[Top] = [pair for names in TOPS if (pair := pair_of(feature, *names)) is not None]
    along = gml.child(feature, ALONG)
    if tops or along is None:
        return tops
    lines = gml.chains_in(along)
    if not lines:
        msg = f"{ALONG} has fewer than two points"
        raise SlopeError(msg)
    return [*lines]


def pair_of(feature: "_Element", start: str, end: str) -> "tuple[Floats, Floats] | None":
    """Start and end of a top, None if there is neither.

    Raises
    ------
    SlopeError
        If there is only one of them, or one is no point.
    """
    elements = [gml.child(feature, name) for name in (start, end)]
    if elements == [None, None]:
        return None
    points = [None if element is None else gml.point_in(element) for element in elements]
    for name, element, point in zip((start, end), elements, points, strict=True):
        if point is None:
            found = "is missing" if element is None else "is no point"
            msg = f"{name} {found}, expected the coordinates of one point"
            raise SlopeError(msg)
    return points[0], points[1]  # type: ignore[return-value]


def kind_of(name: str, said: dict[str, object]) -> SlopeKind:
    """Kind of an object of a class, by what it says of its kind (*rodzaj*).

    Examples
    --------
    >>> kind_of("BDZ_BudowlaZiemna", {"rodzajBudZiemn": "walPrzeciwpowodziowy"})
    'dyke'
    """
    for what, word in said.items():
        if what.startswith("rodzaj"):
            kind = KINDS_BY_CODE.get((name, str(word)), KINDS_BY_WORD.get(str(word)))
            if kind is not None:
                return kind
    return "other"


def own_height(edge: LineString, said: dict[str, object], name: str) -> "Floats | None":
    """Height that an object gives one of its edges, at the middle of that; None if it has none."""
    height = number(said, name)
    if height is None:
        return None
    middle = edge.interpolate(0.5, normalized=True)
    return np.array([[middle.x, middle.y, height]])


def number(said: dict[str, object], name: str) -> float | None:
    """Read a height, None if it is unknown."""
    try:
        height = float(str(said[name]))
    except (KeyError, ValueError):
        return None
    return height if is_height(height) else None
