"""The limit curve: chains within a tolerance of it, against brute force and closed forms."""

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, currently_in_test_context, given, note, settings
from hypothesis import strategies as st
from shapely import LineString, MultiLineString, Point, Polygon
from shapely.affinity import scale

from midrib import Curve, Strip, collapse, minimal_radii, split
from midrib.errors import InvalidAreaError, ParameterError
from midrib.kernels import limit as kernels
from midrib.kernels.boxtree import GRAZE
from midrib.types import Floats
from tests.oracle import Referee
from tests.shapes import NAMED, rectangle, wavy_ribbon
from tests.strategies import combs, divided, polyominoes, simple_areas, tangled, with_holes

if TYPE_CHECKING:
    from collections.abc import Callable

ROUNDING = 1e-9  # of the size
STEPS = 400  # of the dense curve
NEAR_EVENT = 1e-6  # of the main curve's length: stations that rounding may put beyond an event
ARCS_WITHIN = 2.0**-14  # of the mean width, whatever the tolerance


def limit(strip: Strip, tolerance: float | str, **options: Any) -> Curve:
    """The curve, as bare as possible; a draw in which nothing is seen does not count."""
    if currently_in_test_context():
        note(f"{strip.area.wkt}\nmain {strip.main.wkt}\nauxiliary {strip.auxiliary.wkt}")
    plain: dict[str, Any] = {"ends": None, "end_clearance": None}
    try:
        return minimal_radii(strip, tolerance=tolerance, **(plain | options))
    except InvalidAreaError as error:
        assume("sees" not in str(error) and "one point" not in str(error))
        raise


def dense(strip: Strip, **options: Any) -> Curve:
    """Sampled at stations that hit no event but by accident."""
    stations = (np.arange(STEPS) + np.sqrt(2.0) / 4.0) / STEPS * strip.main.length
    plain: dict[str, Any] = {"ends": None, "end_clearance": None, "vertices": False}
    return minimal_radii(strip, stations=stations, **(plain | options))


def runs_of(curve: Curve) -> MultiLineString:
    """What joins the points of a curve, gaps left out."""
    gaps = {float(start) for start in curve.gaps[:, 0]}
    steps = [
        (p, q)
        for (p, q), s, t in zip(
            pairwise(curve.points), curve.stations[:-1], curve.stations[1:], strict=True
        )
        if not (t > s and float(s) in gaps)
    ]
    return MultiLineString([LineString(step) for step in steps])


def is_clear(curve: Curve, stations: Floats, length: float) -> "np.ndarray[Any, Any]":
    """Which stations are apart from the events of a curve whose every event is a vertex."""
    events = np.concatenate([curve.stations, curve.gaps.ravel(), [0.0, length]])
    off = np.abs(events[:, None] - stations).min(axis=0)
    return np.asarray(off > NEAR_EVENT * length)


def check_against_samples(strip: Strip, tolerance: float, **options: Any) -> None:
    """Every point of the dense curve is near the chain, and the chain near the dense curve."""
    curve, exact = limit(strip, tolerance, **options), limit(strip, 0.0, **options)
    sampled, length = dense(strip, **options), strip.main.length
    clear = is_clear(exact, sampled.stations, length)
    referee = Referee(strip.area, strip.auxiliary)
    allowed = max(tolerance, ARCS_WITHIN * strip.layout.mean_width) + ROUNDING * referee.size
    off = shapely.distance(shapely.points(sampled.points), runs_of(curve))
    for row in np.flatnonzero((off > allowed) & clear):
        assert is_in_doubt(referee, sampled.on_main[row]), f"{sampled.stations[row]}: {off[row]}"
    # The chain from its vertices to the limit curve: every vertex of the one is on the other.
    on_limit = shapely.distance(shapely.points(curve.points), runs_of(exact))
    most = ARCS_WITHIN * strip.layout.mean_width + ROUNDING * referee.size
    assert on_limit.max(initial=0.0) <= most
    # Gaps are where samples see nothing.
    every = (np.arange(STEPS) + np.sqrt(2.0) / 4.0) / STEPS * length
    for station in every[is_clear(exact, every, length)]:
        is_gap = any(a <= station <= b for a, b in exact.gaps)
        if is_gap == (np.abs(sampled.stations - station).min() <= ROUNDING * length):
            p = np.array(strip.main.interpolate(station).coords[0][:2])
            assert is_in_doubt(referee, p), f"{station}: {is_gap}"


def is_in_doubt(referee: Referee, p: Floats) -> bool:
    """Whether it hangs on rounding what P sees: along its own wall, past another corner."""
    answer = referee.look(p)
    return answer.upper - answer.lower > ROUNDING * referee.size


