"""Planar sections: towers, tunnels, pipes; and how walls are thinned."""

from collections.abc import Callable

import numpy as np
import pytest
import shapely

from midrib import minimal_radii
from midrib.errors import ParameterError
from midrib.towers.sections import Section, section
from midrib.towers.thinning import average_depth, moving_least_squares
from midrib.types import Bools, Floats
from tests.towers.scans import CONE


def tunnel() -> Floats:
    """A bent tunnel with flat walls, 6 wide, along a sine."""
    random = np.random.default_rng(2)
    y = random.uniform(0.0, 60.0, 30_000)
    x = 3.0 * np.sin(y / 20.0) + random.choice([-3.0, 3.0], y.size)
    strays = random.uniform([-8.0, 0.0, 0.0], [8.0, 60.0, 4.0], (100, 3))
    return np.concatenate([np.column_stack([x, y, random.uniform(0.0, 4.0, y.size)]), strays])


def test_axis_of_a_tunnel_runs_along_its_middle() -> None:
    cut = section(tunnel(), (0, 0, 2), (0, 0, 1), thickness=1.0, interval=0.5, along=(0, 1, 0))
    curve = minimal_radii(cut.strip, ends="caps", centring="symmetric")
    axis = shapely.get_coordinates(cut.in_space(curve.line), include_z=True)
    inner = axis[(axis[:, 1] > 3.0) & (axis[:, 1] < 57.0)]
    assert np.abs(inner[:, 0] - 3.0 * np.sin(inner[:, 1] / 20.0)).max() < 0.05
    assert inner[:, 2] == pytest.approx(2.0)


def test_upright_section_of_a_cone_has_its_walls() -> None:
    cut = section(CONE.points(), (0, 0, 0), (0, 1, 0), thickness=0.3, interval=0.5)
    u, v = shapely.get_coordinates(cut.main).T
    assert np.abs(cut.along) == pytest.approx([0.0, 0.0, 1.0], abs=0.05)
    assert np.ptp(v) == pytest.approx(40.0, abs=1.0)
    assert np.abs(u).mean() == pytest.approx(2.0, abs=0.1)
    assert cut.strip.area.is_valid


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"thickness": 0.0}, "thickness is 0.0, expected a length above 0"),
        ({"normal": (0, 0, 0)}, "normal has no length, expected a direction"),
        ({"normal": (0, 1)}, r"normal is \(0, 1\), expected three numbers"),
        ({"point": (99, 99, 99)}, "the section has 0 points"),
    ],
)
def test_sections_that_cannot_be_are_refused(options: dict[str, object], sentence: str) -> None:
    usual: dict[str, object] = {"point": (0, 0, 0), "normal": (0, 1, 0)}
    usual |= {"thickness": 0.3, "interval": 0.5}
    with pytest.raises(ParameterError, match=sentence):
        section(CONE.points(), **(usual | options))  # type: ignore[arg-type]


def test_moving_least_squares_keeps_straight_lines() -> None:
    v = np.random.default_rng(3).uniform(0.0, 10.0, 500)
    wall = moving_least_squares(np.column_stack([1.0 + 0.3 * v, v]), 0.25)
    assert wall[:, 0] == pytest.approx(1.0 + 0.3 * wall[:, 1], abs=1e-12)
    assert np.diff(wall[:, 1]) == pytest.approx(0.25)


def test_moving_least_squares_leaves_strays_out() -> None:
    random = np.random.default_rng(3)
    v = random.uniform(0.0, 10.0, 2000)
    u = random.normal(0.0, 0.002, v.size)
    u[::40] += 0.5
    wall = moving_least_squares(np.column_stack([u, v]), 0.25)
    assert np.abs(wall[:, 0]).max() < 0.002


def test_average_depth_takes_every_point_once() -> None:
    points = np.array([[0.0, 0.0], [0.0, 0.004], [0.002, 0.008], [0.0, 0.02], [0.0, 0.5]])
    thinned = average_depth(points, 0.01)
    assert thinned == pytest.approx(np.array([[0.002 / 3, 0.004], [0.0, 0.02], [0.0, 0.5]]))


