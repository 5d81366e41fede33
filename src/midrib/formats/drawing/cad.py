"""DXF: a layer for what each standard draws, in its line weight; figures as blocks.

Coordinates are those of the map. If both edges of an object have heights, lines have those of the
slope, figures that of their place, and fills, which are level in DXF, the mean of their outline,
which is drawn in space around them. A layout shows all of it at scale. Objects carry their
identifier and the number of the stroke as extended data of the application MIDRIB, marks of
problems the whole sentence; they are on a layer that is not plotted.
"""

import re
import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from midrib.checks import check_library

if TYPE_CHECKING:
    from pathlib import Path

    from ezdxf.document import Drawing as Document

    from midrib.formats.drawing.content import Drawing, Drawn
    from midrib.formats.drawing.heights import Relief
    from midrib.hatching.drawn import Figure
    from midrib.hatching.standard import Standard
    from midrib.types import Floats

__all__ = ["write_dxf"]

VERSION = "R2010"
APPLICATION = "MIDRIB"
PROBLEMS = f"{APPLICATION}_PROBLEMS"
UNITS = {1.0: 6, 0.3048: 2, 1200.0 / 3937.0: 21, 0.001: 4, 0.01: 5, 1000.0: 7}  # $INSUNITS
FORBIDDEN = re.compile(r'[<>/\\":;?*|=`,]')  # in names of layers and blocks
BLACK, RED = 7, 1  # colour 7 is black on white and white on black
MARK, TEXT, MARGIN = 2.0, 1.5, 10.0  # millimetres: circles, height of notes, margin of the layout
DASHES = ("DASHEDTINY", "DASHED2", "DASHED")  # LibreCAD draws no line types by other names
DASHES_GO_ON = 128  # flag of flat polylines: line types do not begin anew at each vertex
STRING, INTEGER = 1000, 1071  # group codes of extended data,
LONGEST = 250  # whose texts have no more characters than 255


def write_dxf(path: "Path", drawing: "Drawing") -> None:
    """Write a drawing as DXF."""
    check_library("ezdxf", "writing DXF", "dxf")
    from ezdxf.filemanagement import new

    document = new(VERSION)
    document.header["$INSUNITS"] = UNITS.get(round(drawing.metres_per_unit, 12), 0)
    document.header["$MEASUREMENT"] = 1  # metric line types
    document.header["$LTSCALE"] = 1.0  # dashes are in units of the drawing,
    document.header["$PSLTSCALE"] = 0  # in layouts too
    document.header["$LWDISPLAY"] = 1
    document.appids.add(APPLICATION)
    for known in drawing.standards.values():
        add_layers(document, known, drawing.millimetre)
    for drawn in drawing.objects:
        add_object(document, drawn)
    add_problems(document, drawing)
    set_extents(document)
    low, high = drawing.bounds
    add_layout(document, low, high, drawing.scale, drawing.metres_per_unit)
    document.saveas(path)


def layer_name(known: "Standard", what: str) -> str:
    """Name of the layer for what a standard draws."""
    return FORBIDDEN.sub("-", f"{known.name}_{what}".upper())


def add_layers(document: "Document", known: "Standard", millimetre: float) -> None:
    """Add the layers of a standard, and the type of its outline."""
    linetype = "CONTINUOUS"
    if known.outline_dash:
        used = sum(name in document.linetypes for name in DASHES)
        linetype = DASHES[used] if used < len(DASHES) else layer_name(known, "dash")
        lengths = np.array(known.outline_dash) * millimetre
        lengths[1::2] *= -1.0  # gaps
        pattern = [float(abs(lengths).sum()), *map(float, lengths)]
        document.linetypes.add(linetype, pattern, description=f"{known.outline_dash} mm")
    for what, width, style in (
        ("strokes", known.stroke_width, "CONTINUOUS"),
        ("symbols", known.stroke_width, "CONTINUOUS"),
        ("outline", known.outline_width, linetype),
    ):
        layer = document.layers.add(
            layer_name(known, what), linetype=style, lineweight=weight(width)
        )
        colour = bytes.fromhex(known.colour[1:])
        layer.color = BLACK
        if any(colour):
            layer.rgb = (colour[0], colour[1], colour[2])


def weight(width: float) -> int:
    """Line weight nearest to a width in millimetres: DXF has a list of them, in hundredths."""
    from ezdxf.lldxf.const import VALID_DXF_LINEWEIGHTS

    return int(min(VALID_DXF_LINEWEIGHTS, key=lambda known: abs(known - 100.0 * width)))


def add_object(document: "Document", drawn: "Drawn") -> None:
    """Add what is drawn of an object."""
    space, symbols, known = document.modelspace(), drawn.symbols, drawn.symbols.standard

    def attributes(what: str) -> dict[str, Any]:
        return {"layer": layer_name(known, what)}

    def tag(entity: Any, number: int = -1) -> None:
        data = [(STRING, drawn.id), (STRING, drawn.kind), (INTEGER, number)]
        entity.set_xdata(APPLICATION, data)

    for line in symbols.edges:
        tag(add_chain(space, line, attributes("outline"), drawn.relief))
    for line, number in zip(symbols.lines, symbols.line_stroke, strict=True):
        tag(add_chain(space, line, attributes("strokes"), drawn.relief), int(number))
    for area, number in zip(symbols.areas, symbols.area_stroke, strict=True):
        hatch = space.add_hatch(color=256, dxfattribs=attributes("symbols"))  # colour by layer
        hatch.paths.add_polyline_path(shapely.get_coordinates(area)[:-1].tolist(), is_closed=True)
        tag(hatch, int(number))
        if drawn.relief is not None:
            edge = attributes("symbols") | {"lineweight": 0}  # the fill is as wide as it should be
            tag(add_chain(space, area.exterior, edge, drawn.relief), int(number))
            heights = drawn.relief.raised(shapely.get_coordinates(area))[:-1, 2]
            hatch.dxf.elevation = (0.0, 0.0, float(heights.mean()))
    for placed in symbols.placed:
        block = block_of(document, placed.figure)
        places = placed.at if drawn.relief is None else drawn.relief.raised(placed.at)
        for at, size, angle, number in zip(places, *placed[2:], strict=True):
            scales = {"xscale": size, "yscale": size, "zscale": size, "rotation": angle}
            tag(space.add_blockref(block, tuple(at), attributes("symbols") | scales), int(number))


