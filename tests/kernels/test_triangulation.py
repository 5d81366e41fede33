"""The mesh of an area: covers it exactly, with every ring segment a side."""

from collections import Counter
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Polygon, affinity, box

from midrib.kernels.gathering import gather_inside
from midrib.kernels.insertion import BLOCK, coarse_to_fine, insert_all
from midrib.kernels.jit import njit
from midrib.kernels.mesh import Mesh, next_boundary_side
from midrib.kernels.stars import FACE
from midrib.kernels.triangulation import force_rings, within_triangle
from midrib.layout import Boundary, boundary_of
from midrib.ragged import rings_of_area
from midrib.types import Ints
from tests.kernels.calling import callable_from_python
from tests.shapes import VALID, annulus_sector, stadium
from tests.strategies import areas, with_holes

Exact = tuple[Fraction, Fraction]


def mesh_of(area: Polygon) -> tuple[Boundary, Mesh]:
    """Triangulate an area."""
    boundary = boundary_of(*rings_of_area(area))
    return boundary, boundary.mesh


def exact_vertices(mesh: Mesh) -> list[Exact]:
    """Vertices as fractions."""
    return [(Fraction(x), Fraction(y)) for x, y in zip(mesh.x, mesh.y, strict=True)]


def doubled(a: Exact, b: Exact, c: Exact) -> Fraction:
    """Twice the signed area of a triangle."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def exact_area(area: Polygon) -> Fraction:
    """Twice the area between shell and holes."""
    total = Fraction(0)
    for i, ring in enumerate((area.exterior, *area.interiors)):
        points = [(Fraction(x), Fraction(y)) for x, y, *_ in ring.coords]
        size = abs(sum((a[0] * b[1] - b[0] * a[1] for a, b in pairwise(points)), Fraction(0)))
        total += size if i == 0 else -size
    return total


def check_mesh(area: Polygon) -> None:
    """Everything that a mesh promises."""
    boundary, mesh = mesh_of(area)
    vertices = exact_vertices(mesh)
    triangles = mesh.tri.reshape(-1, 3)
    sizes = [doubled(*(vertices[v] for v in t)) for t in triangles]
    assert min(sizes) > 0
    assert sum(sizes) == exact_area(area)
    check_twins(mesh)
    check_sides(area, boundary)


def check_twins(mesh: Mesh) -> None:
    """Twins are each other's, and run the other way."""
    after = np.arange(mesh.tri.size).reshape(-1, 3)[:, [1, 2, 0]].ravel()
    inner = np.flatnonzero(mesh.twin >= 0)
    twin = mesh.twin[inner]
    assert (mesh.twin[twin] == inner).all()
    assert (mesh.tri[twin] == mesh.tri[after[inner]]).all()
    assert (mesh.tri[after[twin]] == mesh.tri[inner]).all()
    doors = [e for e in range(mesh.tri.size) if mesh.twin[e] < 0]
    found = []
    for v in range(mesh.x.size):
        door = mesh.door[v]
        while door >= 0:
            assert mesh.tri[door] == v
            found.append(int(door))
            door = mesh.other_door[door]
    assert sorted(found) == doors


def check_sides(area: Polygon, boundary: Boundary) -> None:
    """Boundary sides lie on the rings and cover them, each once, the area on their left."""
    mesh = boundary.mesh
    after = np.arange(mesh.tri.size).reshape(-1, 3)[:, [1, 2, 0]].ravel()
    outer = np.flatnonzero(mesh.twin < 0)
    ends = np.stack([mesh.tri[outer], mesh.tri[after[outer]]], axis=1)
    sides = [LineString([(mesh.x[a], mesh.y[a]), (mesh.x[b], mesh.y[b])]) for a, b in ends.tolist()]
    assert max(Counter(frozenset(pair) for pair in ends.tolist()).values()) == 1
    assert all(area.boundary.covers(side) for side in sides)
    assert sum(side.length for side in sides) == pytest.approx(area.length, rel=1e-12)
    assert np.array_equal(mesh.tri[boundary.side], boundary.order)
    assert (mesh.twin[boundary.side] < 0).all()
    assert np.array_equal(mesh.tri[after[boundary.side]], np.roll(boundary.order, -1))
    ring = shapely.get_coordinates(shapely.linearrings(
        np.column_stack([mesh.x[boundary.order], mesh.y[boundary.order]])
    ))  # fmt: skip
    assert shapely.is_ccw(shapely.linearrings(ring))
    assert Polygon(ring).equals(Polygon(area.exterior))


