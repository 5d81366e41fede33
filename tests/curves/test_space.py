"""Curves of minimal radii in space: closed forms and how they move with the two curves."""

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString, Polygon, box

from midrib import minimal_radii, minimal_radii_3d
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError
from midrib.strip import Strip
from midrib.types import Floats

RAIL = LineString([(0, 0, 0), (4, 0, 3), (8, 0, 3), (8, 6, 5)])
OTHER = LineString([(0, 2, 1), (3, 2, 4), (6, 2, 4), (6, 7, 7)])
TURN = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])  # orthogonal


def moved(curve: LineString, matrix: Floats, shift: Any = (0.0, 0.0, 0.0)) -> LineString:
    """A curve after an affine map."""
    return LineString(shapely.get_coordinates(curve, include_z=True) @ matrix.T + shift)


def coordinates(line: LineString) -> Floats:
    """Vertices (n, 3)."""
    found: Floats = shapely.get_coordinates(line, include_z=True)
    return found


def test_between_parallel_rails_it_is_the_middle() -> None:
    step = np.array([0.0, 2.0, -1.0])
    curve = minimal_radii_3d(
        LineString([(0, 0, 0), (8, 0, 0)]), LineString([(0, 2, -1), (8, 2, -1)]), count=4
    )
    assert curve.radii == pytest.approx(np.sqrt(5.0))
    assert curve.on_auxiliary - curve.on_main == pytest.approx(np.tile(step, (5, 1)))
    assert curve.stations.tolist() == [0.0, 2.0, 4.0, 6.0, 8.0]


def test_skew_lines_have_their_closed_form() -> None:
    # From (x, 0, 0) the foot on the line (t, t, 1) is at t = x / 2.
    main, auxiliary = LineString([(0, 0, 0), (8, 0, 0)]), LineString([(-9, -9, 1), (9, 9, 1)])
    curve = minimal_radii_3d(main, auxiliary, count=8, ends=None)
    x = curve.on_main[:, 0]
    assert curve.on_auxiliary == pytest.approx(np.column_stack([x / 2, x / 2, np.ones_like(x)]))
    assert curve.radii == pytest.approx(np.sqrt(x**2 / 2.0 + 1.0))
    assert curve.points[:, 2] == pytest.approx(0.5)


def test_rings_one_above_the_other_have_a_ring_between() -> None:
    turn = np.linspace(0.0, 1.9 * np.pi, 60)
    ring = np.column_stack([np.cos(turn), np.sin(turn), np.zeros_like(turn)])
    curve = minimal_radii_3d(
        LineString(ring), moved(LineString(ring), np.eye(3), (0, 0, 3)), ends="caps"
    )
    assert curve.radii == pytest.approx(3.0)
    assert coordinates(curve.line)[:, 2] == pytest.approx(1.5)


@pytest.mark.parametrize("rule", [{"count": 7}, {"percent": 10}, {"spacing": 0.7}, {}])
def test_flat_curves_are_those_of_the_plane(rule: dict[str, Any]) -> None:
    main, auxiliary = [(0, 0), (5, 1), (10, 0), (14, 2)], [(0, 3), (5, 4), (10, 3), (13, 5)]
    flat = minimal_radii(Strip(LineString(main), LineString(auxiliary)), end_clearance=None, **rule)
    curve = minimal_radii_3d(
        *(LineString([(*point, 7.0) for point in c]) for c in (main, auxiliary)),
        stations=flat.stations,
        vertices=False,
    )
    assert curve.points[:, :2] == pytest.approx(flat.points)
    assert curve.radii == pytest.approx(flat.radii)
    assert (curve.points[:, 2] == 7.0).all()


@pytest.mark.parametrize("ends", ["main", "caps", None])
def test_ends_follow_their_rule(ends: Any) -> None:
    curve = minimal_radii_3d(RAIL, OTHER, ends=ends)
    m, a = coordinates(RAIL)[[0, -1]], coordinates(OTHER)[[0, -1]]
    expected = {"main": m, "caps": (m + a) / 2.0, None: curve.points[[0, -1]]}[ends]
    assert coordinates(curve.line)[[0, -1]].tolist() == expected.tolist()


@pytest.mark.parametrize("ends", ["main", "caps", None])
@pytest.mark.parametrize("rule", [{"count": 7}, {"percent": 10}, {}, {"spacing": 1e9}])
def test_reversal_gives_the_reversed_curve(rule: dict[str, Any], ends: Any) -> None:
    there = minimal_radii_3d(RAIL, OTHER, ends=ends, **rule)
    back = minimal_radii_3d(shapely.reverse(RAIL), shapely.reverse(OTHER), ends=ends, **rule)
    assert coordinates(back.line)[::-1] == pytest.approx(coordinates(there.line), abs=1e-12)
    assert back.radii[::-1] == pytest.approx(there.radii)


