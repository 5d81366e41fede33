"""Hatching a slope: strokes from its top to its toe that never cross."""

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import shapely

from midrib.hatching.asked import STIFFNESS, Asked, check_asked, least_length
from midrib.hatching.finishing import (
    Finished,
    Problem,
    finish,
    hide,
    islands_of,
    lines_of,
    zones_of,
)
from midrib.hatching.laying import Ground
from midrib.hatching.matching import Drawn, Start, draw_by_matching
from midrib.hatching.paper import draw_by_paper
from midrib.hatching.rule import MILLIMETRES, Rule, rule_of, with_mean_gap
from midrib.hatching.standards import standard as standard_named
from midrib.strip import Strip, check_strip

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from midrib.types import Bools, Floats

__all__ = ["Hatching", "hatch"]


@dataclass(frozen=True, eq=False)
class Hatching:
    """Strokes of a slope, in order along its top.

    Attributes
    ----------
    strokes : (n,) array of LineString
        From the top down; long ones reach the toe, short ones stop on the way.
    is_long : (n,) array of bool
    width : (n,) array of float
        Lengths of the whole strokes from top to toe, in coordinate units.
    on_top, on_toe : (n, 2) arrays of float
        Ends of the whole strokes.
    spacing : (n - 1,) array of float, (n,) on a closed slope
        Distances from each stroke to the next one along the middle line.
    problems : list of Problem
        Places where a stroke had to be left out or shortened, or where strokes exceed a bound,
        with the reason.
    strip, standard, scale
        What was hatched, and how.
    rule : Rule
        The standard's rule with all overrides, in coordinate units.
    station, share : (n,) arrays of float
        Where on the middle line each stroke is, and how much of the whole stroke is drawn.
    n_excluded : int
        Number of strokes that zones of ``exclude`` have taken, as asked: they are no problems.
    """

    strokes: "NDArray[np.object_]"
    is_long: "Bools"
    width: "Floats"
    on_top: "Floats"
    on_toe: "Floats"
    spacing: "Floats"
    problems: list[Problem]
    strip: Strip
    standard: Any
    scale: float
    rule: Rule
    station: "Floats"
    share: "Floats"
    ground: Ground | None = field(repr=False, default=None)  # for editing
    zones: Any = field(repr=False, default=None)  # that no stroke may enter
    n_excluded: int = 0

    def __repr__(self) -> str:
        """Show what there is of it."""
        long = int(np.count_nonzero(self.is_long))
        return (
            f"<Hatching: {long} long strokes, {self.is_long.size - long} short ones, "
            f"{len(self.problems)} problems>"
        )


