"""Areas whose curve of minimal radii can be written down."""

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from shapely import LineString, Point, Polygon

from midrib import Curve, Strip, collapse, minimal_radii, split
from tests.shapes import annulus_sector, rectangle, wavy_ribbon, wedge

Floats = NDArray[np.float64]


def strip_of(main: str, auxiliary: str) -> Strip:
    """A strip from two chains, given as numbers."""
    return Strip(*(shapely.from_wkt(f"LINESTRING ({chain})") for chain in (main, auxiliary)))


def in_wedge(degrees: float, length: float = 8.0) -> Strip:
    """A corner between two straight legs, main along x; a cap joins their far ends."""
    corner = np.array(wedge(np.radians(degrees), length).exterior.coords)
    return Strip(LineString(corner[[0, 1]]), LineString(corner[[0, 2]]))


def pure(strip: Strip, **options: object) -> Curve:
    """The curve without any conditions at the ends."""
    return minimal_radii(strip, end_clearance=None, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("degrees", [0.5, 5.0, 10.0, 30.0, 45.0, 60.0, 75.0, 89.0])
def test_wedge_leaves_the_corner_at_phi(degrees: float) -> None:
    """tan phi = sin b cos b / (1 + cos^2 b), not half of b."""
    beta = np.radians(degrees)
    curve = pure(in_wedge(degrees), count=16, vertices=False)
    s = curve.stations
    assert s == pytest.approx(np.linspace(0.0, 8.0, 17))
    assert curve.radii == pytest.approx(s * np.sin(beta), abs=1e-12)
    foot = np.column_stack([s * np.cos(beta) ** 2, s * np.cos(beta) * np.sin(beta)])
    assert curve.on_auxiliary == pytest.approx(foot, abs=1e-12)
    x, y = curve.points[1:].T
    phi = np.sin(beta) * np.cos(beta) / (1.0 + np.cos(beta) ** 2)
    assert y / x == pytest.approx(np.full(16, phi), rel=1e-9)


@pytest.mark.parametrize(
    ("degrees", "off"), [(10.0, 0.04), (30.0, 1.1), (60.0, 10.9), (89.999, 45.0)]
)
def test_wedge_is_off_the_bisector_as_published(degrees: float, off: float) -> None:
    x, y = pure(in_wedge(degrees), count=4).points[-1]
    phi = np.degrees(np.arctan2(y, x))
    assert degrees / 2.0 - phi == pytest.approx(off, abs=0.05)


@pytest.mark.parametrize("degrees", [90.0, 91.0, 120.0, 150.0, 179.0])
def test_blunt_wedge_collapses_onto_the_main_curve(degrees: float) -> None:
    curve = pure(in_wedge(degrees), count=8)
    assert curve.on_auxiliary == pytest.approx(np.zeros((9, 2)), abs=1e-12)
    assert curve.points == pytest.approx(curve.on_main / 2.0, abs=1e-12)


def blunt_strip(degrees: float) -> Strip:
    """A blunt corner with legs 4 long, then parallel banks."""
    x, y = 4.0 * np.cos(np.radians(degrees)), 4.0 * np.sin(np.radians(degrees))
    return Strip(LineString([(0, 0), (20, 0)]), LineString([(0, 0), (x, y), (20, y)]))


@pytest.mark.parametrize("degrees", [65.0, 80.0, 90.0, 120.0, 150.0])
def test_end_clearance_puts_a_blunt_corner_onto_its_bisector(degrees: float) -> None:
    curve = minimal_radii(blunt_strip(degrees), spacing=0.5, end_clearance="station")
    x, y = curve.points[1:3].T
    assert np.degrees(np.arctan2(y, x)) == pytest.approx(np.full(2, degrees / 2.0))
    middle = curve.points[curve.stations > 15.0]
    height = 4.0 * np.sin(np.radians(degrees))
    assert middle[:, 1] == pytest.approx(np.full(len(middle), height / 2.0))


@pytest.mark.parametrize("clearance", ["station", "proportional"])
def test_a_wedge_that_nowhere_keeps_clear_is_left_alone(clearance: str) -> None:
    strip = in_wedge(120.0)
    assert np.array_equal(
        minimal_radii(strip, count=8, end_clearance=clearance).points,  # type: ignore[arg-type]
        minimal_radii(strip, count=8, end_clearance=None).points,
    )


def test_proportional_clearance_follows_the_lengths_of_the_first_segments() -> None:
    """Main 8 long, auxiliary 4: Q is half as far from the corner as P."""
    strip = strip_of("0 0, 8 0", "0 0, 0 4, 8 4")
    curve = minimal_radii(strip, count=8, ends=None, end_clearance="proportional")
    free = pure(strip, count=8)
    collapsed = free.on_auxiliary[:, 1] == 0.0
    assert collapsed[:5].all()
    assert curve.on_auxiliary[1:4] == pytest.approx(np.array([[0.0, 0.5], [0.0, 1.0], [0.0, 1.5]]))


@pytest.mark.parametrize("length", [1.0, 2.5])
def test_a_length_keeps_q_that_far_from_the_shared_end(length: float) -> None:
    curve = minimal_radii(in_wedge(90.0), count=8, ends=None, end_clearance=length)
    assert curve.on_auxiliary == pytest.approx(np.tile([0.0, length], (9, 1)), abs=1e-12)


def test_rectangle_gives_its_middle_line() -> None:
    strip = strip_of("0 0, 10 0", "0 2, 10 2")
    curve = pure(strip, count=10)
    assert curve.points.tolist() == [[float(x), 1.0] for x in range(11)]
    assert curve.radii.tolist() == [2.0] * 11
    assert curve.gaps.size == 0
    assert curve.jumps.size == 0
    assert collapse(rectangle(10.0, 2.0)).equals(LineString([(0, 1), (10, 1)]))


@pytest.mark.parametrize("length", [1e2, 1e4, 1e6])
def test_long_strip_gives_its_middle_line(length: float) -> None:
    line = collapse(rectangle(length, 1.0), count=1000)
    assert line.length == length
    assert (shapely.get_coordinates(line)[:, 1] == 0.5).all()


def test_default_interval_is_the_mean_width_at_most() -> None:
    line = collapse(rectangle(100.0, 1.0))
    steps = np.diff(shapely.get_coordinates(line)[:, 0])
    assert steps.max() <= 1.0 + 1e-9
    assert steps.min() > 0.5


def test_square_gives_one_of_its_middle_lines() -> None:
    line = collapse(rectangle(4.0, 4.0))
    across, up = LineString([(0, 2), (4, 2)]), LineString([(2, 0), (2, 4)])
    assert line.equals(across) or line.equals(up)


def test_bend_of_an_l() -> None:
    """Beside the inner corner every radius ends in it."""
    strip = strip_of("0 10, 0 0, 10 0", "2 10, 2 2, 10 2")
    curve = pure(strip, spacing=0.5)
    x, y = curve.on_main.T
    expected = np.where(
        (x == 0.0)[:, None],
        np.column_stack([np.ones(x.size), (y + np.maximum(y, 2.0)) / 2.0]),
        np.column_stack([(x + np.maximum(x, 2.0)) / 2.0, np.ones(x.size)]),
    )
    assert curve.points.tolist() == expected.tolist()
    assert curve.jumps.size == 0


def test_default_interval_of_a_very_thin_strip_is_bounded_by_its_vertices() -> None:
    line = collapse(rectangle(1e9, 1.0))
    assert len(line.coords) <= 1000
    assert line.length == 1e9


@pytest.mark.parametrize("n", [16, 64, 256])
@pytest.mark.parametrize("main_is_inner", [True, False])
def test_annulus_sector_gives_the_mean_circle(n: int, main_is_inner: bool) -> None:
    inner, outer, angle = 5.0, 6.0, 4.0
    ring = np.array(annulus_sector(inner, outer, angle, n).exterior.coords)
    near, far = LineString(ring[: n + 1]), LineString(ring[n + 1 : 2 * n + 2])
    strip = Strip(near, far) if main_is_inner else Strip(far, near)
    curve = pure(strip, count=200)
    sagitta = outer * (1.0 - np.cos(angle / n / 2.0))
    assert np.abs(np.hypot(*curve.points.T) - 5.5).max() <= sagitta * (1.0 + 1e-9)
    assert np.abs(curve.radii - 1.0).max() <= 2.0 * sagitta


def test_s_ribbon_gives_its_spine() -> None:
    """Offsets of one curve, narrower than it is bent: every radius crosses it square."""
    n = 2000
    ring = np.array(wavy_ribbon(n, 0.5).exterior.coords)
    curve = pure(
        Strip(LineString(ring[: n + 1]), LineString(ring[n + 1 : 2 * n + 2])),
        count=300,
        vertices=False,
    )
    x = np.linspace(0.0, 2.0 * np.pi, 20 * n + 1)
    spine = LineString(np.column_stack([x, np.sin(x)]))
    off = shapely.distance(shapely.points(curve.points), spine)
    assert off[1:-1].max() <= 1e-5
    assert curve.radii[1:-1] == pytest.approx(np.full(299, 0.5), abs=1e-5)


def test_triangle_runs_from_its_tip_to_the_middle_of_its_short_side() -> None:
    line = collapse(Polygon([(0, 0), (20, -1), (20, 1)]))
    tip, base = sorted(line.boundary.geoms, key=lambda p: p.x)
    assert tip.equals(Point(0, 0))
    assert base.equals(Point(20, 0))
    axis = LineString([(0, 0), (20, 0)])
    beta = 2.0 * np.arctan(1.0 / 20.0)
    phi = np.arctan(np.sin(beta) * np.cos(beta) / (1.0 + np.cos(beta) ** 2))
    assert line.hausdorff_distance(axis) <= 20.1 * np.sin(beta / 2.0 - phi) * 1.01


def test_parallelogram_of_parallel_banks_has_its_middle_line() -> None:
    curve = pure(strip_of("0 0, 10 0", "2 2, 12 2"), stations=[2.0, 5.0, 10.0], vertices=False)
    assert curve.points.tolist() == [[2.0, 1.0], [5.0, 1.0], [10.0, 1.0]]


def test_radii_tie_where_p_is_as_far_from_two_walls() -> None:
    """The ties are listed in the order of travel along the auxiliary curve."""
    strip = strip_of("0 0, 4 0", "0 0, 0 3, 4 3, 4 0")
    curve = pure(strip, stations=[1.0, 2.0, 3.0], vertices=False)
    assert curve.stations.tolist() == [1.0, 2.0, 2.0, 3.0]
    assert curve.on_auxiliary.tolist() == [[0, 0], [0, 0], [4, 0], [4, 0]]
    assert curve.jumps.tolist() == [2.0]


def test_jumps_are_between_the_stations_where_q_leaps() -> None:
    """Over a slot in the far bank Q goes round one of its corners to the other."""
    strip = strip_of("0 0, 10 0", "0 1, 4 1, 4 5, 6 5, 6 1, 10 1")
    curve = pure(strip, stations=np.arange(0.5, 10.0), vertices=False)
    assert curve.jumps.tolist() == [5.0]
    tied = pure(strip, stations=[3.0, 5.0, 7.0], vertices=False)
    assert tied.on_auxiliary.tolist() == [[3, 1], [4, 1], [6, 1], [7, 1]]
    assert tied.jumps.tolist() == [5.0]


def test_the_end_clearance_leads_q_without_jumps() -> None:
    """The auxiliary curve's first segment is three times as long as the main one's: Q is fast."""
    strip = strip_of("0 0, 10 0, 40 1", "0 0, 0 30, 40 30")
    curve = minimal_radii(strip, spacing=0.5, vertices=False)
    assert curve.jumps.size == 0


def test_hidden_nearest_point_is_passed_over() -> None:
    """A wall from below hides the nearest point; the ray past its top meets the far bank."""
    strip = strip_of("0 0, 4 0, 4 2, 5 2, 5 0, 10 0", "0 3, 6 3, 6 1, 7 1, 7 3, 10 3")
    curve = pure(strip, stations=[3.0], vertices=False)
    assert curve.on_auxiliary.tolist() == [[3.0, 3.0]]
    hidden = pure(
        strip_of("0 0, 4 0, 4 2, 5 2, 5 0, 10 0", "0 9, 4.5 9, 4.5 2.5, 10 2.5"),
        stations=[3.5],
        vertices=False,
    )
    p, v = np.array([3.5, 0.0]), np.array([4.0, 2.0])
    assert hidden.on_main.tolist() == [[3.5, 0.0]]
    assert hidden.on_auxiliary == pytest.approx(np.array([[4.5, 4.0]]))
    along = hidden.on_auxiliary[0] - p
    assert along[0] * (v - p)[1] == pytest.approx(along[1] * (v - p)[0])


def test_a_room_behind_a_bend_is_a_gap() -> None:
    """From the end of a winding side arm of the main curve nothing of the other bank is seen."""
    strip = strip_of("0 0, 4 0, 4 -4, 8 -4, 8 -3, 5 -3, 5 0, 9 0", "0 2, 9 2")
    curve = pure(strip, spacing=0.5, vertices=False)
    assert curve.gaps.shape == (1, 2)
    first, last = curve.gaps[0]
    inside = [s for s in np.arange(0.0, strip.main.length, 0.5) if first <= s <= last]
    seen = set(curve.stations.tolist())
    assert not seen & set(inside)
    for s in inside:
        assert strip.main.interpolate(s).y < -2.0


def test_split_finds_the_sides_of_a_rectangle() -> None:
    strip = split(rectangle(10.0, 2.0))
    chains = {strip.main.normalize().wkt, strip.auxiliary.normalize().wkt}
    assert chains == {"LINESTRING (0 0, 10 0)", "LINESTRING (0 2, 10 2)"}
