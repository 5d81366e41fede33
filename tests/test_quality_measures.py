"""How good a line is: closed forms, oracles, and what must hold for every line."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely import LineString, MultiLineString, MultiPolygon, Point, Polygon, box
from shapely.affinity import rotate, scale, translate

from midrib import Strip, collapse, measures, minimal_radii, split
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError

from .shapes import annulus_sector, rectangle, wedge

RECTANGLE = box(0, 0, 10, 2)
AREAS = [
    RECTANGLE,
    Polygon(RECTANGLE.exterior.coords, [[(4, 0.5), (6, 0.5), (6, 1.0), (4, 1.0)]]),
    MultiPolygon([RECTANGLE, box(20, 0, 30, 4)]),
]
BANKS = Strip(LineString([(0, 0), (10, 0)]), LineString([(0, 2), (10, 2)]))
MIDDLE = LineString([(0, 1), (10, 1)])
BOW_TIE = Polygon([(0, 0), (1, 1), (1, 0), (0, 1)])
POWERS = st.integers(-200, 200)

Floats = NDArray[np.float64]
grid = st.integers(-9, 9)
lines = st.lists(st.tuples(grid, grid), min_size=2, max_size=7, unique=True).map(LineString)


def times(geometry: Any, factor: float) -> Any:
    """A geometry scaled about the origin."""
    return scale(geometry, factor, factor, origin=(0, 0))


def dense(line: LineString, step: float) -> Floats:
    """Points on a line, vertices among them, at most a step apart."""
    points = shapely.get_coordinates(line)
    found = [points[:1]]
    for a, b in pairwise(points):
        count = int(np.ceil(np.hypot(*(b - a)) / step))
        found.append(a + np.arange(1, count + 1)[:, None] / count * (b - a))
    return np.concatenate(found)


def discrete_frechet(p: Floats, q: Floats) -> float:
    """Shortest leash of two frogs that only stop at points: discrete."""
    apart = np.hypot(*(p[:, None] - q[None]).transpose(2, 0, 1))
    leash = np.maximum.accumulate(apart[0])
    for row in apart[1:]:
        before, leash = leash, np.empty_like(leash)
        leash[0] = max(before[0], row[0])
        for j in range(1, len(q)):
            leash[j] = max(row[j], min(before[j], before[j - 1], leash[j - 1]))
    return float(leash[-1])


# centredness


def test_the_middle_is_centred_and_a_bank_is_not() -> None:
    line = LineString([(0, 1), (2, 1.5), (5, 0.5), (9, 2)])
    assert measures.centredness(line, BANKS).tolist() == [0.0, 0.5, 0.5, 1.0]


def test_centredness_is_offset_over_half_width_on_an_annulus() -> None:
    sector = annulus_sector(3.0, 5.0, 1.5, 400)
    strip = split(sector, start=(4.0, 0.0), end=(4.0 * np.cos(1.5), 4.0 * np.sin(1.5)))
    turn = np.linspace(0.3, 1.2, 7)
    arc = LineString(4.25 * np.column_stack([np.cos(turn), np.sin(turn)]))
    assert measures.centredness(arc, strip) == pytest.approx(np.full(7, 0.25), abs=1e-4)


def test_centredness_does_not_see_which_curve_is_the_main_one() -> None:
    line = LineString([(0, 1), (2, 1.5), (5, 0.25)])
    swapped = Strip(BANKS.auxiliary, BANKS.main)
    assert (
        measures.centredness(line, BANKS).tolist() == measures.centredness(line, swapped).tolist()
    )


def test_centredness_has_no_value_in_a_shared_corner() -> None:
    strip = split(wedge(0.5, 10.0), start=(0, 0))
    assert np.isnan(measures.centredness(LineString([(0, 0), (4, 1)]), strip)[0])


def test_spacing_divides_the_line_equally() -> None:
    line = LineString([(0, 0), (1, 0.2), (10, 2)])
    assert measures.centredness(line, BANKS, spacing=20.0).tolist() == [1.0, 1.0]
    found = measures.centredness(LineString([(0, 0), (1, 0.2), (10, 2)]), BANKS, spacing=2.6)
    assert found == pytest.approx([1.0, 0.5, 0.0, 0.5, 1.0])


def test_spacing_divides_each_part_for_itself() -> None:
    parts = MultiLineString([[(0, 1), (2, 1)], [(5, 1.5), (9, 1.5)]])
    found = measures.centredness(parts, BANKS, spacing=2.0)
    assert found.tolist() == [0.0, 0.0, 0.5, 0.5, 0.5]


@given(line=lines, power=POWERS)
def test_centredness_does_not_change_with_scale(line: LineString, power: int) -> None:
    factor = 2.0**power
    larger = Strip(*(times(curve, factor) for curve in (BANKS.main, BANKS.auxiliary)))
    for step in (None, 0.75):
        found = measures.centredness(line, BANKS, spacing=step)
        scaled = step if step is None else step * factor
        assert np.array_equal(
            measures.centredness(times(line, factor), larger, spacing=scaled), found, equal_nan=True
        )
        assert ((found >= 0.0) & (found <= 1.0)).all()


# deviation


def test_all_deviations_of_a_shifted_line_are_the_shift() -> None:
    assert measures.deviation(translate(MIDDLE, 0, 0.25), MIDDLE) == (0.25, 0.25, 0.25, 0.25)


def test_deviations_of_a_slanting_line() -> None:
    slanting = LineString([(0, 1), (10, 2)])
    found = measures.deviation(slanting, MIDDLE)
    assert found.mean == pytest.approx(0.5, abs=1e-2)
    assert found.p95 == pytest.approx(0.95, abs=1e-2)
    assert found.hausdorff == found.frechet == 1.0


def test_a_line_that_is_too_short_deviates_at_its_end() -> None:
    found = measures.deviation(LineString([(0, 1), (6, 1)]), MIDDLE)
    assert found.hausdorff == found.frechet == 4.0
    assert found.mean == pytest.approx(4.0 * 2.0 / 10.0, rel=1e-2)  # a triangle from 6 on


def test_frechet_sees_detours_that_hausdorff_does_not() -> None:
    there_and_back = LineString([(0, 1), (8, 1), (2, 1), (10, 1)])
    found = measures.deviation(there_and_back, MIDDLE)
    assert found.hausdorff == pytest.approx(0.0, abs=1e-14)
    assert found.frechet == pytest.approx(3.0)  # waits at 5


@given(one=lines, other=lines)
def test_frechet_agrees_with_frogs_that_jump_a_short_way(
    one: LineString, other: LineString
) -> None:
    step = 0.5
    p, q = dense(one, step), dense(other, step)
    expected = min(discrete_frechet(p, way) for way in (q, q[::-1]))
    assert expected - step - 1e-9 <= measures.deviation(one, other).frechet <= expected + 1e-9


@given(one=lines, other=lines)
def test_deviations_are_in_order_and_symmetric(one: LineString, other: LineString) -> None:
    found = measures.deviation(one, other)
    assert found == measures.deviation(other, one)
    assert found.mean <= found.hausdorff
    assert found.p95 <= found.hausdorff <= found.frechet
    assert measures.deviation(one, one) == pytest.approx((0.0, 0.0, 0.0, 0.0), abs=1e-13)


@given(one=lines, other=lines)
def test_hausdorff_agrees_with_shapely(one: LineString, other: LineString) -> None:
    expected = shapely.hausdorff_distance(one, other, densify=1e-3)
    step = max(one.length, other.length) / 1000.0
    assert measures.deviation(one, other).hausdorff == pytest.approx(expected, abs=2.0 * step)


@given(one=lines, other=lines, power=POWERS)
def test_doubling_deviations_is_exact(one: LineString, other: LineString, power: int) -> None:
    factor = 2.0**power
    found = measures.deviation(one, other)
    larger = measures.deviation(times(one, factor), times(other, factor))
    assert larger == tuple(value * factor for value in found)


@given(one=lines, other=lines, angle=st.integers(0, 359))
def test_rigid_motion_keeps_deviations(one: LineString, other: LineString, angle: int) -> None:
    moved = [translate(rotate(g, angle, origin=(0, 0)), 1e3, -2e3) for g in (one, other)]
    found, expected = measures.deviation(*moved), measures.deviation(one, other)
    assert found.frechet == pytest.approx(expected.frechet, abs=1e-9)
    # Rounding may make one step more or less of a line that divides almost evenly.
    step = max(one.length, other.length) / 1000.0
    assert list(found[:3]) == pytest.approx(list(expected[:3]), abs=step)


def test_neither_direction_nor_a_finer_division_matters() -> None:
    line, wave = MIDDLE, LineString([(0, 1), (3, 1.5), (6, 0.5), (10, 1)])
    found = measures.deviation(wave, line)
    assert measures.deviation(wave.reverse(), line) == pytest.approx(found)
    assert measures.deviation(wave, line.segmentize(0.5)) == pytest.approx(found)
    assert measures.deviation(wave, line, spacing=0.001) == pytest.approx(found, abs=1e-3)


def test_frechet_has_no_value_for_several_parts() -> None:
    parts = MultiLineString([[(0, 1), (4, 1)], [(5, 1), (10, 1)]])
    found = measures.deviation(parts, MIDDLE)
    assert found.hausdorff == pytest.approx(0.5, abs=1e-2)
    assert np.isnan(found.frechet)
    one_part = MultiLineString([MIDDLE])
    assert measures.deviation(one_part, MIDDLE) == measures.deviation(MIDDLE, MIDDLE)


def test_a_line_without_length_is_a_point() -> None:
    point = LineString([(3, 1), (3, 1)])
    assert measures.deviation(point, point) == (0.0, 0.0, 0.0, 0.0)
    assert measures.deviation(point, MIDDLE).frechet == 7.0


@pytest.mark.parametrize("latitude", [0.0, 52.0])
def test_geographic_deviations_are_metres(latitude: float) -> None:
    line = LineString([(5.0, latitude), (5.1, latitude)])
    aside = translate(line, 0.0, 0.001)
    found = measures.deviation(aside, line, geographic=True)
    up = LineString([(5.0, latitude), (5.0, latitude + 0.001)])
    assert found == pytest.approx((measures.length(up, geographic=True),) * 4, rel=1e-6)


# outside length, length ratio, turning


@pytest.mark.parametrize("area", AREAS)
def test_nothing_of_a_collapsed_line_is_outside(area: Polygon) -> None:
    assert measures.outside_length(collapse(area), area) == 0.0


def test_a_line_along_the_boundary_is_inside() -> None:
    assert measures.outside_length(LineString(RECTANGLE.exterior.coords), RECTANGLE) == 0.0


def test_outside_is_what_islands_and_the_outer_world_hold() -> None:
    through = LineString([(-1, 0.75), (12, 0.75)])
    assert measures.outside_length(through, AREAS).tolist() == [3.0, 5.0, 3.0]


@given(line=lines, area=st.sampled_from(AREAS))
def test_inside_and_outside_are_the_whole_length(line: LineString, area: Polygon) -> None:
    outside = measures.outside_length(line, area)
    pieces = [LineString(pair) for pair in pairwise(line.coords)]
    inside = shapely.length(shapely.intersection(pieces, area)).sum()
    assert outside + inside == pytest.approx(line.length)
    assert (outside == 0.0) == area.covers(line)


def test_an_invalid_area_is_named_with_its_position() -> None:
    with pytest.raises(InvalidAreaError, match=r"areas\[1\] is not valid: Self-intersection"):
        measures.outside_length(MIDDLE, [RECTANGLE, BOW_TIE])
    with pytest.raises(InvalidAreaError, match=r"^areas is not valid"):
        measures.outside_length(MIDDLE, BOW_TIE)


def test_length_ratio_of_a_zigzag() -> None:
    zigzag = LineString([(0, 0), (3, 4), (6, 0)])
    assert measures.length_ratio(zigzag, LineString([(0, 0), (6, 0)])) == 10.0 / 6.0
    assert np.isnan(measures.length_ratio(zigzag, LineString([(1, 1), (1, 1)])))


@pytest.mark.parametrize("n", [16, 64, 256])
def test_turning_along_a_circle_is_width_over_radius(n: int) -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, n + 1)
    circle = LineString(20.0 * np.column_stack([np.cos(turn), np.sin(turn)]))
    ring = Point(0, 0).buffer(21, quad_segs=256).difference(Point(0, 0).buffer(19, quad_segs=256))
    sagitta = 20.0 * (1.0 - np.cos(np.pi / n))  # two thirds of it is a chord off on average
    width = 2.0 - 4.0 / 3.0 * sagitta
    # The last vertex joins nothing.
    expected = width * 360.0 * (1.0 - 1.0 / n) / (2.0 * n * 20.0 * np.sin(np.pi / n))
    assert measures.turning(circle, ring) == pytest.approx(expected, rel=1e-2)


def test_turning_is_blind_to_vertices_that_do_not_turn() -> None:
    corner = LineString([(2, 2), (6, 2), (6, 6)])
    more = LineString([(2, 2), (2, 2), (3, 2), (6, 2), (6, 2), (6, 5), (6, 6)])
    bare, rich = (measures.turning(line, box(0, 0, 8, 8)) for line in (corner, more))
    assert bare == 45.0
    widths = [measures.mean_width(line, box(0, 0, 8, 8)) for line in (corner, more)]
    assert rich / widths[1] == pytest.approx(bare / widths[0])
    assert measures.turning(MIDDLE, RECTANGLE) == 0.0


def test_turning_back_is_half_a_turn() -> None:
    back = LineString([(2, 1), (8, 1), (4, 1)])
    assert measures.turning(back, RECTANGLE) == pytest.approx(180.0 * 2.0 / 10.0)


def test_parts_do_not_turn_into_one_another() -> None:
    parts = MultiLineString([[(2, 1), (4, 1)], [(5, 1), (5, 1.5)]])
    assert measures.turning(parts, RECTANGLE) == 0.0


@given(line=lines, power=st.integers(-100, 100))
def test_ratios_do_not_change_with_scale(line: LineString, power: int) -> None:
    factor = 2.0**power
    larger = [times(g, factor) for g in (line, RECTANGLE, MIDDLE)]
    assert measures.turning(*larger[:2]) == measures.turning(line, RECTANGLE)
    ratio = measures.length_ratio(line, MIDDLE)
    assert measures.length_ratio(larger[0], larger[2]) == ratio
    symmetry = measures.symmetry(line, MIDDLE, RECTANGLE)
    assert measures.symmetry(larger[0], larger[2], larger[1]) == symmetry


# symmetry, jumps, gap share


def swapped(strip: Strip) -> Strip:
    """The strip with its two curves in each other's place."""
    return Strip(strip.auxiliary, strip.main, strip.area)