@given(strip=divided(simple_areas), share=st.sampled_from([0.0, 1e-3, 0.05, 0.5]))
@settings(max_examples=120)
def test_the_chain_is_within_the_tolerance_of_samples(strip: Strip, share: float) -> None:
    check_against_samples(strip, share * strip.layout.mean_width)


@pytest.mark.parametrize(
    "name", ["chevron", "comb", "hook", "kite", "river_with_island", "three_islands", "wavy"]
)
def test_named_areas_are_within_the_tolerance_of_samples(name: str) -> None:
    strip = split(wavy_ribbon(60, 0.4) if name == "wavy" else NAMED[name])
    check_against_samples(strip, strip.layout.mean_width / 20.0)


@given(strip=divided(with_holes()), share=st.sampled_from([0.0, 0.05]))
@settings(max_examples=80)
def test_around_holes_the_chain_is_within_the_tolerance(strip: Strip, share: float) -> None:
    check_against_samples(strip, share * strip.layout.mean_width)


@given(strip=divided(st.one_of(polyominoes(), combs())))
@settings(max_examples=80)
def test_sights_along_walls_and_ties_are_events_like_others(strip: Strip) -> None:
    check_against_samples(strip, 0.0)


@given(strip=divided(simple_areas), share=st.sampled_from([0.0, 0.11, 0.3, 0.45, 0.6]))
@settings(max_examples=60)
def test_a_length_of_end_clearance_holds_for_the_limit_too(strip: Strip, share: float) -> None:
    clearance = share * strip.auxiliary.length
    try:
        dense(strip, end_clearance=clearance)
    except InvalidAreaError:
        assume(False)
    check_against_samples(strip, 0.0, end_clearance=clearance)


@given(strip=divided(tangled()), count=st.integers(5, 15))
@settings(max_examples=60)
def test_radii_at_events_are_those_of_brute_force(strip: Strip, count: int) -> None:
    """Between two events next to each other the referee finds what their motion says."""
    curve = limit(strip, 0.0)
    referee = Referee(strip.area, strip.auxiliary)
    s, same = curve.stations, np.flatnonzero(np.diff(curve.stations) > 0.0)
    rows = same[np.argsort(np.diff(s)[same])[-count:]]
    for i in rows:
        if any(s[i] <= a < s[i + 1] for a, _ in curve.gaps):
            continue
        p = (curve.on_main[i] + curve.on_main[i + 1]) / 2.0
        straight = strip.main.distance(Point(p)) <= ROUNDING * referee.size
        if not straight:
            continue  # P has turned a corner in between
        answer = referee.look(p)
        most = max(curve.radii[i], curve.radii[i + 1])
        assert answer.lower <= most + ROUNDING * referee.size


@given(strip=divided(simple_areas), share=st.floats(1e-3, 0.5))
@settings(max_examples=80)
def test_halving_the_tolerance_never_worsens_the_chain(strip: Strip, share: float) -> None:
    tolerance = share * strip.layout.mean_width
    exact = limit(strip, 0.0)
    points = shapely.points(exact.points)
    off = [
        float(shapely.distance(points, runs_of(limit(strip, t))).max())
        for t in (tolerance, tolerance / 2.0)
    ]
    slack = ARCS_WITHIN * strip.layout.mean_width
    assert off[1] <= max(off[0], 0.0) + slack
    assert limit(strip, tolerance).radii.size <= limit(strip, tolerance / 2.0).radii.size


def without_glances(strip: Strip, tolerance: float, **options: Any) -> Curve:
    """The curve by looking through windows only."""
    usual: Callable[..., Any] = kernels.draw_limit

    def plain(*args: Any) -> Any:
        return usual(*args[:-1], False)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(kernels, "draw_limit", plain)
        return limit(strip, tolerance, **options)


def check_glances(strip: Strip, **options: Any) -> None:
    """Knots and gaps are the same, up to rounding and to how equally near points are told apart."""
    quick, plain = limit(strip, 0.0, **options), without_glances(strip, 0.0, **options)
    size = Referee(strip.area, strip.auxiliary).size
    within = ROUNDING * size
    for one, other in ((quick, plain), (plain, quick)):
        knots = shapely.multipoints(other.points)
        off = shapely.distance(shapely.points(one.points), knots)
        # A knot more or less where motions tie all along: it is on the other curve even so.
        on_curve = shapely.distance(shapely.points(one.points), runs_of(other))
        assert np.count_nonzero(off > NEAR_EVENT * size) <= 2
        assert on_curve.max(initial=0.0) <= ARCS_WITHIN * strip.layout.mean_width + within
    assert quick.gaps == pytest.approx(plain.gaps, abs=NEAR_EVENT * strip.main.length)
    same = np.interp(quick.stations, plain.stations, plain.radii)
    clear = is_clear(plain, quick.stations, strip.main.length)
    assert quick.radii[clear] == pytest.approx(same[clear], rel=1e-3)


