"""Slopes of a DXF drawing: tops on some layers, toes on others.

Lines, polylines, arcs, ellipses and splines of the model space are read, pieces that meet are
joined; blocks are not looked into. A drawing has no coordinate reference system, but may say what
its unit is.
"""

import json
from collections.abc import Iterator
from fnmatch import fnmatchcase
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from shapely import LineString

from midrib.checks import check_library
from midrib.errors import ParameterError
from midrib.formats.contents import listed
from midrib.formats.gathering import Gathered
from midrib.formats.pairs import add_pairs
from midrib.hatching.slope import Slope, SlopeProblem

if TYPE_CHECKING:
    from ezdxf.document import Drawing

__all__ = ["read_cad", "read_lines"]

KINDS = "LINE LWPOLYLINE POLYLINE ARC CIRCLE ELLIPSE SPLINE"
DEVIATION = 1e-4  # of the size of a curve: what a chord is off it at most
SPANS = 16  # Bézier curves of a circle: they are 1e-7 of the radius off it
MOST_NAMES = 8  # in a message
TOPS = ("*gora*", "*góra*", "*top*", "*crest*", "*kruin*", "*oberkante*")
TOES = ("*dol*", "*dół*", "*toe*", "*bottom*", "*voet*", "*teen*", "*unterkante*")


def read_cad(
    path: Path, top: str | None = None, toe: str | None = None
) -> tuple[list[Slope], list[SlopeProblem]]:
    """Read the slopes of a drawing, and what is wrong with some.

    ``top`` and ``toe`` are names of layers, with wildcards; without them the names are searched for
    the words of some languages.

    Raises
    ------
    MissingDependencyError
        If ezdxf is not installed.
    ParameterError
        If the file is no drawing, or has no such layers.
    """
    drawing, found = opened(path), Gathered()
    tops = lines_on(drawing, path, "top", (top,) if top else TOPS)
    toes = lines_on(drawing, path, "toe", (toe,) if toe else TOES)
    add_pairs(found, tops, toes, path.stem, plane_of(drawing))
    return found.result()


def read_lines(path: Path, option: str, layer: str) -> list[LineString]:
    """Read the lines on some layers of a drawing; ``layer`` is a name with wildcards.

    Raises
    ------
    MissingDependencyError
        If ezdxf is not installed.
    ParameterError
        If the file is no drawing, or has no such layers.
    """
    return lines_on(opened(path), path, option, (layer,))


def opened(path: Path) -> "Drawing":
    """Open a drawing.

    Raises
    ------
    MissingDependencyError
        If ezdxf is not installed.
    ParameterError
        If the file is no drawing.
    """
    check_library("ezdxf", "a drawing", "dxf")
    import ezdxf

    try:
        return ezdxf.readfile(path)  # type: ignore[attr-defined]
    except (OSError, ezdxf.DXFError) as error:  # type: ignore[attr-defined]
        msg = f"{str(path)!r} cannot be read as a drawing: {error}"
        raise ParameterError(msg) from error


def plane_of(drawing: "Drawing") -> str | None:
    """Return the plane of a drawing with its unit, as PROJJSON; None if it does not say."""
    from ezdxf.enums import InsertUnits
    from ezdxf.units import conversion_factor, decode

    code = drawing.header.get("$INSUNITS", 0)
    if not code:
        return None
    unit = {
        "type": "LinearUnit",
        "name": decode(code),
        "conversion_factor": conversion_factor(InsertUnits(code), InsertUnits.Meters),
    }
    names = ("Easting", "E", "east"), ("Northing", "N", "north")
    axes = [
        {"name": name, "abbreviation": short, "direction": way, "unit": unit}
        for name, short, way in names
    ]
    return json.dumps(
        {
            "type": "EngineeringCRS",
            "name": "Drawing",
            "datum": {"type": "EngineeringDatum", "name": "Drawing"},
            "coordinate_system": {"subtype": "Cartesian", "axis": axes},
        }
    )


def lines_on(
    drawing: "Drawing", path: Path, option: str, patterns: tuple[str, ...]
) -> list[LineString]:
    """Lines on the layers that fit a pattern.

    Raises
    ------
    ParameterError
        If there is none.
    """
    names = {entity.dxf.layer for entity in drawing.modelspace().query(KINDS)}
    fit = {n for n in names if any(fnmatchcase(n.lower(), p.lower()) for p in patterns)}
    if not names:
        msg = f"{str(path)!r} has no lines, expected {option} to name a layer with some"
        raise ParameterError(msg)
    if not fit:
        more = f" and {len(names) - MOST_NAMES} more" if len(names) > MOST_NAMES else ""
        known = listed(sorted(names)[:MOST_NAMES]) + more
        msg = (
            f"no layer of {str(path)!r} with lines is named like {' or '.join(patterns)}, "
            f"expected {option} to name one of {known}"
        )
        raise ParameterError(msg)
    return [*pieces(drawing, fit)]


def pieces(drawing: "Drawing", layers: set[str]) -> Iterator[LineString]:
    """Curves on some layers as chains, with heights where they have any."""
    from ezdxf.path import make_path

    for entity in drawing.modelspace().query(KINDS):
        if entity.dxf.layer in layers:
            path = make_path(entity, segments=SPANS)
            corners = np.array([tuple(v) for v in path.control_vertices()]).reshape(-1, 3)
            size = float(np.ptp(corners, axis=0).max()) if len(corners) else 0.0
            if size > 0.0:
                points = np.array([tuple(v) for v in path.flattening(DEVIATION * size)])
                yield LineString(points if points[:, 2].any() else points[:, :2])