def both_lines(strip: Strip) -> tuple[LineString, LineString]:
    """The curve of a strip and of the strip swapped."""
    first, second = (minimal_radii(s, ends="caps", count=64) for s in (strip, swapped(strip)))
    return first.line, second.line


def test_a_rectangle_is_symmetric_and_a_bump_is_not() -> None:
    assert measures.symmetry(*both_lines(BANKS), BANKS.area) == pytest.approx(0.0, abs=1e-12)
    bump = Strip(
        LineString([(0, 0), (10, 0)]), LineString([(0, 2), (4, 2), (5, 4), (6, 2), (10, 2)])
    )
    assert 0.01 < measures.symmetry(*both_lines(bump), bump.area) < 0.5


def test_symmetry_is_mean_deviation_over_mean_width() -> None:
    inner = LineString([(1, 1), (9, 1)])
    assert measures.symmetry(inner, translate(inner, 0, 0.5), RECTANGLE) == 0.25


def test_parallel_banks_have_neither_jumps_nor_gaps() -> None:
    curve = minimal_radii(BANKS, count=20)
    assert measures.jumps(curve) == 0.0
    assert measures.gap_share(curve) == 0.0


def test_a_fold_makes_q_jump() -> None:
    teeth = [(0, 2), (3, 2), (3, 9), (4, 9), (4, 1), (5, 1), (5, 2), (10, 2)]
    curve = minimal_radii(Strip(LineString([(0, 0), (10, 0)]), LineString(teeth)), count=200)
    assert measures.jumps(curve) == len(curve.jumps) > 0


