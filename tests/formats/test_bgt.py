"""Slopes of the Dutch map: an area and its crest, in CityGML and in layers."""

from pathlib import Path

import numpy as np
import pytest
import shapely

from midrib.formats.slopes import read_slopes
from tests.formats.gml_files import BGT, collection

FOLDER = Path(__file__).parents[3] / "shared" / "data"
REAL = pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
RD = 'srsName="urn:ogc:def:crs:EPSG::28992"'
AREA = "140000 466000 140020 466000 140020 466004 140000 466004 140000 466000"
CREST = "140020 466004 140000 466004"
NIL = '<imgeo:kruinlijnBegroeidTerreindeel xsi:nil="true" xmlns:xsi="http://x"/>'


def crest(points: str) -> str:
    """A crest line."""
    return (
        f"<imgeo:kruinlijnBegroeidTerreindeel><gml:LineString {RD}><gml:posList>{points}"
        "</gml:posList></gml:LineString></imgeo:kruinlijnBegroeidTerreindeel>"
    )


def part(name: str, on_slope: str, lines: str, extra: str = "", segments: str | None = None) -> str:
    """A part of land, its boundary a list of points or the segments of a curve."""
    boundary = (
        f"<gml:LinearRing><gml:posList>{AREA}</gml:posList></gml:LinearRing>"
        if segments is None
        else f"<gml:Ring><gml:curveMember><gml:Curve><gml:segments>{segments}</gml:segments>"
        "</gml:Curve></gml:curveMember></gml:Ring>"
    )
    return (
        f'<PlantCover gml:id="{name}">{extra}'
        f"<imgeo:geometrie2dBegroeidTerreindeel><gml:Polygon {RD}><gml:exterior>{boundary}"
        "</gml:exterior></gml:Polygon></imgeo:geometrie2dBegroeidTerreindeel>"
        f"<imgeo:begroeidTerreindeelOpTalud>{on_slope}</imgeo:begroeidTerreindeelOpTalud>{lines}"
        "</PlantCover>"
    )


def written(path: Path, *parts: str) -> Path:
    """A file of some parts."""
    return collection(path, BGT, *parts, member="cityObjectMember")


def test_the_crest_is_the_top(tmp_path: Path) -> None:
    (slope,), problems = read_slopes(written(tmp_path / "a.gml", part("a", "true", crest(CREST))))
    assert not problems
    assert (slope.id, slope.kind) == ("a", "slope-unreinforced")
    assert slope.source == "BGT, PlantCover"
    assert [*slope.top.coords] == [(140020.0, 466004.0), (140000.0, 466004.0)]
    assert slope.toe.length == pytest.approx(28.0)
    assert slope.crs is not None
    assert "RD New" in slope.crs


@pytest.mark.parametrize("member", ["curveMember", "curveMembers", "several"])
def test_a_crest_of_several_curves_is_one(member: str, tmp_path: Path) -> None:
    pieces = ["140000 466004 140009 466004", "140020 466004 140009 466004"]
    lines = [
        f"<gml:LineString {RD}><gml:posList>{piece}</gml:posList></gml:LineString>"
        for piece in pieces
    ]
    if member == "curveMember":
        lines = [f"<gml:curveMember>{line}</gml:curveMember>" for line in lines]
    inside = "".join(lines)
    if member == "curveMembers":
        inside = f"<gml:curveMembers>{inside}</gml:curveMembers>"
    name = "imgeo:kruinlijnBegroeidTerreindeel"
    crests = "".join(f"<{name}>{line}</{name}>" for line in lines)
    if member != "several":
        crests = f"<{name}><gml:MultiCurve>{inside}</gml:MultiCurve></{name}>"
    (slope,), (problem,) = read_slopes(written(tmp_path / "a.gml", part("a", "true", crests)))
    assert [*slope.top.coords] == [(140020.0, 466004.0), (140000.0, 466004.0)]
    assert problem.kind == "pieces"


def test_parts_that_do_not_slope_are_passed_over(tmp_path: Path) -> None:
    ended = "<imgeo:eindRegistratie>2019-11-07T05:39:59.000</imgeo:eindRegistratie>"
    path = written(
        tmp_path / "a.gml",
        part("flat", "false", NIL),
        part("crested", "false", crest(CREST)),
        part("old", "true", crest(CREST), ended),
        part("bare", "true", NIL),
        part("across", "true", crest("140020 466002 140000 466002")),
        part("good", "true", crest(CREST)),
    )
    slopes, problems = read_slopes(path)
    assert [slope.id for slope in slopes] == ["crested", "good"]
    assert [problem.id for problem in problems] == ["bare", "across"]
    assert problems[0].reason == "it lies on a slope, but has no crest line"
    assert "off the boundary" in problems[1].reason
    assert [slope.id for slope in read_slopes(path, history=True)[0]] == ["crested", "old", "good"]


def test_arcs_of_the_boundary_become_chords(tmp_path: Path) -> None:
    arc = "<gml:Arc><gml:posList>140020 466000 140010 465990 140000 466000</gml:posList></gml:Arc>"
    chord = (
        "<gml:LineStringSegment><gml:posList>140000 466000 140000 466004 140020 466004 "
        "140020 466000</gml:posList></gml:LineStringSegment>"
    )
    curved = part("a", "true", crest(CREST), segments=arc + chord)
    (slope,), _ = read_slopes(written(tmp_path / "a.gml", curved))
    assert slope.area.area == pytest.approx(80.0 + 50.0 * np.pi, rel=1e-3)
    assert slope.toe.length == pytest.approx(8.0 + 10.0 * np.pi, rel=1e-3)
    assert slope.top.length == 20.0


@pytest.mark.shared
@REAL
def test_slopes_of_gml_are_those_of_the_layers() -> None:
    ours, problems = read_slopes(FOLDER / "nl_bgt_gooi_ondersteunendwegdeel.gml")
    theirs = {slope.id: slope for slope in read_slopes(FOLDER / "nl_bgt_gooi.gpkg")[0]}
    assert len(ours) == 26
    assert len(problems) == 1
    assert len(theirs) == 71
    for slope in ours:
        other = theirs[slope.id]
        assert shapely.equals(slope.area, other.area)
        assert slope.top.equals_exact(other.top, 0.0)
        assert slope.toe.equals_exact(other.toe, 0.0)
    for slope in theirs.values():
        slope.strip()
        assert slope.top.length + slope.toe.length == pytest.approx(slope.area.exterior.length)