@pytest.mark.parametrize("name", VALID)
def test_named_areas_are_covered_exactly(name: str) -> None:
    check_mesh(VALID[name])


@given(area=areas)
@settings(max_examples=300)
def test_areas_are_covered_exactly(area: Polygon) -> None:
    check_mesh(area)


@given(area=with_holes())
@settings(max_examples=200)
def test_areas_with_holes_are_covered_exactly(area: Polygon) -> None:
    check_mesh(area)


@given(area=areas)
@settings(max_examples=200)
def test_triangles_are_as_many_as_euler_says(area: Polygon) -> None:
    """Of n vertices and h holes that touch nothing: n + 2 h - 2."""
    boundary, mesh = mesh_of(area)
    rings = [area.exterior, *area.interiors]
    corners = [xy for ring in rings for xy in ring.coords[:-1]]
    if len(set(corners)) < mesh.x.size or any(
        a.intersects(b) for i, a in enumerate(rings) for b in rings[:i]
    ):
        return
    assert mesh.tri.size // 3 == len(corners) + 2 * len(area.interiors) - 2
    assert boundary.has_holes == bool(area.interiors)


def not_delaunay(mesh: Mesh) -> tuple[int, int]:
    """Inner edges with the vertex across inside the circle by more than rounding, and all."""
    after = np.arange(mesh.tri.size).reshape(-1, 3)[:, [1, 2, 0]].ravel()
    inner = np.flatnonzero(mesh.twin >= 0)
    bad = 0
    xy = np.column_stack([mesh.x, mesh.y])
    for e in inner:
        a, b, c = xy[mesh.tri[e]], xy[mesh.tri[after[e]]], xy[mesh.tri[after[after[e]]]]
        d = xy[mesh.tri[after[after[mesh.twin[e]]]]]
        rows = np.array([a, b, c]) - d
        squares = (rows**2).sum(axis=1)
        det = np.linalg.det(np.column_stack([rows, squares]))
        bad += det > 1e-9 * squares.max() ** 2
    return bad, inner.size


@given(area=areas)
@settings(max_examples=150)
def test_triangles_are_delaunay_between_constraints(area: Polygon) -> None:
    bad, _ = not_delaunay(mesh_of(area)[1])
    assert bad == 0


@pytest.mark.parametrize("n", [4, 64, 1000])
def test_vertices_on_one_circle(n: int) -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False)
    check_mesh(Polygon(np.column_stack([np.cos(angle), np.sin(angle)])))


@pytest.mark.parametrize("height", [1e-3, 1e-6, 1e-9, 1e-12])
def test_a_sliver_with_collinear_vertices(height: float) -> None:
    check_mesh(Polygon([*((float(x), 0.0) for x in range(300)), (-3.0, height)]))


@pytest.mark.parametrize("corner", [(5000.0, 7.0), (-3.0, 100.0), (1e6, 1e6)])
def test_ten_thousand_collinear_vertices(corner: tuple[float, float]) -> None:
    base = [(float(x), 0.0) for x in range(10_000)]
    check_mesh(Polygon([*base, corner]))


def test_ten_thousand_collinear_vertices_on_a_slant() -> None:
    """The vertices are on the line up to rounding only: a boundary of tiny turns."""
    x = np.linspace(0.0, 1.0, 10_000)
    area = Polygon(np.concatenate([np.column_stack([x, 0.3 * x]), [[0.0, 1.0]]]))
    assert area.is_valid
    _, mesh = mesh_of(area)
    assert mesh.tri.size // 3 == area.exterior.coords.__len__() - 3


@pytest.mark.parametrize("n", [3, 12])
def test_a_sheet_of_square_holes(n: int) -> None:
    """Cocircular everywhere: every four corners lie on a circle."""
    cells = [box(3 * i + 1, 3 * j + 1, 3 * i + 2, 3 * j + 2) for i in range(n) for j in range(n)]
    check_mesh(Polygon(box(0, 0, 3 * n, 3 * n).exterior, [cell.exterior for cell in cells]))


