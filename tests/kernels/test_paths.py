"""Joins between points: shortest, inside, exact."""

import heapq
from itertools import combinations

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, note, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely import LineString, Polygon

from midrib.kernels.paths import Beads, join_points
from midrib.layout import Boundary, boundary_of
from midrib.ragged import rings_of_area
from tests.shapes import NAMED, VALID
from tests.strategies import polyominoes, ribbons, tangled, with_holes

Floats = NDArray[np.float64]


def join_vertices(boundary: Boundary, vertices: list[int]) -> tuple[Floats, NDArray[np.intp]]:
    """Path through vertices of the shell, one after the other."""
    mesh = boundary.mesh
    v = np.array(vertices, dtype=np.intp)
    points = np.column_stack([mesh.x[v], mesh.y[v]])
    path, source = join_points(mesh, Beads(points, points, mesh.door[v], v), 1.0, 1.0)
    return np.asarray(path), np.asarray(source)


def length_of(path: Floats) -> float:
    """Length of a path; one of a single point has none."""
    return float(np.hypot(*np.diff(path, axis=0).T).sum())


def shortest_ways(area: Polygon, points: list[tuple[float, float]], start: int) -> list[float]:
    """Lengths of shortest paths along the visibility graph of the points (Dijkstra)."""
    sees: dict[int, list[tuple[int, float]]] = {i: [] for i in range(len(points))}
    for i, j in combinations(range(len(points)), 2):
        sight = LineString([points[i], points[j]])
        if area.covers(sight):
            sees[i].append((j, sight.length))
            sees[j].append((i, sight.length))
    ways = [np.inf] * len(points)
    ways[start] = 0.0
    queue = [(0.0, start)]
    while queue:
        way, i = heapq.heappop(queue)
        if way > ways[i]:
            continue
        for j, step in sees[i]:
            if way + step < ways[j]:
                ways[j] = way + step
                heapq.heappush(queue, (way + step, j))
    return ways


@given(area=st.one_of(tangled(), polyominoes(), ribbons()), k=st.integers(0, 99))
@settings(max_examples=200)
def test_paths_are_those_of_the_visibility_graph(area: Polygon, k: int) -> None:
    assume(not area.interiors)
    note(area.wkt)
    boundary = boundary_of(*rings_of_area(area))
    mesh, order = boundary.mesh, boundary.order
    assume(len(set(order.tolist())) == order.size)
    points = [(float(mesh.x[v]), float(mesh.y[v])) for v in order]
    start = k % order.size
    ways = shortest_ways(area, points, start)
    for j in range(order.size):
        if j == start:
            continue
        path, source = join_vertices(boundary, [int(order[start]), int(order[j])])
        assert tuple(path[0]) == points[start]
        assert tuple(path[-1]) == points[j]
        assert length_of(path) == pytest.approx(ways[j], rel=1e-9)
        assert area.covers(LineString(path))
        for row, v in zip(path, source, strict=True):
            assert v >= 0 or tuple(row) == (mesh.x[-1 - v], mesh.y[-1 - v])


@given(area=with_holes(), picks=st.lists(st.integers(0, 99), min_size=2, max_size=6))
@settings(max_examples=200)
def test_paths_around_holes_stay_inside(area: Polygon, picks: list[int]) -> None:
    note(area.wkt)
    boundary = boundary_of(*rings_of_area(area))
    vertices = [int(boundary.order[k % boundary.order.size]) for k in picks]
    path, source = join_vertices(boundary, vertices)
    assert (np.diff(path, axis=0) != 0.0).any(axis=1).all()
    assume(len(path) > 1)
    assert area.covers(LineString(path))
    stops = [int(s) for s in source if s >= 0]
    assert stops == sorted(stops)


@pytest.mark.parametrize("name", VALID)
def test_a_round_trip_visits_every_vertex(name: str) -> None:
    area = VALID[name]
    boundary = boundary_of(*rings_of_area(area))
    stops = [int(v) for v in boundary.order[::-1]]
    path, _ = join_vertices(boundary, stops)
    assert area.covers(LineString(path))
    line = shapely.multipoints(path)
    places = [(boundary.mesh.x[v], boundary.mesh.y[v]) for v in stops]
    assert all(shapely.Point(place).intersects(line) for place in places)


def test_a_path_around_a_corner_turns_in_it() -> None:
    boundary = boundary_of(*rings_of_area(NAMED["L"]))
    mesh = boundary.mesh
    place = {(float(x), float(y)): v for v, (x, y) in enumerate(zip(mesh.x, mesh.y, strict=True))}
    path, source = join_vertices(boundary, [place[10.0, 2.0], place[2.0, 10.0]])
    assert path.tolist() == [[10.0, 2.0], [2.0, 2.0], [2.0, 10.0]]
    assert source.tolist() == [0, -1 - place[2.0, 2.0], 1]


def test_a_point_outside_is_left_out() -> None:
    boundary = boundary_of(*rings_of_area(NAMED["square"]))
    mesh = boundary.mesh
    side, vertex = int(mesh.door[0]), 0
    points = np.array([[1.0, 1.0], [9.0, 9.0], [3.0, 3.0]])
    origin = np.repeat([[mesh.x[0], mesh.y[0]]], 3, axis=0)
    beads = Beads(points, origin, np.full(3, side), np.full(3, vertex))
    path, source = join_points(mesh, beads, 1.0, 1.0)
    assert path.tolist() == [[1.0, 1.0], [3.0, 3.0]]
    assert source.tolist() == [0, 2]
