"""Slopes of drawings: which toe goes with which top."""

from pathlib import Path

import numpy as np
import pytest
import shapely
from shapely import LineString, Polygon

from midrib.errors import MissingDependencyError, ParameterError
from midrib.formats.drawing.slopes import draw_slopes
from midrib.formats.gathering import Gathered
from midrib.formats.pairs import add_pairs, joined
from midrib.formats.slopes import read_slopes
from midrib.formats.units import unit_of

ezdxf = pytest.importorskip("ezdxf")
FOLDER = Path(__file__).parents[3] / "shared" / "data"


def pairs(tops: list[LineString], toes: list[LineString]) -> Gathered:
    """Slopes between some lines."""
    found = Gathered()
    add_pairs(found, tops, toes, "x")
    return found


def level(y: float, x: float = 0.0, turned: bool = False) -> LineString:
    """A level line, nine long."""
    ends = [(x, y), (x + 9.0, y)]
    return LineString(ends[::-1] if turned else ends)


@pytest.mark.parametrize("turned", [False, True])
def test_each_top_goes_with_its_own_toe(turned: bool) -> None:
    found = pairs([level(0), level(10)], [level(12, turned=turned), level(-2)])
    assert not found.problems
    assert [shapely.normalize(slope.area) for slope in found.slopes] == [
        shapely.normalize(shapely.box(0, -2, 9, 0)),
        shapely.normalize(shapely.box(0, 10, 9, 12)),
    ]
    for slope in found.slopes:
        assert slope.toe.coords[0][0] == slope.top.coords[0][0]
        slope.strip()


def test_the_crest_of_a_dyke_has_two_toes_and_a_ditch_two_tops() -> None:
    dyke = pairs([level(0)], [level(2), level(-3)])
    assert sorted(slope.area.area for slope in dyke.slopes) == [18.0, 27.0]
    ditch = pairs([level(2), level(-3)], [level(0)])
    assert sorted(slope.area.area for slope in ditch.slopes) == [18.0, 27.0]
    assert {slope.id for slope in ditch.slopes} == {"x/1", "x/2"}


def test_closed_lines_go_together_and_bound_a_ring() -> None:
    hole, shell = (LineString(shapely.box(-r, -r, r, r).exterior.coords) for r in (1, 3))
    found = pairs([hole, level(20)], [level(22), shell])
    mound = max(found.slopes, key=lambda slope: slope.area.area)
    assert mound.area.area == 32.0
    assert mound.top.is_closed
    (pit,) = pairs([shell], [hole]).slopes
    assert pit.area.equals(mound.area)
    assert pit.top.equals(shell)


def test_lines_without_a_partner_are_told() -> None:
    ring = LineString(shapely.box(0, 0, 1, 1).exterior.coords)
    found = pairs([ring], [level(0)])
    assert not found.slopes
    assert [problem.reason for problem in found.problems] == [
        "no line goes with this top",
        "no line goes with this toe",
    ]
    assert all(problem.where is not None for problem in found.problems)
    crossing = pairs([LineString([(0, 0), (9, 9)])], [LineString([(0, 1), (9, 8)])])
    assert [problem.kind for problem in crossing.problems] == ["refused"]


def test_what_would_lie_on_another_slope_or_be_wider_than_long_is_no_slope() -> None:
    """A toe is missing, near and far; and a toe is in two pieces with a gap between them."""
    for height in (14.0, 1000.0):
        found = pairs([level(0), level(height)], [level(-3)])
        assert len(found.slopes) == 1
        assert [problem.id for problem in found.problems] == ["top 2"]
    far = pairs([level(0), LineString([(500, 0), (509, 0)])], [level(-3)])
    assert [problem.id for problem in far.problems] == ["top 2"]
    cut = pairs([level(0)], [LineString([(0, -3), (4, -3)]), LineString([(4.1, -3), (9, -3)])])
    assert len(cut.slopes) == 1
    assert [problem.kind for problem in cut.problems] == ["pairs", "refused"]


def test_edges_of_two_slopes_may_meet_in_a_corner() -> None:
    tops = [LineString([(0, 4), (20, 4)]), LineString([(24, 0), (24, -20)])]
    toes = [LineString([(0, 0), (20, 0)]), LineString([(20, 0), (20, -20)])]
    found = pairs(tops, toes)
    assert [slope.area.area for slope in found.slopes] == [80.0, 80.0]
    assert found.problems == []


@pytest.mark.parametrize(("code", "metres"), [(4, 0.001), (2, 0.3048), (6, 1.0)])
def test_the_unit_of_a_drawing_is_known(code: int, metres: float, tmp_path: Path) -> None:
    path = drawing(tmp_path / "a.dxf", "top", "toe")
    document = ezdxf.readfile(path)
    document.header["$INSUNITS"] = code
    document.saveas(path)
    (slope,), _ = read_slopes(path)
    unit = unit_of(slope.crs)
    assert unit is not None
    assert unit.metres == pytest.approx(metres)
    assert draw_slopes([slope]).metres_per_unit == pytest.approx(metres)


