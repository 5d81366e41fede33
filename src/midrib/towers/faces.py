"""A rough axis of a tower with flat faces, and whether it has any.

n_j       outward normal of face j; all faces of a level are equally far from the axis
u_j       where the points of a slab crowd along n_j: the offset of the face, n_j c + apothem
misfit    mean distance of points from the faces, none counted as more than they may be near

Faces show in a slab as directions along which many points have the same offset, whatever part
of the tower is seen; so they are found before the centre is. Every number of faces is tried: every
other face of an octagon is a square's, on which half of the points lie, so what counts is all of
them.
"""

from typing import TYPE_CHECKING

import numpy as np

from midrib.errors import ParameterError
from midrib.towers.rough import Frame, Rough, Search, frame_along, off_shell, slabs_of

if TYPE_CHECKING:
    from midrib.types import Floats, Ints

__all__ = ["check_opposite", "rough_polygon"]

COUNTS = range(3, 13)  # of faces that are looked for
STEP = 0.5  # degrees between the directions that are tried
NEAR = 0.03  # metres: as far off a face as its points may be
LEAST_SHARE = 0.25  # of what a face seen in full would have
LEAST_FACES, LEAST_SLABS = 3, 0.3  # that tell an axis, each in as many of the slabs
OPPOSITE = 1.5  # apothems inwards: a crowd that is farther there is the opposite face's
LEAST_NEAR = 0.3  # of the points of slabs: as many are near the faces


def rough_polygon(sample: "Floats", search: Search) -> Rough | None:
    """Rough axis of a tower with faces; None if it has none."""
    frame = Frame(np.array([*np.median(sample[:, :2], axis=0), sample[:, 2].min()]), np.eye(3))
    found: list[tuple[float, Rough]] = []
    slabs = slabs_of(frame.inwards(sample), search.unit)
    sharpness, angles = crowding(slabs, search.unit)
    for count in COUNTS:
        for turn in best_turns(sharpness, angles, count):
            fit = fitted(frame, slabs, normals_of(count, turn), search.unit)
            found += [] if fit is None else [fit]
    return min(found, key=lambda fit: fit[0])[1] if found else None


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


def best_turns(sharpness: "Floats", angles: "Floats", count: int) -> list[float]:
    """Angles of the first normal for which the directions of ``count`` faces are most crowded.

    Directions do not tell a normal from its opposite, which is no normal of an odd polygon: two.
    """
    period = np.pi / count if count % 2 else 2.0 * np.pi / count
    turns = np.arange(0.0, period, np.radians(STEP))
    every = turns + period * np.arange(round(np.pi / period))[:, None]
    crowd = np.interp(every, angles, sharpness, period=np.pi).mean(axis=0)
    best = float(turns[np.argmax(crowd)])
    return [best, best + period] if count % 2 else [best]


def fitted(
    frame: Frame, slabs: "list[tuple[float, Floats]]", normals: "Floats", unit: float
) -> tuple[float, Rough] | None:
    """Misfit and rough axis with given normals, of the frame; None if too few faces are seen."""
    rows = [
        (z, j, offset)
        for z, points in slabs
        for j, offset in enumerate(crowds_of(points, normals, unit))
        if np.isfinite(offset)
    ]
    seen = np.array(rows).reshape(-1, 3)
    if len(seen) < 6:
        return None
    z, face, offset = seen[:, 0], seen[:, 1].astype(np.intp), seen[:, 2]
    middle, half = (z.max() + z.min()) / 2.0, max(float(np.ptp(z)) / 2.0, 1e-9)
    share = (z - middle) / half
    # x, y and apothem are straight in z: n_j (c + c' z) + h + h' z = u_j.
    n = normals[face]
    design = np.column_stack([n, np.ones(z.size), n * share[:, None], share])
    weight = nearest_three(design, offset, face, len(normals), NEAR * unit)
    line, off = np.zeros(6), offset
    for _ in range(20):
        root = np.sqrt(weight)
        line = np.linalg.lstsq(root[:, None] * design, root * offset, rcond=None)[0]
        off = np.abs(design @ line - offset)
        spread = max(1.4826 * float(np.median(off[weight > 0.1])), 1e-3 * unit)
        weight = np.clip(1.0 - (off / (5.0 * spread)) ** 2, 0.0, 1.0) ** 2 + 1e-9
    agree = np.bincount(face[off < NEAR * unit], minlength=len(normals))
    if (agree >= LEAST_SLABS * len(slabs)).sum() < LEAST_FACES:
        return None
    beyond = offset - design @ line
    for rows in (face == j for j in range(len(normals))):
        if stands_apart(share[rows], beyond[rows], line[2], len(slabs), unit):
            return None
    return standing(frame, slabs, normals, line, (middle, half), NEAR * unit)


def stands_apart(
    share: "Floats", beyond: "Floats", apothem: float, n_slabs: int, unit: float
) -> bool:
    """Whether a face is flat, but ``beyond`` (k,) where a regular polygon has it: a rectangle's.

    Crowds of others' points are one here, one there, or those of the face opposite.
    """
    from scipy.stats import theilslopes

    if beyond.size < max(2.0, LEAST_SLABS * n_slabs):
        return False
    slope, start, *_ = theilslopes(beyond, share)
    is_flat = float(np.median(np.abs(beyond - start - slope * share))) < NEAR * unit
    middle = float(np.median(beyond))
    return is_flat and abs(middle) > NEAR * unit and middle > -OPPOSITE * apothem


def nearest_three(
    design: "Floats", offset: "Floats", face: "Ints", count: int, near: float
) -> "Floats":
    """Weights (k,) of offsets to begin with: 1 where they agree with the best three faces.

    Faces that are not seen may have crowds of others' points, half of all offsets then.
    """
    best = np.ones(face.size)
    most = 0.0
    for first in range(count):
        rows = (face - first) % count < 3
        line = np.linalg.lstsq(design[rows], offset[rows], rcond=None)[0]
        agree = (np.abs(design @ line - offset) < near).astype(np.float64)
        if agree.sum() > most:
            best, most = agree + 1e-9, float(agree.sum())
    return best


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
    near: float,
) -> tuple[float, Rough] | None:
    """Turn a line of centres and apothems in z into a rough axis along it, with its misfit."""
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
    beyond = (way @ normals.T).max(axis=1) - radius
    misfit = float(np.minimum(np.abs(beyond), near).mean())
    foot = frame.outwards(np.array([[x[0], y[0], z[0]]]))[0]
    rise = np.array([x[1] - x[0], y[1] - y[0], z[1] - z[0]])
    along = frame_along(foot, rise)
    length = float(np.linalg.norm(rise))
    s = np.linspace(0.0, length, 101)
    h = apothem[0] + (apothem[1] - apothem[0]) * s / length
    off = off_shell(beyond, radius, LEAST_NEAR)
    if not off <= near:
        return None
    return misfit, Rough(along, np.column_stack([s, 0.0 * s, 0.0 * s, h]), normals, off)


def check_opposite(faces: "Floats") -> None:
    """Refuse towers whose faces have none opposite.

    Raises
    ------
    ParameterError
        If so.
    """
    if len(faces) % 2:
        msg = f"the tower has {len(faces)} faces, none opposite another: expected mode='joint'"
        raise ParameterError(msg)
