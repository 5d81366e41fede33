"""Lines of one area by several methods, side by side, with numbers that compare them."""

import time
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely
from shapely import LineString, Polygon
from shapely.ops import substring

from midrib import measures
from midrib.checks import check_flag
from midrib.curves.collapse import collapse
from midrib.curves.largest import one_part
from midrib.curves.log import steps_to_caller
from midrib.curves.variants import usual_variants, variant_of
from midrib.errors import MidribError, ParameterError, RepairedAreaWarning
from midrib.geodesy import degree_lengths
from midrib.layout import Scale
from midrib.strip import PLANE, Strip, split

__all__ = ["Compared", "Comparison", "compare"]

STEPS_PER_WIDTH = 20.0
P95 = 95.0
ROUNDS = 3  # of which the quickest counts


@dataclass(frozen=True)
class Compared:
    """The line of one method, in numbers.

    Attributes
    ----------
    method : str
        Its name, with a value of its main option after a colon if that was chosen.
    line : LineString or None
        None where the method refuses the area.
    reason : str
        Why it does, else empty.
    vertices : int
    length : float
        In coordinate units, in metres if geographic, as all lengths here.
    centredness : float
        95th percentile, away from the ends, of how far off the middle of the two sides it is: 0
        in the middle, 1 on a side. Islands are on neither side: beside one it says nothing of the
        middle of the channel. See ``midrib.measures.centredness``.
    turning : float
        Degrees by which it turns on a stretch as long as the area is wide.
    off, off_most : float
        95th percentile and largest of its distances from the line of the first method, in mean
        widths of the area.
    cpu : float
        Seconds of CPU time for the line, once the kernels are compiled.
    """

    method: str
    line: LineString | None
    reason: str
    vertices: int
    length: float
    centredness: float
    turning: float
    off: float
    off_most: float
    cpu: float


@dataclass(frozen=True, eq=False)
class Comparison:
    """What methods make of one area.

    Attributes
    ----------
    area : Polygon
        The one that was compared: repaired, and one part of several.
    rows : list of Compared
        In the order of the methods.
    along : LineString or None
    geographic : bool
    notes : list of str
        What was repaired, and which part it is.
    """

    area: Polygon
    rows: list[Compared]
    along: LineString | None
    geographic: bool
    notes: list[str] = field(default_factory=list)

    def __repr__(self) -> str:
        """Show which methods there are."""
        return f"<Comparison: {', '.join(row.method for row in self.rows)}>"


def compare(
    area: Any,
    names: Sequence[str] | None = None,
    *,
    along: Any = None,
    geographic: bool = False,
    part: int | None = None,
) -> Comparison:
    """Collapse an area by several methods and compare the lines.

    Parameters
    ----------
    area : Polygon or MultiPolygon
        One that is not valid is repaired as in ``midrib.collapse``, with a warning.
    names : sequence of str, optional
        Names of methods, or a method with a value of its main option after a colon:
        ``"minimal-radii:none"``, the paper's curve, ``"minimal-radii:symmetric"``,
        ``"mean-curve:kinks"``. All of ``midrib.methods()`` and the paper's curve unless given; the
        first is what the others are held against.
    along : LineString, optional
        Directional polyline, as in ``midrib.collapse``.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude.
    part : int, optional
        Which part of a MultiPolygon, from 0; the largest unless given.

    Returns
    -------
    Comparison
        ``rows`` has a line and its numbers for each method; ``midrib.figures`` draws it.

    Raises
    ------
    GeometryTypeError
        If ``area`` is no Polygon or MultiPolygon.
    InvalidAreaError
        If it is not valid and the repair is not certain.
    ParameterError
        If there is no such method, variant or part.

    Examples
    --------
    >>> found = compare(box(0, 0, 9, 2), ["minimal-radii", "chordal-axis"])
    >>> [(row.method, row.length, round(row.off, 9)) for row in found.rows]
    [('minimal-radii', 9.0, 0.0), ('chordal-axis', 9.0, 0.0)]
    """
    if names is None:
        names = usual_variants()
    if isinstance(names, str) or not names:
        msg = f"names is {names!r}, expected a sequence of names of methods"
        raise ParameterError(msg)
    for name in names:
        variant_of(name)
    check_flag(geographic, "geographic")
    area, notes, is_repaired = one_part(area, part)
    if is_repaired:
        message = f"area: {'; '.join(notes)}"
        warnings.warn(message, RepairedAreaWarning, stacklevel=steps_to_caller())
    scale = degree_lengths(np.array(area.bounds)) if geographic else PLANE
    strip = split(scaled(area, scale), along=None if along is None else scaled(along, scale))
    first: LineString | None = None
    rows = []
    for name in names:
        row = compared(name, area, first, along, strip, scale)
        rows.append(row)
        first = row.line if first is None else first
    return Comparison(area, rows, along, geographic, notes)


def scaled(geometry: Any, scale: Scale) -> Any:
    """Geometry with lengths for coordinates."""
    return shapely.transform(geometry, lambda points: points * scale)


def compared(
    name: str, area: Polygon, first: LineString | None, along: Any, strip: Strip, scale: Scale
) -> Compared:
    """Line of one method and its numbers."""
    method, options = variant_of(name)
    line, cpu, geographic = None, np.inf, scale != PLANE
    for _ in range(1 + ROUNDS):
        started = time.process_time()
        try:
            line = collapse(area, method, along=along, geographic=geographic, **options)
        except MidribError as error:
            return Compared(name, None, str(error), 0, *[np.nan] * 6)
        cpu = min(cpu, time.process_time() - started)
    width = float(measures.mean_width(line, area, geographic=geographic))
    off = off_most = 0.0
    if first is not None:
        deviation = measures.deviation(line, first, geographic=geographic)
        off, off_most = float(deviation.p95) / width, float(deviation.hausdorff) / width
    return Compared(
        name,
        line,
        "",
        int(shapely.get_num_coordinates(line)),
        float(measures.length(line, geographic=geographic)),
        centredness_of(scaled(line, scale), strip),
        float(measures.turning(line, area, geographic=geographic)),
        off,
        off_most,
        cpu,
    )


def centredness_of(line: LineString, strip: Strip) -> float:
    """95th percentile of the centredness of a line, a width from its ends and on."""
    width = strip.area.area / line.length
    first, last = min(width, line.length / 3.0), max(line.length - width, line.length / 1.5)
    lean = measures.centredness(
        substring(line, first, last), strip, spacing=width / STEPS_PER_WIDTH
    )
    return float(np.nanpercentile(lean, P95))
