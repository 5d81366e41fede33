"""BGT and IMGeo, the Dutch large-scale map: parts of land that slope, with their crest lines.

An object that lies on a slope (``…OpTalud``) has its area in a ``geometrie2d…`` and the crest,
where somebody has drawn it, in a ``kruinlijn…``: the upper edge, along the boundary of the area.
The rest of the boundary is the toe.

Source: IMGeo 2.1.1 (CityGML 2.0, GML 3.1.1); names as in the files. The model does not tell what
slopes are made of: all are of the kind ``slope-unreinforced``.
"""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from midrib.formats import gml
from midrib.formats.gathering import Gathered
from midrib.hatching.slope import Slope, SlopeError, SlopeProblem

if TYPE_CHECKING:
    from lxml.etree import _Element
    from shapely import Polygon

    from midrib.hatching.edges import Edges

__all__ = ["MODEL", "read_bgt"]

MODEL = "geostandaarden.nl/imgeo"  # in the namespace
AREA, CREST, ON_SLOPE = "geometrie2d", "kruinlijn", "OpTalud"  # first or last part of names
ENDED = {"eindRegistratie", "terminationDate", "objectEindTijd"}


def read_bgt(path: Path, *, history: bool = False) -> tuple[list[Slope], list[SlopeProblem]]:
    """Read the slopes of a CityGML file, and what is wrong with some.

    Versions that have ended are left out unless ``history`` is true.
    """
    found = Gathered()
    for feature in gml.features(path):
        if not history and any(gml.local(e) in ENDED and gml.is_told(e) for e in feature):
            continue
        with found.refusing(gml.identifier(feature)):
            add_slope(found, feature)
    return found.result()


def add_slope(found: Gathered, feature: "_Element") -> None:
    """Keep an object that lies on a slope.

    Raises
    ------
    InvalidAreaError
        If it has no crest, or it or its area cannot be read.
    """
    crests = [e for e in feature if gml.local(e).startswith(CREST) and gml.is_told(e)]
    on_slope = next((e for e in feature if gml.local(e).endswith(ON_SLOPE)), None)
    if not crests and (on_slope is None or on_slope.text != "true"):
        return
    areas = [a for e in feature if gml.local(e).startswith(AREA) for a in gml.areas_in(e)]
    if not areas:
        msg = "it has no area, expected a polygon"
        raise SlopeError(msg)
    lines = [line for e in crests for line in gml.chains_in(e)]
    if not lines:
        msg = "it lies on a slope, but has no crest line"
        raise SlopeError(msg, np.array(areas[0].exterior.coords[0]))
    said = {"gml_id": gml.identifier(feature)} | gml.leaves(feature)
    crs = gml.system_in(feature).crs

    def slope(identifier: str, area: "Polygon", edges: "Edges") -> Slope:
        origin = f"BGT, {gml.local(feature)}"
        return Slope(
            identifier, "slope-unreinforced", area, edges.top, edges.toe, origin, said, crs=crs
        )

    found.add_sides(gml.identifier(feature), areas, lines, slope)
