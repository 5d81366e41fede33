"""What holes are to a line: in the way, parts of the auxiliary curve, or nothing."""

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from shapely import LineString, Point, Polygon, box
from shapely.affinity import scale

from midrib import Strip, collapse, minimal_radii, profile, split
from midrib.errors import ParameterError
from tests.shapes import NAMED, VALID, rectangle
from tests.strategies import simple_areas, with_holes

LENGTH, WIDTH = 100.0, 20.0
WAYS: list[dict[str, Any]] = [
    {"holes": "auxiliary"},
    {"holes": "auxiliary", "centring": "none"},
    {"channel": "wider"},
]


def river(*islands: Polygon, length: float = LENGTH, width: float = WIDTH) -> Polygon:
    """A rectangle with islands."""
    return Polygon(rectangle(length, width).exterior, [island.exterior for island in islands])


def strip_of(area: Polygon, length: float = LENGTH, width: float = WIDTH) -> Strip:
    """The strip whose main curve is the lower side of a rectangle."""
    main, auxiliary = LineString([(0, 0), (length, 0)]), LineString([(0, width), (length, width)])
    return Strip(main, auxiliary, area)


def height_at(line: LineString, x: float, top: float = WIDTH) -> float:
    """Where a line crosses a vertical, once."""
    crossing = line.intersection(LineString([(x, -1.0), (x, top + 1.0)]))
    assert isinstance(crossing, Point)
    return float(crossing.y)


@st.composite
def rows_of_islands(draw: st.DrawFn) -> list[Polygon]:
    """Islands one after the other, each off the middle by more than rounding."""
    islands = []
    for k in range(draw(st.integers(1, 3))):
        low = draw(st.integers(1, 14))
        high = draw(st.integers(low + 1, 19))
        assume(low + high != WIDTH)
        start = 12 + 28 * k + draw(st.integers(0, 6))
        islands.append(box(start, low, start + draw(st.integers(1, 14)), high))
    return islands


# -- ignored ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("centring", ["none", "symmetric", "centred"])
@pytest.mark.parametrize("name", ["river_with_island", "three_islands", "hole_on_segment"])
def test_ignored_holes_are_not_there(name: str, centring: str) -> None:
    area = VALID[name]
    line = collapse(area, holes="ignored", centring=centring)
    assert line.equals_exact(collapse(Polygon(area.exterior), centring=centring))
    assert not area.covers(line) or name == "hole_on_segment"


def test_a_curve_that_ignores_holes_has_a_strip_without_them() -> None:
    strip = split(NAMED["three_islands"])
    curve = minimal_radii(strip, ends="caps", holes="ignored")
    assert not curve.strip.area.interiors
    assert curve.strip.area.covers(curve.line)
    assert curve.radii == pytest.approx(4.0)


def test_every_part_of_an_area_ignores_its_holes() -> None:
    parts = shapely.MultiPolygon([river(box(40, 7, 60, 13)), box(45, 9, 55, 11)])
    lines = collapse(parts, holes="ignored")
    assert [line.length for line in lines.geoms] == [LENGTH, 10.0]


# -- auxiliary -------------------------------------------------------------------------------------


def test_radii_end_on_auxiliary_holes() -> None:
    area = river(box(40, 7, 60, 11))
    curve = minimal_radii(strip_of(area), spacing=1.0, ends=None, holes="auxiliary")
    is_below = (curve.stations >= 40) & (curve.stations <= 60)
    assert curve.radii[is_below] == pytest.approx(7.0)
    away = np.minimum(abs(curve.stations - 40), abs(curve.stations - 60))
    expected = np.minimum(np.hypot(away, 7.0), WIDTH)
    assert curve.radii[~is_below] == pytest.approx(expected[~is_below])


@given(islands=rows_of_islands())
@settings(max_examples=25)
def test_the_line_is_between_the_main_curve_and_auxiliary_holes(islands: list[Polygon]) -> None:
    area = river(*islands)
    for centring in ("none", "centred"):
        curve = minimal_radii(
            strip_of(area),
            ends="caps",
            holes="auxiliary",
            centring=centring,
        )
        for island in islands:
            low, x = island.bounds[1], island.centroid.x
            assert height_at(curve.line, x) < low
            if centring == "centred" and island.length > 2 * WIDTH:
                assert height_at(curve.line, x) == pytest.approx(low / 2.0, abs=WIDTH / 100)


@given(area=with_holes())
@settings(max_examples=50)
def test_nearest_points_are_on_the_auxiliary_curve_or_on_holes(area: Polygon) -> None:
    strip = split(area)
    curve = minimal_radii(strip, holes="auxiliary", end_clearance=None)
    goal = shapely.union_all([strip.auxiliary, *area.interiors])
    extent = np.ptp(shapely.bounds(area).reshape(2, 2), axis=0).max()
    assert shapely.distance(shapely.points(curve.on_auxiliary), goal).max() <= 1e-9 * extent
    # No point of either that P sees is nearer; seen as far as a straight probe can tell.
    free = minimal_radii(strip, end_clearance=None)
    both, at_free, at = np.intersect1d(free.stations, curve.stations, return_indices=True)
    assert both.size > 0
    assert (curve.radii[at] <= free.radii[at_free] * (1 + 1e-9)).all()