def hidden() -> Strip:
    """A main curve with a side arm that goes round a corner, where it sees nothing."""
    main = [(0, 0), (4, 0), (4, -4), (8, -4), (8, -3), (5, -3), (5, 0), (10, 0)]
    return Strip(LineString(main), LineString([(0, 2), (10, 2)]))


def test_gap_share_is_the_hidden_share_of_the_main_curve() -> None:
    # Hidden is what lies round the corner: both sides of the arm and its end.
    strip = hidden()
    shares = [
        measures.gap_share(minimal_radii(strip, count=count, vertices=False))
        for count in (100, 1000, 10_000)
    ]
    length = strip.main.length
    seen_below = 1.0 + 1.0 / 3.0  # of the lower side, up to the sight past (4, 0) and (5, -3)
    assert shares[-1] == pytest.approx((4.0 - seen_below + 1.0 + 3.0) / length, abs=1e-3)
    assert shares[0] == pytest.approx(shares[-1], abs=0.02)


# all of them


@given(several=st.lists(st.tuples(lines, lines, st.sampled_from(AREAS)), min_size=1, max_size=4))
def test_batch_is_bit_equal_to_each_alone(several: list[tuple[Any, Any, Any]]) -> None:
    one, other, areas = (list(column) for column in zip(*several, strict=True))
    for measure, first, second in (
        (measures.outside_length, one, areas),
        (measures.turning, one, areas),
        (measures.length_ratio, one, other),
    ):
        alone = [measure(*pair) for pair in zip(first, second, strict=True)]
        assert measure(first, second).tolist() == alone
    alone = [measures.deviation(*pair) for pair in zip(one, other, strict=True)]
    assert np.array(measures.deviation(one, other)).T.tolist() == [list(row) for row in alone]
    alone = [measures.symmetry(*row) for row in several]
    assert np.array_equal(measures.symmetry(one, other, areas), alone, equal_nan=True)


