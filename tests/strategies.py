"""Areas and strips to draw, from plain numbers so that failures shrink.

Coordinates are small whole numbers where the shape allows it: that is where vertices line up,
radii tie and sights pass exactly through corners.
"""

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import shapely
from hypothesis import assume, note
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely import LineString, Polygon, affinity, box

from midrib import Strip, split

__all__ = [
    "areas",
    "combs",
    "crowded",
    "divided",
    "gapped",
    "polyominoes",
    "ribbons",
    "spirals",
    "star_shaped",
    "tangled",
    "with_holes",
]

Floats = NDArray[np.float64]
Pair = tuple[int, int]
Exact = tuple[int, int] | tuple[Fraction, Fraction]
UNTANGLINGS = 100


def turn(a: Exact, b: Exact, c: Exact) -> int | Fraction:
    """Twice the signed area of a triangle."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def crosses(a: Pair, b: Pair, c: Pair, d: Pair) -> bool:
    """Whether c and d, and a and b, are on different sides of the other segment."""
    return turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0


def untangled(points: Sequence[Pair]) -> list[Pair]:
    """Reverse parts of a tour until no two of its segments cross (2-opt)."""
    tour = list(points)
    n = len(tour)
    for _ in range(UNTANGLINGS):
        for i in range(n - 2):
            for j in range(i + 2, n - (i == 0)):
                if crosses(tour[i], tour[i + 1], tour[j], tour[(j + 1) % n]):
                    tour[i + 1 : j + 1] = tour[i + 1 : j + 1][::-1]
                    break
            else:
                continue
            break
        else:
            return tour
    return tour


@st.composite
def tangled(draw: st.DrawFn, least: int = 4, most: int = 14) -> Polygon:
    """Points of a grid in a tour without crossings: folds, pockets, gaps."""
    pair = st.tuples(st.integers(0, 24), st.integers(0, 24))
    points = draw(st.lists(pair, min_size=least, max_size=most, unique=True))
    area = Polygon(untangled(points))
    assume(area.is_valid and area.area > 0.0)
    return area


@st.composite
def star_shaped(draw: st.DrawFn) -> Polygon:
    """Spikes around a middle."""
    reach = draw(st.lists(st.integers(1, 40), min_size=3, max_size=16))
    angle = 2.0 * np.pi * np.arange(len(reach)) / len(reach)
    area = Polygon(np.column_stack([reach * np.cos(angle), reach * np.sin(angle)]))
    assume(area.is_valid)
    return area


@st.composite
def combs(draw: st.DrawFn) -> Polygon:
    """A bar with teeth of drawn lengths, the gaps between them as wide as the teeth."""
    teeth = draw(st.lists(st.integers(1, 9), min_size=1, max_size=6))
    back = draw(st.integers(1, 4))
    parts = [box(0, -back, 2 * len(teeth) - 1, 0)]
    parts += [box(2 * i, 0, 2 * i + 1, tooth) for i, tooth in enumerate(teeth)]
    return one_part(parts)


@st.composite
def spirals(draw: st.DrawFn) -> Polygon:
    """A corridor wound inwards."""
    turns = draw(st.integers(3, 9))
    wide = draw(st.sampled_from([0.5, 1.0, 1.5]))
    path, x, y = [(0.0, 0.0)], 0.0, 0.0
    for i in range(turns):
        step = 2.0 * (turns - i)
        x, y = x + step * (1, 0, -1, 0)[i % 4], y + step * (0, 1, 0, -1)[i % 4]
        path.append((x, y))
    area = LineString(path).buffer(wide / 2.0, cap_style="flat", join_style="mitre")
    assume(isinstance(area, Polygon))
    return area


@st.composite
def ribbons(draw: st.DrawFn) -> Polygon:
    """A polyline of drawn points, made wide: folds that come near themselves."""
    steps = draw(st.lists(st.tuples(st.integers(1, 8), st.integers(-9, 9)), min_size=2, max_size=9))
    x = np.cumsum([step for step, _ in steps])
    y = [rise * (-1) ** i for i, (_, rise) in enumerate(steps)]
    wide = draw(st.sampled_from([0.25, 1.0, 2.0]))
    area = LineString(np.column_stack([x, y])).buffer(
        wide / 2.0, cap_style="flat", join_style="mitre", mitre_limit=3.0
    )
    assume(isinstance(area, Polygon) and area.is_valid)
    return area


@st.composite
def polyominoes(draw: st.DrawFn, most: int = 24) -> Polygon:
    """Cells of a walk on squared paper: right angles, holes, rings that touch in corners."""
    moves = draw(st.lists(st.integers(0, 3), min_size=2, max_size=most))
    x, y = 0, 0
    cells = {(0, 0)}
    for move in moves:
        x, y = x + (1, 0, -1, 0)[move], y + (0, 1, 0, -1)[move]
        cells.add((x, y))
    return one_part([box(x, y, x + 1, y + 1) for x, y in sorted(cells)])


def one_part(parts: Sequence[Polygon]) -> Polygon:
    """The union of parts, without vertices on straight lines."""
    area = shapely.union_all(parts).simplify(0.0)
    assume(isinstance(area, Polygon) and area.is_valid)
    return area


simple_areas = st.one_of(tangled(), star_shaped(), combs(), spirals(), ribbons(), polyominoes())


@st.composite
def with_holes(draw: st.DrawFn) -> Polygon:
    """An area with one to three holes, some of which touch a ring in one point."""
    area = draw(st.one_of(tangled(), star_shaped(), ribbons(), combs()))
    for _ in range(draw(st.integers(1, 3))):
        hole = drawn_hole(draw, area)
        if hole is None:
            continue
        shell, holes = area.exterior, [*area.interiors, hole.exterior]
        better = Polygon(shell, holes)
        if better.is_valid:
            area = better
    assume(len(area.interiors) > 0)
    assume(touches_or_keeps_off(area))
    return area


def touches_or_keeps_off(area: Polygon) -> bool:
    """Whether no ring is nearer to another than rounding can tell, unless it touches it exactly.

    A point of the main curve is rounded; what it sees past a corner that is one unit in the last
    place away is up to that rounding.
    """
    rings = [area.exterior, *area.interiors]
    size = float(np.ptp(np.array(area.exterior.coords), axis=0).max())
    vertices = [shapely.points(np.array(ring.coords)) for ring in rings]
    for i, ring in enumerate(rings):
        for other in vertices[:i] + vertices[i + 1 :]:
            exact, gaps = shapely.intersects(other, ring), shapely.distance(other, ring)
            if not (exact | (gaps > 1e-9 * size)).all():
                return False
    return True


def drawn_hole(draw: st.DrawFn, area: Polygon) -> Polygon | None:
    """A triangle in the area, with a corner free, at a vertex, on a segment or nearly on one."""
    rings = [area.exterior, *area.interiors]
    ring = np.array(rings[draw(st.integers(0, len(rings) - 1))].coords)
    k = draw(st.integers(0, len(ring) - 2))
    inside = area.representative_point()
    if draw(st.booleans()):
        inside = area.buffer(-draw(st.sampled_from([0.1, 0.3, 1.0]))).representative_point()
    if inside.is_empty:
        return None
    touch = draw(st.sampled_from(["nowhere", "vertex", "segment", "nearly"]))
    middle = np.array([inside.x, inside.y])
    corner = ring[k] if touch == "vertex" else (ring[k] + ring[k + 1]) / 2.0
    is_exact = is_between(ring[k], corner, ring[k + 1])
    if (touch == "segment" and not is_exact) or (touch == "nearly" and is_exact):
        return None
    away = corner - middle
    across = np.array([-away[1], away[0]]) * draw(st.sampled_from([0.05, 0.2, 0.5]))
    if touch == "nowhere":
        corner = middle + 0.5 * away
    triangle = Polygon([corner, middle + across, middle - across])
    return triangle if triangle.is_valid and triangle.area > 1e-3 else None


def is_between(a: Floats, b: Floats, c: Floats) -> bool:
    """Whether b is exactly on the segment a c, halfway but for rounding."""
    (ax, ay), (bx, by), (cx, cy) = ((Fraction(x), Fraction(y)) for x, y in (a, b, c))
    return (bx - ax) * (cy - ay) == (by - ay) * (cx - ax)


@st.composite
def crowded(draw: st.DrawFn) -> Polygon:
    """Many equal holes in a lattice or on a circle, squared paper: discs that touch a lot at once.

    Holes are moved by nothing, by rounding or by more; some touch.
    """
    n, corners = draw(st.integers(1, 4)), draw(st.sampled_from([3, 4, 6, 8]))
    kind = draw(st.sampled_from(["lattice", "circle", "paper"]))
    angle = 2.0 * np.pi * np.arange(corners) / corners + draw(st.sampled_from([0.0, np.pi / 4]))
    hole = np.column_stack([np.cos(angle), np.sin(angle)])
    if kind == "paper":
        cells = draw(st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5)), max_size=12))
        area = shapely.difference(
            box(0, 0, 6, 6), shapely.union_all([box(x, y, x + 1, y + 1) for x, y in cells])
        )
    else:
        if kind == "lattice":
            places = [(2 * i, 2 * j) for i in range(1, n + 1) for j in range(1, n + 1)]
            shell = box(0, 0, 2 * n + 2, 2 * n + 2).exterior
        else:
            around = 2.0 * np.pi * np.arange(n + 2) / (n + 2)
            places = list(zip(3 * np.cos(around), 3 * np.sin(around), strict=True))
            shell = LineString([(0, 0), (0, 0)]).buffer(5.0, quad_segs=6).exterior
        size = draw(st.sampled_from([0.5, 0.9, 1.0]))
        gap = draw(st.sampled_from([0.0, 0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3]))
        moves = draw(st.lists(st.integers(-9, 9), min_size=2 * len(places), max_size=99))
        area = Polygon(
            shell,
            [
                hole * size + place + gap * np.array(moves[2 * k : 2 * k + 2])
                for k, place in enumerate(places)
            ],
        )
    area = affinity.rotate(area, draw(st.sampled_from([0.0, 30.0])), origin=(0, 0))
    assume(isinstance(area, Polygon) and area.is_valid)
    return area


@st.composite
def gapped(draw: st.DrawFn) -> Polygon:
    """Quarters of squares on paper, their holes moved and slits cut by 1e-12 to 1e-6."""
    n = draw(st.integers(2, 5))
    middles = [(i + 0.5, j + 0.5) for i in range(n) for j in range(n)]
    kept = draw(st.lists(st.integers(0, 4 * len(middles) - 1), min_size=1, max_size=4 * n))
    corners = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
    left_out = [
        Polygon([middles[k // 4], *(corners[[k % 4, k % 4 - 3]] + middles[k // 4])]) for k in kept
    ]
    area = shapely.difference(box(0, 0, n, n), shapely.union_all(left_out))
    gap = 10.0 ** draw(st.sampled_from([-12, -9, -8, -7, -6]))
    for x, y, long, is_flat in draw(
        st.lists(
            st.tuples(st.integers(0, 8), st.integers(0, 8), st.integers(1, 4), st.booleans()),
            max_size=3,
        )
    ):
        slit = box(x, y, x + long, y + gap) if is_flat else box(x, y, x + gap, y + long)
        area = shapely.difference(area, affinity.scale(slit, 0.5, 0.5, origin=(0, 0)))
    area = max(shapely.get_parts(area), key=lambda part: part.area)
    assume(isinstance(area, Polygon) and area.area > 0.0)
    steps = st.tuples(st.integers(-9, 9), st.integers(-9, 9))
    holes = [np.array(hole.coords) + gap / 4 * np.array(draw(steps)) for hole in area.interiors]
    area = affinity.rotate(
        Polygon(area.exterior, holes), draw(st.integers(0, 31)) * 11.25, origin=(0, 0)
    )
    assume(area.is_valid)
    note(area.wkt)
    return area


areas = st.one_of(simple_areas, with_holes())


@st.composite
def divided(draw: st.DrawFn, area: st.SearchStrategy[Polygon] = areas) -> Strip:
    """An area with its curves: proposed, between two drawn vertices, or with drawn caps."""
    polygon = draw(area)
    note(polygon.wkt)
    how = draw(st.sampled_from(["proposed", "corners", "caps"]))
    ring = np.array(polygon.exterior.coords)[:-1]
    n = len(ring)
    if how == "proposed":
        return split(polygon)
    if how == "corners" or n < 5:
        i, j = draw(st.integers(0, n - 1)), draw(st.integers(1, n - 1))
        return split(polygon, start=ring[i], end=ring[(i + j) % n])
    ring = np.roll(ring, draw(st.integers(0, n - 1)), axis=0)
    k = draw(st.integers(1, n - 3))
    closes = draw(st.booleans())  # a cap closes the area, or the curves share their last vertex
    main, rest = ring[: k + 1], ring[k + 1 :]
    if not closes:
        rest = np.concatenate([rest, ring[:1]])
    assume(len(rest) > 1)
    # The other way round the auxiliary curve would make caps that leave the boundary.
    as_drawn, turned = caps_length(main, rest[::-1]), caps_length(main, rest)
    assume(as_drawn < turned)
    return Strip(LineString(main), LineString(rest), polygon)


def caps_length(main: Floats, auxiliary: Floats) -> float:
    """Length of the two caps between curves that run alongside."""
    return float(np.hypot(*(main[[0, -1]] - auxiliary[[0, -1]]).T).sum())
