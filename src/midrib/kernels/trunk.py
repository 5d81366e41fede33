r"""The trunk of an area: the line on which both banks are equally far, from end to end.

It is the medial axis of the two banks without branches. Every radius PQ crosses it: at P the main
bank is nearer, at Q the auxiliary one. Between two of its points the straight way is probed; the
probe that is farthest off is moved onto the trunk and becomes a point of the line.

    auxiliary ---------------
               .  *  .         p, q   points of the trunk
          p-----+-----+-----q  +      probes on the straight way
                               *      the worst one, moved
    main ------\   /---------
                \_/
"""

import numpy as np

from midrib.kernels.banks import banks_of
from midrib.kernels.chain import Chain
from midrib.kernels.glide import ends_of
from midrib.kernels.islands import has_islands, loops_of, no_loops
from midrib.kernels.jit import njit
from midrib.kernels.joining import Joined, cut_all_loops, join_beads, string_beads
from midrib.kernels.landings import land, take_off
from midrib.kernels.mesh import Mesh
from midrib.kernels.paths import Beads
from midrib.kernels.probes import apart_of
from midrib.kernels.tracing import trace
from midrib.kernels.ways import Stops, is_of_main, level_beads, shores_outside, stops_on_way
from midrib.types import Floats, Ints

__all__ = ["SHARE_OF_SLACK", "trace_trunk"]

SHARE_OF_SLACK = 2.0**-24  # of the tolerance: what points of the trunk may be off it


@njit(entry=True)
def trace_trunk(
    mesh: Mesh,
    main: Chain,
    auxiliary: Chain,
    points: Floats,
    at: Ints,
    end: Floats,
    end_origin: Floats,
    end_at: Ints,
    is_trimmed: bool,
    every_bead: bool,
    tolerance: float,
    scale_x: float,
    scale_y: float,
) -> Joined:
    """Trunk of an area from the one end point to the other; loops are cut.

    Parameters
    ----------
    mesh : the area
    main, auxiliary : the two banks
    points, at : radii, as ``draw_radii`` returns them
    end, end_origin, end_at : end points, as in ``join_middles``
    is_trimmed : whether the ends may lie farther in than the ends of the two banks
    every_bead : whether all points of radii are wanted on the trunk, past islands too
    tolerance : how far (in lengths) a probe may be from the trunk; 0 for exact straight stretches
        with their kinks as vertices, and arcs to a 10,000th of the width
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    Joined
        Every piece has been walked with exact signs, so the line does not leave the area. Where
        the straight way between two radii is blocked it bends around the obstacle, by the trunk
        if that can be seen from the turn of the shortest way, else by the wall itself.
    """
    beads = string_beads(points, at, end, end_origin, end_at)
    first, n = end.shape[0] // 2, beads.side.size
    slack = SHARE_OF_SLACK * tolerance
    loops, kept = no_loops(), beads_in_order(points[:, 4], first, n)
    with_islands = has_islands(mesh, main, auxiliary)
    if with_islands:
        some = Beads(beads.point[kept], beads.origin[kept], beads.side[kept], beads.vertex[kept])
        path = join_beads(mesh, some, scale_x, scale_y).points
        loops = loops_of(mesh, main, auxiliary, path, scale_x, scale_y)
    banks = banks_of(mesh, main, auxiliary, loops, slack, scale_x, scale_y)
    apart = apart_of(banks, tolerance)
    near = np.zeros((beads.side.size, 2), np.intp)  # segments of both banks, nearest to each bead
    is_every = every_bead or not with_islands
    level_beads(banks, beads, near, points, at, first, is_every, scale_x, scale_y)
    ends = ends_of(banks, beads, near, end.shape[0] > 0, apart, scale_x, scale_y)
    stops = Stops(beads.point[kept], kept, near[kept])
    if with_islands:
        shore = shores_outside(mesh, main, auxiliary, scale_x, scale_y)
        is_main = is_of_main(shore, mesh, loops)
        stops = stops_on_way(mesh, main, banks, beads, near, is_main, is_trimmed, scale_x, scale_y)
    before = np.full((2, 2), np.nan)
    if loops.wall_is_main.size > 0:
        banks, point, stop_at, before = land(
            mesh, main, auxiliary, banks, loops, beads, stops.point, stops.at, scale_x, scale_y
        )
        stops = Stops(point, stop_at, np.zeros((stop_at.size, 2), np.intp))  # no windows here
        ends = ends_of(banks, beads, near, end.shape[0] > 0, apart, scale_x, scale_y)
    path, source = trace(mesh, banks, beads, stops, ends, tolerance, apart, scale_x, scale_y)
    path, source = take_off(path, source, beads, before)
    return cut_all_loops(mesh, beads, path, source, scale_x, scale_y)


@njit()
def beads_in_order(arc: Floats, first: int, n: int) -> Ints:
    """Return the end beads and those of the most radii whose Q never travel back.

    Radii that do not travel back do not cross, and so have the trunk's points in order; the others
    come from bays. The longest sequence that does not descend, by patience sorting.
    """
    k = arc.size
    length_at, before = np.empty(k + 1, np.intp), np.full(k, -1, np.intp)
    longest = 0  # length_at[m]: the last one of a sequence of m + 1 that ends lowest
    for i in range(k):
        low, high = 0, longest
        while low < high:
            middle = (low + high) // 2
            if arc[length_at[middle]] <= arc[i]:
                low = middle + 1
            else:
                high = middle
        if low > 0:
            before[i] = length_at[low - 1]
        length_at[low] = i
        longest = max(longest, low + 1)
    ends = n - k
    kept = np.empty(longest + ends, np.intp)
    row = length_at[longest - 1] if longest > 0 else -1
    for m in range(longest - 1, -1, -1):
        kept[first + m] = first + row
        row = before[row]
    if ends > 0:
        kept[0], kept[longest + 1] = 0, n - 1
    return kept
