"""A rough axis of a tower with flat faces, and whether it has any.

n_j       outward normal of face j; all faces of a level are equally far from the axis
u_j       where the points of a slab crowd along n_j: the offset of the face, n_j c + apothem

Faces show in a slab as directions along which many points have the same offset, whatever part
of the tower is seen; so they are found before the centre is.
"""

from typing import TYPE_CHECKING

import numpy as np

from midrib.towers.rough import Frame, Rough, Search, frame_along, off_shell, slabs_of

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["rough_polygon"]

COUNTS = (3, 4, 5, 6, 8, 10, 12)  # of faces that are looked for
STEP = 0.5  # degrees between the directions that are tried
NEAR = 0.03  # metres: as far off a face as its points may be
LEAST_SHARE = 0.25  # of what a face seen in full would have
AT_RANDOM = 2.0  # crowds of a face over those of a direction at random
LEAST_NEAR = 0.3  # of the points of slabs: as many are near the faces


def rough_polygon(sample: "Floats", search: Search) -> Rough | None:
    """Rough axis of a tower with faces; None if it has none."""
    frame = Frame(np.array([*np.median(sample[:, :2], axis=0), sample[:, 2].min()]), np.eye(3))
    best: Rough | None = None
    slabs = slabs_of(frame.inwards(sample), search.unit)
    sharpness, angles = crowding(slabs, search.unit)
    for count in COUNTS:
        turn = best_turn(sharpness, angles, count)
        if turn is None:
            continue
        found = fitted(frame, slabs, normals_of(count, turn), search.unit)
        if found is not None and (best is None or found.off < 0.8 * best.off):
            best = found
    return best


def normals_of(count: int, turn: float) -> "Floats":
    """Outward normals (count, 2) of a regular polygon, the first one at an angle."""
    angle = turn + 2.0 * np.pi * np.arange(count) / count
    return np.column_stack([np.cos(angle), np.sin(angle)])


def crowding(slabs: "list[tuple[float, Floats]]", unit: float) -> "tuple[Floats, Floats]":
    """Most points with one offset along each direction, as a share; and the directions' angles."""
    angles = np.radians(np.arange(0.0, 180.0, STEP))
    normals = np.column_stack([np.cos(angles), np.sin(angles)])
    total = np.zeros(angles.size)
    for _, points in slabs:
        xy = points[:, :2]
        low, high = np.percentile(xy, [3, 97], axis=0)
        inside = xy[((xy >= low - (high - low)) & (xy <= high + (high - low))).all(axis=1)]
        reach = 1.5 * np.linalg.norm(high - low)
        width = max(2.0 * NEAR * unit, 2.0 * reach / 400)
        offsets = (inside - (low + high) / 2.0) @ normals.T
        bins = np.clip((offsets + reach) / width, 0, None).astype(np.intp)
        n_bins = int(bins.max(initial=0)) + 1
        flat = bins + n_bins * np.arange(angles.size)
        crowd = np.bincount(flat.ravel(), minlength=n_bins * angles.size).reshape(-1, n_bins)
        total += crowd.max(axis=1) / max(len(inside), 1)
    return total / max(len(slabs), 1), angles


def best_turn(sharpness: "Floats", angles: "Floats", count: int) -> float | None:
    """Angle of the first normal for which the directions of ``count`` faces are most crowded."""
    period = np.pi / count if count % 2 else 2.0 * np.pi / count
    cells = max(1, round(period / np.radians(STEP)))
    phase = np.round((angles % period) / np.radians(STEP)).astype(np.intp) % cells
    counts = np.maximum(np.bincount(phase, minlength=cells), 1)
    folded = np.bincount(phase, weights=sharpness, minlength=cells) / counts
    best = int(np.argmax(folded))
    if folded[best] < AT_RANDOM * np.median(sharpness):
        return None
    return float(best * np.radians(STEP))


