"""Roads that others join: they go straight on, whatever the angle, the widths and the kerbs."""

from typing import Any

import numpy as np
import pytest
import shapely
from shapely import LineString, MultiLineString, Polygon, affinity, box

from midrib import network
from midrib.curves.hubs import Bundle, Lines, led_on, meeting, through
from tests.skeletons.test_networks import nodes_of, ways_of

LENGTH = 120.0


def middles(angle: float) -> tuple[LineString, LineString]:
    """Middle of a road, and of one that joins it in the origin."""
    turn = np.radians(angle)
    branch = LineString([(0, 0), (LENGTH * np.cos(turn), LENGTH * np.sin(turn))])
    return LineString([(-LENGTH, 0), (LENGTH, 0)]), branch


def join(angle: float, width: float = 2.0, kerb: float = 0.0) -> Polygon:
    """A road 2 wide and one that joins it, their corners rounded."""
    _, branch = middles(angle)
    above = box(-LENGTH, -1, 2 * LENGTH, 2 * LENGTH)
    arm = branch.buffer(width / 2, cap_style="flat").intersection(above)
    area = arm.union(box(-LENGTH, -1, LENGTH, 1))
    return area.buffer(kerb, join_style="mitre").buffer(-kerb, quad_segs=32) if kerb else area


def off_middles(found: MultiLineString, angle: float) -> tuple[float, float]:
    """How far the road and the branch are from their middles at most, ends aside."""
    road, branch = middles(angle)
    lines = np.array(found.segmentize(0.1).geoms)
    is_branch = shapely.bounds(lines)[:, 3] > 0.4 * branch.bounds[3]
    far = []
    for ways, middle in ((lines[~is_branch], road), (lines[is_branch], branch)):
        points = shapely.points(shapely.get_coordinates(ways))
        far.append(float(shapely.distance(points, middle).max()))
    return far[0], far[1]


@pytest.mark.parametrize("width", [1.0, 2.0, 3.5])
@pytest.mark.parametrize("angle", [15, 20, 25, 30, 35, 45, 60, 75, 90])
def test_a_road_goes_straight_on_where_corners_are_sharp(angle: float, width: float) -> None:
    turned = network(affinity.rotate(join(angle, width), 10, origin=(0, 0)))
    found = affinity.rotate(turned, -10, origin=(0, 0))
    assert ways_of(found) == {3: 1, 1: 3}
    road, branch = off_middles(found, angle)
    assert road < 1e-9
    assert branch < 1e-6


@pytest.mark.parametrize("kerb", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("width", [1.0, 2.0, 3.5])
@pytest.mark.parametrize("angle", [15, 20, 30, 45, 60, 90])
def test_kerbs_hardly_bend_a_road(angle: float, width: float, kerb: float) -> None:
    found = network(join(angle, width, kerb))
    assert ways_of(found) == {3: 1, 1: 3}
    road, branch = off_middles(found, angle)
    assert road < 0.08
    assert branch < 0.2


@pytest.mark.parametrize("angle", [15, 30])
def test_branches_on_both_sides_leave_a_road_straight(angle: float) -> None:
    other = affinity.translate(affinity.rotate(join(angle), 180, origin=(0, 0)), 60, 0)
    found = network(join(angle).union(other))
    assert ways_of(found) == {3: 2, 1: 4}
    hubs = [p for p, ways in nodes_of(found).items() if ways == 3]
    assert sorted(hubs) == pytest.approx(np.array([(0, 0), (60, 0)]), abs=1e-6)


def test_an_estuary_is_cut_back_no_farther_than_near_its_junction() -> None:
    """It never gets narrower than it is about to be: 2 at the junction, 1 far away."""
    river = Polygon([(0, -2), (100, -0.5), (100, 0.5), (0, 2), (-30, 2), (-30, -2)])
    found = network(river.union(box(-2, 0, 2, 40)))
    vertices = shapely.get_coordinates(found)
    assert np.abs(vertices[vertices[:, 1] < 2]).min(axis=0)[1] < 0.1
    assert ways_of(found) == {3: 1, 1: 3}


def lines(*arms: tuple[float, float, float], weight: Any = 1.0) -> Lines:
    """Arms by where they are and the degrees from which they come."""
    places = np.array(arms, dtype=float)
    turn = np.radians(places[:, 2])
    inwards = -np.column_stack([np.cos(turn), np.sin(turn)])
    return Lines(places[:, :2], inwards, np.full(len(arms), weight))


@pytest.mark.parametrize(
    ("degrees", "pair"),
    [
        ((0, 180, 20), (0, 1)),
        ((5, 100, 180), (0, 2)),
        ((0, 170, 190), None),  # a fork
        ((90, 210, 330), None),
        ((0, 90, 180, 270), None),  # two roads
        ((0, 50, 130, 180), (0, 3)),
        ((0, 180), None),
    ],
)
def test_the_through_road_is_the_only_pair_that_faces_each_other(
    degrees: tuple[float, ...], pair: tuple[int, int] | None
) -> None:
    assert through(lines(*((0, 0, turn) for turn in degrees))) == pair


def test_the_hub_is_on_the_through_road_though_the_branch_leads_elsewhere() -> None:
    """Three lines that meet in no point: least squares would leave the road."""
    crooked = lines((9, 0, 0), (-9, 0, 180), (5, 3, 45))
    assert meeting(np.array([4.0, 1.0]), crooked, 0.0) == pytest.approx((2, 0))
    held = meeting(np.array([4.0, 1.0]), crooked, 1e9)
    assert held == pytest.approx((4, 0))


@pytest.mark.parametrize(("bend", "turned"), [(0.0, 0.0), (0.1, 0.5), (10.0, np.pi / 4)])
def test_arms_are_led_on_along_a_parabola_up_to_half_a_right_angle(
    bend: float, turned: float
) -> None:
    arm = Bundle(np.zeros((1, 2)), np.array([[1.0, 0]]), np.array([[0, bend]]), np.ones(1))
    led = led_on(arm, np.array([3.0, 4.0]))
    assert led.points[0] == pytest.approx((5, 2.5 * turned))
    assert led.directions[0] == pytest.approx(np.array([1, turned]) / np.hypot(1, turned))
