"""Heights of the line: on banks that lie in a plane, the line lies in it too."""

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, note, settings
from hypothesis import strategies as st
from shapely import LineString, Polygon

from midrib import collapse, minimal_radii, split
from midrib.strip import Strip
from midrib.types import Floats
from tests.shapes import VALID
from tests.strategies import areas


def plane(x: Floats, y: Floats) -> Floats:
    """Heights that rise by 2 along x and fall by 3 along y."""
    return 2.0 * x - 3.0 * y + 1.0


def with_heights(area: Polygon) -> Polygon:
    """An area whose boundary lies in the plane."""
    rings = [shapely.get_coordinates(ring) for ring in (area.exterior, *area.interiors)]
    rings = [np.column_stack([ring, plane(*ring.T)]) for ring in rings]
    return Polygon(rings[0], rings[1:])


def check_plane(line: LineString) -> None:
    """Every vertex of a line lies in the plane."""
    x, y, z = shapely.get_coordinates(line, include_z=True).T
    assert z == pytest.approx(plane(x, y), abs=1e-9 * (1.0 + np.abs(z).max()))


@pytest.mark.parametrize("skip", ["bays", None])
@pytest.mark.parametrize("ends", ["main", "caps", "radii", None])
@pytest.mark.parametrize("name", VALID)
def test_lines_between_flat_banks_are_flat(name: str, ends: Any, skip: Any) -> None:
    check_plane(collapse(with_heights(VALID[name]), ends=ends, skip=skip))


@given(area=areas, skip=st.sampled_from(["bays", None]))
@settings(max_examples=300)
def test_turns_and_crossings_are_as_high_as_the_banks(area: Polygon, skip: Any) -> None:
    note(area.wkt)
    check_plane(collapse(with_heights(area), skip=skip))


@pytest.mark.parametrize("care", [{"simplify": "10%"}, {"smooth": True}])
@pytest.mark.parametrize("name", VALID)
def test_aftercare_keeps_flat_lines_flat(name: str, care: Any) -> None:
    check_plane(collapse(with_heights(VALID[name]), **care))


def test_ends_of_the_callers_are_as_high_as_the_banks() -> None:
    strip = split(with_heights(VALID["hook"]))
    check_plane(minimal_radii(strip, ends=((0.5, 0.3), (1.5, 2.7))).line)


def test_the_line_is_halfway_between_banks_that_differ() -> None:
    # One bank is level at 10, the other rises from 0 to 9 along the strip.
    main = LineString([(0, 0, 10), (90, 0, 10)])
    auxiliary = LineString([(0, 20, 0), (90, 20, 9)])
    curve = minimal_radii(Strip(main, auxiliary), ends="caps", count=9)
    x, _, z = shapely.get_coordinates(curve.line, include_z=True).T
    assert x.tolist() == [10.0 * i for i in range(10)]
    assert z == pytest.approx(5.0 + x / 20.0)