def test_joined_lines_are_in_the_order_of_the_file() -> None:
    """And none is lost where lines are twice there, or cross in their middles."""
    rows = [LineString([(0, y), (9, y)]) for y in (5.0, 0.0, 22.0, 3.0)]
    assert [line.coords[0][1] for line in joined(rows)] == [5.0, 0.0, 22.0, 3.0]
    halves = [LineString([(4, 0), (9, 0)]), rows[0], LineString([(0, 0), (4, 0)])]
    assert [line.coords[0][1] for line in joined(halves)] == [0.0, 5.0]
    cross = [LineString([(0, 0), (4, 4)]), LineString([(0, 4), (4, 0)])]
    assert len(joined(cross)) == 2
    assert joined([]) == joined([LineString()]) == []


def test_pieces_are_joined_whichever_way_they_run() -> None:
    pieces = [LineString([(0, 0), (1, 0)]), LineString([(3, 0), (1, 0)]), level(9)]
    assert sorted(line.length for line in joined(pieces)) == [3.0, 9.0]


def drawing(path: Path, top: str = "SKARPA_GORA", toe: str = "SKARPA_DOL") -> Path:
    """A half annulus in lines and arcs, one edge in two pieces, and a line on another layer."""
    document = ezdxf.new()
    space = document.modelspace()
    space.add_arc((0, 0), 10, 0, 180, dxfattribs={"layer": top})
    space.add_lwpolyline([(10, 0), (10, -5)], dxfattribs={"layer": top})
    space.add_lwpolyline([(12, 0, 0, 0, 1), (-12, 0)], format="xyseb", dxfattribs={"layer": toe})
    space.add_line((12, -5), (12, 0), dxfattribs={"layer": toe})
    space.add_line((0, 0), (1, 1), dxfattribs={"layer": "0"})
    document.saveas(path)
    return path


@pytest.mark.parametrize("names", [("SKARPA_GORA", "SKARPA_DOL"), ("a", "b")])
def test_tops_and_toes_are_found_by_their_layers(names: tuple[str, str], tmp_path: Path) -> None:
    path = drawing(tmp_path / "a.dxf", *names)
    told = {} if len(names[0]) > 1 else {"top": "A", "toe": "b*"}
    (slope,), problems = read_slopes(path, **told)  # type: ignore[arg-type]
    assert not problems
    assert slope.area.area == pytest.approx(22.0 * np.pi + 10.0, rel=1e-3)
    assert slope.top.length == pytest.approx(10.0 * np.pi + 5.0, rel=1e-3)
    off = np.hypot(*shapely.get_coordinates(slope.top).T)
    assert off[shapely.get_coordinates(slope.top)[:, 1] >= 0.0] == pytest.approx(10.0, rel=2e-4)
    slope.strip()


def test_heights_of_polylines_are_known(tmp_path: Path) -> None:
    document = ezdxf.new()
    space = document.modelspace()
    space.add_polyline3d([(0, 0, 172), (9, 0, 173)], dxfattribs={"layer": "top"})
    space.add_polyline3d([(0, 2, 170), (9, 2, 0)], dxfattribs={"layer": "toe"})
    document.saveas(tmp_path / "a.dxf")
    (slope,), _ = read_slopes(tmp_path / "a.dxf")
    assert slope.top_heights is not None
    assert slope.top_heights[:, 2].tolist() == [172.0, 173.0]
    assert slope.toe_heights is not None
    assert slope.toe_heights[:, 2].tolist() == [170.0]


def test_layers_that_are_missing_are_named(tmp_path: Path) -> None:
    path = drawing(tmp_path / "a.dxf", "a", "b")
    with pytest.raises(ParameterError, match="named like x, expected top to name one of '0', 'a'"):
        read_slopes(path, top="x", toe="b")
    with pytest.raises(ParameterError, match=r"named like \*gora\* or .*, expected top to name"):
        read_slopes(path)
    document = ezdxf.new()
    for k in range(12):
        document.modelspace().add_line((0, 0), (1, k), dxfattribs={"layer": f"L{k:02}"})
    document.saveas(tmp_path / "many.dxf")
    with pytest.raises(ParameterError, match=r"'L00', .*'L07' and 4 more$"):
        read_slopes(tmp_path / "many.dxf")
    broken = tmp_path / "b.dxf"
    broken.write_text("nothing")
    with pytest.raises(ParameterError, match=r"b\.dxf' cannot be read as a drawing"):
        read_slopes(broken)


def test_the_missing_library_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = drawing(tmp_path / "a.dxf")
    monkeypatch.setattr("midrib.checks.find_spec", lambda _: None)
    with pytest.raises(MissingDependencyError, match=r"pip install midrib\[dxf\]"):
        read_slopes(path)


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
def test_lines_and_arcs_of_a_real_drawing_join_into_loops() -> None:
    from midrib.formats.cad import pieces

    document = ezdxf.readfile(FOLDER / "dxf_2_polylines.dxf")
    lines = joined([*pieces(document, {"0"})])
    assert len(lines) < 79
    assert all(Polygon(line).is_valid for line in lines if line.is_closed)


