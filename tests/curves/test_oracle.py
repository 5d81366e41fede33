"""Radii against brute force: see ``tests.oracle``."""

from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, note, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from midrib import Curve, Strip, minimal_radii, split
from midrib.errors import InvalidAreaError
from tests.oracle import (
    Referee,
    exact_nearest,
    exact_points,
    exactly_visible,
    run_length,
    stations_by,
)
from tests.shapes import NAMED
from tests.strategies import combs, divided, polyominoes, simple_areas, spirals, with_holes

Floats = NDArray[np.float64]
AGREES = 1e-9  # of the size

rules: st.SearchStrategy[dict[str, Any]] = st.one_of(
    st.just({}),
    st.fixed_dictionaries({"count": st.integers(1, 25), "vertices": st.booleans()}),
    st.fixed_dictionaries({"percent": st.sampled_from([5.0, 12.5, 30.0, 100.0])}),
    st.fixed_dictionaries({"share": st.sampled_from([0.07, 0.25, 0.4]), "vertices": st.booleans()}),
)


def options_of(rule: dict[str, float], strip: Strip) -> dict[str, float]:
    """A rule's options; ``share`` is a spacing in lengths of the main curve."""
    options = dict(rule)
    if "share" in options:
        options["spacing"] = options.pop("share") * strip.main.length
    return options


def seen(strip: Strip, **options: object) -> Curve | None:
    """The curve, None where no station sees anything."""
    try:
        return minimal_radii(strip, ends="main", **options)  # type: ignore[arg-type]
    except InvalidAreaError as error:
        assert "sees" in str(error)  # noqa: PT017
        return None


def rows_at(curve: Curve | None, station: float, slack: float) -> NDArray[np.intp]:
    """Rows of the radii drawn at a station."""
    if curve is None:
        return np.empty(0, dtype=np.intp)
    return np.flatnonzero(np.abs(curve.stations - station) <= slack)


def check(strip: Strip, curve: Curve | None, stations: Floats, low: Floats, high: Floats) -> None:
    """Hold the radii of a curve against the referee, station by station."""
    note(f"main {strip.main.wkt}\nauxiliary {strip.auxiliary.wkt}")
    referee = Referee(strip.area, strip.auxiliary)
    near = AGREES * referee.size
    length = strip.main.length
    used = np.zeros(0 if curve is None else curve.radii.size, dtype=np.bool_)
    for station, lowest, highest in zip(stations, low, high, strict=True):
        rows = rows_at(curve, station, 1e-12 * length)
        p = np.array(strip.main.interpolate(station).coords[0][:2])
        answer = referee.look(p, lowest, highest)
        if rows.size == 0:
            assert answer.upper == np.inf, f"no radius at {station}, oracle: {answer}"
            continue
        assert curve is not None
        used[rows] = True
        for row in rows:
            on_main, on_auxiliary = curve.on_main[row], curve.on_auxiliary[row]
            radius = curve.radii[row]
            assert np.hypot(*(on_main - p)) <= near
            assert shapely.Point(on_auxiliary).distance(referee.curve) <= near
            assert radius == pytest.approx(np.hypot(*(on_auxiliary - on_main)), abs=near)
            assert answer.lower - near <= radius <= answer.upper + near, (station, answer, radius)
            assert referee.maybe_visible(on_main, on_auxiliary), f"{station}: Q is out of sight"
            middle = (on_main + on_auxiliary) / 2.0
            assert np.array_equal(curve.points[row], middle)
    assert used.all(), "a radius belongs to no station of the rule"
    check_gaps(curve, stations, length)


def check_gaps(curve: Curve | None, stations: Floats, length: float) -> None:
    """Gaps are the runs of stations without a radius, no more and no less."""
    if curve is None:
        return
    blind = [s for s in stations if rows_at(curve, s, 1e-12 * length).size == 0]
    listed = [
        s
        for s in stations
        if any(a - 1e-12 * length <= s <= b + 1e-12 * length for a, b in curve.gaps)
    ]
    assert listed == blind
    for a, b in curve.gaps:
        assert a <= b
        assert np.abs(np.asarray(blind) - a).min() <= 1e-12 * length
        assert np.abs(np.asarray(blind) - b).min() <= 1e-12 * length


def everywhere(stations: Floats) -> tuple[Floats, Floats]:
    """No bounds on the arc length of Q."""
    return np.full(stations.size, -np.inf), np.full(stations.size, np.inf)


def default_count(strip: Strip) -> int:
    """Intervals on the main curve by default: none longer than the mean width."""
    outline = shapely.Polygon(strip.area.exterior)
    width = 2.0 * outline.area / (strip.main.length + strip.auxiliary.length)
    return max(int(np.ceil(strip.main.length / width)), 2)


