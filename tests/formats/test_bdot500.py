"""Slopes of BDOT500: every one has the top that the register means, or a reason why it has none."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
import shapely

from midrib.errors import ParameterError
from midrib.formats.drawing.slopes import draw_slopes
from midrib.formats.slopes import read_slopes
from midrib.hatching.checking import check_slopes
from midrib.types import Floats
from tests.formats.gml_files import (
    BDOT_2015,
    BDOT_2021,
    ZONE_6,
    At,
    collection,
    dyke,
    earthwork,
    ring,
)

FOLDER = Path(__file__).parents[3] / "shared" / "data"
E0, N0 = 6_481_000.0, 5_616_000.0
CORNERS: list[At] = [(E0, N0), (E0 + 9, N0), (E0 + 10, N0 + 2), (E0, N0 + 2)]
SLOPE = ring(CORNERS)
NAMES = ("old", "new")
ALONG = "poliliniaKierunkowa"


def moved(points: Sequence[At], x: float, y: float) -> list[At]:
    """Points somewhere else."""
    return [(p[0] + x, p[1] + y, *p[2:]) for p in points]


def height(x: float, y: float, value: float | str) -> str:
    """A point of known height, of the model of 2015."""
    return (
        "<bdz:BDZ_PunktOOkreslonejWysokosci><bdz:geometria>"
        f"<gml:Point {ZONE_6}><gml:pos>{y} {x}</gml:pos></gml:Point></bdz:geometria>"
        f"<bdz:rzednaGory>{value}</bdz:rzednaGory></bdz:BDZ_PunktOOkreslonejWysokosci>"
    )


def test_the_top_leads_forward_from_start_to_end(tmp_path: Path) -> None:
    feature = earthwork("a", SLOPE, CORNERS[2], CORNERS[0])
    (slope,), problems = read_slopes(collection(tmp_path / "a.gml", BDOT_2015, feature))
    assert not problems
    assert slope.id == "a"
    assert slope.kind == "slope-reinforced"
    assert slope.source == "BDOT500 2015, BDZ_BudowlaZiemna"
    assert [*slope.top.coords] == [CORNERS[2], CORNERS[3], CORNERS[0]]
    assert [*slope.toe.coords] == [CORNERS[2], CORNERS[1], CORNERS[0]]
    assert slope.attributes["rodzajBudZiemn"] == "skarpaUmocniona"
    assert slope.crs is not None
    assert "CS2000/18" in slope.crs
    assert slope.strip().main.equals(slope.top)
    assert slope.strip().auxiliary.equals(slope.toe)


@pytest.mark.parametrize("ended", ["koniecObiekt", "koniecWersjiObiektu"])
def test_history_is_read_when_asked_for(ended: str, tmp_path: Path) -> None:
    extra = f"<bdz:cyklZyciaObiektu><bt:{ended}>2022-09-08</bt:{ended}></bdz:cyklZyciaObiektu>"
    features = [
        earthwork(name, SLOPE, CORNERS[0], CORNERS[1], extra=extra * (name == "old"))
        for name in NAMES
    ]
    path = collection(tmp_path / "a.gml", BDOT_2015, *features)
    assert [slope.id for slope in read_slopes(path)[0]] == ["new"]
    assert [slope.id for slope in read_slopes(path, history=True)[0]] == ["old", "new"]


def test_what_is_empty_is_not_there(tmp_path: Path) -> None:
    """Registers write empty elements for what is not known or does not apply."""
    names = ("koniecObiekt", "poczatekGoryKolejnejSkarpy", "koniecGoryKolejnejSkarpy", ALONG)
    extra = "".join(f'<bdz:{name} nilReason="missing"> </bdz:{name}>' for name in names)
    features = [
        earthwork("a", SLOPE, CORNERS[0], CORNERS[1], extra=extra),
        earthwork("b", SLOPE, extra=extra),
    ]
    slopes, problems = read_slopes(collection(tmp_path / "a.gml", BDOT_2015, *features))
    assert [slope.id for slope in slopes] == ["a"]
    assert [problem.reason[:13] for problem in problems] == ["it has no top"]


@pytest.mark.parametrize(
    ("word", "kind"),
    {
        "nasyp": "embankment",
        "grobla": "dyke",
        "walPrzeciwpowodziowy": "dyke",
        "wykop": "cutting",
        "skarpaNieumocniona": "slope-unreinforced",
        "inna": "other",
    }.items(),
)
def test_kinds_have_our_names(word: str, kind: str, tmp_path: Path) -> None:
    feature = earthwork("a", SLOPE, CORNERS[0], CORNERS[1], kind=word)
    (slope,), _ = read_slopes(collection(tmp_path / "a.gml", BDOT_2015, feature))
    assert slope.kind == kind


def test_what_is_no_slope_is_told_and_the_others_go_on(tmp_path: Path) -> None:
    off = (E0 - 5.0, N0)
    bow_tie = ring([CORNERS[0], CORNERS[2], CORNERS[1], CORNERS[3]])
    path = collection(
        tmp_path / "a.gml",
        BDOT_2015,
        earthwork("no top", SLOPE),
        earthwork("no end", SLOPE, CORNERS[0]),
        earthwork("off", SLOPE, off, CORNERS[1]),
        earthwork("crossing", bow_tie, CORNERS[0], CORNERS[1]),
        earthwork("words", SLOPE.replace("5616000.0", "north"), CORNERS[0], CORNERS[1]),
        earthwork("endless", SLOPE.replace("5616000.0", "inf"), CORNERS[0], CORNERS[1]),
        earthwork("odd", SLOPE.replace("5616000.0 ", "", 1), CORNERS[0], CORNERS[1]),
        earthwork("no area", "", CORNERS[0], CORNERS[1]),
        earthwork("line", ring(CORNERS[:2]), CORNERS[0], CORNERS[1]),
        earthwork("good", SLOPE, CORNERS[0], CORNERS[1]),
    )
    slopes, problems = read_slopes(path)
    assert [slope.id for slope in slopes] == ["good"]
    assert {problem.kind for problem in problems} == {"refused"}
    reasons = {problem.id: problem.reason for problem in problems}
    assert reasons["no top"].startswith("it has no top, expected poczatekGorySkarpy and koniecGory")
    assert reasons["no end"].startswith("koniecGorySkarpy is missing")
    assert reasons["off"].startswith("start is 5 off the boundary")
    where = next(problem.where for problem in problems if problem.id == "crossing")
    assert where is not None
    at = f"({where.x:.12g}, {where.y:.12g})"
    assert reasons["crossing"] == f"its area is not valid: Self-intersection at {at}"
    assert reasons["words"].startswith("the coordinates 'north")
    assert "are not rows of 2 numbers" in reasons["odd"]
    assert reasons["endless"] == "a coordinate is not finite"
    assert reasons["no area"] == "it has no area, expected a polygon"
    assert reasons["line"] == "a ring has fewer than three points"
    places = {problem.id: problem.where for problem in problems if problem.where is not None}
    assert places["off"].coords[0] == off
    assert places["no top"].coords[0] == places["no end"].coords[0] == CORNERS[0]
    assert places["crossing"].distance(shapely.Point(E0 + 5, N0 + 1)) < 1.0


def test_heights_lie_on_the_edges_they_are_on(tmp_path: Path) -> None:
    other = moved(CORNERS, 100, 0)
    path = collection(
        tmp_path / "a.gml",
        BDOT_2015,
        height(E0 + 4, N0, 171.5),
        height(E0, N0, 172.0),
        height(E0 + 5, N0 + 2, 168.5),
        height(E0 + 7, N0, 0.0),
        height(E0 + 7, N0, "brak"),
        height(E0 + 5, N0 + 1, 170.0),
        earthwork("a", SLOPE, CORNERS[0], CORNERS[1]),
        earthwork("b", ring(other), other[0], other[1]),
    )
    (a, b), problems = read_slopes(path)
    assert not problems
    assert a.top_heights is not None
    assert sorted(a.top_heights.tolist()) == [[E0, N0, 172.0], [E0 + 4, N0, 171.5]]
    assert a.toe_heights is not None
    assert sorted(a.toe_heights.tolist()) == [[E0, N0, 172.0], [E0 + 5, N0 + 2, 168.5]]
    assert b.top_heights is None
    assert b.toe_heights is None


def test_heights_of_vertices_are_known_unless_they_are_nought(tmp_path: Path) -> None:
    corners = [(*point, z) for point, z in zip(CORNERS, (172.0, 0.0, 168.0, 169.0), strict=True)]
    feature = earthwork("a", ring(corners), CORNERS[0], CORNERS[1])
    (slope,), _ = read_slopes(collection(tmp_path / "a.gml", BDOT_2015, feature))
    assert slope.top_heights is not None
    assert slope.top_heights[:, 2].tolist() == [172.0]
    assert slope.toe_heights is not None
    assert slope.toe_heights[:, 2].tolist() == [172.0, 169.0, 168.0]


def test_both_sides_of_a_dyke_are_slopes(tmp_path: Path) -> None:
    low, high = CORNERS, moved(CORNERS, 0, 5)
    tops = [(low[2], low[3]), (high[0], high[1])]
    for surfaces in ([ring(low), ring(high)], [ring(high), ring(low)]):
        path = collection(tmp_path / "a.gml", BDOT_2021, dyke("d", surfaces, tops))
        slopes, problems = read_slopes(path)
        assert not problems
        assert [slope.id for slope in slopes] == ["d/1", "d/2"]
        assert [slope.kind for slope in slopes] == ["dyke", "dyke"]
        for slope, top in zip(slopes, tops, strict=True):
            assert (slope.top.coords[0], slope.top.coords[-1]) == top


def winding_dyke(path: Path) -> Path:
    """A dyke of the model of 2021: a winding crest 3 m wide, slopes of 3 to 7 m on both sides."""
    share = np.linspace(0.0, 1.0, 25)
    middle = np.column_stack([90.0 * share, 12.0 * np.sin(2.2 * np.pi * share)])
    along = np.gradient(middle, axis=0)
    normal = np.column_stack([-along[:, 1], along[:, 0]]) / np.hypot(*along.T)[:, None]
    width = 5.0 + 2.0 * np.sin(3.0 * np.pi * share)[:, None]

    def beside(off: Floats | float) -> list[At]:
        points = np.round(middle + off * normal + [E0, N0], 2)
        return [(float(x), float(y)) for x, y in points]

    left, right = beside(1.5), beside(-1.5)[::-1]
    surfaces = [ring(left + beside(1.5 + width)[::-1]), ring(right + beside(-1.5 - 0.8 * width))]
    tops = [(left[0], left[-1]), (right[0], right[-1])]
    return collection(path, BDOT_2021, dyke("d", surfaces, tops))


def test_both_sides_of_a_winding_dyke_are_hatched_downwards(tmp_path: Path) -> None:
    slopes, problems = read_slopes(winding_dyke(tmp_path / "a.gml"))
    assert not problems
    assert not check_slopes(slopes)
    drawing = draw_slopes(slopes, "pl-2021")
    assert [drawn.id for drawn in drawing.objects] == ["d/1", "d/2"]
    assert not drawing.problems
    for drawn, slope in zip(drawing.objects, slopes, strict=True):
        lines = drawn.symbols.lines
        assert len(lines) > 30
        assert shapely.covers(slope.area.buffer(1e-6), lines).all()
        crest, foot = (shapely.get_point(lines, end) for end in (0, -1))
        assert shapely.distance(slope.top, crest).max() < 1e-6
        assert (shapely.distance(slope.top, foot) > 1.0).all()
    both = np.concatenate([drawn.symbols.lines for drawn in drawing.objects])
    assert not check_slopes([], strokes=both)


def test_a_dyke_with_its_crest_as_a_hole_is_one_slope(tmp_path: Path) -> None:
    hole = [(E0 + 3, N0 + 0.5), (E0 + 6, N0 + 0.5), (E0 + 6, N0 + 1.5), (E0 + 3, N0 + 1.5)]
    tops = [(hole[0], hole[1]), (hole[2], hole[3])]
    feature = dyke("d", [SLOPE + ring(hole, "interior")], tops)
    (slope,), problems = read_slopes(collection(tmp_path / "a.gml", BDOT_2021, feature))
    assert slope.top.is_closed
    assert slope.top.length == pytest.approx(8.0)
    assert [problem.kind for problem in problems] == ["orientation"]


def test_sides_of_a_dyke_need_a_part_each(tmp_path: Path) -> None:
    tops = [(CORNERS[0], CORNERS[1]), (CORNERS[2], CORNERS[3])]
    together = dyke("d", [SLOPE], tops)
    slopes, problems = read_slopes(collection(tmp_path / "a.gml", BDOT_2021, together))
    assert [slope.id for slope in slopes] == ["d/1"]
    assert [problem.reason[:34] for problem in problems] == ["two tops are on the same part of i"]
    alone = dyke("d", [SLOPE, ring(moved(CORNERS, 0, 5))], tops[:1])
    slopes, problems = read_slopes(collection(tmp_path / "b.gml", BDOT_2021, alone))
    assert [slope.id for slope in slopes] == ["d"]
    assert [problem.reason for problem in problems] == ["part 2 of 2 of its area has no top"]


@pytest.mark.parametrize(
    ("name", "what", "code", "kind"),
    [
        ("OT_Budowle", "rodzajBudowli", "n", "wall"),
        ("OT_Komunikacja", "rodzajObiektu", "s", "stairs"),
        ("OT_Komunikacja", "rodzajObiektu", "j", "directed"),
    ],
)
def test_walls_and_stairs_follow_their_directional_polyline(
    name: str, what: str, code: str, kind: str, tmp_path: Path
) -> None:
    line = " ".join(f"{y} {x}" for x, y in [CORNERS[1], CORNERS[0], CORNERS[3]])
    feature = (
        f'<ot:{name} gml:id="w"><ot:geometria><gml:Polygon {ZONE_6}>{SLOPE}</gml:Polygon>'
        f"</ot:geometria><ot:{what}>{code}</ot:{what}><ot:poliliniaKierunkowa>"
        f"<gml:Curve {ZONE_6}><gml:segments><gml:LineStringSegment><gml:posList>{line}"
        "</gml:posList></gml:LineStringSegment></gml:segments></gml:Curve>"
        f"</ot:poliliniaKierunkowa></ot:{name}>"
    )
    (slope,), _ = read_slopes(collection(tmp_path / "a.gml", BDOT_2021, feature))
    assert slope.kind == kind
    assert [*slope.top.coords] == [CORNERS[1], CORNERS[0], CORNERS[3]]


def test_stairs_of_the_building_register_are_read(tmp_path: Path) -> None:
    line = " ".join(f"{y} {x}" for x, y in CORNERS[:2])
    feature = (
        f'<egb:EGB_ObiektTrwaleZwiazanyZBudynkiem gml:id="s"><egb:geometria><gml:Polygon {ZONE_6}>'
        f"{SLOPE}</gml:Polygon></egb:geometria><egb:rodzajObiektuZwiazanegoZBudynkiem>s"
        "</egb:rodzajObiektuZwiazanegoZBudynkiem><egb:poliliniaKierunkowa>"
        f"<gml:LineString {ZONE_6}><gml:posList>{line}</gml:posList></gml:LineString>"
        "</egb:poliliniaKierunkowa></egb:EGB_ObiektTrwaleZwiazanyZBudynkiem>"
    )
    spaces = 'xmlns:egb="ewidencjaGruntowIBudynkow:1.0"'
    (slope,), _ = read_slopes(collection(tmp_path / "a.gml", spaces, feature))
    assert slope.kind == "stairs"
    assert [*slope.top.coords] == CORNERS[:2]


def test_areas_without_a_direction_are_passed_over(tmp_path: Path) -> None:
    feature = (
        f'<ot:OT_Wody gml:id="w"><ot:geometria><gml:Polygon {ZONE_6}>{SLOPE}</gml:Polygon>'
        "</ot:geometria></ot:OT_Wody>"
    )
    assert read_slopes(collection(tmp_path / "a.gml", BDOT_2021, feature)) == ([], [])


def test_heights_of_an_object_are_those_of_its_edges(tmp_path: Path) -> None:
    extra = "<bdz:rzednaGory>172.5</bdz:rzednaGory><bdz:rzednaDolu>0.00</bdz:rzednaDolu>"
    feature = earthwork("a", SLOPE, CORNERS[0], CORNERS[1], extra=extra)
    (slope,), _ = read_slopes(collection(tmp_path / "a.gml", BDOT_2015, feature))
    assert slope.top_heights is not None
    assert slope.top_heights.tolist() == [[E0 + 4.5, N0, 172.5]]
    assert slope.toe_heights is None


@pytest.mark.parametrize("member", ["gml:featureMember", "gml:member", "gml:featureMembers"])
def test_features_are_found_in_whatever_holds_them(member: str, tmp_path: Path) -> None:
    features = [earthwork(name, SLOPE, CORNERS[0], CORNERS[1]) for name in "abc"]
    path = collection(tmp_path / "a.gml", BDOT_2015, *features, member=member)
    assert [slope.id for slope in read_slopes(path)[0]] == ["a", "b", "c"]


def test_the_envelope_tells_the_system_of_all(tmp_path: Path) -> None:
    about = f"<gml:boundedBy><gml:Envelope {ZONE_6}/></gml:boundedBy>"
    feature = earthwork("a", SLOPE, CORNERS[0], CORNERS[1]).replace(f" {ZONE_6}", "")
    path = collection(tmp_path / "a.gml", BDOT_2015, feature, about=about)
    (slope,), _ = read_slopes(path)
    assert slope.top.coords[0] == CORNERS[0]
    assert slope.crs is not None


def test_broken_files_are_refused_in_a_sentence(tmp_path: Path) -> None:
    path = collection(tmp_path / "a.gml", BDOT_2015, earthwork("a", SLOPE, CORNERS[0], CORNERS[1]))
    path.write_text(path.read_text()[:-30])
    with pytest.raises(ParameterError, match=r"a\.gml' cannot be read to its end: "):
        read_slopes(path)
    with pytest.raises(ParameterError, match="does not exist"):
        read_slopes(tmp_path / "none.gml")


def test_entities_are_not_resolved(tmp_path: Path) -> None:
    feature = earthwork("a", SLOPE, CORNERS[0], CORNERS[1], kind="&file;")
    path = collection(tmp_path / "a.gml", BDOT_2015, feature)
    secret = tmp_path / "secret.txt"
    secret.write_text("secret")
    declared = f'<!DOCTYPE x [<!ENTITY file SYSTEM "{secret.as_uri()}">]><gml:FeatureCollection'
    path.write_text(path.read_text().replace("<gml:FeatureCollection", declared))
    with pytest.raises(ParameterError, match="has a document type of its own, expected plain GML"):
        read_slopes(path)


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
def test_gml_and_gpkg_of_opole_have_the_same_slopes() -> None:
    (ours, problems), (theirs, more) = (
        read_slopes(FOLDER / f"pl_bdot500_opole_west.{ending}") for ending in ("gml", "gpkg")
    )
    assert not problems + more
    assert len(ours) == len(theirs) == 134
    for a, b in zip(ours, theirs, strict=True):
        assert (a.id, a.kind) == (b.id, b.kind)
        for name in ("area", "top", "toe"):
            assert getattr(a, name).equals_exact(getattr(b, name), 0.0)
        a.strip()
        assert a.top.length + a.toe.length == pytest.approx(a.area.length)
        assert np.isclose(a.area.area, b.area.area)


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
def test_the_slope_of_the_training_file_is_the_one_of_the_gpkg() -> None:
    path = FOLDER / "pl_szkoleniowy_bdot500.gml"
    assert read_slopes(path) == ([], [])  # it has ended
    (ours,), _ = read_slopes(path, history=True)
    (theirs,), _ = read_slopes(FOLDER / "pl_szkoleniowy_skarpa_kreski.gpkg")
    assert ours.kind == theirs.kind == "slope-unreinforced"
    assert ours.top.equals_exact(theirs.top, 0.0)
    assert ours.toe.equals_exact(theirs.toe, 0.0)
