"""Tops in pieces: they are one where they follow each other, and stay apart where they do not."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString, MultiLineString, Point, Polygon
from shapely.ops import substring

from midrib.formats.gathering import Gathered
from midrib.formats.slopes import Slope, SlopeProblem, read_slopes
from midrib.formats.tops import joined_tops
from tests.formats.test_slope_layers import save

FOLDER = Path(__file__).parents[3] / "shared" / "data"
SLAB = Polygon([(0, 0), (20, 0), (20, 2), (0, 2)])  # mean width 1.82
CREST = LineString([(0, 2), (20, 2)])
BEND = Polygon([(0, 0), (12, 0), (12, 12), (10, 12), (10, 2), (0, 2)])
LENS = Polygon([(0, 0), (5, -1), (15, -1), (20, 0), (15, 1), (5, 1)])
LOWER, UPPER = LineString(LENS.exterior.coords[:4]), LineString(LENS.exterior.coords[3:])
RING = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (2, 7), (7, 7), (7, 2)]])


def sides(area: Polygon, tops: Sequence[Any]) -> tuple[list[Slope], list[SlopeProblem]]:
    """Slopes of an object with these tops."""
    found = Gathered()

    def slope(name: str, part: Polygon, edges: Any) -> Slope:
        return Slope(name, "other", part, edges.top, edges.toe, "")

    found.add_sides("a", [area], tops, slope)
    return found.result()


@given(cuts=st.lists(st.floats(0.02, 0.98), min_size=1, max_size=5), turned=st.integers(0, 63))
@pytest.mark.parametrize(
    ("area", "crest"),
    [
        (SLAB, CREST),
        (BEND, LineString([(0, 2), (10, 2), (10, 12)])),
        (BEND, LineString([(0, 0), (12, 0), (12, 12)])),
        (Polygon(np.roll(SLAB.exterior.coords[:-1], 2, axis=0)), CREST),
        (SLAB.reverse(), CREST),
    ],
    ids=["slab", "inner corner", "outer corner", "other start", "reversed"],
)
def test_pieces_of_a_crest_make_the_crest(
    area: Polygon, crest: LineString, cuts: list[float], turned: int
) -> None:
    places = [0.0, *sorted(set(cuts)), 1.0]
    pieces = [substring(crest, a, b, normalized=True) for a, b in pairwise(places)]
    pieces = [p.reverse() if turned >> k & 1 else p for k, p in enumerate(pieces) if p.length]
    (top,), (doubt,) = joined_tops(area, pieces[::2] + pieces[1::2])
    assert isinstance(top, LineString)
    assert top.equals(crest)
    assert doubt.kind == "pieces"
    assert f"{len(pieces)} pieces" in doubt.reason


@pytest.mark.parametrize(("gap", "is_one"), [(0.1, True), (0.18, True), (0.19, False), (5, False)])
def test_gaps_up_to_a_tenth_of_the_mean_width_are_closed(gap: float, is_one: bool) -> None:
    pieces = [LineString([(20, 2), (9, 2)]), LineString([(9 - gap, 2), (0, 2)])]
    slopes, problems = sides(SLAB, pieces)
    assert [slope.top.equals(CREST) for slope in slopes] == [is_one]
    assert [p.kind for p in problems] == (["pieces"] if is_one else ["orientation", "refused"])
    assert f"{gap:.3g} apart" in problems[-1].reason
    assert is_one or problems[-1].reason.endswith("or 0.182 at most")


def test_starts_and_ends_in_pieces_are_joined_too() -> None:
    pairs = [
        (np.array([20.0, 2.0]), np.array([9.0, 2.0])),
        (np.array([9.0, 2.0]), np.array([0, 2])),
    ]
    (slope,), (problem,) = sides(SLAB, pairs)
    assert slope.id == "a"
    assert slope.top.wkt == "LINESTRING (20 2, 0 2)"
    assert problem.kind == "pieces"


@pytest.mark.parametrize("area", [SLAB, SLAB.reverse()])
@pytest.mark.parametrize("turned", [False, True])
def test_the_longest_piece_gives_the_direction(area: Polygon, turned: bool) -> None:
    long, short = LineString([(0, 2), (14, 2)]), LineString([(20, 2), (14, 2)])
    (top,), _ = joined_tops(area, [short, long.reverse() if turned else long])
    assert isinstance(top, LineString)
    assert [*top.coords] == [*(CREST.reverse() if turned else CREST).coords]


def test_pieces_that_overlap_or_are_stored_twice_are_one() -> None:
    pieces = [LineString([(0, 2), (12, 2)]), LineString([(8, 2), (20, 2)]), CREST]
    (top,), _ = joined_tops(SLAB, pieces)
    assert isinstance(top, LineString)
    assert top.equals(CREST)


@pytest.mark.parametrize(
    ("area", "tops"),
    [
        (SLAB, [CREST, LineString([(0, 0), (20, 0)])]),
        (LENS, [LOWER, UPPER]),
        (LENS, [UPPER, LineString([(1, -0.2), *LOWER.coords[1:]])]),
    ],
    ids=["two long sides", "meeting at both tips", "meeting at one tip"],
)  # fmt: skip
def test_tops_on_both_sides_stay_apart(area: Polygon, tops: list[LineString]) -> None:
    assert joined_tops(area, tops) == (tops, [])


def test_pieces_round_a_hole_are_all_of_it() -> None:
    hole = LineString(RING.interiors[0])
    pieces = [substring(hole, 0, 7), substring(hole, 7, hole.length - 3), substring(hole, 17, 20)]
    (slope,), (problem,) = sides(RING, pieces)
    assert slope.top.is_closed
    assert slope.top.length == pytest.approx(20)
    assert problem.kind == "pieces"


def test_pieces_round_the_outer_ring_are_a_pit() -> None:
    ring = LineString(RING.exterior)
    (top,), _ = joined_tops(RING, [substring(ring, 0, 20), substring(ring, 20, 36)])
    assert isinstance(top, LineString)
    assert top.is_closed


@pytest.mark.parametrize("end", [0, 20])
def test_a_short_piece_across_the_end_is_left_out(end: int) -> None:
    slopes, (problem,) = sides(SLAB, [LineString([(end, 0), (end, 2)]), CREST])
    assert [slope.top.equals(CREST) for slope in slopes] == [True]
    assert "2 long, turns off the others by 90 degrees" in problem.reason


def test_a_short_piece_that_cuts_a_corner_is_a_part() -> None:
    bevelled = Polygon([(0, 0), (12, 0), (12, 12), (10, 12), (10, 3), (9, 2), (0, 2)])
    pieces = [LineString(p) for p in (((0, 2), (9, 2)), ((9, 2), (10, 3)), ((10, 3), (10, 12)))]
    (top,), _ = joined_tops(bevelled, pieces)
    assert isinstance(top, LineString)
    assert top.equals(shapely.line_merge(MultiLineString(pieces)))


def test_a_piece_off_the_ring_stays_for_itself() -> None:
    slopes, problems = sides(SLAB, [LineString([(0, 2), (9, 2)]), LineString([(9, 1), (20, 1)])])
    assert len(slopes) == 1
    assert [p.reason for p in problems if p.kind == "refused"] == [
        "the top's start is 1 off the boundary, expected 0.182 at most"
    ]


def test_many_pieces_of_a_layer_are_joined_by_place_and_by_field(tmp_path: Path) -> None:
    path = tmp_path / "slopes.gpkg"
    save(path, "slope", [SLAB], id=["a"])
    pieces = [[(9.05, 2), (20, 2)], [(4, 2), (0, 2)], [(4.1, 2), (9, 2)]]
    save(path, "crest", [MultiLineString(pieces[:2]), LineString(pieces[2])], id=["a", "a"])
    for top in ("crest", "crest:id"):
        (slope,), (problem,) = read_slopes(path, layer="slope", top=top)
        assert slope.id == "a"
        assert slope.top.equals(CREST)
        assert problem.where == Point(4, 2)  # at the widest gap


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
@pytest.mark.parametrize("by", ["kruinlijn", "kruinlijn:gml_id"])
def test_crests_of_a_base_map_cut_into_pieces_are_the_crests(by: str, tmp_path: Path) -> None:
    import pyogrio

    source, path = FOLDER / "nl_bgt_gooi.gpkg", tmp_path / "cut.gpkg"
    areas, crests = (
        pyogrio.read_dataframe(source, layer=layer)[["gml_id", "geometry"]]
        for layer in ("talud", "kruinlijn")
    )
    rng = np.random.default_rng(4)
    widths = 2 * areas.area / areas.length
    width = dict(zip(areas.gml_id, widths, strict=True))
    rows = []
    for name, crest in zip(crests.gml_id, crests.geometry, strict=True):
        places = np.sort(rng.uniform(0.1, 0.9, rng.integers(1, 4))) * crest.length
        stops, starts = [*places, crest.length], [0.0, *places + 0.05 * width[name]]
        for a, b in zip(starts, stops, strict=True):
            if b > a:
                piece = substring(crest, a, b)
                rows.append((name, piece.reverse() if rng.random() < 0.5 else piece))
    whole, _ = read_slopes(source)
    save(path, "talud", areas.geometry.tolist(), gml_id=areas.gml_id.tolist())
    save(path, "kruinlijn", [piece for _, piece in rows], gml_id=[name for name, _ in rows])
    slopes, problems = read_slopes(path, layer="talud", top=by)
    assert {p.reason for p in problems if p.kind == "refused"} == {"it has no top"}
    assert [slope.id for slope in slopes] == [slope.id for slope in whole]
    for slope, other in zip(slopes, whole, strict=True):
        assert shapely.hausdorff_distance(slope.top, other.top) <= 0.05 * mean_width(slope)


def mean_width(slope: Slope) -> float:
    """Mean width of a slope."""
    return float(2 * slope.area.area / slope.area.length)
