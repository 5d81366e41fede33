"""Checks find what is wrong, where it is, and nothing else."""

from collections import Counter
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString, Point, Polygon, box

from midrib.errors import GeometryTypeError
from midrib.formats.drawing.slopes import draw_slopes
from midrib.formats.slopes import read_slopes
from midrib.hatching import checking
from midrib.hatching.checking import check_slopes, falls
from midrib.hatching.finding import CHECKS, Finding
from midrib.hatching.hatch import hatch
from midrib.hatching.slope import Slope, SlopeKind, SlopeProblem
from midrib.hatching.standard import Standard

FOLDER = Path(__file__).parents[3] / "shared" / "data"
REAL = pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
AREA = box(0, 0, 9, 2)
TOP, TOE = LineString([(0, 2), (9, 2)]), LineString([(0, 2), (0, 0), (9, 0), (9, 2)])
SLOPE = Slope("a", "other", AREA, TOP, TOE, "test")
MOUND = Slope(
    "m",
    "other",
    Polygon(box(0, 0, 9, 9).exterior, [box(3, 3, 6, 5).exterior]),
    LineString(box(3, 3, 6, 5).exterior.coords),
    LineString(box(0, 0, 9, 9).exterior.coords),
    "test",
)


def with_heights(slope: Slope, top: list[list[float]], toe: list[list[float]]) -> Slope:
    """Slope with points of known height."""
    return replace(slope, top_heights=np.array(top), toe_heights=np.array(toe))


def translated(slope: Slope, name: str, y: float) -> Slope:
    """Slope farther up."""
    moved = {
        what: shapely.affinity.translate(getattr(slope, what), 0.0, y)
        for what in ("area", "top", "toe")
    }
    return replace(slope, id=name, **moved)


def names(findings: list[Finding]) -> list[tuple[str, str]]:
    """Slope and check of each finding."""
    return [(finding.id, finding.check) for finding in findings]


def test_a_good_slope_has_no_finding() -> None:
    good = with_heights(SLOPE, [[0, 2, 170]], [[0, 0, 168], [9, 0, 169]])
    assert check_slopes([SLOPE, good, MOUND]) == []


def test_problems_of_reading_are_listed_first() -> None:
    problems = [SlopeProblem("x", "orientation", "odd"), SlopeProblem("y", "refused", "no top")]
    findings = check_slopes([], problems)
    assert names(findings) == [("y", "refused"), ("x", "orientation")]
    assert list(CHECKS) == sorted(CHECKS, key=list(CHECKS).index)


@given(
    rise=st.floats(-5.0, 5.0),
    gradient=st.floats(-3.0, 3.0),
    stations=st.lists(st.floats(0.5, 8.5), min_size=1, max_size=6),
)
def test_the_top_is_compared_beside_the_toe(
    rise: float, gradient: float, stations: list[float]
) -> None:
    """Edges that climb along themselves, far more than across: means would not tell."""
    top = [[0.0, 2.0, 170.0], [9.0, 2.0, 170.0 + 9.0 * gradient]]
    toe = [[x, 0.0, 170.0 + x * gradient - rise] for x in stations]
    slope = with_heights(SLOPE, top, toe)
    assert falls(slope)[:, 2] == pytest.approx(rise, abs=1e-9)
    found = check_slopes([slope])
    if rise < -1e-9:
        assert names(found) == [("a", "swapped")]
        assert found[0].where is not None
        assert found[0].where.distance(LineString([(0, 0), (9, 0)])) == 0.0
        assert f"up to {-rise:.2g}"[:8] in found[0].reason
    elif rise > 1e-9:
        assert found == []


def test_shared_ends_tell_nothing() -> None:
    ends = [[0.0, 2.0, 170.0], [9.0, 2.0, 168.0]]
    assert falls(with_heights(SLOPE, ends, ends)).shape == (0, 3)
    assert falls(SLOPE).shape == (0, 3)


def test_heights_run_round_a_mound() -> None:
    slope = with_heights(MOUND, [[3, 3, 10], [6, 5, 12]], [[0, 0, 8], [9, 9, 8], [9, 0, 8]])
    assert len(falls(slope)) == 3
    assert (falls(slope)[:, 2] >= 2.0).all()
    assert names(check_slopes([with_heights(MOUND, [[3, 3, 5]], [[0, 0, 8]])])) == [
        ("m", "swapped")
    ]


def test_most_heights_decide_and_the_lowest_place_is_told() -> None:
    top = [[0.0, 2.0, 170.0], [9.0, 2.0, 170.0]]
    mostly = with_heights(SLOPE, top, [[2, 0, 168], [4, 0, 171], [7, 0, 169]])
    assert check_slopes([mostly]) == []
    swapped = with_heights(SLOPE, top, [[2, 0, 168], [4, 0, 173], [7, 0, 171]])
    (finding,) = check_slopes([swapped])
    assert finding.where == Point(4, 0)
    assert "up to 3 lower" in finding.reason