@given(strip=divided(st.one_of(simple_areas, tangled(), polyominoes(), combs())))
@settings(max_examples=150)
def test_a_glance_finds_what_looking_around_does(strip: Strip) -> None:
    check_glances(strip)


@given(strip=divided(with_holes()))
@settings(max_examples=50)
def test_glances_leave_islands_to_looking_around(strip: Strip) -> None:
    check_glances(strip)


@given(strip=divided(simple_areas), share=st.sampled_from([0.11, 0.3]))
@settings(max_examples=50)
def test_glances_keep_the_end_clearance(strip: Strip, share: float) -> None:
    try:
        check_glances(strip, end_clearance=share * strip.auxiliary.length)
    except InvalidAreaError:
        assume(False)


@pytest.mark.parametrize("name", ["L", "chevron", "comb", "hook", "kite", "river_with_island"])
@pytest.mark.parametrize("clearance", [None, "station", "proportional"])
def test_named_areas_at_a_glance(name: str, clearance: str | None) -> None:
    check_glances(split(NAMED[name]), end_clearance=clearance)


def test_a_rectangle_needs_two_stations() -> None:
    curve = limit(split(rectangle(10, 2)), 0.0, ends="caps")
    assert curve.stations.tolist() == [0.0, 10.0]
    assert curve.line.equals(LineString([(0, 1), (10, 1)]))


def test_an_elbow_has_its_events_and_no_other() -> None:
    """Along the outer bank: foot, the inner corner at rest, foot."""
    curve = limit(split(NAMED["L"]), 0.0, ends="caps")
    assert curve.line.normalize().equals(
        LineString([(1, 10), (1, 2), (1, 1), (2, 1), (10, 1)]).normalize()
    )


@pytest.mark.parametrize("beta", [10.0, 30.0, 60.0])
def test_a_wedge_has_one_straight_piece(beta: float) -> None:
    """tan phi = sin b cos b / (1 + cos^2 b), up to where the foot leaves the other leg."""
    angle = np.radians(beta)
    tip, leg = (0.0, 0.0), (10.0 * np.cos(angle), 10.0 * np.sin(angle))
    curve = limit(Strip(LineString([tip, (10.0, 0.0)]), LineString([tip, leg])), 0.0)
    assert curve.stations.tolist() == [0.0, 10.0]
    x, y = curve.points[-1]
    assert y / x == pytest.approx(np.sin(angle) * np.cos(angle) / (1.0 + np.cos(angle) ** 2))


def test_a_graze_is_an_arc_of_a_hyperbola() -> None:
    """From under a shelf of the main bank Q moves as the sight past the shelf's edge says."""
    main = LineString([(-20, 5), (-20, 0), (10, 0), (10, 1), (4, 1), (4, 4), (20, 4)])
    strip = Strip(main, LineString([(-20, 5), (20, 15)]), Polygon([*main.coords, (20, 15)]))
    check_against_samples(strip, 0.0)
    coarse, fine = limit(strip, 0.1), limit(strip, 0.001)
    grazes = (fine._radii.kind == GRAZE) & (fine.on_main[:, 1] == 0.0)
    assert np.count_nonzero(grazes) > 4
    x = fine.on_main[grazes][:, 0]
    beyond = x + (40.0 + x) / x * (4.0 - x)  # past (4, 1) to the bank at 10 + x / 4
    assert fine.on_auxiliary[grazes][:, 0] == pytest.approx(beyond)
    assert fine.radii.size > coarse.radii.size


def test_behind_a_named_tooth_the_nearest_point_is_suddenly_far() -> None:
    """A tooth of the main bank hides a tongue of the other one; beyond it only the bank is seen."""
    main = LineString([(0, 0), (5.5, 0), (5.5, 3), (6, 3), (6, 0), (12, 0)])
    other = LineString([(0, 10), (4, 10), (4, 2), (5, 2), (5, 10), (12, 10)])
    strip = Strip(main, other)
    check_against_samples(strip, 0.0)