@pytest.mark.parametrize("missing", [None, LineString(), MultiLineString()])
def test_missing_and_empty_lines_give_nan(missing: Any) -> None:
    assert np.isnan(measures.outside_length(missing, RECTANGLE))
    assert np.isnan(measures.turning(missing, RECTANGLE))
    assert np.isnan(measures.length_ratio(missing, MIDDLE))
    assert np.isnan(measures.length_ratio(MIDDLE, missing))
    assert np.isnan(measures.deviation(missing, MIDDLE)).all()
    assert np.isnan(measures.deviation([MIDDLE, MIDDLE], [MIDDLE, missing]).frechet).tolist() == [
        False,
        True,
    ]
    assert np.isnan(measures.symmetry(missing, MIDDLE, RECTANGLE))
    assert measures.centredness(missing, BANKS).size == 0
    assert measures.centredness(missing, BANKS, spacing=1.0).size == 0


@pytest.mark.parametrize("missing", [None, Polygon(), MultiPolygon()])
def test_missing_and_empty_areas_give_nan(missing: Any) -> None:
    assert np.isnan(measures.outside_length(MIDDLE, missing))
    assert np.isnan(measures.turning([MIDDLE], [missing])).tolist() == [True]
    assert np.isnan(measures.symmetry(MIDDLE, MIDDLE, missing))