@given(strip=divided(), rule=rules)
@settings(max_examples=400)
def test_radii_are_those_of_brute_force(strip: Strip, rule: dict[str, float]) -> None:
    options = options_of(rule, strip)
    curve = seen(strip, end_clearance=None, **options)
    if not rule:
        assume(default_count(strip) < 60)
        options = {"count": default_count(strip)}
    stations = stations_by(strip.main, strip.area, **options)  # type: ignore[arg-type]
    check(strip, curve, stations, *everywhere(stations))


@given(strip=divided(with_holes()), count=st.integers(1, 20))
@settings(max_examples=300)
def test_radii_around_holes_are_those_of_brute_force(strip: Strip, count: int) -> None:
    curve = seen(strip, end_clearance=None, count=count)
    stations = stations_by(strip.main, strip.area, count=count)
    check(strip, curve, stations, *everywhere(stations))


@given(strip=divided(simple_areas), shares=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=9))
@settings(max_examples=100)
def test_radii_at_given_stations_are_those_of_brute_force(
    strip: Strip, shares: list[float]
) -> None:
    stations = np.unique(np.array(shares) * strip.main.length)
    assume(stations.size == 1 or np.diff(stations).min() > 1e-9 * strip.main.length)
    curve = seen(strip, end_clearance=None, stations=stations, vertices=False)
    check(strip, curve, stations, *everywhere(stations))
    if curve is not None:
        assert set(curve.stations) <= set(stations)


def shared_ends(strip: Strip) -> tuple[bool, bool]:
    """Whether the curves share their start and their end."""
    main, auxiliary = strip.main.coords, strip.auxiliary.coords
    return main[0] == auxiliary[0], main[-1] == auxiliary[-1]


def paces(strip: Strip, clearance: str, s: Floats, *, backwards: bool) -> Floats:
    """How far from the shared end Q has to be, for stations s from that end."""
    reach = float(strip.auxiliary.length)
    if clearance == "station":
        return np.asarray(np.minimum(s, reach), dtype=np.float64)
    main = run_length(strip.main, backwards=backwards)
    auxiliary = run_length(strip.auxiliary, backwards=backwards)
    on_run = np.where(s <= main, s * auxiliary / main, auxiliary + s - main)
    return np.asarray(np.minimum(on_run, reach), dtype=np.float64)


def crowd(strip: Strip, free: Curve | None, stations: Floats, *, backwards: bool) -> list[int]:
    """Stations next to a shared end, as far as each free radius is nearer to it than half of P."""
    found: list[int] = []
    for i in reversed(range(stations.size)) if backwards else range(stations.size):
        s = strip.main.length - stations[i] if backwards else stations[i]
        rows = rows_at(free, stations[i], 1e-12 * strip.main.length)
        if s > 0.0:
            if rows.size == 0 or free is None:
                return found if len(found) > 1 else []
            arcs = [arc_of(strip, free.on_auxiliary[row]) for row in rows]
            from_end = [strip.auxiliary.length - a if backwards else a for a in arcs]
            assume(abs(max(from_end) - s / 2.0) > 1e-9 * strip.main.length)
            if max(from_end) >= s / 2.0:
                return found if len(found) > 1 else []
        found.append(i)
    return []  # no radius keeps clear of this end: it is none


def arc_of(strip: Strip, point: Floats) -> float:
    """Arc length of a point of the auxiliary curve."""
    return float(strip.auxiliary.project(shapely.Point(point)))


@given(
    strip=divided(),
    clearance=st.sampled_from(["station", "proportional"]),
    count=st.integers(2, 24),
)
@settings(max_examples=150)
def test_radii_that_keep_clear_of_shared_ends(strip: Strip, clearance: str, count: int) -> None:
    stations = stations_by(strip.main, strip.area, count=count)
    free = seen(strip, end_clearance=None, count=count)
    low, high = everywhere(stations)
    starts, ends = shared_ends(strip)
    if starts and (crowded := crowd(strip, free, stations, backwards=False)):
        low[crowded] = paces(strip, clearance, stations[crowded], backwards=False)
    if ends and (crowded := crowd(strip, free, stations, backwards=True)):
        to_go = strip.main.length - stations[crowded]
        high[crowded] = strip.auxiliary.length - paces(strip, clearance, to_go, backwards=True)
    curve = seen(strip, end_clearance=clearance, count=count)
    check(strip, curve, stations, low, high)


