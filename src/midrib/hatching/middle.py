"""The middle line of a slope, beside its top, and the two edges as the kernels see them."""

from contextlib import suppress
from typing import NamedTuple

import numpy as np
import shapely

from midrib.curves.construction import Construction
from midrib.errors import InvalidAreaError
from midrib.hatching.bounds import Curves
from midrib.hatching.chains import Chain as Edge
from midrib.kernels.chain import Chain
from midrib.kernels.mesh import Mesh
from midrib.kernels.slit import around, slit_open
from midrib.layout import Boundary, EndPoints, Layout, boundary_of
from midrib.ragged import place_text, rings_of_area, without_holes
from midrib.strip import PLANE, Strip
from midrib.types import Floats

__all__ = ["Middle", "lay_out_slope", "middle_of"]

CENTRED = "0.2%"  # of the width: decisions that rounding may change then make no visible difference
GRID_BITS = 24  # a cell of the grid is so many halvings of the extent
SIDE = np.pi / 3.0  # angle with the top from which on an edge is a side
LONGEST_SIDE = 2.0  # mean widths
FAR_ALONG = 2.0  # mean widths over which the top has a direction: noise should not decide
NO_ENDS = EndPoints(
    np.empty((0, 2)), np.empty((0, 2)), np.empty((0, 2), dtype=np.intp), np.empty(0)
)


class Middle(NamedTuple):
    """A slope with its middle line; the top runs with the area on its left, the others beside it.

    That is so whichever way the caller's top runs: strokes do not depend on it.
    """

    mesh: Mesh
    top: Chain
    toe: Chain
    line: Floats  # (m, 2), of a closed slope closed
    is_turned: bool  # whether the caller's top runs the other way
    sides: tuple[int, int] = (0, 0)  # segments of the toe that are sides, at its start and end

    @property
    def is_closed(self) -> bool:
        """Whether the slope goes all the way round."""
        return bool((self.line[0] == self.line[-1]).all())

    @property
    def length(self) -> float:
        """Length of the middle line."""
        return float(np.hypot(*np.diff(self.line, axis=0).T).sum())

    @property
    def curves(self) -> Curves:
        """The line and the edges as polylines with the stations that strokes have."""
        corners = np.column_stack([self.mesh.x, self.mesh.y])
        steps = np.hypot(*np.diff(self.line, axis=0).T)
        closed = self.is_closed
        edges = (Edge(corners[c.vertex], c.arc, closed) for c in (self.top, self.toe))
        return Curves(Edge(self.line, np.append(0.0, np.cumsum(steps)), closed), *edges)

    @property
    def periods(self) -> Floats:
        """Lengths of top, toe and line of a closed slope, 0 of an open one."""
        lengths = np.array([self.top.arc[-1], self.toe.arc[-1], self.length])
        return lengths if self.is_closed else np.zeros(3)


def middle_of(strip: Strip) -> Middle:
    """Middle line of a slope: as far from the top as from the toe."""
    plain, corner = on_grid(strip)
    if strip.is_closed:
        ring = lay_out_ring(strip)
        return ring._replace(line=line_around(plain) + corner)
    layout, is_turned = lay_out_slope(strip)
    same, _ = (layout, is_turned) if plain is strip else lay_out_slope(plain)
    caps = capped(same, sides_of(same))
    _, path = Construction(centring="centred", tolerance=CENTRED, ends="caps").of(caps)
    line = path.points + corner
    return Middle(layout.mesh, layout.main, layout.auxiliary, line, is_turned, sides_of(layout))


def on_grid(strip: Strip) -> tuple[Strip, Floats]:
    """Strip without islands from its lower left corner on, rounded to a grid, and that corner.

    The same slope elsewhere is the same strip, but for what rounding makes of its place: what is
    a tie, on a slope that is its own mirror image, is decided alike. A strip that is none on the
    grid stays as it is.
    """
    corners = np.array(strip.area.bounds).reshape(2, 2)
    cell = 2.0 ** (np.frexp(np.ptp(corners, axis=0).max())[1] - GRID_BITS)

    def moved(points: Floats) -> Floats:
        cells: Floats = np.round((points - corners[0]) / cell) * cell
        return cells

    with suppress(InvalidAreaError):
        curves = (shapely.transform(curve, moved) for curve in (strip.main, strip.auxiliary))
        return Strip(*curves), corners[0]
    return strip, np.zeros(2)


