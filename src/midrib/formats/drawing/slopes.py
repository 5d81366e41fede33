"""Slopes of a register to a drawing: each in its standard, with what went wrong."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from shapely import LineString, Point

from midrib import interrupts
from midrib.errors import InvalidAreaError, ParameterError
from midrib.formats.drawing.content import LEFT_OUT, REFUSED, Drawing, Drawn, Trouble
from midrib.formats.drawing.heights import relief_of
from midrib.formats.units import METRE, is_geographic, unit_of
from midrib.hatching.checking import doubts
from midrib.hatching.draw import draw
from midrib.hatching.finding import CHECK_OF
from midrib.hatching.keys import STROKED
from midrib.hatching.sharing import in_step
from midrib.hatching.standards import standard_for, standards_named
from midrib.strip import Strip

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from midrib.hatching.sharing import Shared
    from midrib.hatching.slope import Slope, SlopeProblem
    from midrib.hatching.standard import Standard

__all__ = ["check_standard", "draw_slopes", "try_out"]


def draw_slopes(
    slopes: "Sequence[Slope]",
    standard: str = "pl-2021",
    scale: float = 500.0,
    *,
    problems: "Sequence[SlopeProblem]" = (),
    values: dict[str, Any] | None = None,
    track: "Callable[[Sequence[Slope]], Iterable[Slope]]" = iter,
    shared: "Shared" = "meet",
    **options: Any,
) -> Drawing:
    """Draw slopes, walls, stairs and conveyors of a register at scale.

    Parameters
    ----------
    slopes : sequence of Slope
        As ``read_slopes`` returns them.
    standard : str, default "pl-2021"
        A standard, a file of one, or the beginning of names: then each object is drawn by the one
        that is made for its kind.
    scale : float, default 500
    problems : sequence of SlopeProblem, optional
        Of ``read_slopes``, to be listed with those of drawing.
    values : dict, optional
        Values that take the place of the standard's, in millimetres on paper; of several
        standards, those that draw strokes.
    track : function, optional
        Wraps the sequence of slopes, to show how far the work is.
    shared : {"meet", "between", "apart"}, default "meet"
        Of slopes with a top or a toe in common, as the sides of a dyke or a ditch: "meet" starts
        their patterns at the same end of it, so that strokes of one kind meet where both are as
        wide; "between" half a gap on as well; "apart" draws each as if it were alone.
    **options
        Those of ``midrib.hatch``.

    Returns
    -------
    Drawing
        ``problems`` tells what is refused, left out, or not drawn as it should be.

    Raises
    ------
    ParameterError
        If there is no such standard, an option has a value it cannot have, or the coordinates are
        not those of one plane.
    """
    crs = one_crs(slopes)
    unit = unit_of(crs) or METRE
    drawing = Drawing(scale, crs, unit.metres)
    drawing.problems += [Trouble(p.id, p.reason, p.where, p.kind) for p in problems]
    own = in_step(slopes, options, shared)
    for slope, mine in zip(track(slopes), own, strict=True):
        interrupts.check()
        add_slope(drawing, slope, styled(standard, slope.kind, values or {}), mine)
    draw_edges_once(drawing)
    return drawing


def add_slope(
    drawing: Drawing,
    slope: "Slope",
    known: "Standard | None",
    options: dict[str, Any],
) -> None:
    """Add a slope, or the reason why it is not drawn."""
    if known is None:
        reason = f"no symbol for an object of kind {slope.kind!r} in this standard"
        drawing.problems.append(Trouble(slope.id, reason, middle_of(slope), LEFT_OUT))
        return
    try:
        symbols, strokes = draw(
            slope.strip(),
            known,
            drawing.scale,
            metres_per_unit=drawing.metres_per_unit,
            drop=slope.drop,
            **options,
        )
    except InvalidAreaError as error:
        drawing.problems.append(Trouble(slope.id, str(error), middle_of(slope), REFUSED))
        return
    is_long, width = (None, None) if strokes is None else (strokes.is_long, strokes.width)
    relief = relief_of(slope.top, slope.toe)
    drawn = Drawn(
        slope.id,
        slope.kind,
        symbols,
        is_long,
        width,
        slope.attributes,
        relief,
        n_excluded=0 if strokes is None else strokes.n_excluded,
    )
    drawing.objects.append(drawn)
    drawing.problems += [Trouble(slope.id, d.reason, d.where, d.check) for d in doubts(slope)]
    for problem in [] if strokes is None else strokes.problems:
        trouble = Trouble(slope.id, problem.reason, problem.where, CHECK_OF[problem.kind])
        drawing.problems.append(trouble)


def draw_edges_once(drawing: Drawing) -> None:
    """Leave out of each outline what an earlier one has drawn: dashes would fill gaps."""
    edges = [edge for drawn in drawing.objects for edge in drawn.symbols.edges]
    owner = [k for k, drawn in enumerate(drawing.objects) for _ in drawn.symbols.edges]
    tree = shapely.STRtree(edges)
    left: dict[int, list[LineString]] = {}
    for i, whole in enumerate(edges):
        before = [edges[j] for j in tree.query(whole, predicate="intersects") if j < i]
        if before:  # a line that is only crossed is cut too, and put together again
            rest = shapely.line_merge(shapely.difference(whole, shapely.union_all(before)))
        left.setdefault(owner[i], []).extend(shapely.get_parts(rest if before else whole))
    for k, lines in left.items():
        drawn = drawing.objects[k]
        symbols = replace(drawn.symbols, edges=np.array([*lines, None], dtype=object)[:-1])
        drawing.objects[k] = replace(drawn, symbols=symbols)


def styled(name: str, kind: str, values: dict[str, Any]) -> "Standard | None":
    """Return the standard for a kind of object, with values of the caller's, None if none is.

    Of several standards, the values are for those that draw strokes.
    """
    known = standard_for(name, kind)
    if known is None or (len(standards_named(name)) > 1 and known.symbol not in STROKED):
        return known
    return known.with_values(**values)


def check_standard(name: str, values: dict[str, Any], scale: float) -> None:
    """Refuse a standard that there is not, or values or a scale it cannot have, before any work.

    Raises
    ------
    ParameterError
        If so.
    """
    for known in standards_named(name):
        (styled(name, known.kinds[0], values) or known).at(scale)


def try_out(name: str, scale: float, values: dict[str, Any], **options: Any) -> None:
    """Draw a slope of 40 by 8 millimetres on paper: this loads the kernels and checks options.

    Raises
    ------
    ParameterError
        If an option has a value it cannot have.
    """
    for known in standards_named(name):
        mine = styled(name, known.kinds[0], values) or known
        x, y = 0.04 * scale, 0.008 * scale
        sides = LineString([(0.0, 0.0), (x, 0.0)]), LineString([(0.0, y), (x, y)])
        draw(Strip(*sides), mine, scale, **options)


def one_crs(slopes: "Sequence[Slope]") -> str | None:
    """CRS of all slopes.

    Raises
    ------
    ParameterError
        If they have different ones, or are not in a plane.
    """
    found = {slope.crs for slope in slopes}
    if len(found) > 1:
        msg = f"the slopes of IN are in {len(found)} different CRS, expected one"
        raise ParameterError(msg)
    crs = found.pop() if found else None
    if is_geographic(crs):
        msg = "IN has coordinates in degrees, expected a CRS in a plane: strokes are at map scale"
        raise ParameterError(msg)
    return crs


def middle_of(slope: "Slope") -> Point:
    """Middle of the top, to mark a slope that is not drawn."""
    return shapely.force_2d(slope.top).interpolate(0.5, normalized=True)
