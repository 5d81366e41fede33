"""A rough axis from a sample: where the tower is, how thick, and which way it stands.

slab      points within half a slab's thickness of a height
circle    the one through three points of a slab that most others lie on
frame     origin on the axis near the base; third axis along it
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.errors import ParameterError
from midrib.towers.splines import basis_on

if TYPE_CHECKING:
    from midrib.types import Bools, Floats

__all__ = ["Frame", "Rough", "Search", "frame_along", "off_shell", "rough_round", "slabs_of"]

SLABS, SLAB_SPACING, SLAB_SHARE = 24, 5.0, 0.4  # at least, at most so far apart, thickness
TRIES, SLAB_POINTS, KEPT = 300, 1000, 3  # triples, points, circles kept of a slab
NEAR, NEAR_SHARE = 0.04, 0.1  # of a circle: metres, and share of its radius
LEAST_IN_SLAB = 8
LEAST_RADIUS = 0.02  # metres
LINE_TRIES = 2000
LEAST_NEAR = 0.03  # of the points of its slabs are near a round tower at the least: trees
BESIDE = 0.3  # of the radius: points farther off the shell have nothing to do with it
BEND_STIFFNESS = 3e-3  # of the rough axis: an S-bend passes, the scatter of single slabs does not


class Frame(NamedTuple):
    """Coordinates along an axis: q = turn (p - origin)."""

    origin: "Floats"
    turn: "Floats"

    def inwards(self, points: "Floats") -> "Floats":
        """Coordinates in the frame."""
        moved: Floats = (points - self.origin) @ self.turn.T
        return moved

    def outwards(self, points: "Floats") -> "Floats":
        """Coordinates of the cloud."""
        moved: Floats = points @ self.turn + self.origin
        return moved


class Search(NamedTuple):
    """Where to look for the tower."""

    unit: float  # coordinate units in a metre
    near: tuple[float, float] | None = None  # a place beside which the axis is
    radius: tuple[float, float] | None = None  # least and largest


class Rough(NamedTuple):
    """The rough axis: table of x, y, radius at heights of the frame, and the shape."""

    frame: Frame
    table: "Floats"  # (m, 4): s, x, y, radius (apothem)
    faces: "Floats"  # (k, 2) outward normals in the frame; none if round
    off: float  # median distance of the points of slabs from the shell


def frame_along(point: "Floats", direction: "Floats") -> Frame:
    """Frame with its third axis along a direction that is not flat, the first one beside x."""
    t = direction / np.linalg.norm(direction)
    first = np.array([1.0, 0.0, 0.0]) - t[0] * t
    first /= np.linalg.norm(first)
    return Frame(np.asarray(point, dtype=np.float64), np.array([first, np.cross(t, first), t]))


def slabs_of(sample: "Floats", unit: float) -> "list[tuple[float, Floats]]":
    """Heights, and points (n, 3) of the slabs there; few points are no slab."""
    low, high = np.percentile(sample[:, 2], [0.2, 99.8])
    spacing = min((high - low) / SLABS, SLAB_SPACING * unit)
    thickness = SLAB_SHARE * spacing
    random = np.random.default_rng(1)
    order = np.argsort(sample[:, 2], kind="stable")
    heights = sample[order, 2]
    slabs = []
    for z in np.arange(low + thickness / 2.0, high, spacing):
        first, last = np.searchsorted(heights, [z - thickness / 2.0, z + thickness / 2.0])
        rows = order[first:last]
        if rows.size > SLAB_POINTS:
            rows = random.choice(rows, SLAB_POINTS, replace=False)
        if rows.size >= LEAST_IN_SLAB:
            slabs.append((float(z), sample[rows]))
    return slabs


def circles_in(points: "Floats", search: Search, random: np.random.Generator) -> "Floats":
    """Best circles (k, 4) of a slab: x, y, radius, score; k is at most ``KEPT``."""
    triples = points[random.integers(0, len(points), (TRIES, 3)), :2]
    circles = circles_through(triples)
    low, high = search.radius or (LEAST_RADIUS * search.unit, np.inf)
    spread = np.ptp(np.percentile(points[:, :2], [2, 98], axis=0), axis=0)
    high = min(high, float(spread.max()))
    circles = circles[(circles[:, 2] >= low) & (circles[:, 2] <= high)]
    if search.near is not None:
        away = np.hypot(*(circles[:, :2] - search.near).T)
        circles = circles[away <= np.maximum(circles[:, 2], search.unit)]
    if not circles.size:
        return np.zeros((0, 4))
    near = np.minimum(NEAR * search.unit, NEAR_SHARE * circles[:, 2])
    off = np.hypot(*(points[:, None, :2] - circles[:, :2]).transpose(2, 0, 1)) - circles[:, 2]
    # Points that are everywhere lie on every circle, in proportion to its band.
    density = len(points) / max(float(np.prod(spread)), 1e-300)
    band = 4.0 * np.pi * circles[:, 2] * near
    score = (np.abs(off) < near).sum(axis=0) - np.minimum(density * band, len(points))
    found = np.column_stack([circles, score])[np.argsort(-score, kind="stable")]
    kept: list[Floats] = []
    for row in found:
        if all(np.hypot(*(row[:2] - k[:2])) > 0.5 * min(row[2], k[2]) for k in kept):
            kept.append(refined(row, points, search.unit))
            if len(kept) == KEPT:
                break
    return np.array(kept)


def circles_through(triples: "Floats") -> "Floats":
    """Circles (k, 3) through triples (n, 3, 2) of points that do not lie on a line."""
    a, b, c = triples[:, 0], triples[:, 1] - triples[:, 0], triples[:, 2] - triples[:, 0]
    twice = 2.0 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    is_round = np.abs(twice) > 1e-9 * np.maximum((b**2).sum(1), (c**2).sum(1))
    a, b, c, twice = a[is_round], b[is_round], c[is_round], twice[is_round]
    bb, cc = (b**2).sum(1), (c**2).sum(1)
    x = (c[:, 1] * bb - b[:, 1] * cc) / twice
    y = (b[:, 0] * cc - c[:, 0] * bb) / twice
    return np.column_stack([a[:, 0] + x, a[:, 1] + y, np.hypot(x, y)])


def refined(circle: "Floats", points: "Floats", unit: float) -> "Floats":
    """Circle by least squares through the points near one; its score stays."""
    x, y, radius, score = circle
    for _ in range(3):
        near = min(NEAR * unit, NEAR_SHARE * radius)
        way = points[:, :2] - (x, y)
        away = np.hypot(*way.T)
        rows = np.abs(away - radius) < near
        if rows.sum() < LEAST_IN_SLAB:
            break
        unit_way = way[rows] / away[rows][:, None]
        design = np.column_stack([unit_way, np.ones(rows.sum())])
        step = np.linalg.lstsq(design, away[rows] - radius, rcond=None)[0]
        if np.abs(step).max() > radius:
            break
        x, y, radius = x + step[0], y + step[1], radius + step[2]
    return np.array([x, y, radius, score])


def rough_round(sample: "Floats", search: Search) -> Rough:
    """Rough axis of a round tower.

    Raises
    ------
    ParameterError
        If no circles of slabs stand one above the other.
    """
    upright = Frame(np.array([*np.median(sample[:, :2], axis=0), sample[:, 2].min()]), np.eye(3))
    frame = upright
    for _ in range(2):  # sections of the second run are perpendicular to the axis of the first
        inner = frame.inwards(sample)
        aim = search
        if search.near is not None:
            place = frame.inwards(np.array([[*search.near, frame.origin[2]]]))[0]
            aim = search._replace(near=(float(place[0]), float(place[1])))
        table, direction, _ = stacked(inner, aim)
        foot = np.array([table[0, 1], table[0, 2], table[0, 0]])
        frame = frame_along(frame.outwards(foot[None])[0], direction @ frame.turn)
    inner = frame.inwards(sample)
    table, _, off = stacked(inner, search._replace(near=(0.0, 0.0)))
    return Rough(frame, table, np.zeros((0, 2)), off)


def stacked(points: "Floats", search: Search) -> "tuple[Floats, Floats, float]":
    """Stack circles (m, 4) of s, x, y, radius; also their direction and how far off points are."""
    random = np.random.default_rng(2)
    slabs = slabs_of(points, search.unit)
    rows = [
        (z, *circle)
        for z, slab in slabs
        for circle in circles_in(slab, search, random)
        if circle[3] > 0.0
    ]
    circles = np.array(rows).reshape(-1, 5)
    chosen = on_a_line(circles, random)
    if chosen.sum() < 3:
        msg = (
            f"no tower was found: circles of {int(chosen.sum())} of {len(slabs)} slabs stand one "
            "above the other, expected 3; near= and radius= say where it is and how thick"
        )
        raise ParameterError(msg)
    circles = circles[chosen]
    smooth, line = smoothed(circles, search.unit)
    near = np.concatenate([slab for z, slab in slabs if (circles[:, 0] == z).any()])
    x, y, r = (np.interp(near[:, 2], smooth[:, 0], smooth[:, k]) for k in (1, 2, 3))
    off = off_shell(np.hypot(near[:, 0] - x, near[:, 1] - y) - r, r, LEAST_NEAR)
    return smooth, np.array([line[0], line[1], 1.0]), off


def off_shell(beyond: "Floats", radius: "Floats", least: float) -> float:
    """Median distance from a shell of what is near it; infinite if less than a share is."""
    near = np.abs(beyond) < BESIDE * radius
    if near.sum() < max(LEAST_IN_SLAB, least * near.size):
        return np.inf
    return float(np.median(np.abs(beyond[near])))


def on_a_line(circles: "Floats", random: np.random.Generator) -> "Bools":
    """Which circles (n, 5) of s, x, y, radius, score stand on the line that most stand on."""
    if len(circles) < 3:
        return np.zeros(len(circles), dtype=np.bool_)
    pairs = random.integers(0, len(circles), (LINE_TRIES, 2))
    one, two = circles[pairs[:, 0]], circles[pairs[:, 1]]
    rise = two[:, 0] - one[:, 0]
    ok = rise > 0.2 * np.ptp(circles[:, 0])
    one, two, rise = one[ok], two[ok], rise[ok]
    if not len(one):
        return np.zeros(len(circles), dtype=np.bool_)
    slope = (two[:, 1:4] - one[:, 1:4]) / rise[:, None]
    expected = one[:, None, 1:4] + slope[:, None] * (circles[:, 0] - one[:, :1])[..., None]
    off = np.abs(expected - circles[:, 1:4])
    size = np.maximum(expected[..., 2], 0.0)
    good = (np.hypot(off[..., 0], off[..., 1]) < 0.5 * size) & (off[..., 2] < 0.35 * size)
    best = int(np.argmax((good * circles[:, 4]).sum(axis=1)))
    return one_a_slab(circles, good[best])


def one_a_slab(circles: "Floats", good: "Bools") -> "Bools":
    """Of the good circles of each slab the one that most points lie on."""
    chosen = np.zeros(len(circles), dtype=np.bool_)
    for s in np.unique(circles[good, 0]):
        rows = np.flatnonzero(good & (circles[:, 0] == s))
        chosen[rows[np.argmax(circles[rows, 4])]] = True
    return chosen


def smoothed(circles: "Floats", unit: float) -> "tuple[Floats, Floats]":
    """Table (m, 4) of s, x, y, radius through circles, few of which are wrong; slopes of x, y."""
    s, values = circles[:, 0], circles[:, 1:4]
    weight = np.ones(s.size)
    height = max(float(np.ptp(s)), 1e-9)
    share = (s - s.min()) / height
    basis = basis_on(0.0, 1.0, 1.0 / max(1, min(10, s.size // 3)))
    design, penalty = basis.design(share), BEND_STIFFNESS * basis.penalty
    line = np.column_stack([np.ones(s.size), s])
    fit, straight = values, np.zeros((2, 3))
    for _ in range(10):
        normal = design.T @ (weight[:, None] * design) + penalty
        coefficients = np.linalg.solve(
            normal + 1e-12 * np.eye(basis.size), design.T @ (weight[:, None] * values)
        )
        fit = design @ coefficients
        straight = np.linalg.lstsq(
            np.sqrt(weight)[:, None] * line, np.sqrt(weight)[:, None] * values, rcond=None
        )[0]
        off = np.abs(values - fit).max(axis=1)
        spread = max(1.4826 * float(np.median(off)), 1e-9 * unit)
        weight = np.clip(1.0 - (off / (6.0 * spread)) ** 2, 0.0, 1.0) ** 2 + 1e-9
    at = np.linspace(0.0, 1.0, 101)
    table = np.column_stack([s.min() + at * height, basis.design(at) @ coefficients])
    return table, straight[1, :2]
