"""Where the middle line of a slope ends."""

import numpy as np
import pytest
from shapely import LineString

from midrib import Strip
from midrib.hatching.middle import middle_of

TOP = [(0.0, 10.0), (100.0, 10.0)]


def slope(chamfer: float, lift: float = 0.0) -> Strip:
    """A slope 10 wide whose toe begins with an upright side and then a chamfer of so many degrees.

    The top is lifted at one place, 10 from its start; the middle line runs towards there.
    """
    turn = np.radians(chamfer)
    corner = (4.0 * np.cos(turn), 4.0 - 4.0 * np.sin(turn))
    top = [TOP[0], (10.0, 10.0 + lift), TOP[1]]
    toe = [TOP[0], (0.0, 4.0), corner, (100.0, corner[1])]
    return Strip(LineString(top), LineString(toe))


@pytest.mark.parametrize("lift", [-1.0, 0.0, 1.0])
@pytest.mark.parametrize("chamfer", [30.0, 44.0, 48.0])
def test_a_side_ends_where_the_toe_turns_whatever_noise_there_is(
    chamfer: float, lift: float
) -> None:
    line = middle_of(slope(chamfer, lift)).line
    assert line[-1] == pytest.approx((0.0, 7.0), abs=0.02)


@pytest.mark.parametrize("steep", [20.0, 50.0])
def test_a_tip_is_no_side(steep: float) -> None:
    toe = [(0.0, 10.0), (10.0 / np.tan(np.radians(steep)), 0.0), (100.0, 0.0)]
    line = middle_of(Strip(LineString(TOP), LineString(toe))).line
    assert line[-1] == pytest.approx((0.0, 10.0), abs=0.02)