def lay_out_slope(strip: Strip) -> tuple[Layout, bool]:
    """Layout without islands whose main curve has the area on its left; whether it was turned."""
    layout = filled_layout(strip)
    main, middle = layout.main, layout.middle
    if layout.mesh.tri[main.side[0]] == main.vertex[0]:
        return layout, False
    turned = layout._replace(
        main=backwards(main),
        auxiliary=backwards(layout.auxiliary),
        middle=EndPoints(
            middle.point[::-1].copy(),
            middle.origin[::-1].copy(),
            middle.at[::-1].copy(),
            middle.height[::-1].copy(),
        ),
    )
    return turned, True


def filled_layout(strip: Strip) -> Layout:
    """Layout of a slope without its islands.

    The edges of a ring that is closed by a touch run along its hole, which then stays.
    """
    if strip.area.interiors:
        with suppress(InvalidAreaError):
            return Strip(strip.main, strip.auxiliary, without_holes(strip.area)).layout
    return strip.layout


def capped(layout: Layout, sides: tuple[int, int]) -> Layout:
    """Layout in which the sides of a slope are caps: the middle line ends halfway along them."""
    toe, ends = layout.auxiliary, layout.middle
    point, at = ends.point.copy(), ends.at.copy()
    for end, count in enumerate(sides):
        edge = backwards(toe) if end else toe
        if count:
            half = edge.arc[count] / 2.0
            k = int(np.searchsorted(edge.arc, half, side="right")) - 1
            share = (half - edge.arc[k]) / (edge.arc[k + 1] - edge.arc[k])
            corners = np.column_stack([layout.mesh.x, layout.mesh.y])[edge.vertex[[k, k + 1]]]
            point[end] = corners[0] + share * (corners[1] - corners[0])
            at[end] = edge.side[k], edge.vertex[k] if share == 0.0 else -1
    if not any(sides):
        return layout
    first, last = sides[0], toe.vertex.size - sides[1]
    shorter = Chain(
        toe.vertex[first:last].copy(),
        toe.side[first : last - 1].copy(),
        toe.arc[first:last] - toe.arc[first],
    )
    return layout._replace(auxiliary=shorter, middle=EndPoints(point, point, at, ends.height))


def sides_of(layout: Layout) -> tuple[int, int]:
    """How many segments of the toe are sides of the slope, at its start and at its end.

    Registers often name the top only, and all else is toe. If the toe leaves the end of the top at
    60 degrees or more and then turns to run along it, at less, what lies before the turn is a side.
    """
    top, toe = layout.main, layout.auxiliary
    first, last = side_at(layout, top, toe), side_at(layout, backwards(top), backwards(toe))
    return (first, last) if first + last < toe.side.size else (0, 0)


def side_at(layout: Layout, top: Chain, toe: Chain) -> int:
    """How many segments of the toe, from the start that it shares with the top, are a side."""
    if top.vertex[0] != toe.vertex[0]:
        return 0
    x, y = layout.mesh.x, layout.mesh.y
    width = layout.mean_width
    beyond = FAR_ALONG * width
    along = np.array([np.interp(beyond, top.arc, axis[top.vertex]) for axis in (x, y)])
    along -= x[top.vertex[0]], y[top.vertex[0]]
    for k in range(toe.side.size):
        a, b = toe.vertex[k], toe.vertex[k + 1]
        step = np.array([x[b] - x[a], y[b] - y[a]])
        cosine = float(along @ step / (np.hypot(*along) * np.hypot(*step)))
        if cosine > np.cos(SIDE):
            return k
        if toe.arc[k + 1] > LONGEST_SIDE * width:
            return 0
    return 0


def backwards(chain: Chain) -> Chain:
    """Return the same chain the other way."""
    arc = chain.arc[-1] - chain.arc[::-1]
    return Chain(chain.vertex[::-1].copy(), chain.side[::-1].copy(), arc)


def lay_out_ring(strip: Strip) -> Middle:
    """Slope around a mound or a pit, without islands; it has no line yet."""
    top_is_hole = shapely.Polygon(strip.main).area < shapely.Polygon(strip.auxiliary).area
    inner, outer = (strip.main, strip.auxiliary)[:: 1 if top_is_hole else -1]
    boundary = boundary_of(*rings_of_area(shapely.Polygon(outer, [inner])))
    mesh = boundary.mesh
    sides = side_of_hole(boundary), int(boundary.side[0])
    top_side, toe_side = sides if top_is_hole else sides[::-1]
    top_vertex, toe_vertex = int(mesh.tri[top_side]), int(mesh.tri[toe_side])
    top = around(mesh, top_side, top_vertex, top_vertex, False)
    toe = around(mesh, toe_side, toe_vertex, toe_vertex, True)
    is_turned = shapely.is_ccw(shapely.LinearRing(strip.main.coords)) == top_is_hole
    return Middle(mesh, top, toe, np.zeros((0, 2)), bool(is_turned))


