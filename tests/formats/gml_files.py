"""Small GML files of the registers, as they write them."""

from collections.abc import Sequence
from pathlib import Path
from typing import TypeAlias

__all__ = [
    "BDOT_2015",
    "BDOT_2021",
    "BGT",
    "At",
    "collection",
    "dyke",
    "earthwork",
    "position",
    "ring",
]

At: TypeAlias = tuple[float, ...]  # east, north and perhaps height
GML = "http://www.opengis.net/gml/3.2"
BDOT_2015 = (
    'xmlns:bdz="urn:gugik:specyfikacje:gmlas:bazaDanychObiektowTopograficznych500:1.0" '
    'xmlns:bt="urn:gugik:specyfikacje:gmlas:modelPodstawowy:1.0"'
)
BDOT_2021 = 'xmlns:ot="bazaDanychObiektowTopograficznych500:1.0"'
BGT = 'xmlns:imgeo="http://www.geostandaarden.nl/imgeo/2.1"'
ZONE_6 = 'srsName="urn:ogc:def:crs:EPSG::2177"'


def position(point: At) -> str:
    """Coordinates as Polish registers write them: north, east."""
    return " ".join(repr(c) for c in (point[1], point[0], *point[2:]))


def ring(points: Sequence[At], side: str = "exterior") -> str:
    """One ring of a polygon, closed."""
    text = " ".join(position(point) for point in [*points, points[0]])
    size = len(points[0])
    return (
        f'<gml:{side}><gml:LinearRing><gml:posList srsDimension="{size}">{text}</gml:posList>'
        f"</gml:LinearRing></gml:{side}>"
    )


def earthwork(
    name: str,
    rings: str,
    start: At | None = None,
    end: At | None = None,
    kind: str = "skarpaUmocniona",
    extra: str = "",
) -> str:
    """An object of the model of 2015."""
    points = {"poczatekGorySkarpy": start, "koniecGorySkarpy": end}
    told = "".join(
        f"<bdz:{what} {ZONE_6}>{position(point)}</bdz:{what}>"
        for what, point in points.items()
        if point is not None
    )
    return (
        f'<bdz:BDZ_BudowlaZiemna gml:id="{name}"><bdz:geometria><gml:Polygon {ZONE_6}>{rings}'
        f"</gml:Polygon></bdz:geometria><bdz:rodzajBudZiemn>{kind}</bdz:rodzajBudZiemn>{told}{extra}"
        "</bdz:BDZ_BudowlaZiemna>"
    )


def dyke(name: str, surfaces: list[str], tops: Sequence[Sequence[At]]) -> str:
    """A dyke of the model of 2021: a part of its area and a top for each side."""
    names = [f"{what}{which}Skarpy" for which in ("Gory", "GoryKolejnej") for what in WORDS]
    points = [point for top in tops for point in top]
    told = "".join(
        f"<ot:{what}><gml:Point {ZONE_6}><gml:pos>{position(point)}</gml:pos></gml:Point>"
        f"</ot:{what}>"
        for what, point in zip(names, points, strict=False)
    )
    members = "".join(
        f"<gml:surfaceMember><gml:Polygon>{rings}</gml:Polygon></gml:surfaceMember>"
        for rings in surfaces
    )
    return (
        f'<ot:OT_Wody gml:id="{name}"><ot:geometria><gml:MultiSurface {ZONE_6}>{members}'
        f"</gml:MultiSurface></ot:geometria><ot:rodzajObiektu>w</ot:rodzajObiektu>{told}</ot:OT_Wody>"
    )


WORDS = ("poczatek", "koniec")


def collection(
    path: Path, spaces: str, *features: str, member: str = "gml:featureMember", about: str = ""
) -> Path:
    """Write features as a collection and return the path."""
    inside = "\n".join(f"<{member}>{feature}</{member}>" for feature in features)
    path.write_text(
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<gml:FeatureCollection xmlns:gml="{GML}" {spaces}>'
        f"{about}{inside}</gml:FeatureCollection>",
        encoding="utf-8",
    )
    return path
