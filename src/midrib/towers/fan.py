"""The fan: many planes through the axis, a curve of minimal radii from either wall of each.

c_0(s)    the reference axis
u_k       direction of plane k
wall      chain of points (u, s): how far the sectors at u_k and opposite are from c_0
m_k(s)    the mean of plane k's two curves at a height: how far the axis is from c_0 along u_k
c(s)      the centre: u_k · (c - c_0) = m_k in the sense of robust least squares

The distances are those of cells, so a wall's curvature across the sector is taken out already.
Walls about a straight axis end alike: near the ends, where the nearest point of a tapered wall is
the other's end, the errors of the two ways cancel. About a leaning one they would not.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
from shapely import LineString

from midrib.curves.minimal_radii import minimal_radii
from midrib.errors import InvalidAreaError
from midrib.strip import Strip
from midrib.towers.faces import check_opposite
from midrib.towers.levels import Centres
from midrib.towers.weights import tukey

if TYPE_CHECKING:
    from midrib.towers.joint import Fit
    from midrib.towers.pipeline import Options, Shell
    from midrib.types import Floats

__all__ = ["fan", "mean_curve"]

LEAST_PLANES = 3
LEAST_LEVELS = 4  # of a wall
RUN = 3  # levels of which neighbours err together, more or less


def fan(shell: "Shell", options: "Options") -> "tuple[Centres, dict[str, Any]]":
    """Centres of levels by a fan of planes."""
    cells, grid = shell.cells, shell.cells.grid
    depth = depths_of(shell)
    s = grid.middles
    directions, means = [], []
    half = grid.n_sectors // 2
    faces = cells.reference.faces
    check_opposite(faces)
    count = half if len(faces) else min(options.planes, half)  # sectors of one face, or of an arc
    for group in np.array_split(np.arange(half), count):
        angle = (group + 0.5) * 2.0 * np.pi / grid.n_sectors
        toward = np.column_stack([np.cos(angle), np.sin(angle)]).mean(axis=0)
        if len(faces):
            toward = faces[np.argmax(faces @ toward)]
        found = plane_of(s, depth[:, group].mean(axis=1), depth[:, group + half].mean(axis=1))
        if found is not None:
            directions.append(toward)
            means.append(found)
    steps = {"directions": np.array(directions), "heights": s, "means": np.array(means)}
    u = steps["directions"].reshape(-1, 2)
    beside = centres_of(s, u, steps["means"], options.unit)
    centres = beside._replace(xy=beside.xy + cells.reference.at(s)[:, :2])
    sigma = np.sqrt(centres.sigma**2 + shared_variance(centres, shell.fit))
    return centres._replace(sigma=sigma), steps


def depths_of(shell: "Shell") -> "Floats":
    """Distance (levels, sectors) of the wall from the reference axis in each sector.

    NaN where there is no cell. Of a polygon's face, the distance is measured along its normal. The
    cell's own mean height is near its level's middle; the reference shell carries the distance.
    """
    cells = shell.cells
    depth = np.full((cells.grid.n_levels, cells.grid.n_sectors), np.nan)
    used = shell.fit.weight > 0.0
    level, sector = cells.level[used], cells.sector[used]
    depth[level, sector] = cells.reference.at(cells.grid.middles[level])[:, 2] + cells.d[used]
    return depth


def plane_of(s: "Floats", near: "Floats", far: "Floats") -> "Floats | None":
    """Mean of the curves of minimal radii from either wall at heights s; None if a wall is bare."""
    rows = np.isfinite(near) & np.isfinite(far)
    if rows.sum() < LEAST_LEVELS:
        return None
    # Walls that do not end at one height would give slanted caps, and ends off the middle.
    low, high = s[rows][[0, -1]]
    inside = (s >= low) & (s <= high)
    right = np.column_stack([near, s])[inside & np.isfinite(near)]
    left = np.column_stack([-far, s])[inside & np.isfinite(far)]
    mean = mean_curve(left, right)
    if mean is None:
        return None
    at = np.interp(s, mean[:, 1], mean[:, 0], left=np.nan, right=np.nan)
    return np.where(rows, at, np.nan)


def mean_curve(left: "Floats", right: "Floats") -> "Floats | None":
    """Same-height mean (n, 2) of the curves of minimal radii from either wall; None if none is."""
    try:
        strip = Strip(LineString(left), LineString(right))
        curve = minimal_radii(
            strip, ends="caps", end_clearance=None, centring="symmetric", mean=(0.0, 1.0)
        )
    except InvalidAreaError:
        return None
    line = np.array(curve.line.coords)[:, :2]
    return line[np.argsort(line[:, 1], kind="stable")]


def centres_of(s: "Floats", directions: "Floats", means: "Floats", unit: float) -> Centres:
    """Centre of each level from the planes that cross it."""
    xy, sigma = np.full((s.size, 2), np.nan), np.full((s.size, 2), np.nan)
    why = np.full(s.size, "", dtype="U96")
    for i in range(s.size):
        rows = np.flatnonzero(np.isfinite(means[:, i])) if len(means) else np.zeros(0, np.intp)
        if rows.size < LEAST_PLANES:
            why[i] = f"{rows.size} planes, expected {LEAST_PLANES}"
            continue
        design, known = directions[rows], means[rows, i]
        weight, every = np.ones(rows.size), np.ones(rows.size, dtype=np.bool_)
        for _ in range(8):
            normal = (design * weight[:, None]).T @ design
            answer = np.linalg.solve(normal + 1e-12 * np.eye(2), design.T @ (weight * known))
            residual = known - design @ answer
            weight = np.maximum(tukey(residual, every, unit), 1e-6)
        free = max(float(weight.sum()) - 2.0, 1.0)
        noise = float((weight * residual**2).sum()) / free
        xy[i] = answer
        sigma[i] = np.sqrt(noise * np.diag(np.linalg.inv(normal + 1e-12 * np.eye(2))))
    return Centres(s, xy, calm(sigma), why)


def shared_variance(centres: Centres, fit: "Fit") -> float:
    """Variance of a coordinate of a centre by what the planes of a level err by together.

    Planes through one patch of a wall are no witnesses of their own, and what all of a level err by
    is no residual of it. But the level is that far off the joint axis, which averages over many
    patches; what patches do to that axis comes on top. The median level tells both, so that a few
    where the axis leaps do not count; of squared distances in a plane it is 2 log 2 variances.
    """
    rows = np.isfinite(centres.xy).all(axis=1)
    if not rows.any():
        return 0.0
    s = centres.s[rows]
    off = ((centres.xy[rows] - fit.values(s)[:, :2]) ** 2).sum(axis=1)
    axis = np.trace(fit.covariances(s), axis1=1, axis2=2) / 2.0
    alone = (centres.sigma[rows] ** 2).mean(axis=1)
    whole = np.median(off) / (2.0 * np.log(2.0)) + np.median(axis)
    return max(0.0, float(whole - np.median(alone)))


def calm(sigma: "Floats") -> "Floats":
    """Average each standard deviation with its neighbours: few planes tell little alone."""
    square = sigma**2
    out = sigma.copy()
    for i in range(len(sigma)):
        near = square[max(0, i - RUN) : i + RUN + 1]
        known = near[np.isfinite(near[:, 0])]
        if len(known) and np.isfinite(sigma[i, 0]):
            out[i] = np.sqrt(known.mean(axis=0))
    return out