def test_a_way_past_an_island_stays_on_its_side() -> None:
    r"""Where Q jumps an island is in the way: the curve passes above it, a straight one below.

       Q ._                 _. Q         tolerance 1.1, more than the knots are off the way below
            \    over     /
       S .       <>       . S            over the island it is 1.7 off
    --------- P ---------
    """
    main = LineString([(-30, 0), (30, 0)])
    other = LineString([(-30, 6), (-6, 8), (-1, 20), (1, 20), (6, 8), (30, 6)])
    island = [(-0.3, 4), (0, 3.2), (0.3, 4), (0, 4.7)]
    area = Polygon([*main.coords, *other.coords[::-1]], [island])
    strip, tolerance = Strip(main, other, area), 1.1
    exact, curve = limit(strip, 0.0), limit(strip, tolerance)
    assert exact.line.distance(Point(0, 4.7)) == 0.0
    assert curve.line.distance(Point(0, 4.7)) == 0.0
    assert shapely.hausdorff_distance(exact.line, curve.line, 0.01) <= tolerance


@pytest.mark.parametrize("power", [-200, -31, 1, 60, 200])
@pytest.mark.parametrize("name", ["L", "chevron", "comb", "river_with_island"])
def test_doubling_is_exact(name: str, power: int) -> None:
    factor = 2.0**power
    strip = split(NAMED[name])
    larger = Strip(
        *(
            scale(g, factor, factor, origin=(0, 0))
            for g in (strip.main, strip.auxiliary, strip.area)
        )
    )
    curve = limit(strip, 0.01, ends="caps")
    grown = limit(larger, 0.01 * factor, ends="caps")
    assert np.array_equal(grown.stations, curve.stations * factor)
    assert np.array_equal(grown.points, curve.points * factor)


@given(strip=divided(simple_areas), share=st.sampled_from([0.0, 0.03]))
@settings(max_examples=60)
def test_reversed_curves_have_the_reversed_chain(strip: Strip, share: float) -> None:
    tolerance = share * strip.layout.mean_width
    curve = limit(strip, tolerance)
    turned = limit(Strip(strip.main.reverse(), strip.auxiliary.reverse(), strip.area), tolerance)
    allowed = 2.0 * tolerance + ARCS_WITHIN * strip.layout.mean_width
    allowed += 1e-7 * Referee(strip.area, strip.auxiliary).size
    for one, other in ((curve, turned), (turned, curve)):
        assert shapely.distance(shapely.points(one.points), runs_of(other)).max() <= allowed


@given(area=st.one_of(simple_areas, with_holes()), centring=st.sampled_from(["none", "symmetric"]))
@settings(max_examples=60)
def test_lines_stay_inside(area: Polygon, centring: str) -> None:
    try:
        line = collapse(area, centring=centring, tolerance="1%")
    except InvalidAreaError:
        assume(False)
    assert area.covers(line)
    assert line.is_simple


@pytest.mark.parametrize("clearance", ["station", "proportional"])
def test_end_clearance_in_a_right_angle_ends_where_radii_keep_clear(clearance: str) -> None:
    """From a corner of 90 degrees on, every free radius is the corner itself."""
    strip = split(rectangle(10, 2), start=(0, 0), end=(10, 2))
    options: dict[str, Any] = {"ends": None, "end_clearance": clearance}
    curve = minimal_radii(strip, tolerance=0.0, **options)
    sampled = minimal_radii(strip, count=400, **options)
    off = shapely.distance(shapely.points(sampled.points), runs_of(curve))
    assert np.quantile(off, 0.98) <= 1e-9


@pytest.mark.parametrize(
    "option",
    [{"count": 3}, {"spacing": 1.0}, {"percent": 5.0}, {"vertices": True}, {"stations": [1.0]},
     {"skip": "bays"}],
)  # fmt: skip
@pytest.mark.parametrize("centring", ["none", "symmetric"])
def test_a_tolerance_chooses_the_stations_alone(option: dict[str, Any], centring: str) -> None:
    (name,) = option
    with pytest.raises(ParameterError, match=f"tolerance and {name} exclude each other"):
        collapse(rectangle(9, 2), tolerance=0.1, centring=centring, **option)
    assert collapse(rectangle(9, 2), tolerance=0.1, **option).length > 0.0


@pytest.mark.parametrize("tolerance", [-1.0, np.inf, np.nan, "1", "x%", "-1%", True, [1]])
def test_tolerances_that_are_no_length_are_refused(tolerance: Any) -> None:
    with pytest.raises(ParameterError, match=r"tolerance is .*, expected a length of 0 or more"):
        minimal_radii(split(rectangle(9, 2)), tolerance=tolerance)


def test_a_share_is_one_of_the_mean_width() -> None:
    strip = split(NAMED["river_with_island"])
    width = strip.layout.mean_width
    assert limit(strip, "2%").line.equals(limit(strip, 0.02 * width).line)
    centred = minimal_radii(strip, centring="centred", tolerance="1%")
    assert centred.line.equals(minimal_radii(strip, centring="centred").line)