def add_chain(space: Any, line: Any, attributes: dict[str, Any], relief: "Relief | None") -> Any:
    """Add a polyline, in space if heights are known; a straight one is a line then."""
    points = shapely.get_coordinates(line)
    closed = len(points) > 2 and bool((points[0] == points[-1]).all())
    if relief is not None:
        corners = relief.raised(points[: -1 if closed else None]).tolist()
        if len(corners) == 2:
            return space.add_line(*corners, dxfattribs=attributes)
        return space.add_polyline3d(corners, close=closed, dxfattribs=attributes)
    chain = space.add_lwpolyline(
        points[: -1 if closed else None].tolist(), close=closed, dxfattribs=attributes
    )
    chain.dxf.flags |= DASHES_GO_ON
    return chain


def block_of(document: "Document", figure: "Figure") -> str:
    """Name of the block with a figure of size 1, added where it is not there yet."""
    name = FORBIDDEN.sub("-", f"{APPLICATION}_{figure.name}".upper())
    if name in document.blocks:
        return name
    block = document.blocks.new(name)
    by_layer = {"layer": "0"}  # takes over the layer of the insert
    if figure.is_filled:
        hatch = block.add_hatch(color=256, dxfattribs=by_layer)
        edge = hatch.paths.add_edge_path()
        edge.add_arc((0.0, 0.0), radius=0.5, start_angle=0.0, end_angle=360.0)
    elif figure.is_round:
        block.add_circle((0.0, 0.0), radius=0.5, dxfattribs=by_layer)
    else:
        for line in figure.lines:
            block.add_lwpolyline(line.tolist(), dxfattribs=by_layer)
    return name


def add_problems(document: "Document", drawing: "Drawing") -> None:
    """Mark what is amiss: a circle, its kind and number beside it; the sentence is attached."""
    if not any(trouble.where is not None for trouble in drawing.problems):
        return
    document.layers.add(PROBLEMS, color=RED).dxf.plot = 0
    space, attributes = document.modelspace(), {"layer": PROBLEMS}
    radius = 0.5 * MARK * drawing.millimetre
    for number, trouble in enumerate(drawing.problems, start=1):
        if trouble.where is None:
            continue
        x, y = trouble.where.coords[0][:2]
        circle = space.add_circle((x, y), radius, attributes)
        note = space.add_text(
            f"{trouble.kind} {number}", height=TEXT * drawing.millimetre, dxfattribs=attributes
        )
        note.set_placement((x + radius, y + radius))  # beside the circle, clear of it
        told = textwrap.wrap(trouble.reason, LONGEST)
        data = [(STRING, trouble.id), (STRING, trouble.kind), (INTEGER, number)]
        for entity in (circle, note):
            entity.set_xdata(APPLICATION, data + [(STRING, line) for line in told])


def set_extents(document: "Document") -> None:
    """Tell how far everything reaches, notes too: viewers start with that."""
    from ezdxf.bbox import extents

    found = extents(document.modelspace(), fast=True)
    if found.has_data:
        document.modelspace().reset_extents(found.extmin, found.extmax)
        # The writer takes a corner at the origin for one that is not known.
        document.header["$EXTMIN"], document.header["$EXTMAX"] = found.extmin, found.extmax


def add_layout(
    document: "Document", low: "Floats", high: "Floats", scale: float, metres_per_unit: float
) -> None:
    """Set the first layout up so that it shows what lies between two corners at scale."""
    millimetre = scale / 1000.0 / metres_per_unit
    size = np.maximum((high - low) / millimetre, 1.0)
    layout = document.paperspace("Layout1")
    sheet = size + 2.0 * MARGIN
    layout.page_setup(size=tuple(sheet), margins=(0, 0, 0, 0), units="mm")
    layout.add_viewport(
        center=tuple(sheet / 2.0),
        size=tuple(size),
        view_center_point=tuple((low + high) / 2.0),
        view_height=float(high[1] - low[1]) or millimetre,
        status=1,
    )
    # LibreCAD prints the model on paper with the limits of the layout, in units of the drawing.
    layout.dxf.limmin, layout.dxf.limmax = (0.0, 0.0), tuple(sheet / 1000.0 / metres_per_unit)
    document.header["$PSVPSCALE"] = 1.0 / scale
    margin = MARGIN / 1000.0 / metres_per_unit
    document.header["$PINSBASE"] = (*(margin - low / scale), 0.0)
    document.set_modelspace_vport(
        height=1.1 * max(float(high[1] - low[1]), millimetre), center=tuple((low + high) / 2.0)
    )
