"""Branches of graphs and shortest ways through them."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from midrib.curves.graphs import Graph, pruned
from midrib.kernels.graph import branches_of, shortest_way
from midrib.strip import PLANE


def branches(n: int, edges: list[tuple[int, int]]) -> list[list[int]]:
    """Return vertices of each branch."""
    rows, offsets = branches_of(n, np.array(edges, dtype=np.intp).reshape(-1, 2))
    return [part.tolist() for part in np.split(rows, offsets[1:-1])] if rows.size else []


@pytest.mark.parametrize(
    ("edges", "expected"),
    [
        ([(0, 1), (1, 2)], [[0, 1, 2]]),
        ([(0, 1), (1, 2), (1, 3)], [[0, 1], [1, 2], [1, 3]]),
        ([(0, 1), (1, 2), (2, 0)], [[0, 1, 2, 0]]),
        ([(0, 1), (1, 2), (2, 0), (2, 3)], [[2, 1, 0, 2], [2, 3]]),
        ([(0, 1), (1, 2), (2, 0), (3, 4), (4, 5)], [[3, 4, 5], [0, 1, 2, 0]]),
        ([], []),
    ],
)
def test_branches_lead_from_tip_or_junction_to_the_next(
    edges: list[tuple[int, int]], expected: list[list[int]]
) -> None:
    assert branches(6, edges) == expected


@st.composite
def graphs(draw: st.DrawFn) -> tuple[int, list[tuple[int, int]]]:
    """Draw a graph without repeated edges."""
    n = draw(st.integers(2, 9))
    pairs = [(i, j) for i in range(n) for j in range(i + 1, n)]
    return n, draw(st.lists(st.sampled_from(pairs), unique=True, min_size=1, max_size=20))


@given(graphs())
def test_every_edge_is_in_one_branch(graph: tuple[int, list[tuple[int, int]]]) -> None:
    n, edges = graph
    degree = np.bincount(np.ravel(edges), minlength=n)
    found = branches(n, edges)
    steps = [(min(a, b), max(a, b)) for rows in found for a, b in itertools.pairwise(rows)]
    assert sorted(steps) == sorted(edges)
    for rows in found:
        assert all(degree[v] == 2 for v in rows[1:-1])
        assert rows[0] == rows[-1] or (degree[[rows[0], rows[-1]]] != 2).all()


@given(graphs(), st.data())
def test_no_way_is_shorter(graph: tuple[int, list[tuple[int, int]]], data: st.DataObject) -> None:
    n, edges = graph
    coordinates = st.tuples(st.integers(0, 20), st.integers(0, 20))
    places = data.draw(st.lists(coordinates, min_size=n, max_size=n))
    points = np.array(places, dtype=np.float64)
    scale = 1.0, 2.0
    apart = np.full((n, n), np.inf)
    np.fill_diagonal(apart, 0.0)
    for a, b in edges:
        apart[a, b] = apart[b, a] = np.hypot(*((points[a] - points[b]) * scale))
    for k in range(n):  # Floyd and Warshall
        apart = np.minimum(apart, apart[:, [k]] + apart[[k]])
    way = shortest_way(points, np.array(edges, dtype=np.intp), 0, n - 1, *scale)
    if np.isinf(apart[0, n - 1]):
        assert way.size == 0
        return
    assert (way[0], way[-1]) == (0, n - 1)
    known = {frozenset(edge) for edge in edges}
    assert all(frozenset(step) in known for step in itertools.pairwise(way))
    length = np.hypot(*(np.diff(points[way], axis=0) * scale).T).sum()
    assert length == pytest.approx(apart[0, n - 1])


def test_lengths_of_units_count() -> None:
    points = np.array([(0.0, 0.0), (3.0, 1.0), (0.0, 2.0), (0.0, 4.0)])
    edges = np.array([(0, 1), (1, 3), (0, 2), (2, 3)])
    assert shortest_way(points, edges, 0, 3, 1.0, 1.0).tolist() == [0, 2, 3]
    assert shortest_way(points, edges, 0, 3, 0.1, 1.0).tolist() == [0, 2, 3]
    bent = np.array([(0.0, 0.0), (3.0, 1.0), (4.0, 3.0), (0.0, 4.0)])
    assert shortest_way(bent, edges, 0, 3, 1.0, 0.1).tolist() == [0, 1, 3]
    long = np.array([(0.0, 0.0), (1.0, 6.0), (7.0, 0.0), (2.0, 0.0)])
    assert shortest_way(long, edges, 0, 3, 1.0, 1.0).tolist() == [0, 2, 3]
    assert shortest_way(long, edges, 0, 3, 1.0, 0.1).tolist() == [0, 1, 3]


def test_what_a_branch_explains_is_its_disc_beyond_that_of_the_junction() -> None:
    points = np.array([(0.0, 0.0), (9.0, 0.0), (-9.0, 0.0), (0.0, 0.9)])
    edges = np.array([(0, 1), (0, 2), (0, 3)])
    radius = np.array([1.0, 1.0, 1.0, 0.8])
    graph = Graph(points, edges, radius)
    assert len(pruned(graph, PLANE, 0.0, 1.5).edges) == 3
    assert len(pruned(graph, PLANE, 0.0, 1.75).edges) == 2
    assert len(pruned(graph, PLANE, 0.89, 0.0).edges) == 3
    assert len(pruned(graph, PLANE, 0.91, 0.0).edges) == 2
    assert len(pruned(graph, (1.0, 2.0), 0.91, 0.0).edges) == 3
