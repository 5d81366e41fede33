"""The paper's way: two planes through the axis, walls thinned to curves, curves of minimal radii.

X, Y              planes through the axis along x and y; of a tower with faces across two of them
main, auxiliary   walls of a section: the first where the direction comes from, the other ahead
from_main         curve of minimal radii with the first wall as main curve; from_auxiliary the other
mean_curve        their mean in equal shares of length; same_height at equal heights

Where walls taper by an angle, a curve from one wall is off the axis by r times the squared sine of
it, towards that wall.
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from shapely import LineString

from midrib.curves.minimal_radii import minimal_radii
from midrib.errors import InvalidAreaError
from midrib.strip import Strip
from midrib.towers.faces import check_opposite
from midrib.towers.levels import Centres
from midrib.towers.thinning import thinned_wall

if TYPE_CHECKING:
    from collections.abc import Iterable

    from midrib.towers.cells import Reference
    from midrib.towers.pipeline import Options, Shell, Track
    from midrib.types import Bools, Floats

__all__ = ["PlaneSteps", "paper", "steps_of_walls"]

HALF_SLAB, MOST_HALF_SLAB = 0.01, 0.15  # metres
INTERVAL, RADIUS = 0.25, 0.01  # metres: of stations, of Average Depth
WANTED = 12  # points of a wall in an interval: where there are fewer, slabs are thicker
REACH = 0.10  # metres: as far off the shell as points of a wall may be
UPWARDS = (0.0, 1.0)
SMOOTH = 2.5  # metres: what a mean scatters about its mean so far around tells its uncertainty


class PlaneSteps(NamedTuple):
    """Everything that was made in one plane; chains of u, along the plane's direction, and s."""

    direction: "Floats"
    points: "Floats"
    main: "Floats"
    auxiliary: "Floats"
    from_main: "Floats"
    from_auxiliary: "Floats"
    mean_curve: "Floats"
    same_height: "Floats"
    told: tuple[float, float]  # heights between which both ways meet a wall and not its end


def paper(shell: "Shell", options: "Options", track: "Track") -> "tuple[Centres, dict[str, Any]]":
    """Centres of levels from two planes, and the steps: ``"planes"``, a list of two."""
    unit = options.unit
    check_opposite(shell.cells.reference.faces)
    directions = directions_of(shell.cells.reference.faces)
    half = half_slab(shell, unit)
    walls = collected(track(shell.cloud.chunks(), "sections"), shell, directions, half, unit)
    planes = []
    for direction, points in zip(directions, walls, strict=True):
        main = thinned_wall(
            points[points[:, 0] < 0.0], options.thinning, INTERVAL * unit, RADIUS * unit
        )
        other = thinned_wall(
            points[points[:, 0] > 0.0], options.thinning, INTERVAL * unit, RADIUS * unit
        )
        found = steps_of_walls(main, other, INTERVAL * unit, direction, points)
        if found is not None:
            planes.append(found)
    s = shell.cells.grid.middles
    if len(planes) < 2:
        nothing = np.full((s.size, 2), np.nan)
        why = np.full(s.size, "a wall of a section is not seen", dtype="U96")
        return Centres(s, nothing, nothing, why), {"planes": planes}
    return centres_of(planes, s, unit), {"planes": planes, "half_slab": half}


def directions_of(faces: "Floats") -> "Floats":
    """Directions of the two planes: along x and y, or across two faces that are no opposites."""
    if not len(faces):
        return np.eye(2)
    along = np.abs(faces @ faces[0])
    return faces[[0, int(np.argmin(along))]]


def half_slab(shell: "Shell", unit: float) -> float:
    """Half the thickness of the slabs: the paper's, or what sparse clouds need."""
    cells = shell.cells
    radius = float(np.median(cells.reference.table[:, 2]))
    area = 2.0 * np.pi * radius / cells.grid.n_sectors * cells.grid.level
    density = float(np.median(cells.n)) / area
    needed = WANTED / density / (INTERVAL * unit) / 2.0
    return float(min(max(HALF_SLAB * unit, needed), MOST_HALF_SLAB * unit, 0.2 * radius))


def collected(
    chunks: "Iterable[Floats]", shell: "Shell", directions: "Floats", half: float, unit: float
) -> "list[Floats]":
    """Points (n, 2), u and s, of the walls in each plane's slab, moved into the plane.

    A point beside the plane moves along the fitted shell's section, so that a thick slab does not
    make a round wall thinner.
    """
    reference = shell.cells.reference
    kept: list[list[Floats]] = [[] for _ in directions]
    for chunk in chunks:
        inner = reference.frame.inwards(chunk)
        for found, direction in zip(kept, directions, strict=True):
            across = inner[:, 1] * direction[0] - inner[:, 0] * direction[1]
            rows = np.abs(across) <= half
            u = inner[rows, :2] @ direction
            found.append(moved(u, across[rows], inner[rows, 2], direction, reference, unit))
    return [np.concatenate([np.zeros((0, 2)), *found]) for found in kept]


