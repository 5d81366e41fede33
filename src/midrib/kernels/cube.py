"""Counts of a cloud's points by level, sector and distance from a reference shell.

s, q      foot of a point on the reference axis, and the way from it to the point, in a frame whose
          third axis is nearly the reference axis
c(s)      reference axis, h(s) reference radius (or apothem): a table of knots with straight lines
d         distance of the point beyond the reference shell: |q| - h, or that to the outermost of
          the faces' planes, max over j of n_j q, less h
level, sector, bin    of s, of the azimuth of q, of d

                     bins of d
             c(s)    | | | |
        -----+-------|-|*|-|---   level
             '--- q ----'
"""

import numpy as np

from midrib.kernels.jit import njit
from midrib.types import Floats, Singles

__all__ = ["MOMENTS", "count_points"]

MOMENTS = 3  # sums for each cell: of what azimuths are beyond the sector's start, of s, of ones
FULL_TURN = 2.0 * np.pi


@njit(entry=True)
def count_points(
    points: Floats,
    origin: Floats,
    turn: Floats,
    table: Floats,
    faces: Floats,
    grid: Floats,
    counts: Singles,
    sums: Singles,
    moments: Floats,
) -> int:
    """Add a chunk of points to the cube.

    Parameters
    ----------
    points : (n, 3) coordinates
    origin, turn : (3,) and (3, 3), the frame: q = turn (p - origin)
    table : (m, 5) x, y, radius of the reference shell and the slopes of x and y, at even steps of s
    faces : (k, 2) outward normals of the faces; none of a round shell
    grid : (6,) s of the table's first row and its step; s of the first level and its step; the
        least d that counts and the width of a bin
    counts, sums : (levels, sectors, bins) float32, added to: ones, and d less the bin's middle
    moments : (levels, sectors, 3) added to, see ``MOMENTS``

    Returns
    -------
    int
        How many of the points were counted.

    Notes
    -----
    O(1) a point. The foot is exact for straight axes, and off by the square of the slope, times
    the distance of the point, times the bend, for others.
    """
    s_table, step, s_level, height, d_low, width = grid
    m, (n_levels, n_sectors, n_bins) = table.shape[0], counts.shape
    sector = FULL_TURN / n_sectors
    total = 0
    for i in range(points.shape[0]):
        dx, dy, dz = points[i, 0] - origin[0], points[i, 1] - origin[1], points[i, 2] - origin[2]
        x = turn[0, 0] * dx + turn[0, 1] * dy + turn[0, 2] * dz
        y = turn[1, 0] * dx + turn[1, 1] * dy + turn[1, 2] * dz
        z = turn[2, 0] * dx + turn[2, 1] * dy + turn[2, 2] * dz
        # 1. The foot: two steps, each from the tangent at the one before.
        s, qx, qy, qz, apothem = z, 0.0, 0.0, 0.0, 0.0
        for _ in range(3):
            at = min(max((s - s_table) / step, 0.0), m - 1.000001)
            k = int(at)
            u = at - k
            cx = table[k, 0] + u * (table[k + 1, 0] - table[k, 0])
            cy = table[k, 1] + u * (table[k + 1, 1] - table[k, 1])
            apothem = table[k, 2] + u * (table[k + 1, 2] - table[k, 2])
            tx = table[k, 3] + u * (table[k + 1, 3] - table[k, 3])
            ty = table[k, 4] + u * (table[k + 1, 4] - table[k, 4])
            qx, qy, qz = x - cx, y - cy, z - s
            s += (tx * qx + ty * qy + qz) / (1.0 + tx * tx + ty * ty)
        level = int(np.floor((s - s_level) / height))
        if not 0 <= level < n_levels:
            continue
        # 2. How far beyond the shell.
        if faces.shape[0] == 0:
            d = np.sqrt(qx * qx + qy * qy + qz * qz) - apothem
        else:
            d = -np.inf
            for j in range(faces.shape[0]):
                d = max(d, faces[j, 0] * qx + faces[j, 1] * qy)
            d -= apothem
        bin_ = int(np.floor((d - d_low) / width))
        if not 0 <= bin_ < n_bins:
            continue
        # 3. The cell.
        azimuth = np.arctan2(qy, qx)
        if azimuth < 0.0:
            azimuth += FULL_TURN
        j = min(int(azimuth / sector), n_sectors - 1)
        counts[level, j, bin_] += 1.0
        sums[level, j, bin_] += d - (d_low + (bin_ + 0.5) * width)
        moments[level, j, 0] += azimuth - j * sector
        moments[level, j, 1] += s
        moments[level, j, 2] += 1.0
        total += 1
    return total