@given(
    strip=divided(),
    share=st.floats(0.0, 0.45) | st.floats(0.55, 0.7),
    count=st.integers(1, 15),
)
@settings(max_examples=100)
def test_radii_that_keep_a_length_clear_of_shared_ends(
    strip: Strip, share: float, count: int
) -> None:
    clearance = share * strip.auxiliary.length
    stations = stations_by(strip.main, strip.area, count=count)
    low, high = everywhere(stations)
    starts, ends = shared_ends(strip)
    if starts:
        low[:] = clearance
    if ends:
        high[:] = strip.auxiliary.length - clearance
    curve = seen(strip, end_clearance=clearance, count=count)
    check(strip, curve, stations, low, high)


@given(
    strip=divided(st.one_of(polyominoes(), combs(), spirals())), step=st.sampled_from([0.5, 0.25])
)
@settings(max_examples=80)
def test_radii_and_ties_on_squared_paper_are_exact(strip: Strip, step: float) -> None:
    """Sights along walls and through corners are open, and every tie is listed, in order."""
    assume(strip.main.length < 60)
    note(f"main {strip.main.wkt}\nauxiliary {strip.auxiliary.wkt}")
    curve = seen(strip, end_clearance=None, spacing=step)
    for station in stations_by(strip.main, strip.area, spacing=step):
        p = np.round(np.array(strip.main.interpolate(station).coords[0]) * 64.0) / 64.0
        nearest = exact_nearest(strip.area, strip.auxiliary, (Fraction(p[0]), Fraction(p[1])))
        rows = rows_at(curve, station, 1e-12)
        if not nearest:
            assert rows.size == 0
            continue
        assert rows.size > 0, f"no radius at {station}"
        assert curve is not None
        expected = np.unique(np.array(nearest, dtype=np.float64), axis=0)
        radius = np.hypot(*(expected[0] - p))
        assert curve.on_main[rows] == pytest.approx(np.tile(p, (rows.size, 1)), abs=1e-12)
        assert curve.radii[rows] == pytest.approx(np.full(rows.size, radius), abs=1e-12)
        if (curve.on_main[rows] == p).all():
            found = curve.on_auxiliary[rows]
            assert found[np.lexsort(found.T[::-1])] == pytest.approx(expected, abs=1e-12)
            arcs = [arc_of(strip, point) for point in found]
            assert arcs == sorted(arcs)


@pytest.mark.parametrize("name", sorted(set(NAMED) - {"T", "plus", "comb"}))
def test_the_referee_hardly_ever_doubts(name: str) -> None:
    """Bounds that are wide apart would let anything pass; walls in one line do leave doubt."""
    strip = split(NAMED[name])
    referee = Referee(strip.area, strip.auxiliary)
    stations = (np.arange(50) + 0.4142) * strip.main.length / 50
    answers = [referee.look(np.array(strip.main.interpolate(s).coords[0][:2])) for s in stations]
    assert sum(a.upper - a.lower > 1e-4 * referee.size for a in answers) <= 1


def test_exact_visibility_allows_to_touch_and_refuses_to_leave() -> None:
    corridor = shapely.from_wkt("POLYGON ((0 0, 4 0, 4 3, 3 3, 3 1, 1 1, 1 3, 0 3, 0 0))")
    points = exact_points(corridor.exterior)
    sides = list(pairwise(points))
    zero, one, three, four = (Fraction(k) for k in (0, 1, 3, 4))
    assert exactly_visible((zero, one), (four, one), sides)  # along the wall
    assert exactly_visible((one, three), (one, zero), sides)  # along another, and beyond
    assert not exactly_visible((one, three), (three, three), sides)  # across the mouth
    assert exactly_visible((zero, three), (four / 4 * 3 / 2, zero), sides)  # through a corner


def test_a_sight_along_a_wall_ends_where_a_hole_touches_it() -> None:
    """The closed segment lies in the closed area, but leads through no part of it."""
    area = shapely.from_wkt("POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0), (2 0, 3 1, 1 1, 2 0))")
    auxiliary = shapely.from_wkt("LINESTRING (0 2, 0 0)")
    main = shapely.from_wkt("LINESTRING (0 2, 4 2, 4 0, 0 0)")
    corner = Fraction(4), Fraction(0)
    assert exact_nearest(area, auxiliary, corner) == [(Fraction(0), Fraction(0))]
    curve = minimal_radii(
        Strip(main, auxiliary, area), stations=[2.0, 6.0], vertices=False, end_clearance=None
    )
    assert curve.on_main.tolist() == [[2.0, 2.0]]
    assert curve.gaps.tolist() == [[6.0, 6.0]]