def moved(
    u: "Floats",
    across: "Floats",
    s: "Floats",
    direction: "Floats",
    reference: "Reference",
    unit: float,
) -> "Floats":
    """Points u, s of the walls that are near the shell, in the plane itself."""
    rows = reference.at(s)
    a = rows[:, :2] @ direction
    b = rows[:, 1] * direction[0] - rows[:, 0] * direction[1]
    side = np.sign(u - a)
    if len(reference.faces):
        here = plane = a + side * rows[:, 2]
    else:
        here = a + side * np.sqrt(np.maximum(rows[:, 2] ** 2 - (across - b) ** 2, 0.0))
        plane = a + side * np.sqrt(np.maximum(rows[:, 2] ** 2 - b**2, 0.0))
    near = np.abs(u - here) <= np.minimum(REACH * unit, rows[:, 2] / 2.0)
    return np.column_stack([u - here + plane, s])[near]


def steps_of_walls(
    main: "Floats", auxiliary: "Floats", interval: float, direction: "Floats", points: "Floats"
) -> PlaneSteps | None:
    """Curves of minimal radii both ways and their two means; None if the walls bound no area."""
    low = max(main[0, 1], auxiliary[0, 1]) if len(main) and len(auxiliary) else np.inf
    high = min(main[-1, 1], auxiliary[-1, 1]) if np.isfinite(low) else -np.inf
    if high - low < 4.0 * interval:
        return None
    # Walls that do not begin at one height would give slanted caps, and ends off the middle.
    main, auxiliary = cut(main, low, high), cut(auxiliary, low, high)
    usual: dict[str, Any] = {"spacing": interval, "ends": "caps", "end_clearance": None}
    try:
        strip = Strip(LineString(main), LineString(auxiliary))
        swapped = Strip(LineString(auxiliary), LineString(main))
        curves = [
            minimal_radii(strip, **usual),
            minimal_radii(swapped, **usual),
            minimal_radii(strip, centring="symmetric", mean="proportional", **usual),
            minimal_radii(strip, centring="symmetric", mean=UPWARDS, **usual),
        ]
    except InvalidAreaError:
        return None
    lines = [np.array(curve.line.coords)[:, :2] for curve in curves]
    met = [curve.points[is_inside(curve.on_auxiliary[:, 1], low, high), 1] for curve in curves[:2]]
    if not all(heights.size for heights in met):
        return None
    told = float(max(h.min() for h in met)), float(min(h.max() for h in met))
    one, other, mean, level = lines
    return PlaneSteps(direction, points, main, auxiliary, one, other, mean, level, told)


def is_inside(v: "Floats", low: float, high: float) -> "Bools":
    """Which heights are between two, and not an end's but for rounding."""
    margin = 1e-9 * (high - low)
    inside: Bools = (v > low + margin) & (v < high - margin)
    return inside


def cut(chain: "Floats", low: float, high: float) -> "Floats":
    """Part of a rising chain between two heights, ends interpolated."""
    inner = chain[(chain[:, 1] > low) & (chain[:, 1] < high)]
    ends = [(np.interp(v, chain[:, 1], chain[:, 0]), v) for v in (low, high)]
    return np.concatenate([[ends[0]], inner, [ends[1]]])


def centres_of(planes: list[PlaneSteps], s: "Floats", unit: float) -> Centres:
    """Centres at heights from the same-height means of two planes."""
    known, scatter = [], []
    for plane in planes:
        order = np.argsort(plane.same_height[:, 1], kind="stable")
        line = plane.same_height[order]
        mean = np.interp(s, line[:, 1], line[:, 0])
        mean[(s < plane.told[0]) | (s > plane.told[1])] = np.nan
        for wall in (plane.main, plane.auxiliary):
            mean[far_from_vertex(s, wall[:, 1], 2.0 * INTERVAL * unit)] = np.nan
        known.append(mean)
        scatter.append(scatter_of(s, mean, SMOOTH * unit))
    matrix = np.array([plane.direction for plane in planes])
    inverse = np.linalg.inv(matrix)
    xy = (inverse @ np.array(known)).T
    sigma = np.sqrt((inverse**2 @ np.array(scatter) ** 2).T)
    why = np.where(np.isnan(xy).any(axis=1), "a wall of a section is not seen", "").astype("U96")
    return Centres(s, xy, sigma, why)


def far_from_vertex(s: "Floats", v: "Floats", most: float) -> "Any":
    """Which heights have no vertex of a wall near."""
    at = np.clip(np.searchsorted(v, s), 1, len(v) - 1)
    return np.minimum(np.abs(s - v[at]), np.abs(s - v[at - 1])) > most


def scatter_of(s: "Floats", mean: "Floats", reach: float) -> "Floats":
    """How much a mean scatters about the straight line through it near each height."""
    off = np.full(s.size, np.nan)
    known = np.isfinite(mean)
    for i in np.flatnonzero(known):
        near = known & (np.abs(s - s[i]) <= reach)
        if near.sum() > 3:
            line = np.polynomial.Polynomial.fit(s[near] - s[i], mean[near], 1)
            off[i] = np.sqrt(np.sum((mean[near] - line(s[near] - s[i])) ** 2) / (near.sum() - 2))
    return np.where(known & np.isnan(off), np.nanmax(off, initial=0.0), off)
