"""The whole of ``collapse`` with its default options in one call: rings in, a line out.

It is made of the kernels that other options call one by one; in one call, two dozen arrays need not
go back and forth, which takes as long as all the geometry of an area of 100 vertices.
"""

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.layout import lay_out_rings
from midrib.kernels.radii import draw_radii
from midrib.kernels.rings import LARGEST, SMALLEST, count_rings, normalise_rings, sizes
from midrib.kernels.stations import default_count, even_stations, place_stations
from midrib.kernels.trunk import trace_trunk
from midrib.types import Floats, Ints

__all__ = ["collapse_rings"]


@njit()
def collapse_rings(
    coordinates: Floats,
    offsets: Ints,
    is_known: bool,
    share: float,
    scale_x: float,
    scale_y: float,
) -> tuple[bool, Floats, int]:
    """Trunk of an area between the ends that its shape proposes.

    Parameters
    ----------
    coordinates, offsets : the rings, as ``normalise_rings`` takes them
    is_known : whether the area is known to be valid
    share : tolerance, as a share of the mean width
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    is_done, points, loops
        Not done where something is unusual: the single steps know what to do or to say. Nor where
        an area that is not known to be valid may not be.
    """
    nothing = np.empty((0, 2))
    largest, extent = sizes(coordinates)
    if not (largest <= LARGEST and extent >= SMALLEST):
        return False, nothing, 0
    rings = normalise_rings(coordinates, offsets)
    if not is_known and count_rings(rings) < offsets.size - 1:
        return False, nothing, 0
    divided = lay_out_rings(rings, np.empty(0), is_known, scale_x, scale_y)
    if not divided.is_divided:
        return False, nothing, 0
    mesh, main, auxiliary = divided.mesh, divided.main, divided.auxiliary
    n_vertices = main.arc.size + auxiliary.arc.size
    own = even_stations(main.arc[-1], default_count(main.arc[-1], divided.mean_width, n_vertices))
    _, points, segment, vertex = place_stations(
        own, False, 0.0, main.arc, main.vertex, mesh.x, mesh.y
    )
    side = np.empty(segment.size, np.intp)
    for i in range(segment.size):
        side[i] = main.side[segment[i]]
    low, high = np.full(own.size, -np.inf), np.full(own.size, np.inf)
    drawn = draw_radii(
        mesh, main, auxiliary, points, side, vertex, low, high, 0.0, scale_x, scale_y
    )
    if drawn.points.shape[0] == 0:
        return False, nothing, 0
    middle, tolerance = divided.middle[:, :2].copy(), share * divided.mean_width
    line = trace_trunk(
        mesh, main, auxiliary, drawn.points, drawn.at, middle, middle, divided.middle_at,
        False, False, tolerance, scale_x, scale_y,
    )  # fmt: skip
    return line.points.shape[0] > 1, line.points, line.loops
