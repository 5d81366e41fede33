"""Areas whose walls nearly touch: every radius is a distance, or the axis is refused."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from shapely import Polygon
from shapely.affinity import scale

from midrib import Skeleton, skeleton
from midrib.curves import axes
from midrib.errors import InvariantError
from midrib.kernels.medial import Fault, medial_axis
from midrib.layout import boundary_of
from midrib.ragged import rings_of_area
from tests.strategies import gapped

BETWEEN = [0.25, 0.5, 0.75]
LAST_PLACE = {
    "a_step_of_the_last_place": (
        "POLYGON ((0.5 0.5, 0 1, 0.9999999999999999 1, 1 0.9999999999999999, 1.5000000000000002 "
        "1.4999999999999998, 2 1, 3 1, 3 0, 2 0, 1 0, 0 0, 0.5 0.5))"
    ),
    "a_tip_of_the_last_place": (
        "POLYGON ((2 0, 3 0, 4 0, 5 0, 5 -1, 5 -2, 5 -3, 4 -3, 4 -4, 5 -4, 5 -5, 4 -5, 3 -5, 2 "
        "-5, 1 -5, 0 -5, 0 -4, 0 -3, 0 -2, 0 -1, 1 -1, 1 0, 2 0), (1.1803534594179155e-8 "
        "-3.0000000118035346, 1 -2.000000023607069, 1 -3, 1 -4, 2 -4, 2 -3, 2 -2, "
        "1.0000000236070692 -2, 1.4142135741766295 -1.5857864494304397, 1.4142135623730954 "
        "-1.585786437626905, 1.0000000000000002 -2, 1 -2, 1 -2.0000000000000004, 0 -3, "
        "1.1803534594179155e-8 -3.0000000118035346))"
    ),
    "a_corner_of_the_last_place": (
        "POLYGON ((-0.5517991268316309 2.7740803265049054, 0.0037714744537165 3.60554930294684, "
        "-0.8276980657256239 4.16111915348371, -0.9656476024934333 4.854640034574357, "
        "-1.6591669499653385 4.716690233750267, -1.1035975171317722 5.54815938128859, "
        "-1.1035975171317713 5.54815938128859, -1.2986878391479002 6.5289446616918205, "
        "-1.2986887301492955 6.528944484460624, -1.1035985853646242 5.5481600950600996, "
        "-1.9350661759205892 6.103729862400422, -1.3794969592829318 6.935199283472672, "
        "-0.8239270810201251 7.766668812812284, 0.007542948907433 7.21109860589368, "
        "0.8390125612099784 6.655528372874079, 0.283442101380416 5.824058826995668, "
        "1.1149119404929209 5.268488527551931, 1.2528620959183856 4.574969243356092, "
        "1.946381552795466 4.7129182945323285, 1.3908113197758638 3.881448682229783, "
        "2.222280932078409 3.325878449210181, 1.666710699058807 2.4944088369076356, "
        "0.9731907139123341 2.3564594339406177, 1.1111404660392046 1.6629392246050905, "
        "0.5555704353050712 0.8314700521785665, -0.275899379282943 1.3870398453221475, "
        "0.2796708537366593 2.218509457624693, -0.5517991268316309 2.7740803265049054), "
        "(0.6972913971147903 3.7434989925883118, 0.8352410867562617 3.0499790699272378, "
        "1.3908113197758638 3.881448682229783, 0.6972913971147903 3.7434989925883118))"
    ),
    "a_wall_that_a_disc_only_just_meets": (
        "POLYGON ((2.0000028720963927 7, 2.0000028720963927 7.000000000007553, "
        "2.9999998632228397 7.00000262983136, 4 7, 3.5 7.5, 3.9999988716023753 "
        "8.00000040164822, 5 8, 5.999999669831038 7.999999436660259, 5.500002030879309 "
        "7.5000020308783615, 5.292895249692287 7.707108812065384, 5.292893218813452 "
        "7.707106781186548, 5.5 7.5, 5 7, 5.000002273393282 6.000002266967225, 4.5 5.5, 4 5, "
        "3.5 5.5, 3.000000331827151 4.999997283778546, 2.500000055547615 5.5000024068536515, 2 "
        "5, 1.5 5.5, 2.0000021568142627 5.999997336965136, 2.499999138001959 6.499999799220455, "
        "2 7, 2.0000028720963927 7), (2.9999995618152253 6.000002106993071, 3.4999995618152253 "
        "6.500002106993071, 2.9999995618152253 7.000002106993071, 2.9999995618152253 "
        "6.000002106993071), (4.500001512360248 6.500001579189397, 4.000001512360248 "
        "6.000001579189397, 5.000001512360248 6.000001579189397, 4.500001512360248 "
        "6.500001579189397))"
    ),
}
WRONG = ("a_step_of_the_last_place", "a_tip_of_the_last_place")  # if all their vertices count


def extent(area: Polygon) -> float:
    """Diagonal of an area's bounds."""
    x_low, y_low, x_high, y_high = area.bounds
    return float(np.hypot(x_high - x_low, y_high - y_low))


