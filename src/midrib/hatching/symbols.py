r"""Symbols: what is drawn of strokes. Lines, filled areas, and figures that stand in a place.

b           base: from b[0] to b[1] along the top, symbol_width on paper, p in it
p, q        ends of the whole stroke, on the top and on the toe
e           end of the stroke: q, or a point on the way
m           where the sides meet: the end, the tip of a triangle, the fork of a Y

    b[0]--p--b[1]   top      Symbols keep apart if bases have no point in common, sides are inside
      \   |   /              the area, and whole strokes do not cross. A whole stroke beside it that
       \  |  /               came in through a side could only leave through the base, the stroke
        \ | /                or the same side, and none of them lets it. A side that came in would
          m                  have to end on its own stroke, which is not in there.
          |
          e
          q         toe      The head of a tadpole keeps off the whole strokes beside it.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.errors import ParameterError
from midrib.hatching.chains import Chain, chain_of
from midrib.hatching.drawn import HEAD, Pen, Placed, Symbols, drawing, edges_of
from midrib.hatching.keys import STROKED
from midrib.hatching.standard import Standard
from midrib.hatching.standards import standard

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from midrib.hatching.hatch import Hatching
    from midrib.types import Bools, Floats

__all__ = ["symbols"]

CLOSE = 0.45  # of the way to the next stroke, that a base takes at the most
DROPS = (1.05, 1.2, 1.4, 1.7, 2.0)  # radii from the top to the middle of a head: what fits first
HALF_WAY = 0.49  # to the next stroke, that a head takes at the most
EQUILATERAL = 3.0**0.5 / 2.0  # height over base
ROUNDS = 6  # of halving, to the largest size that fits: within 2 %
# How far rounding may take a point of the top out of the area: so many last places of coordinates,
# and a share of the extent.
ULPS, WITHIN = 64.0, 1e-12


def symbols(hatching: "Hatching", *, metres_per_unit: float = 1.0) -> Symbols:
    """Draw the strokes of a hatching as its standard wants them.

    Symbols are as wide as the standard says, narrower where the next stroke or the boundary is
    near; they do not overlap where the strokes do not.

    Parameters
    ----------
    hatching : Hatching
        As ``midrib.hatch`` returns it.
    metres_per_unit : float, default 1
        Length of a coordinate unit in metres.

    Returns
    -------
    Symbols
        In coordinate units, in the order of the strokes.

    Raises
    ------
    ParameterError
        If the standard's symbol is not made of strokes.
    """
    known = standard(hatching.standard).at(hatching.scale)
    if known.symbol not in STROKED:
        msg = f"standard {known.name!r} draws {known.symbol!r}, expected a symbol made of strokes"
        raise ParameterError(msg)
    edges = edges_of(hatching.strip.area, hatching.strip.main, known)
    strokes = strokes_of(hatching)
    millimetre = hatching.scale / 1000.0 / metres_per_unit
    is_wedge = strokes.length < known.wedge_below * millimetre
    kinds = np.where(is_wedge, "wedge", known.symbol)
    if (kinds == "line").all():  # so it is without strokes
        lines = Pen()
        lines.take(hatching.strokes, np.arange(len(strokes.p)))
        return drawing(lines, Pen(), (), edges, known)
    return drawn_strokes(strokes, kinds, 0.5 * known.symbol_width * millimetre, edges, known)


class Strokes(NamedTuple):
    """Strokes with the room they have on the top."""

    top: Chain
    station: "Floats"  # (n,) of p on the top
    p: "Floats"  # (n, 2)
    e: "Floats"
    q: "Floats"
    before: "Floats"  # (n,) what a base may take of the top before p
    after: "Floats"
    area: Polygon
    grown: Polygon  # with what rounding needs

    @property
    def length(self) -> "Floats":
        """Lengths of the strokes as they are drawn."""
        lengths: Floats = np.hypot(*(self.e - self.p).T)
        return np.maximum(lengths, np.finfo(np.float64).tiny)  # to be divided by

    def part(self, share: "Floats | float") -> "Floats":
        """Points at a share of the way from p to e."""
        return self.p + np.expand_dims(share, -1) * (self.e - self.p)

    def whole(self) -> "NDArray[np.object_]":
        """Whole strokes as lines."""
        lines: NDArray[np.object_] = shapely.linestrings(np.stack([self.p, self.q], axis=1))
        return lines


def strokes_of(hatching: "Hatching") -> Strokes:
    """Strokes of a hatching, with the room they have."""
    top = chain_of(hatching.strip.main)
    area = shapely.force_2d(hatching.strip.area)  # a copy, to be prepared
    p, q = np.asarray(hatching.on_top), np.asarray(hatching.on_toe)
    n = len(p)
    e = shapely.get_coordinates(shapely.get_point(hatching.strokes, -1))
    station = shapely.line_locate_point(shapely.force_2d(hatching.strip.main), shapely.points(p))
    before = np.full(n, np.inf)
    after = np.full(n, np.inf)
    if n > 1:
        gaps = np.diff(station, append=station[:1])
        if top.is_closed:
            gaps = np.mod(gaps, top.length)
        else:
            gaps[-1] = np.inf
        # Where rounding has put two strokes the wrong way round, neither has room.
        gaps = np.maximum(gaps, 0.0)
        after, before = CLOSE * gaps, CLOSE * np.roll(gaps, 1)
    elif top.is_closed:
        before[:] = after[:] = CLOSE * top.length
    if not top.is_closed:  # a base ends where the top does
        before, after = np.minimum(before, station), np.minimum(after, top.length - station)
    corners = np.array(area.bounds).reshape(2, 2)
    rounding = ULPS * np.spacing(np.abs(corners).max()) + WITHIN * np.ptp(corners)
    grown = shapely.buffer(area, rounding, quad_segs=1)
    shapely.prepare([area, grown])
    return Strokes(top, station, p, e, q, before, after, area, grown)


def drawn_strokes(
    strokes: Strokes,
    kinds: "NDArray[np.object_]",
    half: float,
    edges: "NDArray[np.object_]",
    known: Standard,
) -> Symbols:
    """Draw strokes, each as a symbol of its kind."""
    lines, areas = Pen(), Pen()
    has_head = kinds == "tadpole"
    size = largest(lambda share: bases_fit(strokes, kinds, half * share), len(kinds))
    drop = np.zeros(len(kinds))
    if has_head.any():
        head = largest(lambda share: ~np.isnan(drops_of_heads(strokes, half * share)), len(kinds))
        drop = drops_of_heads(strokes, half * head)
        size = np.where(has_head, head, size)
    meeting = strokes.part(meets_at(strokes, kinds, half * size))
    start, stop = ends_of_bases(strokes, half * size)
    is_head = has_head & (size > 0.0)
    for i, kind in enumerate(kinds):
        tail = LineString([strokes.p[i], strokes.e[i]])
        if kind == "line" or size[i] == 0.0:
            lines.add(tail, i)
        elif kind == "tadpole":
            neck = strokes.part((drop + half * size) / strokes.length)[i]
            if (neck != strokes.e[i]).any():
                lines.add(LineString([neck, strokes.e[i]]), i)
        else:
            base = strokes.top.between(start[i], stop[i])
            add_based(lines, areas, kind, base, meeting[i], strokes.e[i], i)
            if kind == "tapered":
                lines.add(tail, i)
    placed = Placed(
        HEAD,
        strokes.part(drop / strokes.length)[is_head],
        2.0 * half * size[is_head],
        np.zeros(is_head.sum()),
        np.flatnonzero(is_head),
    )
    return drawing(lines, areas, (placed,) if is_head.any() else (), edges, known)


def largest(fits: "Callable[[Floats], Bools]", n: int) -> "Floats":
    """Return the largest share of its size that fits for each of n symbols, 0 if none is found."""
    share, step = np.ones(n), 1.0
    good = fits(share)
    best = np.where(good, 1.0, 0.0)
    for _ in range(ROUNDS if not good.all() else 0):
        step *= 0.5
        share = np.where(good, share + step, share - step)
        share = np.where(best == 1.0, 1.0, share)
        good = fits(share)
        best = np.where(good, share, best)
    return best


def ends_of_bases(strokes: Strokes, half: "Floats") -> tuple["Floats", "Floats"]:
    """Stations where bases of a half width begin and end."""
    before, after = np.minimum(half, strokes.before), np.minimum(half, strokes.after)
    return strokes.station - before, strokes.station + after


def meets_at(strokes: Strokes, kinds: "NDArray[np.object_]", half: "Floats") -> "Floats":
    """Share of its stroke at which the sides of each symbol meet."""
    height = np.full(len(kinds), np.inf)
    is_triangle = np.isin(kinds, ("triangle", "filled-triangle"))
    height = np.where(is_triangle, 2.0 * EQUILATERAL * half, height)
    height = np.where(kinds == "y", np.minimum(2.0 * half, 0.5 * strokes.length), height)
    share: Floats = np.minimum(height / strokes.length, 1.0)
    return share


def bases_fit(strokes: Strokes, kinds: "NDArray[np.object_]", half: "Floats") -> "Bools":
    """Whether the sides of symbols are inside the area."""
    meeting = strokes.part(meets_at(strokes, kinds, half))
    sides = [np.stack([strokes.top.at(b), meeting], axis=1) for b in ends_of_bases(strokes, half)]
    fit: Bools = shapely.covers(strokes.grown, shapely.linestrings(np.stack(sides))).all(axis=0)
    return fit


def drops_of_heads(strokes: Strokes, radius: "Floats") -> "Floats":
    """Least way from the top to the middle of each head; NaN where it does not fit anywhere.

    A head is inside the area, on its stroke, and clear of the whole strokes beside it.
    """
    found = np.full(len(radius), np.nan)
    boundary, whole = shapely.boundary(strokes.area), strokes.whole()
    shapely.prepare(boundary)
    for drop in DROPS:
        discs = shapely.points(strokes.part(drop * radius / strokes.length))
        free = shapely.distance(discs, boundary)
        for turn in (1, -1):
            beside = HALF_WAY * shapely.distance(discs, np.roll(whole, turn))
            if not strokes.top.is_closed:
                beside[0 if turn == 1 else -1] = np.inf
            free = np.minimum(free, np.where(len(whole) > 1, beside, np.inf))
        fits = (radius <= free) & ((drop + 1.0) * radius <= strokes.length)
        fits &= shapely.covers(strokes.area, discs)
        found = np.where(np.isnan(found) & fits, drop * radius, found)
    return found


def add_based(
    lines: Pen,
    areas: Pen,
    kind: str,
    base: "Floats",
    meeting: "Floats",
    end: "Floats",
    stroke: int,
) -> None:
    """Draw a symbol that stands on the top."""
    if kind == "y":
        lines.add(LineString([base[0], meeting, base[-1]]), stroke)
    elif kind == "triangle":
        lines.add(LineString([*base, meeting, base[0]]), stroke)
    else:
        areas.add(Polygon([*base, meeting]), stroke)
    if (meeting != end).any():
        lines.add(LineString([meeting, end]), stroke)