def test_the_auxiliary_curve_may_run_either_way() -> None:
    one, other = (minimal_radii_3d(RAIL, c) for c in (OTHER, shapely.reverse(OTHER)))
    assert one.line.equals_exact(other.line)
    assert one.auxiliary.equals_exact(OTHER)
    assert other.auxiliary.equals_exact(OTHER)


def test_ties_are_in_order_of_travel() -> None:
    main = LineString([(0, 0, -1), (0, 0, 0), (0, 0, 1)])
    auxiliary = LineString([(-2, 0, -5), (-2, 0, 5), (2, 0, 5), (2, 0, -5)])
    curve = minimal_radii_3d(main, auxiliary, stations=[1.0], vertices=False, ends=None)
    assert curve.on_auxiliary.tolist() == [[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
    assert curve.line.wkt == "LINESTRING Z (-1 0 0, 1 0 0)"


@given(power=st.integers(min_value=-200, max_value=200))
def test_doubling_is_exact(power: int) -> None:
    factor = 2.0**power
    curve = minimal_radii_3d(moved(RAIL, factor * np.eye(3)), moved(OTHER, factor * np.eye(3)))
    expected = minimal_radii_3d(RAIL, OTHER)
    assert (curve.points == factor * expected.points).all()
    assert (curve.radii == factor * expected.radii).all()


def test_rigid_motion_moves_the_curve_along() -> None:
    shift = np.array([5e5, 5e6, 100.0])
    curve = minimal_radii_3d(moved(RAIL, TURN, shift), moved(OTHER, TURN, shift), count=9)
    expected = minimal_radii_3d(RAIL, OTHER, count=9)
    assert curve.points - shift == pytest.approx(expected.points @ TURN.T, abs=1e-7)
    assert curve.radii == pytest.approx(expected.radii, abs=1e-7)


@pytest.mark.parametrize(
    "skip", [0, slice(0, 1), slice(0.0, 0.1), box(-1, -1, 0.1, 1), lambda s, p: (s + p[:, 2]) == 0]
)
def test_stations_are_dropped_by_all_rules(skip: Any) -> None:
    all_of_them = minimal_radii_3d(RAIL, OTHER, ends=None)
    curve = minimal_radii_3d(RAIL, OTHER, skip=skip, ends=None)
    assert curve.stations.tolist() == all_of_them.stations[1:].tolist()


def test_vertical_steps_are_steps() -> None:
    shaft = LineString([(0, 0, 0), (0, 0, 5), (0, 0, 10)])
    curve = minimal_radii_3d(shaft, LineString([(2, 0, 0), (2, 0, 10)]), count=2, ends="caps")
    assert curve.line.wkt == "LINESTRING Z (1 0 0, 1 0 5, 1 0 10)"


def test_what_has_no_curve_is_refused() -> None:
    flat = LineString([(0, 0), (1, 1)])
    with pytest.raises(GeometryTypeError, match="main is a LineString without Z, expected"):
        minimal_radii_3d(flat, OTHER)
    with pytest.raises(GeometryTypeError, match="auxiliary is a Polygon, expected a LineString"):
        minimal_radii_3d(RAIL, Polygon())
    with pytest.raises(InvalidAreaError, match="main has fewer than two distinct points"):
        minimal_radii_3d(LineString([(1, 1, 1), (1, 1, 1)]), OTHER)
    with pytest.raises(InvalidAreaError, match="auxiliary has a coordinate that is not finite"):
        minimal_radii_3d(RAIL, LineString([(1, 1, 1), (2, 1, np.nan)]))
    with pytest.raises(InvalidAreaError, match=r"the curve is one point, \(1, 0, 0\)"):
        _ = minimal_radii_3d(
            LineString([(0, 0, 0), (0, 0, 1)]),
            LineString([(2, 0, -9), (2, 0, 9)]),
            stations=[0.0],
            vertices=False,
            ends=None,
        ).line


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"ends": np.array([1, 2])}, "ends is .*, expected 'main', 'caps' or None"),
        ({"ends": "radii"}, "ends is 'radii', expected 'main', 'caps' or None"),
        ({"skip": "bays"}, "skip is 'bays', which needs an area"),
        ({"spacing": 0.0}, "spacing is 0.0, expected a positive number"),
        ({"stations": [99.0]}, "station 99 is not on the main curve"),
        ({"skip": slice(None)}, "no station is left on the main curve"),
    ],
)
def test_options_that_cannot_be_are_refused(options: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ParameterError, match=sentence):
        minimal_radii_3d(RAIL, OTHER, **options)