def check(area: Polygon, found: Skeleton) -> None:
    """Radii are distances, along the edges too, where the discs of two ends hold what is between.

    The distance to the boundary changes by no more than one goes, so that on an edge it is at
    least what either end leaves of it, and at most what either end lets it be.
    """
    size = extent(area)
    distance = shapely.distance(shapely.points(found.points), area.boundary)
    np.testing.assert_allclose(found.radius, distance, rtol=0.0, atol=1e-9 * size)
    a, b = found.points[found.edges[:, 0]], found.points[found.edges[:, 1]]
    run = np.hypot(*(b - a).T)
    for share in BETWEEN:
        at = shapely.points(a + share * (b - a))
        assert shapely.distance(at, area).max() <= 1e-9 * size
        far = shapely.distance(at, area.boundary)
        one, other = found.radius[found.edges].T
        assert (far <= np.minimum(one + share * run, other + run - share * run) + 1e-9 * size).all()
        assert (far >= np.maximum(one - share * run, other - run + share * run) - 1e-9 * size).all()
    rings = [area.exterior, *area.interiors]
    assert len(found.edges) - len(found.points) + 1 <= len(rings) - 1


def upright(name: str, up: float) -> Polygon:
    """One of the areas, as it is or upside down."""
    return scale(shapely.from_wkt(LAST_PLACE[name]), 1.0, up, origin=(0, 0))


@pytest.mark.parametrize("up", [1.0, -1.0])
@pytest.mark.parametrize("name", sorted(LAST_PLACE))
def test_radii_are_distances_where_walls_are_as_short_as_rounding(name: str, up: float) -> None:
    area = upright(name, up)
    check(area, skeleton(area))


@pytest.mark.parametrize("name", WRONG)
def test_an_axis_with_a_wrong_radius_is_none(name: str) -> None:
    """The disc rolls along a wall whose direction is noise; the search ends, and all is wrong."""
    area = upright(name, 1.0)
    is_done, *_, fault = medial_axis(boundary_of(*rings_of_area(area)).mesh, 1.0, 1.0, 1e-3, 0.0)
    assert not is_done
    assert fault.miss > 1e-9 * extent(area)


def test_a_refusal_says_where(monkeypatch: pytest.MonkeyPatch) -> None:
    nothing = np.empty((0, 2)), np.empty(0), np.empty((0, 2), np.intp)
    monkeypatch.setattr(axes, "medial_axis", lambda *_: (False, *nothing, Fault(np.inf, 1.5, 0.25)))
    with pytest.raises(InvariantError, match=r"it is wrong about \(1\.5, 0\.25\), please report"):
        skeleton(shapely.box(0, 0, 3, 1))


@given(area=gapped())
@settings(max_examples=300)
def test_radii_are_distances_where_walls_nearly_touch(area: Polygon) -> None:
    """Some areas are refused, none has a wrong radius."""
    try:
        found = skeleton(area)
    except InvariantError as error:
        assert "it is wrong about" in str(error)  # noqa: PT017
        return
    check(area, found)