def test_heights_are_interpolated_over_the_seam_of_a_ring() -> None:
    """The ring begins in (6, 3): (4.5, 3) is 1.5 past (3, 3) on the 5 to (6, 5)."""
    slope = with_heights(MOUND, [[6, 5, 10], [3, 3, 12]], [[4.5, 0, 8]])
    assert falls(slope)[0, 2] == pytest.approx(12.0 - 2.0 * 1.5 / 5.0 - 8.0)


def test_rings_may_be_as_unequal_as_they_are() -> None:
    outer = box(-3, -3, 12, 12).exterior
    wide = replace(MOUND, area=Polygon(outer, MOUND.area.interiors), toe=LineString(outer.coords))
    assert wide.toe.length > 4.0 * wide.top.length
    assert "orientation" not in {finding.check for finding in check_slopes([wide])}


@pytest.mark.parametrize(
    ("slope", "place"),
    [
        (replace(SLOPE, top=LineString([(0, 2), (4, 2.5), (9, 2)])), Point(4, 2.5)),
        (replace(SLOPE, top=LineString([(0, 2), (9, 0)])), Point(4.5, 1)),
        (replace(SLOPE, toe=LineString([(0, 2), (-1, 0), (9, 0), (9, 2)])), Point(-1, 0)),
    ],
)
def test_edges_off_the_boundary_are_found_with_the_place(slope: Slope, place: Point) -> None:
    (finding,) = check_slopes([slope])
    assert finding.check == "off-ring"
    assert finding.where == place


def test_edges_that_leave_a_part_of_the_boundary_are_found() -> None:
    stub = replace(
        SLOPE, top=LineString([(0, 2), (5, 2)]), toe=LineString([(0, 2), (0, 0), (9, 0)])
    )
    (finding,) = check_slopes([stub])
    assert finding.check == "off-ring"
    assert "belongs to neither curve" in finding.reason


@pytest.mark.parametrize(("height", "is_doubtful"), [(2.9, False), (3.2, True)])
def test_very_unequal_edges_are_doubtful(height: float, is_doubtful: bool) -> None:
    area = box(0, 0, 2, height)
    top = LineString([(0, height), (2, height)])
    toe = LineString([(0, height), (0, 0), (2, 0), (2, height)])
    for edges in ((top, toe), (toe, top)):
        slope = Slope("a", "other", area, *edges, "test")
        assert bool(check_slopes([slope])) == is_doubtful


@pytest.mark.parametrize(
    ("strokes", "count"),
    [
        ([[(1, 2), (1, 0)], [(2, 2), (2, 0)]], 0),
        ([[(1, 2), (1, 0)], [(2, 2), (1, 0)]], 0),  # a common foot
        ([[(1, 2), (1, 0)], [(1, 1), (3, 1)]], 0),  # one starts on the other
        ([[(0, 2), (9, 2)], [(1, 2), (1, 0)]], 0),  # an outline and a stroke
        ([[(1, 2), (3, 0)], [(3, 2), (1, 0)]], 1),
        ([[(1, 2), (3, 0)], [(3, 2), (1, 0)], [(2, 2), (2, 0)]], 3),
        ([[(1, 2), (1, 0)], [(1, 1), (1, -1)]], 1),  # one along the other
        ([[(1, 2), (1, 0)], [(1, 0), (1, 2)]], 1),  # twice the same
    ],
)
def test_strokes_in_each_others_way_are_found(
    strokes: list[list[tuple[float, float]]], count: int
) -> None:
    told = check_slopes([SLOPE], strokes=[None, *map(LineString, strokes)])
    found = [finding for finding in told if finding.check == "crossing"]
    assert names(found) == [("a", "crossing")] * count
    for finding in found:
        assert finding.where is not None
        assert finding.where.distance(AREA) < 1e-9


def test_strokes_off_every_slope_have_no_name() -> None:
    cross = [LineString([(20, 0), (22, 2)]), LineString([(20, 2), (22, 0)])]
    finding, *others = check_slopes([SLOPE], strokes=cross)
    assert (finding.id, finding.where) == ("", Point(21, 1))
    assert finding.reason == "strokes 1 and 2 cross"
    assert names(others) == [("", "outside")] * 2