def test_missing_curves_give_nan() -> None:
    curve = minimal_radii(BANKS)
    for measure in (measures.jumps, measures.gap_share):
        assert np.isnan(measure(None))
        assert np.isnan(measure([[curve, None]])).tolist() == [[False, True]]


def test_arrays_keep_their_shape_and_broadcast() -> None:
    lots = np.array([[MIDDLE, None], [None, MIDDLE]], dtype=object)
    assert measures.outside_length(lots, RECTANGLE).shape == (2, 2)
    assert measures.turning(MIDDLE, [RECTANGLE] * 3).shape == (3,)
    assert measures.length_ratio([], []).shape == (0,)
    assert measures.deviation(lots, MIDDLE).frechet.shape == (2, 2)
    assert measures.deviation([], []).mean.shape == (0,)
    assert measures.symmetry(lots, MIDDLE, RECTANGLE).shape == (2, 2)
    assert isinstance(measures.deviation(MIDDLE, MIDDLE).p95, float)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: measures.outside_length([MIDDLE, Point(0, 0)], RECTANGLE), r"lines\[1\] is a Po"),
        (lambda: measures.outside_length(MIDDLE, MIDDLE), "areas is a LineString, expected Poly"),
        (lambda: measures.length_ratio(MIDDLE, [7]), r"references\[0\] is a int, expected Line"),
        (lambda: measures.turning(MIDDLE, "sea"), r"areas is a str, expected Polygon"),
        (lambda: measures.deviation(RECTANGLE, MIDDLE), "lines is a Polygon, expected LineString"),
        (lambda: measures.symmetry(MIDDLE, RECTANGLE, RECTANGLE), "swapped is a Polygon"),
        (lambda: measures.centredness(MIDDLE, RECTANGLE), "strip is a Polygon, expected a Strip"),
        (lambda: measures.centredness([MIDDLE], BANKS), "line is an array, expected one"),
        (lambda: measures.centredness(RECTANGLE, BANKS), "line is a Polygon, expected LineString"),
        (lambda: measures.jumps([None, MIDDLE]), r"curves\[1\] is a LineString, expected Curve"),
        (lambda: measures.gap_share(7), "curves is a int, expected Curve"),
    ],
)
def test_wrong_kinds_are_named_with_their_position(call: Any, sentence: str) -> None:
    with pytest.raises(GeometryTypeError, match=sentence):
        call()