def hatch(
    strip: Strip,
    standard: Any = "pl-2021-slope-unreinforced",
    scale: float = 500.0,
    *,
    rule: Literal["matching", "mean", "paper"] | None = None,
    metres_per_unit: float = 1.0,
    factor: float | None = None,
    spacing: float | None = None,
    min_spacing: float | None = None,
    max_spacing: float | None = None,
    min_length: float | None = None,
    pattern: str | None = None,
    short_ratio: float | None = None,
    start: Start = "left",
    offset: float = 1.0,
    first: Literal["long", "short"] | None = None,
    end_strokes: bool = False,
    exclude: Any = None,
    stiffness: float = STIFFNESS,
    top_share: float | None = None,
) -> Hatching:
    """Hatch a slope with strokes from its top to its toe.

    Strokes follow each other evenly along the middle line, nearly at right angles to both edges.
    None crosses another one or leaves the slope, and every long one reaches from edge to edge.

    Parameters
    ----------
    strip : Strip
        The slope: ``main`` is its top, ``auxiliary`` its toe. Both may be closed. Strokes that
        would meet an island end before it.
    standard : str or Standard, default "pl-2021-slope-unreinforced"
        How strokes are spaced and how long they are, on paper; ``midrib.standards()`` lists them.
    scale : float, default 500
        The map's scale is 1 : ``scale``.
    rule : {"matching", "mean", "paper"}, optional
        The standard's unless given, which is "matching" for nearly all: the engine described here.
        "mean" has one gap for the whole slope, as drawing tools have: the factor times the mean
        distance of the top's vertices from the toe; strokes are at right angles to the top then.
        "paper" is the procedure of the paper, for comparison: from the first point of the top on,
        to the nearest point of the toe that is seen; such strokes may share feet and cross. It has
        no start, offset, end strokes, stiffness and top share.
    metres_per_unit : float, default 1
        Length of a unit of the coordinates.
    factor : float, optional
        Gap between strokes over their length, in place of the standard's.
    spacing : float, optional
        Fixed gap in paper millimetres, in place of a factor.
    min_spacing, max_spacing : float, optional
        Least and largest gap in paper millimetres, in place of the standard's.
    min_length : float, optional
        Whole strokes shorter than this on paper, in millimetres, are not drawn: at tips, strokes
        end there. Nor is what is drawn of a short one shorter. A quarter of the least gap unless
        given, about the width of the line.
    pattern : str, optional
        Long and short strokes in turn: "LS", "LSS", "LSSL", "L".
    short_ratio : float, optional
        Length of a short stroke over that of a whole one, 0.05 to 0.95; 1 makes no difference.
    start : {"left", "right", "first", "last"}, default "left"
        Where the pattern starts: at the end of the slope that is on the left, or right, as one
        looks down from the top, or at the first, or last, point of the top. On closed slopes
        "left" and "right" start at the leftmost vertex of the top, "first" and "last" at its
        first one.
    offset : float, default 1
        Where the first stroke falls, in gaps from the start; the last is as far from the end.
    first : {"long", "short"}, optional
        What the first stroke is; that of the pattern unless given.
    end_strokes : bool, default False
        Draw whole strokes on the straight ends of the slope too, where it has such ends: caps
        between top and toe, or sides that the toe holds. Others that end on a side, or whose ends
        would be nearer to theirs than 0.3 gaps, give way.
    exclude : Polygon, MultiPolygon or sequence of them, optional
        Zones that no stroke may enter: those that would are left out, as asked, which is no
        problem unless none is left; ``n_excluded`` counts them. The others stay where they are.
    stiffness : float, default 0.9
        Over how many lengths of stroke directions are evened out. More turns slower at corners
        and is calmer under noise; less keeps strokes nearer to the normals of the edges.
    top_share : float, optional
        0: strokes stand to both edges alike; 1: at right angles to the top; between, in
        proportion. 0 unless given, and 1 by the rule "mean".

    Returns
    -------
    Hatching
        ``strokes``, ``is_long``, ``width`` and more; ``problems`` names each place where a stroke
        had to be left out or shortened, zones apart.

    Raises
    ------
    GeometryTypeError
        If ``strip`` is not a Strip.
    ParameterError
        If an option has a value it cannot have.
    InvalidAreaError
        If the slope has no middle line: its edges see nothing of each other.

    Notes
    -----
    1. The centred curve of minimal radii of the slope is the middle line. 2. Directions along it
    are the smoothing spline of its normals. 3. The rule asks for the gap
    g(w) = clamp(factor w, least, largest) beside a stroke of length w. Between two neighbours lies
    the mean of what both ask for, times one factor that makes the count of gaps whole. 4. From its
    point on the line each stroke goes both ways until it meets the boundary. 5. Where strokes
    would not advance on both edges, a run of them chooses other directions. Time is nearly linear
    in vertices and strokes.

    Strokes advance on both edges, so that the ends of two never interleave on the boundary, and
    lie inside: therefore they do not cross (docs/hatching.md has the proof). This is checked by
    exact signs at the end.

    References
    ----------
    Buczek, Area collapse algorithm computing new curve of 2D geometric objects, Geodesy and
    Cartography 66(1), 2017, 23-44, section 5 and Eq. 2.

    Examples
    --------
    >>> hatching = hatch(split(box(0, 0, 12, 4)), scale=500)
    >>> hatching.on_top[:, 0].round(6)
    array([ 2.,  4.,  6.,  8., 10.])
    >>> shapely.length(hatching.strokes).round(6)
    array([4., 2., 4., 2., 4.])
    """
    check_strip(strip)
    ground = rule_of(
        standard, scale, metres_per_unit, factor=factor, spacing=spacing, min_spacing=min_spacing,
        max_spacing=max_spacing, pattern=pattern, short_ratio=short_ratio,
    )  # fmt: skip
    usual = standard_named(standard).at(scale).rule
    # With a gap of the caller's, a standard that has the mean keeps the directions of its strokes.
    takes_mean = rule == "mean" or (rule is None and usual == "mean" and ground.factor is not None)
    kind = usual if rule is None else rule
    check_asked(Asked(kind, start, offset, end_strokes, stiffness, top_share), first, ground)
    least = least_length(min_length, ground, scale / MILLIMETRES / metres_per_unit)
    if takes_mean:
        ground = with_mean_gap(ground, strip.main, strip.auxiliary)
    zones = zones_of(exclude)
    where: Ground | None = None
    if kind == "paper":
        drawn = draw_by_paper(strip, ground)
    else:
        share = float(kind == "mean") if top_share is None else top_share
        drawn, where = draw_by_matching(strip, ground, start, offset, end_strokes, stiffness, share)
    curves = None if where is None else where.curves
    finished = finish(drawn, ground, least, first, strip, curves, offset)
    finished.problems.extend(seems_closed(drawn, strip))
    n_excluded = 0 if zones is None else hide(drawn, finished, zones)
    made = assemble(
        drawn, finished, where, strip=strip, standard=standard, scale=scale, rule=ground
    )
    return replace(made, zones=zones, n_excluded=n_excluded)