def test_arc_lengths_on_auxiliary_holes_never_descend_along_a_river() -> None:
    """The auxiliary curve goes round each island on its way, so that radii stay in order."""
    area = river(box(20, 11, 30, 15), box(40, 5, 50, 16), box(70, 2, 90, 12)).segmentize(0.5)
    curve = minimal_radii(split(area), spacing=1.0, ends=None, holes="auxiliary")
    assert curve.loops_cut == 0
    assert (np.diff(curve._radii.arc) >= 0).all()
    assert curve._radii.arc[-1] > LENGTH + 70.0  # and round the first two islands


def test_bridges_to_auxiliary_holes_are_no_banks() -> None:
    """From a far corner one leads across half the river."""
    area = river(box(40, 7, 60, 11))
    line = minimal_radii(strip_of(area), ends="caps", holes="auxiliary", centring="centred").line
    assert height_at(line, 15.0) == pytest.approx(10.0, abs=0.1)
    assert height_at(line, 85.0) == pytest.approx(10.0, abs=0.1)


# -- wider channels --------------------------------------------------------------------------------


@given(islands=rows_of_islands())
@settings(max_examples=50)
def test_the_wider_channel_is_taken_past_every_island(islands: list[Polygon]) -> None:
    line = collapse(river(*islands), channel="wider")
    for island in islands:
        _, low, _, high = island.bounds
        is_below = low > WIDTH - high
        y = height_at(line, island.centroid.x)
        assert (y < low) if is_below else (y > high)


def test_of_channels_side_by_side_the_widest_is_taken() -> None:
    """Upper bank, 4, island, 6, island, 5, lower bank: between the islands."""
    area = river(box(40, 5, 60, 7), box(40, 13, 60, 16))
    assert height_at(collapse(area, channel="wider"), 50.0) == pytest.approx(10.0, abs=0.2)


def test_the_widest_way_may_wind() -> None:
    """The middle of three islands closes the upper channel, however wide it is before."""
    area = river(box(20, 5, 30, 6), box(45, 8, 55, 19), box(70, 5, 80, 6))
    line = collapse(area, channel="wider")
    assert height_at(line, 25.0) > 6.0
    assert height_at(line, 50.0) < 8.0
    assert height_at(line, 75.0) > 6.0


def test_mirrored_rivers_have_mirrored_lines() -> None:
    area = river(box(20, 5, 30, 6), box(40, 13, 60, 16), box(45, 8, 55, 10))
    mirrored = scale(area, 1.0, -1.0, origin=(0, WIDTH / 2))
    line, other = (collapse(a, channel="wider") for a in (area, mirrored))
    assert line.hausdorff_distance(scale(other, 1.0, -1.0, origin=(0, WIDTH / 2))) <= 0.3


def test_the_ends_of_a_wider_line_may_lie_inside() -> None:
    area = river(box(40, 9, 60, 17))
    line = collapse(area, channel="wider", ends=((20, 10), (80, 10)))
    assert line.coords[0] == (20, 10)
    assert line.coords[-1] == (80, 10)
    assert shapely.get_coordinates(line)[:, 0].min() == 20
    assert shapely.get_coordinates(line)[:, 0].max() == 80
    assert height_at(line, 50.0) == pytest.approx(4.5, abs=0.2)


# -- all of them -----------------------------------------------------------------------------------


@pytest.mark.parametrize("options", WAYS)
@pytest.mark.parametrize("name", sorted(VALID))
def test_lines_stay_inside_and_simple(name: str, options: dict[str, Any]) -> None:
    line = collapse(VALID[name], **options)
    assert VALID[name].covers(line)
    assert line.is_simple


@given(area=st.one_of(simple_areas, with_holes()), options=st.sampled_from(WAYS))
@settings(max_examples=100)
def test_lines_of_any_area_stay_inside_and_simple(area: Polygon, options: dict[str, Any]) -> None:
    line = collapse(area, **options)
    assert area.covers(line)
    assert line.is_simple


@pytest.mark.parametrize("options", [*WAYS, {"holes": "ignored"}])
@pytest.mark.parametrize("name", ["L", "hook"])
def test_without_holes_they_are_all_the_same(name: str, options: dict[str, Any]) -> None:
    plain = {key: value for key, value in options.items() if key == "centring"}
    line, expected = collapse(NAMED[name], **options), collapse(NAMED[name], **plain)
    assert line.hausdorff_distance(expected) <= 0.03