@pytest.mark.parametrize("power", [-200, -60, 60, 200])
@pytest.mark.parametrize("name", ["comb", "three_islands", "hook", "necklace"])
def test_powers_of_two_give_the_same_triangles(name: str, power: int) -> None:
    area = VALID[name]
    factor = 2.0**power
    larger = shapely.transform(area, lambda xy: xy * factor)
    _, mesh = mesh_of(area)
    _, other = mesh_of(larger)
    assert np.array_equal(mesh.tri, other.tri)
    assert np.array_equal(mesh.twin, other.twin)
    assert np.array_equal(mesh.x * factor, other.x)


@pytest.mark.parametrize("area", [annulus_sector(900.0, 901.0, 3.0, 3000), stadium(1e3, 1.0)])
def test_long_bent_areas_are_covered_exactly(area: Polygon) -> None:
    check_mesh(area)


@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=30)
def test_rough_rivers_are_covered_exactly(seed: int) -> None:
    rng = np.random.default_rng(seed)
    x = np.cumsum(rng.uniform(0.0, 1.0, 150))
    low, high = np.cumsum(rng.normal(0.0, 0.3, 150)), rng.uniform(0.01, 2.0, 150)
    area = Polygon(
        np.concatenate([np.column_stack([x, low]), np.column_stack([x, low + high])[::-1]])
    )
    check_mesh(area)


@pytest.mark.parametrize("turn", [0.1, 0.3, 0.7, 1.9])
def test_straight_banks_get_no_fans_of_slivers(turn: float) -> None:
    """Their vertices lie on one line up to rounding, where the circle test cannot tell."""
    area = shapely.segmentize(box(0, 0, 400, 40), 0.1)
    _, mesh = mesh_of(affinity.rotate(area, turn, origin=(0, 0), use_radians=True))
    assert np.bincount(mesh.tri).max() <= 16


@pytest.mark.parametrize("n", [1, 2, 3, 5, 8, 33, 100, BLOCK + 1, 4 * BLOCK, 5 * BLOCK + 7])
def test_vertices_go_in_coarse_to_fine(n: int) -> None:
    order, stride = callable_from_python(coarse_to_fine)(n)
    assert sorted(order) == list(range(n))
    when = np.empty(n, int)
    when[order] = np.arange(n)
    for p in range(1, n):
        step = min(p & -p, stride)
        assert when[p - step] < when[p]
        if step < stride and p + step < n:
            assert when[p + step] < when[p]


@callable_from_python
@njit()
def in_both_ways(x: Any, y: Any, ring_next: Any, by_rings: Any) -> Any:
    """What is inside, gathered at once, and found by forcing segments in."""
    n = x.size
    same, touches = np.full(n, -1), np.full(n, -1)
    xy = within_triangle(x, y)
    face, out = np.empty(FACE * (2 * n + 2), np.int32), np.empty(n + 3, np.uint32)
    count, _ = insert_all(n, xy, ring_next, False, face, out, same)
    inside = gather_inside(count, ring_next, same, xy, False, face, by_rings)
    return inside, force_rings(count, x, y, xy, ring_next, same, touches, face, out, by_rings)


@callable_from_python
@njit()
def between_constraints(x: Any, y: Any, ring_next: Any) -> Any:
    """Whether there are constraints while vertices go in, and what is inside."""
    n = x.size
    same, xy = np.full(n, -1), within_triangle(x, y)
    face, out = np.empty(FACE * (2 * n + 2), np.int32), np.empty(n + 3, np.uint32)
    count, is_constrained = insert_all(n, xy, ring_next, True, face, out, same)
    inside = gather_inside(max(count, 0), ring_next, same, xy, True, face, True)
    return is_constrained and count >= 0, inside


def check_both_ways(area: Polygon) -> bool:
    """Whether all segments were edges; then both ways agree, to the order of triangles."""
    rings, _ = rings_of_area(area)
    for by_rings in (True, False):
        inside, forced = in_both_ways(rings.x, rings.y, rings.ring_next, by_rings)
        if inside.is_done:
            assert forced[0] == 0
            assert forced[-1]
            for one, other in zip(inside[1:], forced[1:4], strict=True):
                assert np.array_equal(one, other)
    return bool(inside.is_done)