def line_around(strip: Strip) -> Floats:
    """Middle line of a slope around a mound or a pit.

    Of the ring slit open at one seam, half of the line is taken, far from the seam; the other half
    of the ring slit open on the other side.
    """
    mesh, top, toe = lay_out_ring(strip)[:3]
    seam, other = seams(mesh, top, toe)
    area = abs(shapely.Polygon(strip.main).area - shapely.Polygon(strip.auxiliary).area)
    width = 2.0 * area / (top.arc[-1] + toe.arc[-1])
    sides = int(top.side[0]), int(toe.side[-1])
    station = dict(zip(top.vertex[:-1].tolist(), top.arc[:-1].tolist(), strict=True))
    at = [station[int(mesh.tri[e])] for e in (seam, other)]
    ahead = (at[1] - at[0]) % top.arc[-1]  # from the seam to the other one
    behind = top.arc[-1] - ahead
    halves = [
        half_of(mesh, sides, seam, width, (ahead / 2.0, ahead + behind / 2.0)),
        half_of(mesh, sides, other, width, (behind / 2.0, behind + ahead / 2.0)),
    ]
    line = np.concatenate([halves[0][:-1], halves[1]])
    line[-1] = line[0]  # the same point, up to the tolerance of centring
    distinct: Floats = line[np.append(True, (line[1:] != line[:-1]).any(axis=1))]
    return distinct


def side_of_hole(boundary: Boundary) -> int:
    """Return a boundary side of the only hole.

    Raises
    ------
    InvalidAreaError
        If the hole touches the shell.
    """
    mesh = boundary.mesh
    on_shell = np.zeros(mesh.tri.size, dtype=np.bool_)
    on_shell[boundary.side] = True
    hole_sides = np.flatnonzero((mesh.twin < 0) & ~on_shell)
    touching = np.intersect1d(mesh.tri[hole_sides], mesh.tri[boundary.side])
    if touching.size:
        place = place_text(np.array([mesh.x[touching[0]], mesh.y[touching[0]]]))
        msg = f"top and toe touch at {place}, expected rings apart from each other"
        raise InvalidAreaError(msg)
    return int(hole_sides[0])


def seams(mesh: Mesh, top: Chain, toe: Chain) -> tuple[int, int]:
    """Two half-edges from top to toe that are far from each other.

    The first leaves the leftmost, lowest vertex of the top that has one, so that it does not
    depend on where rings start.
    """
    start = mesh.tri
    stop = mesh.tri[np.arange(mesh.tri.size) // 3 * 3 + (np.arange(mesh.tri.size) + 1) % 3]
    places = [np.full(mesh.x.size, np.nan), np.full(mesh.x.size, np.nan)]
    for place, chain in zip(places, (top, toe), strict=True):
        place[chain.vertex[:-1]] = chain.arc[:-1] / chain.arc[-1]
    mixed = np.flatnonzero(~np.isnan(places[0][start]) & ~np.isnan(places[1][stop]))
    a, b = start[mixed], stop[mixed]
    order = np.lexsort([mesh.y[b], mesh.x[b], mesh.y[a], mesh.x[a]])
    mixed, a, b = mixed[order], a[order], b[order]
    apart = np.zeros(mixed.size)
    for place, vertex in zip(places, (a, b), strict=True):
        ahead = (place[vertex] - place[vertex[0]]) % 1.0
        apart += np.minimum(ahead, 1.0 - ahead) * (1.0 + (vertex is a))
    apart[a == a[0]] = -1.0
    return int(mixed[0]), int(mixed[np.argmax(np.round(apart, 6))])


def half_of(
    mesh: Mesh, sides: tuple[int, int], seam: int, width: float, between: tuple[float, float]
) -> Floats:
    """Middle line of a ring slit open, between two stations on the top from the seam on.

    Of radii that tie at a station, the last one counts, at either end.
    """
    n = mesh.x.size
    a, b = int(mesh.tri[seam]), int(mesh.tri[mesh.twin[seam]])
    slit = slit_open(mesh, seam)
    ring = around(mesh, sides[0], a, n, False), around(mesh, sides[1], b, n + 1, True)
    low, high = between
    count = max(int(np.ceil((high - low) / width)), 8)
    stations = np.linspace(low, high, count + 1)
    layout = Layout(slit, *ring, NO_ENDS, PLANE, None, width)
    drawn = Construction(
        centring="centred", tolerance=CENTRED, ends=None, vertices=False, stations=stations
    )
    radii, path = drawn.of(layout)
    at_start = radii.station[path.radius[path.on_radii]] == 0
    first = int(path.on_radii[at_start][-1]) if at_start.any() else 0
    return path.points[first:]