def pipe(keep: Callable[[Floats, Floats], Bools]) -> Floats:
    """Points of a pipe along x, those that are kept of x and y."""
    x, angle = np.random.default_rng(1).uniform(0, [[20.0], [2 * np.pi]], (2, 60_000))
    points = np.column_stack([x, 0.5 * np.cos(angle), 3.0 + 0.5 * np.sin(angle)])
    return points[keep(points[:, 0], points[:, 1])]


def cut_of(points: Floats) -> Section:
    """Level section of the pipe."""
    return section(points, (0, 0, 3), (0, 0, 1), thickness=0.05, interval=0.25)


@pytest.mark.parametrize("length", [1.0, 2.0, 4.0])
def test_a_wall_with_a_gap_is_refused_with_the_place(length: float) -> None:
    points = pipe(lambda x, y: (x < 8.0) | (x > 8.0 + length) | (y < 0.0))
    with pytest.raises(ParameterError, match=r"from (7\.8|7\.9|8\.0|8\.1|8\.2).* along it"):
        cut_of(points)


def test_what_stands_between_the_walls_is_refused_with_the_place() -> None:
    clutter = np.random.default_rng(2).uniform([8.0, -0.3, 3.0], [12.0, 0.3, 3.0], (1500, 3))
    with pytest.raises(ParameterError, match="no two walls with nothing between them"):
        cut_of(np.vstack([pipe(lambda x, _: x > -1.0), clutter]))


def test_short_gaps_and_strays_are_passed_over() -> None:
    strays = np.random.default_rng(3).uniform([0.0, -0.5, 3.0], [20.0, 0.5, 3.0], (15, 3))
    cut = cut_of(np.vstack([pipe(lambda x, y: (abs(x - 8.0) > 0.2) | (y < 0.0)), strays]))
    curve = minimal_radii(cut.strip, ends="caps", centring="symmetric")
    assert np.abs(np.array(cut.in_space(curve.line).coords)[:, 1]).max() < 0.003


RADIUS, LEAD, CORE = 6.0, 2.5, 2.0  # of a bent pipe, of what is straight before and after, its ends