def raised(line: LineString, *heights: float) -> LineString:
    """A line with heights at its ends."""
    return LineString([(*p, z) for p, z in zip(line.coords, heights, strict=True)])


# Across a dyke with a berm that is narrower than its slopes, y and height: the crest, the inner
# edge of the berm (a toe), the outer one (a top), the foot.
BERM = [(20.0, 9.0), (14.0, 6.0), (12.0, 5.95), (4.0, 2.0)]


def berm(along: float, *, flat: bool = False) -> tuple[list[LineString], list[LineString]]:
    """Tops and toes of a dyke with a berm; its crest rises by so much from end to end."""
    lines = [level(y) if flat else raised(level(y), z, z + along) for y, z in BERM]
    return lines[::2], lines[1::2]


@pytest.mark.parametrize("along", [0.0, 30.0], ids=["level crest", "rising crest"])
def test_a_berm_whose_heights_are_known_is_no_slope(along: float) -> None:
    found = pairs(*berm(along))
    assert sorted(slope.area.bounds[1::2] for slope in found.slopes) == [(4.0, 12.0), (14.0, 20.0)]
    assert not found.problems


def test_heights_are_compared_where_lines_are_beside_each_other() -> None:
    """A steep ramp, level across: most vertices of its lower edge are at its lower end."""
    top = raised(level(2), 100, 130)
    toe = LineString([(x, 0, 100 + 30 * x / 9) for x in (0.0, 0.5, 1.0, 1.5, 9.0)])
    assert not pairs([top], [toe]).slopes
    turned = LineString(toe.coords[::-1])
    assert not pairs([top], [turned]).slopes


def test_lines_behind_others_cast_no_doubt() -> None:
    """A ditch with a flat bottom, as wide as its sides."""
    ditch = pairs([level(0), level(7)], [level(2), level(5)])
    assert sorted(slope.area.area for slope in ditch.slopes) == [18.0, 18.0]
    assert not ditch.problems


def test_a_berm_without_heights_is_doubted() -> None:
    found = pairs(*berm(0.0, flat=True))
    doubts = [problem for problem in found.problems if problem.kind == "pairs"]
    on_berm = [slope.id for slope in found.slopes if slope.area.bounds[1::2] == (12.0, 14.0)]
    assert on_berm
    assert {*on_berm} <= {doubt.id for doubt in doubts}
    assert "a berm or a path is no slope" in doubts[0].reason
    assert all(doubt.where is not None for doubt in doubts)


@pytest.mark.parametrize(
    ("fall", "is_slope"), [(-1.0, False), (0.0, False), (0.09, False), (0.11, True)]
)
def test_what_falls_no_more_than_a_path_is_no_slope(fall: float, is_slope: bool) -> None:
    found = pairs([raised(level(2), 7 + fall, 7 + fall)], [raised(level(0), 7, 7)])
    assert len(found.slopes) == is_slope
    assert (
        [problem.reason for problem in found.problems] == []
        if is_slope
        else [
            "no line goes with this top: toe 1 beside it is not lower than a path may be",
            "no line goes with this toe: top 1 beside it is not higher than a path may be",
        ]
    )


@pytest.mark.parametrize("middle", [(True, True), (True, False), (False, True)])
def test_two_slopes_may_share_an_edge(middle: tuple[bool, bool]) -> None:
    """The edge between two slopes is on the layer of tops, on that of toes, or on both."""
    shared = raised(level(5), 6, 6)
    tops = [raised(level(9), 9, 9), *[shared] * middle[0]]
    toes = [*[shared] * middle[1], raised(level(0), 2, 2)]
    found = pairs(tops, toes)
    assert not found.problems
    assert sorted(slope.area.bounds[1::2] for slope in found.slopes) == [(0.0, 5.0), (5.0, 9.0)]
    for slope in found.slopes:
        assert slope.top.coords[0][1] > slope.toe.coords[0][1]


def test_a_shared_edge_on_both_layers_needs_no_heights() -> None:
    found = pairs([level(9), level(5)], [level(5), level(0)])
    assert {problem.kind for problem in found.problems} <= {"pairs"}
    assert sorted(slope.area.bounds[1::2] for slope in found.slopes) == [(0.0, 5.0), (5.0, 9.0)]


def test_pairs_that_nothing_else_is_beside_are_not_doubted() -> None:
    assert not pairs([level(0), level(30)], [level(-2), level(33)]).problems
    walled = pairs([level(0), level(5)], [level(2), level(8)])
    assert {p.kind for p in walled.problems} == {"pairs"}


def test_a_berm_of_a_drawing_is_left_out(tmp_path: Path) -> None:
    document = ezdxf.new()
    for layer, lines in zip(("DYKE_TOP", "DYKE_TOE"), berm(0.5), strict=True):
        for line in lines:
            document.modelspace().add_polyline3d([*line.coords], dxfattribs={"layer": layer})
    document.saveas(tmp_path / "a.dxf")
    slopes, problems = read_slopes(tmp_path / "a.dxf")
    assert sorted(slope.area.area for slope in slopes) == [54.0, 72.0]
    assert not problems
