"""Top and toe together are the boundary, whatever tells where the top is."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString, Polygon, box

from midrib.hatching.edges import edges_along, edges_between, mean_width
from midrib.hatching.slope import SlopeError
from midrib.types import Floats

CORNERS = [(0.0, 0.0), (9.0, 0.0), (10.0, 2.0), (6.0, 3.0), (0.0, 2.0)]
AREA = Polygon(CORNERS)
MOUND = Polygon(box(0, 0, 9, 9).exterior, [box(3, 3, 6, 5).exterior])
AREAS = {
    "counter-clockwise": AREA,
    "clockwise": Polygon(CORNERS[::-1]),
    "with a hole": Polygon(CORNERS, [box(4, 1, 5, 2).exterior]),
    "with heights": Polygon([(x, y, x + y + 1.0) for x, y in CORNERS]),
    "with a repeat": Polygon([*CORNERS[:3], CORNERS[2], *CORNERS[3:]]),
    "far from the origin": shapely.affinity.translate(AREA, 5e5, 5e6),
}


def at(area: Polygon, k: int) -> Floats:
    """Vertex k of the shell."""
    corner: Floats = shapely.get_coordinates(area.exterior)[k]
    return corner


@pytest.mark.parametrize("area", AREAS.values(), ids=AREAS)
@given(first=st.integers(0, 4), steps=st.integers(1, 4))
def test_top_and_toe_are_the_ring_in_its_order(area: Polygon, first: int, steps: int) -> None:
    corners = np.unique(shapely.get_coordinates(area.exterior), axis=0, return_index=True)[1]
    ring = shapely.get_coordinates(area.exterior, include_z=area.has_z)[np.sort(corners)]
    last = (first + steps) % 5
    top, toe, doubts = edges_between(area, ring[first], ring[last])
    assert not doubts
    run = [k % 5 for k in range(first, first + steps + 1)]
    assert shapely.get_coordinates(top, include_z=area.has_z).tolist() == ring[run].tolist()
    back = [k % 5 for k in range(first, first + steps - 6, -1)]
    assert shapely.get_coordinates(toe, include_z=area.has_z).tolist() == ring[back].tolist()


@pytest.mark.parametrize("area", AREAS.values(), ids=AREAS)
@given(first=st.integers(0, 4), steps=st.integers(1, 4))
def test_a_line_along_the_boundary_gives_itself(area: Polygon, first: int, steps: int) -> None:
    ring = np.array([at(area, k) for k in range(len(area.exterior.coords) - 1)])
    ring = ring[np.sort(np.unique(ring, axis=0, return_index=True)[1])]
    run = [k % 5 for k in range(first, first + steps + 1)]
    for way in (run, run[::-1]):
        top, toe, doubts = edges_along(area, LineString(ring[way]))
        assert shapely.get_coordinates(top).tolist() == ring[way].tolist()
        assert top.length + toe.length == pytest.approx(area.exterior.length)
        assert not doubts


@given(share=st.floats(0.1, 0.9))
def test_a_start_between_two_vertices_is_kept_and_doubted(share: float) -> None:
    start = np.array([9.0 * share, 0.0])
    top, toe, (doubt,) = edges_between(AREA, start, at(AREA, 2))
    assert top.coords[0] == pytest.approx(tuple(start))
    assert top.coords[1:] == [(9.0, 0.0), (10.0, 2.0)]
    assert doubt.kind == "orientation"
    assert (top.coords[0], top.coords[-1]) == (toe.coords[0], toe.coords[-1])
    assert top.length + toe.length == pytest.approx(AREA.length)


def test_two_places_of_one_segment_run_on_or_all_round() -> None:
    a, b = np.array([3.0, 0.0]), np.array([5.0, 0.0])
    onwards, back = edges_between(AREA, a, b), edges_between(AREA, b, a)
    assert onwards.top.wkt == "LINESTRING (3 0, 5 0)"
    assert back.top.length == pytest.approx(AREA.length - 2.0)
    assert back.toe.equals(onwards.top)


def test_a_start_on_the_boundary_stays_there_and_one_beside_it_goes_to_the_vertex() -> None:
    top, _, (doubt,) = edges_between(AREA, np.array([0.1, 0.0]), at(AREA, 2))
    assert top.coords[0] == (0.1, 0.0)
    assert doubt.kind == "orientation"
    top, _, (doubt,) = edges_between(AREA, np.array([0.1, 0.01]), at(AREA, 2))
    assert top.coords[0] == (0.0, 0.0)
    assert doubt.kind == "off-ring"
    top, _, doubts = edges_between(AREA, np.array([1e-10, 0.0]), at(AREA, 2))
    assert top.coords[0] == (0.0, 0.0)
    assert not doubts


@pytest.mark.parametrize(("off", "kind"), [(0.5, "off-ring"), (0.001, "off-ring")])
def test_a_start_beside_a_vertex_means_that_vertex(off: float, kind: str) -> None:
    area = shapely.affinity.scale(AREA, 10.0, 10.0, origin=(0, 0))
    top, _, (doubt,) = edges_between(area, np.array([0.0, -off]), at(area, 2))
    assert top.coords[0] == (0.0, 0.0)
    assert doubt.kind == kind
    assert doubt.reason == f"start is {off:.3g} off a vertex"


def test_a_start_off_the_boundary_is_refused_with_the_place() -> None:
    near = 0.1 * mean_width(AREA)
    edges_between(AREA, np.array([4.0, -0.9 * near]), at(AREA, 2))
    with pytest.raises(SlopeError, match=r"start is .* off the boundary, expected 0\.2") as refused:
        edges_between(AREA, np.array([4.0, -1.1 * near]), at(AREA, 2))
    assert refused.value.where is not None
    assert refused.value.where.coords[0] == (4.0, -1.1 * near)
    with pytest.raises(SlopeError, match="end is nan off"):
        edges_between(AREA, at(AREA, 0), np.array([np.nan, 0.0]))


def test_a_line_that_leaves_the_boundary_is_refused_with_the_place() -> None:
    line = LineString([(0, 0), (4, 1), (9, 0)])
    with pytest.raises(SlopeError, match="the top is 1 off the boundary") as refused:
        edges_along(AREA, line)
    assert refused.value.where is not None
    assert refused.value.where.coords[0] == (4.0, 1.0)
    with pytest.raises(SlopeError, match="off the boundary"):
        edges_along(AREA, LineString([(0, 0), (10, 2)]))


@pytest.mark.parametrize("turned", [False, True])
def test_the_top_of_a_mound_is_its_hole(turned: bool) -> None:
    area = Polygon(MOUND.exterior, [MOUND.interiors[0].coords[:: -1 if turned else 1]])
    start = np.array([6.0, 3.0])
    for edges in (edges_between(area, start, start), edges_along(area, area.interiors[0])):
        top, toe, doubts = edges
        assert not doubts
        assert top.is_closed
        assert shapely.equals(Polygon(top), Polygon(area.interiors[0]))
        assert shapely.equals(Polygon(toe), Polygon(area.exterior))
        assert shapely.is_ccw(top) == shapely.is_ccw(toe)
    assert edges_between(area, start, start).top.coords[0] == (6.0, 3.0)


def test_a_pit_is_doubted() -> None:
    corner = at(MOUND, 0)
    top, toe, (doubt,) = edges_between(MOUND, corner, corner)
    assert shapely.equals(Polygon(top), Polygon(MOUND.exterior))
    assert shapely.equals(Polygon(toe), Polygon(MOUND.interiors[0]))
    assert doubt.kind == "orientation"
    assert doubt.where.coords[0] == tuple(corner)


def test_a_part_of_a_hole_stands_for_all_of_it_and_is_doubted() -> None:
    start, end = (np.array(corner) for corner in MOUND.interiors[0].coords[:2])
    for edges in (
        edges_between(MOUND, start, end),
        edges_along(MOUND, LineString(MOUND.interiors[0].coords[:2])),
    ):
        assert shapely.equals(Polygon(edges.top), Polygon(MOUND.interiors[0]))
        assert [doubt.kind for doubt in edges.doubts] == ["orientation"]


def test_one_place_for_start_and_end_needs_a_hole_for_the_toe() -> None:
    with pytest.raises(SlopeError, match="of an area with no hole, expected one hole"):
        edges_between(AREA, at(AREA, 0), at(AREA, 0))
    area = box(0, 0, 9, 9)
    twins = Polygon(area.exterior, [box(x, 2, x + 2, 4).exterior for x in (1, 5)])
    with pytest.raises(SlopeError, match="with 2 holes, none larger than the others together"):
        edges_between(twins, np.zeros(2), np.zeros(2))


def test_other_holes_of_a_closed_slope_are_islands() -> None:
    island, large = box(8, 8, 8.5, 8.5).exterior, box(2, 2, 6, 6).exterior
    area = Polygon(box(0, 0, 9, 9).exterior, [island, large])
    for corner, top, toe in (
        ((2.0, 2.0), large, area.exterior),
        ((0.0, 0.0), area.exterior, large),
    ):
        edges = edges_between(area, np.array(corner), np.array(corner))
        assert shapely.equals(Polygon(edges.top), Polygon(top))
        assert shapely.equals(Polygon(edges.toe), Polygon(toe))


def test_start_and_end_on_two_rings_are_refused() -> None:
    with pytest.raises(SlopeError, match="start is on ring 0 and end on ring 1"):
        edges_between(MOUND, at(MOUND, 0), np.array([6.0, 3.0]))
