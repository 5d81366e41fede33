"""DXF of a tower's axis: lines in space, a point for each level, texts where there is room.

Seen from above, which is how it is plotted, a tower's axis is a short curve: the scale is the
largest of 1:1, 1:2, 1:5, 1:10 … at which it fits on a page, and a height stands beside its level
unless that of a lower one is in the way; what else is marked has its text on the other side. Seen
from the side, all is where it is.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.checks import check_library
from midrib.formats.drawing.cad import RED, UNITS, VERSION, add_layout, set_extents

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from ezdxf.document import Drawing

    from midrib.types import Floats, Ints

__all__ = ["Mark", "write_axis_dxf"]

LINE, POINTS, HEIGHTS = "MIDRIB_AXIS", "MIDRIB_LEVELS", "MIDRIB_HEIGHTS"  # layers
MARKED = 6  # magenta, which is seen on black and on white
PAGE, TEXT, MARK = 150.0, 2.5, 1.0  # millimetres: the axis at most, texts, circles of named levels
ROOM = np.array([0.8, 1.4])  # of a character, in heights of a text: its width with what is beside


class Mark(NamedTuple):
    """Something that is marked on an axis."""

    layer: str
    point: "Floats"  # (3,)
    text: str


def write_axis_dxf(
    path: "Path",
    points: "Floats",
    unit: float,
    breaks: "Ints | Sequence[int]" = (),
    marks: "Sequence[Mark]" = (),
) -> None:
    """Write centres (n, 3) of levels, from the base up, with ``unit`` coordinate units in a metre.

    ``breaks`` are the rows at which another polyline begins. Every mark has a point and a circle
    on its layer, and its text unless that of a lower one is in the way.

    Raises
    ------
    MissingDependencyError
        If ezdxf is not installed.
    """
    check_library("ezdxf", "writing DXF", "dxf")
    from ezdxf.filemanagement import new

    scale = scale_of(points, unit)
    millimetre = scale / 1000.0 * unit
    document = new(VERSION)
    document.header["$INSUNITS"] = UNITS.get(round(1.0 / unit, 12), 0)
    document.header["$MEASUREMENT"] = 1
    document.layers.add(LINE, color=RED)
    document.layers.add(POINTS)
    document.layers.add(HEIGHTS)
    space = document.modelspace()
    corners = points.tolist()
    for part in np.split(points, breaks):
        if len(part) > 1:
            space.add_polyline3d(part.tolist(), dxfattribs={"layer": LINE})
    for corner in corners:
        space.add_point(corner, {"layer": POINTS})
    size, texts = TEXT * millimetre, [f"{corner[2] / unit:.2f}" for corner in corners]
    # Beside the axis: below it where it rises to the right.
    rises = len(points) > 1 and np.prod(points[-1, :2] - points[0, :2]) > 0.0
    below = -1.5 if rises else 0.5
    longest = max(map(len, texts), default=0)
    for row in with_room(points, size * ROOM * [longest, 1.0]):
        x, y, z = corners[row]
        note = space.add_text(texts[row], height=size, dxfattribs={"layer": HEIGHTS})
        space.add_circle((x, y, z), 0.5 * MARK * millimetre, {"layer": HEIGHTS})
        note.set_placement((x + 0.5 * size, y + below * size, z))
    add_marks(document, marks, size, MARK * millimetre, 0.5 if rises else -1.5)
    set_extents(document)
    if len(corners):
        low, high = (np.array(document.header[name])[:2] for name in ("$EXTMIN", "$EXTMAX"))
        add_layout(document, low, high, scale, 1.0 / unit)
    document.saveas(path)


def add_marks(
    document: "Drawing", marks: "Sequence[Mark]", size: float, radius: float, below: float
) -> None:
    """Add marks with texts of this size to the left of them, so far below or above."""
    from ezdxf.enums import TextEntityAlignment

    space = document.modelspace()
    points = np.array([mark.point for mark in marks]).reshape(-1, 3)
    longest = max((len(mark.text) for mark in marks), default=0)
    named = with_room(points, size * ROOM * [longest, 1.0])
    for row, (layer, point, text) in enumerate(marks):
        if layer not in document.layers:
            document.layers.add(layer, color=MARKED)
        x, y, z = np.asarray(point).tolist()
        space.add_point((x, y, z), {"layer": layer})
        space.add_circle((x, y, z), radius, {"layer": layer})
        if row in named:
            note = space.add_text(text, height=size, dxfattribs={"layer": layer})
            place = (x - radius - 0.5 * size, y + below * size, z)
            note.set_placement(place, align=TextEntityAlignment.RIGHT)


def scale_of(points: "Floats", unit: float) -> float:
    """Return the n of the largest scale 1:n, n = 1, 2, 5, 10 …, at which an axis fits on a page."""
    length = float(np.ptp(points[:, :2], axis=0).max()) if len(points) else 0.0
    least = max(1000.0 * length / unit / PAGE, 1.0)
    power = 10.0 ** np.floor(np.log10(least))
    return float(power * min(step for step in (1.0, 2.0, 5.0, 10.0) if step * power >= least))


def with_room(points: "Floats", room: "Floats") -> "Ints":
    """Levels to name, from the base up: those whose texts, ``room`` wide and high, are clear.

    O(n m) for n levels of which m are named.
    """
    named: list[int] = []
    for row, place in enumerate(points[:, :2]):
        if not (abs(points[named, :2] - place) < room).all(axis=1).any():
            named.append(row)
    return np.array(named, dtype=np.intp)