@pytest.mark.parametrize(
    ("stroke", "reason", "place"),
    [
        ([(20, 2), (20, 0)], "stroke 2, 2 long, is outside of every slope", ("", 20, 1)),
        ([(1, 2), (1, -0.5)], "0.5 of stroke 2 is outside of the slope", ("a", 1, -0.25)),
        ([(4, 3), (4, -0.5)], "1 of stroke 2 is outside of the slope", ("a", 4, 2.5)),
        # From one slope into another: it is on the one that holds more of it.
        ([(1, 2), (1, 5)], "1 of stroke 2 is outside of the slope", ("b", 1, 2.5)),
    ],
)
def test_strokes_outside_are_found_with_place_and_length(
    stroke: list[tuple[float, float]], reason: str, place: tuple[str, float, float]
) -> None:
    up = translated(SLOPE, "b", 3.0)
    found = check_slopes([SLOPE, up], strokes=[None, LineString(stroke)])
    name, x, y = place
    first = next(finding for finding in found if finding.id == name)
    assert (first.check, first.reason, first.where) == ("outside", reason, Point(x, y))


def test_both_ends_of_a_stroke_that_stick_out_are_found() -> None:
    found = check_slopes([SLOPE], strokes=[LineString([(4, 3), (4, -0.5)])])
    assert [finding.where for finding in found] == [Point(4, 2.5), Point(4, -0.25)]


@given(
    x=st.floats(-3.0, 12.0),
    y=st.floats(-2.0, 4.0),
    way=st.floats(0.0, 360.0),
    length=st.floats(0.5, 6.0),
)
def test_outside_is_what_the_slope_does_not_cover(
    x: float, y: float, way: float, length: float
) -> None:
    """Exactly shapely's difference, but for parts within half a line of the slope."""
    angle = np.radians(way)
    stroke = LineString([(x, y), (x + length * np.cos(angle), y + length * np.sin(angle))])
    reach = 0.5 * 0.18 * 0.5
    rest = shapely.get_parts(stroke.difference(AREA))  # farthest at an end: the slope is convex
    ends = [shapely.points(part.coords) for part in rest if not part.is_empty]
    depth = [shapely.distance(AREA, points).max() for points in ends]
    found = check_slopes([SLOPE], strokes=[stroke])
    # A corner is rounded, so that what is about a reach from it may count or not.
    assert sum(d > reach for d in depth) <= len(found) <= sum(d > 0.97 * reach for d in depth)
    places = [finding.where for finding in found]
    assert all(shapely.distance(AREA, place) > 0.0 for place in places)


def test_what_a_line_on_paper_covers_is_not_outside() -> None:
    """Half of 0.18 mm, at 1:500: 0.045."""
    for over, count in ((0.044, 0), (0.046, 1)):
        stroke = LineString([(1, 2), (1, -over)])
        assert len(check_slopes([SLOPE], strokes=[stroke])) == count
        assert not check_slopes([SLOPE], strokes=[stroke], scale=1000.0)
        assert len(check_slopes([SLOPE], strokes=[stroke], metres_per_unit=0.5)) == 0


def test_outlines_around_several_slopes_are_not_outside() -> None:
    both = [SLOPE, translated(SLOPE, "b", 2.0)]
    around = LineString(box(0, 0, 9, 4).exterior)
    assert check_slopes(both, strokes=[around]) == []
    found = check_slopes(both, strokes=[around, LineString([(1, 4), (1, 0)])])
    assert names(found) == [("a", "outside")]


def test_our_own_strokes_are_inside() -> None:
    lines = hatch(MOUND.strip(), "pl-2021-slope-reinforced").strokes
    assert check_slopes([MOUND], strokes=lines) == []
    assert len(check_slopes([SLOPE], strokes=lines)) == len(lines)


@given(x=st.floats(0.5, 8.5), shift=st.sampled_from([0.0, 5e5, 5e6]))
def test_ends_on_another_line_are_no_crossing_whatever_rounding_does(
    x: float, shift: float
) -> None:
    """A stroke from a slanted outline: its end is on either side of that by rounding."""
    outline = LineString([(shift, 2.0 * shift), (shift + 9.0, 2.0 * shift + 1.7)])
    start = outline.interpolate(x)
    stroke = LineString([start, (start.x + 0.3, start.y - 2.0)])
    assert check_slopes([], strokes=[outline, stroke]) == []
    longer = LineString([(start.x - 1e-3, start.y + 0.01), *stroke.coords])
    assert names(check_slopes([], strokes=[outline, longer])) == [("", "crossing")]


@pytest.mark.parametrize("wrong", [Point(1, 1), AREA, "LINESTRING (0 0, 1 1)"])
def test_strokes_that_are_no_lines_are_refused(wrong: object) -> None:
    kind = getattr(wrong, "geom_type", "str")
    with pytest.raises(GeometryTypeError, match=rf"strokes\[1\] is a {kind}, expected a LineStr"):
        check_slopes([SLOPE], strokes=[TOP, wrong])