def check_constraints(area: Polygon) -> bool:
    """Whether constraints were of use; then the triangles are those that are found without."""
    rings, _ = rings_of_area(area)
    is_constrained, inside = between_constraints(rings.x, rings.y, rings.ring_next)
    if not (is_constrained and inside.is_done):
        return False
    usual, forced = in_both_ways(rings.x, rings.y, rings.ring_next, True)
    tri = usual.tri if usual.is_done else forced[1]
    assert triangles_of(inside.tri) == triangles_of(tri)
    return True


def triangles_of(tri: Ints) -> set[frozenset[int]]:
    """Triangles, whatever their order and that of their corners."""
    return {frozenset(corners) for corners in tri.reshape(-1, 3).tolist()}


@pytest.mark.parametrize("name", VALID)
def test_named_areas_are_gathered_as_they_are_forced(name: str) -> None:
    check_both_ways(VALID[name])


@given(area=st.one_of(areas, with_holes()))
@settings(max_examples=200)
def test_areas_are_gathered_as_they_are_forced(area: Polygon) -> None:
    check_both_ways(area)


@pytest.mark.parametrize("name", VALID)
def test_constraints_leave_named_areas_as_they_are(name: str) -> None:
    check_constraints(VALID[name])
    check_constraints(VALID[name].segmentize(VALID[name].length / 300))


@given(area=st.one_of(areas, with_holes()), count=st.integers(70, 300))
@settings(max_examples=200)
def test_constraints_leave_areas_as_they_are(area: Polygon, count: int) -> None:
    check_constraints(area.segmentize(area.length / count))


@given(seed=st.integers(0, 2**32 - 1), roughness=st.floats(0.0, 0.3))
@settings(max_examples=60)
def test_constraints_leave_bent_areas_as_they_are(seed: int, roughness: float) -> None:
    """Smooth banks have constraints all along, rough ones vertices far from any."""
    rng = np.random.default_rng(seed)
    turn = np.linspace(0.0, 2.0 * np.pi, 400, endpoint=False)
    wobble = 1.0 + 0.3 * np.sin(3.0 * turn) + roughness * rng.normal(0.0, 0.1, 400)
    ring = Polygon(np.column_stack([20.0 * wobble * np.cos(turn), 9.0 * wobble * np.sin(turn)]))
    assert check_constraints(ring) or roughness > 0.0
    hole = Polygon(np.column_stack([2.0 * np.cos(turn), 2.0 * np.sin(turn)])[::4])
    assert check_constraints(ring.difference(hole)) or roughness > 0.0


def test_densely_drawn_areas_are_gathered() -> None:
    """With holes too: the short way is taken where it can be."""
    shell, hole = box(0, 0, 90, 30), box(40, 10, 50, 20)
    assert check_both_ways(shell.difference(hole).segmentize(2.0))


@pytest.mark.parametrize(
    "area",
    [
        Polygon([(0, 0), (9, 0), (9, 3), (0, 3)], [[(20, 1), (20, 2), (21, 2), (21, 1)]]),
        Polygon([(0, 0), (9, 3), (9, 0), (0, 3)]),
        Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(0, 0), (3, 4), (4, 3)]]),
        Polygon(
            [(0, 0), (9, 0), (9, 9), (0, 9)],
            [[(1, 1), (8, 1), (8, 8), (1, 8)], [(3, 3), (6, 3), (6, 6), (3, 6)]],
        ),
    ],
    ids=["hole outside", "crossing", "touching", "hole in a hole"],
)
def test_rings_that_may_not_be_valid_are_not_gathered(area: Polygon) -> None:
    assert not check_both_ways(area)


onward = callable_from_python(next_boundary_side)


@pytest.mark.parametrize("name", VALID)
def test_the_next_boundary_side_ends_the_fan(name: str) -> None:
    """Of rings that touch too, where several fans meet in a vertex."""
    _, mesh = mesh_of(VALID[name])
    for e in np.flatnonzero(mesh.twin < 0):
        f = following(int(e))
        while mesh.twin[f] >= 0:
            f = following(int(mesh.twin[f]))
        assert onward(mesh, e) == f


def following(e: int) -> int:
    """Next half-edge of a triangle."""
    return e - 2 if e % 3 == 2 else e + 1
