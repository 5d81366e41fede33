"""DXF of a tower's axis: a line in space, and a point with its height for each level."""

from typing import TYPE_CHECKING

import numpy as np

from midrib.checks import check_library
from midrib.formats.drawing.cad import RED, UNITS, VERSION, set_extents

if TYPE_CHECKING:
    from pathlib import Path

    from midrib.types import Floats

__all__ = ["write_axis_dxf"]

LINE, POINTS, HEIGHTS = "MIDRIB_AXIS", "MIDRIB_LEVELS", "MIDRIB_HEIGHTS"  # layers
SHARE = 0.3  # of the distance between levels: the height of texts


def write_axis_dxf(path: "Path", points: "Floats", unit: float) -> None:
    """Write centres (n, 3) of levels, from the base up, with ``unit`` coordinate units in a metre.

    Raises
    ------
    MissingDependencyError
        If ezdxf is not installed.
    """
    check_library("ezdxf", "writing DXF", "dxf")
    from ezdxf.filemanagement import new

    document = new(VERSION)
    document.header["$INSUNITS"] = UNITS.get(round(1.0 / unit, 12), 0)
    document.header["$MEASUREMENT"] = 1
    document.layers.add(LINE, color=RED)
    document.layers.add(POINTS)
    document.layers.add(HEIGHTS)
    space = document.modelspace()
    corners = points.tolist()
    if len(corners) > 1:
        space.add_polyline3d(corners, dxfattribs={"layer": LINE})
        size = SHARE * float(np.median(np.diff(points[:, 2])))
        for corner in corners:
            text = f"{corner[2] / unit:.2f}"
            note = space.add_text(text, height=size, dxfattribs={"layer": HEIGHTS})
            note.set_placement(corner)
    for corner in corners:
        space.add_point(corner, {"layer": POINTS})
    set_extents(document)
    document.saveas(path)
