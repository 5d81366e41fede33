"""A ring slit open is a disc: its boundary is one loop that passes every vertex once."""

import numpy as np
import pytest
from shapely import Polygon, box

from midrib.hatching.middle import seams, side_of_hole
from midrib.kernels.slit import around, slit_open
from midrib.layout import boundary_of
from midrib.ragged import rings_of_area

RINGS = {
    "squares": Polygon(box(0, 0, 9, 9).exterior, [box(3, 3, 6, 6).exterior.coords]),
    "off centre": Polygon(box(0, 0, 30, 9).exterior, [box(1, 2, 3, 4).exterior.coords]),
    "triangles": Polygon([(0, 0), (20, 1), (9, 17)], [[(8, 4), (9, 8), (12, 5)]]),
}


@pytest.mark.parametrize("name", RINGS)
@pytest.mark.parametrize("which", [0, 1])
def test_slit_rings_have_one_boundary(name: str, which: int) -> None:
    boundary = boundary_of(*rings_of_area(RINGS[name]))
    mesh = boundary.mesh
    sides = side_of_hole(boundary), int(boundary.side[0])
    top, toe = (
        around(mesh, side, int(mesh.tri[side]), int(mesh.tri[side]), back)
        for side, back in zip(sides, (False, True), strict=True)
    )
    seam = seams(mesh, top, toe)[which]
    slit = slit_open(mesh, seam)
    points = [np.column_stack([m.x, m.y])[m.tri] for m in (mesh, slit)]
    assert (points[0] == points[1]).all()
    open_sides = np.flatnonzero(slit.twin < 0)
    following = {}
    for e in open_sides:
        after = e - 2 if e % 3 == 2 else e + 1
        following[int(slit.tri[e])] = int(slit.tri[after])
    assert len(following) == len(open_sides) == mesh.x.size + 2  # no vertex is left twice
    v, count = int(slit.tri[seam]), 0
    while count <= len(following):
        v, count = following[v], count + 1
        if v == int(slit.tri[seam]):
            break
    assert count == len(following)


@pytest.mark.parametrize("is_backward", [False, True])
def test_chains_around_rings_start_where_they_should(is_backward: bool) -> None:
    boundary = boundary_of(*rings_of_area(RINGS["squares"]))
    mesh = boundary.mesh
    for start in boundary.order.tolist():
        chain = around(mesh, int(boundary.side[0]), start, 99, is_backward)
        assert chain.vertex[0] == start
        assert chain.vertex[-1] == 99
        assert sorted(chain.vertex[:-1]) == sorted(boundary.order)
        assert chain.arc[-1] == 36.0
        ends = mesh.tri[chain.side + np.where(chain.side % 3 == 2, -2, 1)]
        first = ends if is_backward else mesh.tri[chain.side]
        assert (first == chain.vertex[:-1]).all()