def seems_closed(drawn: Drawn, strip: Strip) -> list[Problem]:
    """Tell of a slope with ends whose strokes all meet an island: it may run all round that."""
    islands = [] if strip.is_closed else islands_of(strip)
    chords = lines_of(drawn.on_top, drawn.on_toe, np.ones(drawn.kept.size))[drawn.kept]
    if not islands or not chords.size:
        return []
    if not shapely.intersects(chords, shapely.union_all(islands)).all():
        return []
    reason = (
        "every stroke meets an island; if the slope runs all round it, its top is closed, expected "
        "midrib.Strip(top, toe, area) with the island's edge as top or toe"
    )
    return [Problem(max(islands, key=lambda island: island.area).representative_point(), reason)]


def assemble(
    drawn: Drawn, finished: Finished, ground: Ground | None, *, strip: Strip, standard: Any,
    scale: float, rule: Rule,
) -> Hatching:  # fmt: skip
    """Put a hatching together, its strokes in the order of the caller's top."""
    rows = np.flatnonzero(finished.kept)
    if ground is not None and ground.from_right != ground.middle.is_turned:
        rows = rows[::-1]
    on_top, on_toe, share = drawn.on_top[rows], drawn.on_toe[rows], finished.share[rows]
    station = drawn.station[rows]
    return Hatching(
        strokes=lines_of(on_top, on_toe, share),
        is_long=finished.is_long[rows],
        width=np.hypot(*(on_toe - on_top).T),
        on_top=on_top,
        on_toe=on_toe,
        spacing=gaps_between(station, ground),
        problems=finished.problems,
        strip=strip,
        standard=standard,
        scale=scale,
        rule=rule,
        station=station,
        share=share,
        ground=ground,
    )


def gaps_between(station: "Floats", ground: Ground | None) -> "Floats":
    """Distances between neighbours along the middle line, on a closed one all the way round."""
    if ground is None or not ground.middle.is_closed:
        gaps: Floats = abs(np.diff(station))
        return gaps
    total = ground.ladder.rungs[-1, 0]
    ahead = (np.roll(station, -1) - station) % total
    behind = (station - np.roll(station, -1)) % total
    shorter: Floats = (
        np.minimum(ahead, behind) if station.size > 1 else np.full(station.size, total)
    )
    return shorter