@pytest.mark.parametrize("spacing", [0.0, -1.0, np.nan, np.inf, True, "wide"])
def test_a_spacing_that_divides_nothing_is_refused(spacing: Any) -> None:
    for call in (
        lambda: measures.centredness(MIDDLE, BANKS, spacing=spacing),
        lambda: measures.deviation(MIDDLE, MIDDLE, spacing=spacing),
        lambda: measures.symmetry(MIDDLE, MIDDLE, RECTANGLE, spacing=spacing),
    ):
        with pytest.raises(ParameterError, match=r"spacing is .*, expected a positive"):
            call()


def test_z_is_ignored() -> None:
    high = LineString([(0, 1, 7), (10, 1, 9)])
    assert measures.deviation(high, MIDDLE) == measures.deviation(MIDDLE, MIDDLE)
    assert measures.turning(high, rectangle(10.0, 2.0)) == 0.0
    assert measures.centredness(high, BANKS).tolist() == [0.0, 0.0]


def test_far_origin_changes_measures_little() -> None:
    wave = LineString([(0, 1), (3, 1.5), (6, 0.5), (10, 1)])
    far = [translate(g, 5e5, 5e6) for g in (wave, MIDDLE, RECTANGLE)]
    assert measures.deviation(far[0], far[1]) == pytest.approx(
        measures.deviation(wave, MIDDLE), abs=1e-8
    )
    assert measures.turning(far[0], far[2]) == pytest.approx(measures.turning(wave, RECTANGLE))
    assert measures.outside_length(far[0], far[2]) == 0.0
