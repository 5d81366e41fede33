"""Straight skeletons of combs and spirals: long and narrow, with reflex vertices all along."""

import numpy as np
import pytest
import shapely
from shapely import LineString, MultiLineString, Polygon, affinity, box

from midrib.curves.straight_skeleton import StraightSkeleton
from midrib.types import Ints
from tests.curves.test_straight_skeleton import check_roof, lines_in

ROOT = np.sqrt(2.0)


def comb(teeth: int, lean: float = 0.0) -> Polygon:
    """A back with teeth 1 wide and 2 apart, each longer than the last."""
    boxes = [box(3 * k, 0, 3 * k + 1, 4 + k) for k in range(teeth)]
    whole = shapely.union_all([box(0, -1, 3 * teeth - 2, 0), *boxes])
    return affinity.skew(whole, lean, 0, origin=(0, 0))


def square_spiral(turns: int) -> LineString:
    """Legs that grow by 3 every other time."""
    steps = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    legs = [np.multiply(steps[k % 4], 3 * (1 + k // 2)) for k in range(turns)]
    return LineString(np.cumsum([(0, 0), *legs], axis=0))


def round_spiral(vertices: int) -> Polygon:
    """A band whose edges have no two directions in common."""
    turn = np.linspace(2.0, 20.0, vertices)
    inner, outer = turn, turn + 1.5 + 0.3 * np.sin(3.0 * turn)
    ring = [
        np.column_stack([r * np.cos(turn), r * np.sin(turn)])[::way]
        for r, way in ((inner, 1), (outer, -1))
    ]
    return Polygon(np.concatenate(ring))


def connected(ridges: Ints, n: int) -> int:
    """How many nodes the first ridge is connected with."""
    known = np.zeros(n, dtype=bool)
    known[ridges[0]] = True
    while True:
        reached = ridges[known[ridges].any(axis=1)]
        if known[reached].all():
            return int(known.sum())
        known[reached] = True


def check_tree(area: Polygon, *, is_generic: bool) -> StraightSkeleton:
    """Ridges are one tree with a leaf for each vertex; each face has its own edge."""
    found = check_roof(area)
    n = len(found.faces)
    nodes = np.unique(found.ridges)
    assert len(found.ridges) == len(nodes) - 1
    assert connected(found.ridges, len(found.points)) == len(nodes)
    degree = np.bincount(found.ridges.ravel(), minlength=len(found.points))
    inner = nodes[found.time[nodes] > 0.0]
    assert n == shapely.get_num_coordinates(area) - 1
    assert len(inner) == n - 2 if is_generic else len(inner) <= n - 2
    assert (degree[inner] == 3).all() if is_generic else (degree[inner] >= 2).all()
    edges = MultiLineString([found.points[[walk[0], walk[-1]]] for walk in found.faces])
    assert edges.length == pytest.approx(area.length)
    assert edges.hausdorff_distance(area.boundary) < 1e-9
    return found


@pytest.mark.parametrize("teeth", [2, 5, 40])
@pytest.mark.parametrize("lean", [0.0, 20.0])
def test_combs_have_a_ridge_in_every_tooth(teeth: int, lean: float) -> None:
    area = comb(teeth, lean)
    found = check_tree(area, is_generic=False)
    half = 0.5 * np.cos(np.radians(lean))
    middles = [LineString([(3 * k + 0.5, 1), (3 * k + 0.5, 3 + k)]) for k in range(teeth)]
    ridges = lines_in(found).buffer(1e-9)
    for middle in shapely.get_parts(affinity.skew(MultiLineString(middles), lean, 0, (0, 0))):
        assert ridges.covers(middle)
        time = shapely.distance(middle, area.boundary)
        assert time == pytest.approx(half)


@pytest.mark.parametrize("turns", [1, 2, 7, 30])
@pytest.mark.parametrize("degrees", [0, 30, 33.7])
def test_square_spirals_in_closed_form(turns: int, degrees: float) -> None:
    middle = affinity.rotate(square_spiral(turns), degrees, origin=(0, 0))
    area = middle.buffer(0.5, cap_style="flat", join_style="mitre")
    found = check_tree(area, is_generic=False)
    assert found.time.max() == pytest.approx(0.5)
    length = middle.length - 1.0 + (2 * (turns - 1) + 4) * ROOT / 2.0
    assert lines_in(found).length == pytest.approx(length)
    inside = shapely.line_interpolate_point(middle, np.linspace(0.5, middle.length - 0.5, 101))
    assert shapely.distance(inside, lines_in(found)).max() < 1e-9


@pytest.mark.parametrize("vertices", [20, 101, 700])
def test_round_spirals_are_trees_of_three_ways(vertices: int) -> None:
    check_tree(round_spiral(vertices), is_generic=True)
