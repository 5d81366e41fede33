"""Nearest points in space: what looking at every segment finds."""

import numpy as np
import pytest
from hypothesis import given, note
from hypothesis import strategies as st

from midrib.kernels.spacetree import nearest_in_space
from midrib.types import Floats

coordinates = st.integers(min_value=-4, max_value=4).map(float)
points = st.lists(st.tuples(coordinates, coordinates, coordinates), min_size=1, max_size=40)


def arcs(chain: Floats) -> Floats:
    """Arc lengths of vertices."""
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(chain, axis=0), axis=1))])


def nearest_by_looking_at_all(p: Floats, chain: Floats) -> tuple[float, Floats]:
    """Distance, and the points of all segments that are as near."""
    a, step = chain[:-1], np.diff(chain, axis=0)
    share = np.clip(((p - a) * step).sum(axis=1) / (step * step).sum(axis=1), 0.0, 1.0)
    q = a + share[:, None] * step
    distance = np.linalg.norm(q - p, axis=1)
    return float(distance.min()), q[distance <= distance.min() + 1e-9]


@given(drawn=points, seen_from=points)
def test_all_nearest_points_are_found_and_no_others(
    drawn: list[tuple[float, float, float]], seen_from: list[tuple[float, float, float]]
) -> None:
    note(f"{drawn} from {seen_from}")
    chain = np.array(drawn)
    chain = chain[np.append(True, (chain[1:] != chain[:-1]).any(axis=1))]
    if len(chain) < 2:
        chain = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]])
    p, arc = np.array(seen_from), arcs(chain)
    found, index = nearest_in_space(p, chain, arc)
    assert np.unique(index).tolist() == list(range(len(p)))
    for i, point in enumerate(p):
        distance, expected = nearest_by_looking_at_all(point, chain)
        rows = found[index == i]
        assert rows[:, 4] == pytest.approx(distance, abs=1e-9)
        assert np.linalg.norm(rows[:, :3] - point, axis=1) == pytest.approx(rows[:, 4], abs=1e-9)
        assert (np.diff(rows[:, 3]) > 0.0).all()
        gaps = np.linalg.norm(rows[:, None, :3] - expected[None], axis=2)
        assert gaps.min(axis=0).max() < 1e-9
        assert gaps.min(axis=1).max() < 1e-9
        for row in rows:
            at = [np.interp(row[3], arc, column) for column in chain.T]
            assert at == pytest.approx(row[:3], abs=1e-9)


def test_long_chains_are_searched_by_their_tree() -> None:
    turn = np.linspace(0.0, 60.0, 4001)
    helix = np.column_stack([np.cos(turn), np.sin(turn), turn / 5.0])
    p = helix[::97] * [1.5, 1.5, 1.0] + [0.0, 0.0, 0.1]
    found, index = nearest_in_space(p, helix, arcs(helix))
    assert index.tolist() == list(range(len(p)))
    expected = [nearest_by_looking_at_all(point, helix)[0] for point in p]
    assert found[:, 4] == pytest.approx(expected, rel=1e-12)


def test_the_centre_of_a_ring_ties_with_all_of_it() -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 9)
    ring = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(9)])
    found, _ = nearest_in_space(np.array([[0.0, 0.0, 2.0]]), ring, arcs(ring))
    assert len(found) == 8
    assert found[:, 3] == pytest.approx(arcs(ring)[:-1] + arcs(ring)[1] / 2.0)