def bent_pipe(degrees: float, density: int, clutter: float) -> tuple[Floats, shapely.LineString]:
    """Level section of a pipe 2 wide that bends, with lamps and loose points in it; its axis."""
    random = np.random.default_rng(int(degrees) + density)
    arc = RADIUS * np.radians(degrees)
    length = arc + 2.0 * LEAD

    def at(s: Floats, d: Floats) -> Floats:
        on_arc = np.clip(s - LEAD, 0.0, arc) / RADIUS
        beyond = (s - LEAD) - on_arc * RADIUS
        x = (RADIUS - d) * np.sin(on_arc) + beyond * np.cos(on_arc)
        y = RADIUS - (RADIUS - d) * np.cos(on_arc) + beyond * np.sin(on_arc)
        return np.column_stack([x, y])

    n = int(density * length)
    parts = [at(random.uniform(0.0, length, n), w + random.normal(0.0, 0.005, n)) for w in (-1, 1)]
    loose = int(clutter * n)
    parts.append(at(random.uniform(0.0, length, loose), random.uniform(-0.9, 0.9, loose)))
    for place, side in random.uniform([0.0, -0.6], [length, 0.6], (5, 2)):
        around = random.normal([place, side], [0.1, 0.05], (loose // 5, 2))
        parts.append(at(*around.T))
    flat = np.vstack(parts)
    heights = random.uniform(-0.02, 0.02, len(flat))
    axis = at(np.linspace(0.0, length, 5000), np.zeros(5000))
    return np.column_stack([flat, heights]), shapely.LineString(axis)


def off_axis(degrees: float, density: int, clutter: float) -> float:
    """How far the axis of a bent pipe is off, away from its ends."""
    points, true = bent_pipe(degrees, density, clutter)
    cut = section(points, (0, 0, 0), (0, 0, 1), thickness=0.1, interval=0.25)
    curve = minimal_radii(cut.strip, ends="caps", centring="symmetric")
    axis = shapely.points(shapely.get_coordinates(cut.in_space(curve.line)))
    s = true.project(axis)
    assert np.ptp(s) > true.length - CORE
    inner = (s > CORE) & (s < true.length - CORE)
    return float(shapely.distance(true, axis)[inner].max())


@pytest.mark.parametrize(
    ("density", "clutter"), [(50, 0.0), (50, 0.02), (200, 0.0), (200, 0.1), (2000, 0.1)]
)
@pytest.mark.parametrize("degrees", [0, 30, 90, 180, 260])
def test_axis_of_a_bent_pipe_is_right_with_clutter_in_it(
    degrees: int, density: int, clutter: float
) -> None:
    assert off_axis(degrees, density, clutter) < 0.003


@pytest.mark.parametrize(("density", "bound"), [(10, 0.1), (50, 0.003)])
@pytest.mark.parametrize("degrees", [0, 30, 90, 180, 260])
def test_few_points_with_clutter_give_an_axis_or_are_refused(
    degrees: int, density: int, bound: float
) -> None:
    try:
        off = off_axis(degrees, density, 0.1)
    except ParameterError:
        return
    assert off < bound


@pytest.mark.parametrize("along", [(1, 0, 0), (-1, 0, 0)])
def test_main_has_the_other_wall_where_u_grows(along: tuple[int, int, int]) -> None:
    points, _ = bent_pipe(0, 200, 0.0)
    cut = section(points, (0, 0, 0), (0, 0, 1), thickness=0.1, interval=0.25, along=along)
    (u, v), (other_u, _) = (np.array(wall.coords).T for wall in (cut.main, cut.auxiliary))
    assert u.max() < other_u.min()
    assert (np.diff(v) > 0.0).all()


def test_two_pipes_beside_each_other_are_refused() -> None:
    points, _ = bent_pipe(0, 200, 0.0)
    with pytest.raises(ParameterError, match="50% of the section's points lie on neither"):
        section(
            np.vstack([points, points + np.array([0.0, 4.0, 0.0])]),
            (0, 0, 0), (0, 0, 1), thickness=0.1, interval=0.25,
        )  # fmt: skip


def test_a_wall_with_a_piece_beyond_a_gap_is_refused() -> None:
    points, _ = bent_pipe(260, 200, 0.0)
    y, x = points[:, 1], points[:, 0]
    hole = (x > 5.0) & (np.abs(y - RADIUS) < 0.6)  # in the outer wall and the inner one
    with pytest.raises(ParameterError):
        section(points[~hole], (0, 0, 0), (0, 0, 1), thickness=0.1, interval=0.25)


@pytest.mark.parametrize("degrees", [30, 90, 180])
def test_few_points_are_looked_at_more_coarsely(degrees: int) -> None:
    assert off_axis(degrees, 10, 0.0) < 0.05


def test_gaps_that_coarse_cells_pass_over_are_refused() -> None:
    points, _ = bent_pipe(0, 200, 0.0)
    hole = (np.abs(points[:, 0]) < 0.6) & (points[:, 1] > 0.0)
    with pytest.raises(ParameterError, match="no two walls"):
        section(points[~hole], (0, 0, 0), (0, 0, 1), thickness=0.1, interval=0.25)


def test_a_piece_of_both_walls_beyond_a_gap_is_not_left_out() -> None:
    points, _ = bent_pipe(0, 200, 0.0)
    hole = np.abs(points[:, 0] - 1.1) < 0.5
    with pytest.raises(ParameterError, match="no two walls"):
        section(points[~hole], (0, 0, 0), (0, 0, 1), thickness=0.1, interval=0.25)
