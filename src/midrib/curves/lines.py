"""Lines of the parts of areas: by one kernel where options are usual, else area by area."""

from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib import interrupts
from midrib.curves.methods import RadiiFinder
from midrib.curves.parts import Part, polygons_of
from midrib.curves.usual import usual_lines
from midrib.errors import InvariantError, MidribError
from midrib.geodesy import degree_lengths, is_beyond_pole, lengths_at
from midrib.ragged import pack_areas
from midrib.strip import PLANE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from midrib.curves.finding import Finder, Found
    from midrib.curves.log import Log
    from midrib.ends import End
    from midrib.layout import Scale
    from midrib.ragged import Packed
    from midrib.types import Floats, Ints

    Areas = NDArray[np.object_]

__all__ = ["lines_at_once", "lines_of"]


def lines_of(
    parts: list[Part],
    find: "Finder",
    along: "Areas | None",
    geographic: bool,
    log: "Log",
    threads: int = 1,
    joints: "list[tuple[End, End] | None] | None" = None,
) -> list[LineString | None]:
    """Return the line of each part, None where it was refused."""
    if not parts:
        return []
    polygons = polygons_of(parts)
    packed = pack_areas(polygons)
    bounds = shapely.bounds(polygons) if geographic else None
    lines: Areas = np.full(len(parts), None, dtype=object)
    loops = np.zeros(len(parts), np.intp)
    if is_usual(find) and along is None and joints is None:
        lines, loops = usual_lines(packed, usual_scales(packed, bounds), threads)
    is_open = np.array([line is None for line in lines])
    for i in np.flatnonzero(is_open | (loops > 0)).tolist():
        part = parts[i]
        if not is_open[i]:
            log.note(part.area, part.number, "loops cut", f"{loops[i]} loops cut")
            continue
        interrupts.check()
        guide = None if along is None else along[part.area]
        try:
            scale = PLANE if bounds is None else degree_lengths(bounds[i])
            found = find_between(find, joints, i, *packed.rings(i), guide, scale)
            check_finite(found)
        except MidribError as error:
            log.refuse(part.area, part.number, error)
            continue
        lines[i] = noted_line(found, part, log)
    return list(lines)


def is_usual(find: "Finder") -> bool:
    """Whether one kernel does all that a finder does."""
    return isinstance(find, RadiiFinder) and find.is_usual


def lines_at_once(areas: "Areas", geographic: bool, threads: int) -> "Areas":
    """Return the lines of areas of which there is nothing to say, None for all others.

    For usual options. Triangles show that an area is valid, which takes a fifth of the time that
    the question takes; parts and a log take as long again. Those of which that cannot be said are
    left to the steps that can.
    """
    lines: Areas = np.full(areas.size, None, dtype=object)
    is_one = np.fromiter((isinstance(area, Polygon) for area in areas), np.bool_, areas.size)
    at = np.flatnonzero(is_one)
    at = at[~shapely.is_empty(areas[at])]
    if at.size > 0:
        packed = pack_areas(areas[at])
        bounds = shapely.bounds(areas[at]) if geographic else None
        scales = usual_scales(packed, bounds)
        found, loops = usual_lines(packed, scales, threads, are_known=False)
        found[loops > 0] = None
        lines[at] = found
    return lines


def usual_scales(packed: "Packed", bounds: "Floats | None") -> "Floats":
    """Lengths of one unit of x and of y in each area; NaN where the single steps are to look."""
    scales = np.ones((packed.has_z.size, 2))
    if bounds is not None:
        scales[:] = np.column_stack(lengths_at((bounds[:, 1] + bounds[:, 3]) / 2.0))
        scales[is_beyond_pole(bounds)] = np.nan
    scales[packed.has_z] = np.nan
    return scales


def noted_line(found: "Found", part: Part, log: "Log") -> LineString:
    """Line as a geometry; what there is to say of it goes to the log."""
    if found.loops:
        log.note(part.area, part.number, "loops cut", f"{found.loops} loops cut")
    if found.bays:
        count = f"{found.bays} of {found.bays + found.stations} stations"
        log.note(part.area, part.number, "bays left out", count)
    points = found.points
    if found.height is not None:
        points = np.column_stack([points, found.height])
    line: LineString = shapely.linestrings(points)
    return line


def check_finite(found: "Found") -> None:
    """Refuse a line that tools would choke on."""
    if not np.isfinite(found.points).all():
        msg = "the line has a coordinate that is not finite, please report this area"
        raise InvariantError(msg)


def find_between(
    find: "Finder",
    joints: "list[tuple[End, End] | None] | None",
    i: int,
    coordinates: "Floats",
    offsets: "Ints",
    guide: Any,
    scale: "Scale",
) -> "Found":
    """Line of area i between the ends it is to have; where there is none, strike these out."""
    if joints is not None and joints[i] is not None:
        try:
            return find(coordinates, offsets, guide, scale, joints[i])
        except MidribError:
            joints[i] = None
    return find(coordinates, offsets, guide, scale)