def fitted(
    frame: Frame, slabs: "list[tuple[float, Floats]]", normals: "Floats", unit: float
) -> Rough | None:
    """Rough axis with given normals, of the frame; None if too few faces are seen."""
    rows = [
        (z, j, offset)
        for z, points in slabs
        for j, offset in enumerate(crowds_of(points, normals, unit))
        if np.isfinite(offset)
    ]
    seen = np.array(rows).reshape(-1, 3)
    usual = np.bincount(seen[:, 1].astype(np.intp), minlength=len(normals)) >= 0.3 * len(slabs)
    if not len(seen) or usual.sum() < 3:
        return None
    z, face, offset = seen[:, 0], seen[:, 1].astype(np.intp), seen[:, 2]
    middle, half = (z.max() + z.min()) / 2.0, max(float(np.ptp(z)) / 2.0, 1e-9)
    share = (z - middle) / half
    # x, y and apothem are straight in z: n_j (c + c' z) + h + h' z = u_j.
    n = normals[face]
    design = np.column_stack([n, np.ones(z.size), n * share[:, None], share])
    weight = np.ones(z.size)
    line = np.zeros(6)
    for _ in range(20):
        root = np.sqrt(weight)
        line = np.linalg.lstsq(root[:, None] * design, root * offset, rcond=None)[0]
        off = np.abs(design @ line - offset)
        spread = max(1.4826 * float(np.median(off)), 1e-3 * unit)
        weight = np.clip(1.0 - (off / (5.0 * spread)) ** 2, 0.0, 1.0) ** 2 + 1e-9
    return standing(frame, slabs, normals, line, (middle, half))


def crowds_of(points: "Floats", normals: "Floats", unit: float) -> "Floats":
    """Offsets (k,) at which the points of a slab crowd along each normal, NaN without a crowd."""
    xy = points[:, :2]
    centre = np.median(xy, axis=0)
    offsets = np.full(len(normals), np.nan)
    least = LEAST_SHARE * len(xy) / len(normals)
    # A tower seen from one side has its median near that side; a tenth of the way beyond it
    # still tells the outer face from the inner one.
    for j, n in enumerate(normals):
        along = (xy - centre) @ n
        outer = np.sort(along[along > -0.1 * np.ptp(np.percentile(along, [3, 97]))])
        if outer.size < least:
            continue
        last = np.searchsorted(outer, outer + 2.0 * NEAR * unit, side="right")
        crowd = last - np.arange(outer.size)
        best = int(np.argmax(crowd))
        if crowd[best] >= least:
            offsets[j] = np.median(outer[best : last[best]]) + centre @ n
    return offsets


def standing(
    frame: Frame,
    slabs: "list[tuple[float, Floats]]",
    normals: "Floats",
    line: "Floats",
    span: tuple[float, float],
) -> Rough | None:
    """Turn a line of centres and apothems in z into a rough axis along it."""
    middle, half = span
    z = np.array([middle - half, middle + half])
    share = np.array([-1.0, 1.0])
    x, y, apothem = (line[k] + line[k + 3] * share for k in range(3))
    if not (apothem > 0.0).all():
        return None
    points = np.concatenate([points for _, points in slabs])
    at = (points[:, 2] - middle) / half
    way = points[:, :2] - (line[:2] + at[:, None] * line[3:5])
    radius = np.abs(line[2] + at * line[5])
    off = off_shell((way @ normals.T).max(axis=1) - radius, radius, LEAST_NEAR)
    foot = frame.outwards(np.array([[x[0], y[0], z[0]]]))[0]
    rise = np.array([x[1] - x[0], y[1] - y[0], z[1] - z[0]])
    along = frame_along(foot, rise)
    length = float(np.linalg.norm(rise))
    s = np.linspace(0.0, length, 101)
    h = apothem[0] + (apothem[1] - apothem[0]) * s / length
    return Rough(along, np.column_stack([s, 0.0 * s, 0.0 * s, h]), normals, off)