def test_strokes_that_cross_beside_a_slope_are_not_on_it() -> None:
    """In the corner of an L, within its bounds."""
    area = Polygon([(0, 0), (9, 0), (9, 2), (2, 2), (2, 9), (0, 9)])
    top = LineString([(9, 2), (2, 2), (2, 9)])
    toe = LineString([(9, 2), (9, 0), (0, 0), (0, 9), (2, 9)])
    bent = Slope("L", "other", area, top, toe, "test")
    cross = [LineString([(6, 6), (8, 8)]), LineString([(6, 8), (8, 6)])]
    assert ("", "crossing") in names(check_slopes([bent], strokes=cross))


def test_slopes_that_cannot_be_matched_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    def draw(strip: object, known: Standard, **options: object) -> object:
        assert strip is not None
        assert known.name == "iof-104"
        assert options == {"scale": 1000.0, "metres_per_unit": 0.5, "drop": None, "start": "left"}
        kinds = {"missing": "a stroke is left out", "beyond": "strokes turn too far"}
        problems = [SlopeProblem("", kind, kinds[kind], Point(4, 1)) for kind in kinds]
        return SimpleNamespace(hatching=SimpleNamespace(problems=problems))

    monkeypatch.setattr(checking, "draw", draw)
    found = check_slopes([SLOPE], standard="iof-104", scale=1000.0, metres_per_unit=0.5)
    assert found == [
        Finding("a", "unmatched", "a stroke is left out", Point(4, 1)),
        Finding("a", "beyond", "strokes turn too far", Point(4, 1)),
    ]


@pytest.mark.parametrize("kind", ["wall", "conveyor", "directed"])
def test_only_what_is_hatched_has_to_be_matched(
    monkeypatch: pytest.MonkeyPatch, kind: SlopeKind
) -> None:
    monkeypatch.setattr(checking, "draw", None)
    assert check_slopes([replace(SLOPE, kind=kind)]) == []


@pytest.mark.shared
@REAL
def test_known_heights_confirm_every_top_of_opole() -> None:
    slopes, problems = read_slopes(FOLDER / "pl_bdot500_opole_west.gml")
    falling = [fall for fall in map(falls, slopes) if len(fall)]
    assert len(falling) == 48
    assert sum(map(len, falling)) == 224
    assert min(fall[:, 2].min() for fall in falling) > 0.0
    findings = check_slopes(slopes, problems)
    told = [(f.id, f.check, f.reason, f.where) for f in findings]
    assert told == sorted(told, key=lambda one: [*CHECKS].index(one[1]))
    assert Counter(check for _, check, *_ in told) == {"unmatched": 1, "beyond": 5}
    drawn = draw_slopes(slopes, problems=problems).problems
    assert sorted(told, key=str) == sorted(
        ((p.id, p.kind, p.reason, p.where) for p in drawn), key=str
    )


@pytest.mark.shared
@REAL
def test_swapped_slopes_of_opole_are_found() -> None:
    slopes, _ = read_slopes(FOLDER / "pl_bdot500_opole_west.gml")
    turned = [
        replace(s, top=s.toe, toe=s.top, top_heights=s.toe_heights, toe_heights=s.top_heights)
        for s in slopes
    ]
    checkable = {slope.id for slope in turned if len(falls(slope))}
    found = check_slopes(turned)
    assert {finding.check for finding in found} <= {"swapped", "unmatched", "beyond"}
    assert {finding.id for finding in found if finding.check == "swapped"} == checkable


@pytest.mark.shared
@REAL
def test_slopes_of_gooi_with_the_crest_on_a_short_side_are_doubtful() -> None:
    found = check_slopes(*read_slopes(FOLDER / "nl_bgt_gooi.gpkg"))
    assert Counter(finding.check for finding in found) == {
        "refused": 50,
        "orientation": 7,
        "unmatched": 17,
        "beyond": 7,
    }
    assert all(finding.where is not None for finding in found)


@pytest.mark.shared
@REAL
def test_the_reference_drawing_has_no_crossing() -> None:
    from tests.formats.layers import read_all

    path = FOLDER / "pl_szkoleniowy_skarpa_kreski.gpkg"
    strokes = read_all(path, "kreski_wzorcowe")[2]
    slopes, problems = read_slopes(path)
    assert check_slopes(slopes, problems, strokes=strokes) == []
    moved = shapely.affinity.translate(strokes[20], 0.0, 3.0)
    found = check_slopes(slopes, problems, strokes=[*strokes, moved])
    assert {finding.check for finding in found} >= {"outside"}
    assert all(f"{len(strokes) + 1}" in finding.reason for finding in found)
