"""What stays the same, or moves along, when an area is moved, turned, scaled or rewritten."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, note, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely import LineString, MultiLineString, MultiPolygon, Polygon
from shapely.affinity import affine_transform, scale, translate

from midrib import Curve, Strip, collapse, minimal_radii, split
from midrib.errors import InvalidAreaError
from tests.oracle import Referee
from tests.shapes import NAMED, VALID
from tests.strategies import areas, divided, ribbons, simple_areas, star_shaped, tangled, with_holes

Floats = NDArray[np.float64]
FAR = (5e5, 5e6)
FAR_BOUND = 64 * np.spacing(5e6)  # of radii and points: 64 units in the last place
oblique = st.one_of(tangled(), star_shaped(), ribbons())


def seen(strip: Strip, **options: object) -> Curve:
    """The curve; a draw in which no station sees anything does not count."""
    note(f"{strip.area.wkt}\nmain {strip.main.wkt}\nauxiliary {strip.auxiliary.wkt}")
    try:
        return minimal_radii(strip, **options)  # type: ignore[arg-type]
    except InvalidAreaError as error:
        assume("sees" not in str(error))
        raise


def generic(strip: Strip, n: int) -> Floats:
    """Stations at which no sight lines up with anything, but by accident."""
    shares: Floats = (np.arange(n) + np.sqrt(2.0) / 4.0) / n
    return shares * float(strip.main.length)


def decided(strip: Strip, stations: Floats) -> Floats:
    """Stations whose radius does not hang on a sight exactly along a wall or through a corner."""
    referee = Referee(strip.area, strip.auxiliary)
    answers = [referee.look(np.array(strip.main.interpolate(s).coords[0][:2])) for s in stations]
    doubts = np.array([answer.upper - answer.lower for answer in answers])
    sure = stations[doubts < 1e-6 * referee.size]
    assume(sure.size > 0)
    return np.asarray(sure)


def moved(strip: Strip, move: Callable[[object], object]) -> Strip:
    """The strip of the moved curves and area."""
    # The curves of a ring that is closed by a touch run along a hole: none can be given by hand.
    shell = strip.area.exterior.length
    assume(strip.main.length + strip.auxiliary.length <= shell * (1.0 + 1e-9))
    return Strip(*(move(g) for g in (strip.main, strip.auxiliary, strip.area)))


def check_radii(found: Curve, expected: Curve, points: Floats, bound: float) -> None:
    """Same stations and radii; the same Q wherever no other radius is nearly as short."""
    assert found.radii == pytest.approx(expected.radii, abs=bound)
    assert found.on_main == pytest.approx(points[0], abs=bound)
    assert found.on_auxiliary == pytest.approx(points[1], abs=bound)
    assert found.points == pytest.approx(points[2], abs=bound)


@given(strip=divided(), degrees=st.floats(0.0, 360.0), mirrored=st.booleans())
@settings(max_examples=150)
def test_curve_turns_and_mirrors_with_its_area(
    strip: Strip, degrees: float, mirrored: bool
) -> None:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    sign = -1.0 if mirrored else 1.0
    matrix = np.array([[c, -s * sign], [s, c * sign]])

    def move(g: object) -> object:
        return affine_transform(g, [*matrix.ravel(), 0.0, 0.0])

    turned_area = move(strip.area)
    assume(turned_area.is_valid)  # type: ignore[attr-defined]
    stations = decided(strip, generic(strip, 12))
    options = {"vertices": False, "end_clearance": None}
    curve = seen(strip, stations=stations, **options)
    turned = seen(moved(strip, move), stations=stations * (1.0 - 1e-15), **options)
    size = np.hypot(*np.ptp(shapely.get_coordinates(strip.area), axis=0))
    points = np.stack([p @ matrix.T for p in (curve.on_main, curve.on_auxiliary, curve.points)])
    check_radii(turned, curve, points, 1e-9 * size)


@given(
    strip=divided(),
    power=st.integers(-200, 200),
    share=st.sampled_from([0.1, 0.3]),
    clearance=st.sampled_from([None, "station", "proportional", 0.25]),
    ends=st.sampled_from(["main", "caps", None]),
)
@settings(max_examples=150)
def test_doubling_is_exact(
    strip: Strip, power: int, share: float, clearance: object, ends: object
) -> None:
    factor = 2.0**power
    strip = moved(strip, lambda g: g)
    spacing = share * strip.main.length
    larger = moved(strip, lambda g: scale(g, factor, factor, origin=(0, 0)))
    scaled = clearance * factor if isinstance(clearance, float) else clearance
    curve = seen(strip, spacing=spacing, end_clearance=clearance, ends=ends)
    big = seen(larger, spacing=spacing * factor, end_clearance=scaled, ends=ends)
    for name in ("stations", "on_main", "on_auxiliary", "points", "radii", "gaps", "jumps"):
        assert np.array_equal(getattr(big, name), factor * getattr(curve, name)), name
    assume(len(curve._path.points) > 1)  # a line of one point is a case of its own
    assert np.array_equal(coordinates(big.line), factor * coordinates(curve.line))


@given(area=areas, power=st.integers(-200, 200))
@settings(max_examples=150)
def test_doubling_is_exact_for_proposed_ends_too(area: Polygon, power: int) -> None:
    factor = 2.0**power
    line = collapse(area)
    larger = collapse(scale(area, factor, factor, origin=(0, 0)))
    assert np.array_equal(coordinates(larger), factor * coordinates(line))


@given(strip=divided(oblique))
@settings(max_examples=100)
def test_radii_far_from_the_origin_are_the_same_within_rounding(strip: Strip) -> None:
    shifted_area = translate(strip.area, *FAR)
    assume(shifted_area.is_valid)
    stations = generic(strip, 10)
    curve = seen(strip, stations=stations, vertices=False, end_clearance=None)
    far_strip = moved(strip, lambda g: translate(g, *FAR))
    assume(stations[-1] <= far_strip.main.length)
    far = seen(far_strip, stations=stations, vertices=False, end_clearance=None)
    points = np.stack([p + FAR for p in (curve.on_main, curve.on_auxiliary, curve.points)])
    # A graze turns rounding at the corner into more at the far bank.
    size = np.hypot(*np.ptp(shapely.get_coordinates(strip.area), axis=0))
    check_radii(far, curve, points, FAR_BOUND * max(1.0, size))


@pytest.mark.parametrize("name", ["rectangle", "L", "U", "hook", "river_with_island", "kite"])
def test_whole_numbers_far_from_the_origin_give_the_same_line(name: str) -> None:
    near = collapse(NAMED[name], count=64)
    far = collapse(translate(NAMED[name], *FAR), count=64)
    assert coordinates(far) == pytest.approx(coordinates(near) + FAR, abs=FAR_BOUND)


def rewritten(area: Polygon, start: int, *, turned: bool) -> Polygon:
    """The same area with rings that start elsewhere, and run the other way, and swap places."""
    rings = []
    for ring in (area.exterior, *area.interiors):
        points = np.roll(np.array(ring.coords)[:-1], start, axis=0)
        rings.append(points[::-1] if turned else points)
    holes = rings[:0:-1] if turned else rings[1:]
    return Polygon(rings[0], holes)


@given(area=areas, start=st.integers(1, 30), turned=st.booleans())
@settings(max_examples=200)
def test_rings_may_start_anywhere_and_run_either_way(
    area: Polygon, start: int, turned: bool
) -> None:
    same = rewritten(area, start, turned=turned)
    assert np.array_equal(coordinates(collapse(same)), coordinates(collapse(area)))


@pytest.mark.parametrize("name", VALID)
def test_named_rings_may_start_anywhere_and_run_either_way(name: str) -> None:
    area = VALID[name]
    expected = coordinates(collapse(area))
    for start in range(len(area.exterior.coords) - 1):
        for turned in (False, True):
            same = rewritten(area, start, turned=turned)
            assert np.array_equal(coordinates(collapse(same)), expected)


def enriched(line: LineString, *, closed: bool = False) -> LineString:
    """Every vertex twice, and the middle of every segment; halves are exact on squared paper."""
    points = np.array(line.coords)
    rows = [points[:1]]
    for a, b in pairwise(points):
        rows.append(np.array([a, (a + b) / 2.0, b]))
    return LineString(np.concatenate(rows if not closed else rows[1:]))


@given(strip=divided(tangled()))
@settings(max_examples=150)
def test_repeated_and_collinear_vertices_change_no_radius(strip: Strip) -> None:
    ring = np.array(strip.area.exterior.coords)
    assume(np.array_equal(ring, np.round(ring)))
    ends = np.concatenate([strip.main.coords, strip.auxiliary.coords])
    assume(np.array_equal(ends, np.round(ends)))
    shell = enriched(LineString(ring)).coords
    rich = Strip(enriched(strip.main), enriched(strip.auxiliary), Polygon(shell))
    stations = decided(strip, generic(strip, 9))
    options = {"vertices": False, "end_clearance": None}
    curve = seen(strip, stations=stations, **options)
    richer = seen(rich, stations=stations, **options)
    points = np.stack([curve.on_main, curve.on_auxiliary, curve.points])
    check_radii(richer, curve, points, 1e-12 * 40.0)


def is_decided(free: Curve) -> bool:
    """Whether no Q is just half as far from an end as P, where collapsed radii begin."""
    main, auxiliary = free.strip.main, free.strip.auxiliary
    arc = np.array([auxiliary.project(shapely.Point(q)) for q in free.on_auxiliary])
    from_start = np.abs(2.0 * arc - free.stations)
    from_end = np.abs(2.0 * (auxiliary.length - arc) - (main.length - free.stations))
    return bool(min(from_start.min(), from_end.min()) > 1e-9 * main.length)


@given(
    strip=divided(oblique),
    rule=st.sampled_from([{"count": 7}, {"count": 12}, {"percent": 12.5}, {"count": 1}]),
    vertices=st.booleans(),
    clearance=st.sampled_from([None, "station", "proportional"]),
)
@settings(max_examples=150)
def test_reversing_the_main_curve_reverses_the_curve(
    strip: Strip, rule: dict[str, float], vertices: bool, clearance: str | None
) -> None:
    back = Strip(strip.main.reverse(), strip.auxiliary, strip.area)
    assert back.auxiliary.equals_exact(strip.auxiliary.reverse())
    options = {**rule, "vertices": vertices, "end_clearance": clearance, "ends": None}
    assume(clearance is None or is_decided(seen(strip, **{**options, "end_clearance": None})))
    there, again = seen(strip, **options), seen(back, **options)
    bound = 1e-9 * max(strip.main.length, strip.auxiliary.length)
    assert again.stations[::-1] == pytest.approx(strip.main.length - there.stations, abs=bound)
    points = np.stack([there.on_main, there.on_auxiliary, there.points])[:, ::-1]
    assert again.radii[::-1] == pytest.approx(there.radii, abs=bound)
    assert again.on_main == pytest.approx(points[0], abs=bound)
    assert again.on_auxiliary == pytest.approx(points[1], abs=bound)


@given(some=st.lists(areas, min_size=1, max_size=5))
@settings(max_examples=60)
def test_an_array_gives_what_each_area_gives_alone(some: list[Polygon]) -> None:
    lines = collapse(some)
    for line, area in zip(lines, some, strict=True):
        assert np.array_equal(coordinates(line), coordinates(collapse(area)))


@given(some=st.lists(areas, min_size=2, max_size=4))
@settings(max_examples=60)
def test_parts_give_what_each_gives_alone(some: list[Polygon]) -> None:
    apart = [translate(area, 1000.0 * i) for i, area in enumerate(some)]
    lines = collapse(MultiPolygon(apart))
    assert isinstance(lines, MultiLineString)
    assert len(lines.geoms) == len(apart)
    for line, area in zip(lines.geoms, apart, strict=True):
        assert np.array_equal(coordinates(line), coordinates(collapse(area)))


def test_arrays_keep_their_shape() -> None:
    grid = np.array([[NAMED["L"], None], [NAMED["U"], NAMED["kite"]]], dtype=object)
    lines = collapse(grid)
    assert lines.shape == (2, 2)
    assert lines[0, 1] is None
    assert lines[1, 0].equals(collapse(NAMED["U"]))


def test_a_geoseries_keeps_its_index_and_crs() -> None:
    geopandas = pytest.importorskip("geopandas")
    areas_ = [NAMED["L"], None, NAMED["kite"]]
    series = geopandas.GeoSeries(areas_, index=["b", "a", "c"], crs="EPSG:2180")
    lines = collapse(series)
    assert isinstance(lines, geopandas.GeoSeries)
    assert list(lines.index) == ["b", "a", "c"]
    assert lines.crs == series.crs
    assert lines["a"] is None
    assert lines["c"].equals(collapse(NAMED["kite"]))
    frame = geopandas.GeoDataFrame(geometry=series)
    assert collapse(frame).equals(lines)


def test_problems_of_a_geoseries_are_named_by_its_labels() -> None:
    geopandas = pytest.importorskip("geopandas")
    series = geopandas.GeoSeries([NAMED["L"], shapely.Point(1, 1)], index=["road", "tree"])
    lines, problems = collapse(series, on_error="report")
    assert [(p.index, p.status) for p in problems] == [("tree", "refused")]
    assert lines["road"] is not None


# Metres in a degree of longitude and of latitude on WGS 84, as tabulated.
DEGREES = {0.0: (111319.491, 110574.276), 45.0: (78846.806, 111131.778), 60.0: (55800.0, 111412.2)}


@pytest.mark.parametrize("latitude", DEGREES)
@pytest.mark.parametrize("name", ["L", "U", "river_with_island", "hook"])
def test_degrees_give_the_line_of_the_scaled_plane(latitude: float, name: str) -> None:
    low, high = NAMED[name].bounds[1], NAMED[name].bounds[3]
    plane = translate(NAMED[name], 0.0, -(low + high) / 2.0)
    across, along = DEGREES[latitude]
    to_degrees = [100.0 / across, 0.0, 0.0, 100.0 / along, 19.0, latitude]
    line = collapse(affine_transform(plane, to_degrees), geographic=True, spacing=50.0)
    expected = collapse(scale(plane, 100.0, 100.0, origin=(0, 0)), spacing=50.0)
    back = (coordinates(line) - (19.0, latitude)) * (across, along)
    tabulated = 2e-5 * 1000.0  # the table has five or six digits
    assert LineString(back).hausdorff_distance(expected) <= tabulated


def test_a_geographic_crs_is_noticed() -> None:
    geopandas = pytest.importorskip("geopandas")
    area = affine_transform(NAMED["L"], [1e-3, 0.0, 0.0, 1e-3, 19.0, 52.0])
    series = geopandas.GeoSeries([area], crs="EPSG:4326")
    aware, planar = collapse(series)[0], collapse(series, geographic=False)[0]
    assert aware.equals(collapse(area, geographic=True))
    assert not aware.equals(planar)
    assert planar.equals(collapse(area))


@given(area=st.one_of(simple_areas, with_holes()))
@settings(max_examples=60)
def test_split_and_collapse_agree(area: Polygon) -> None:
    """``collapse`` is ``minimal_radii`` of ``split`` with other defaults."""
    curve = minimal_radii(split(area), ends="caps", centring="centred", end_clearance=None)
    assert np.array_equal(coordinates(curve.line), coordinates(collapse(area)))


def coordinates(line: object) -> Floats:
    """Coordinates of a line."""
    return np.asarray(shapely.get_coordinates(line))