@pytest.mark.parametrize("power", [-40, 3])
@pytest.mark.parametrize("options", WAYS)
def test_scaled_rivers_have_scaled_lines(options: dict[str, Any], power: int) -> None:
    factor = 2.0**power
    area = NAMED["three_islands"]
    large = scale(area, factor, factor, origin=(0, 0))
    points, expected = (shapely.get_coordinates(collapse(a, **options)) for a in (large, area))
    assert np.array_equal(points, expected * factor)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"holes": "open"}, "holes is 'open', expected 'blocked', 'auxiliary' or 'ignored'"),
        ({"holes": None}, "holes is None, expected"),
        ({"holes": np.array([1, 2])}, "holes is array"),
        ({"holes": "auxiliary", "centring": "symmetric"}, "goes with centring='none' or 'centred'"),
        ({"channel": "left"}, "channel is 'left', expected 'shorter' or 'wider'"),
        ({"channel": "wider", "centring": "none"}, "goes with holes='blocked' and centring="),
        ({"channel": "wider", "holes": "ignored"}, "goes with holes='blocked' and centring="),
    ],
)
def test_what_makes_no_sense_is_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        collapse(rectangle(9, 2), **options)


# -- courts and open rings -------------------------------------------------------------------------


@pytest.mark.parametrize("options", [{}, {"channel": "wider"}, {"holes": "auxiliary"}])
def test_the_line_of_a_court_goes_straight_into_its_channel(options: dict[str, Any]) -> None:
    """From the middle of a side half as far as the building, then along it."""
    area = Polygon(box(0, 0, 30, 20).exterior, [box(6, 4, 26, 14).exterior])
    line = collapse(area, **options)
    assert line.coords[0] == (0, 10)
    assert line.coords[1] == pytest.approx((3, 10), abs=1e-6)
    rows = profile(line, area)
    inner = (rows.stations > 2.9) & (rows.stations < line.length - 1.9)
    assert rows.width[inner].min() >= 3.99


@pytest.mark.parametrize("channel", ["shorter", "wider"])
def test_a_line_does_not_turn_back_from_its_landing(channel: str) -> None:
    points = shapely.get_coordinates(collapse(VALID["hole_on_hole"], channel=channel))
    off = np.hypot(*(points - points[0]).T)
    assert off[1] == pytest.approx(1.25, abs=1e-6)
    assert (off[1:] >= off[1]).all()


def test_a_court_with_its_building_far_from_the_ends_is_left_as_it_is() -> None:
    area = river(box(40, 6, 60, 16))
    line = collapse(area)
    assert line.coords[0] == (0, 10)
    assert height_at(line, 5.0) == pytest.approx(10.0, abs=0.2)


def ring() -> Polygon:
    """A round path 6 wide, narrowing to nothing at its lowest point, where hole and shell touch."""
    turn = np.linspace(0.0, 2.0 * np.pi, 65)[:-1] - np.pi / 2.0
    shell = 20.0 * np.column_stack([np.cos(turn), np.sin(turn)])
    shell[0] = lowest = (0.0, -20.0)
    inner = lowest + 0.85 * (shell - lowest)
    return Polygon(shell, [inner[[0, *range(4, 61)]]])


def test_a_ring_closed_by_a_touch_is_followed_all_the_way_round() -> None:
    area = ring()
    assert area.is_valid
    strip = split(area)
    assert min(strip.main.length, strip.auxiliary.length) > 100.0
    line = collapse(area)
    assert area.covers(line)
    assert line.is_simple
    assert not line.is_closed
    assert line.length == pytest.approx(2.0 * np.pi * 18.5, rel=0.05)
    assert max(Point(0, -20).distance(Point(line.coords[i])) for i in (0, -1)) <= 2.5


def test_a_touch_on_a_segment_closes_a_ring_too() -> None:
    """The hole's lowest vertex lies inside a segment of the shell."""
    hole = Polygon([(10, 0), (16, 6), (10, 12), (4, 6)])
    area = Polygon(box(0, 0, 20, 16).exterior, [hole.exterior])
    line = collapse(area)
    assert area.covers(line)
    assert line.is_simple


def test_heights_go_round_a_ring_that_is_closed_by_a_touch() -> None:
    line = collapse(shapely.force_3d(ring(), 7.0))
    assert shapely.get_coordinates(line, include_z=True)[:, 2] == pytest.approx(7.0)


def test_a_hole_that_touches_one_side_closes_no_ring() -> None:
    strip = split(VALID["hole_on_segment"])
    assert strip.main.length == pytest.approx(10.0)
    assert strip.auxiliary.length == pytest.approx(10.0)


@pytest.mark.parametrize("channel", ["shorter", "wider"])
def test_dense_banks_beside_islands_make_no_dense_lines(channel: str) -> None:
    """The trunk goes by a side between the banks at most every half width."""
    sparse = river(box(20, 4, 30, 7), box(60, 12, 80, 16))
    dense = shapely.segmentize(sparse, 0.1)
    few, many = (
        shapely.get_num_coordinates(collapse(area, channel=channel)) for area in (sparse, dense)
    )
    assert many <= 2 * few
