"""The scoreboard says yes to a perfect line and no, in the right column, to each flaw."""

import dataclasses

import numpy as np
import pytest
import shapely
from shapely import LineString, MultiLineString

from families import Case, make
from reference import axis_of
from rivals import MIDRIB
from score import COLUMNS, score_of
from scoreboard import all_runs, page, panel
from sheets import draw_sheet


def along_rectangle(*at: tuple[float, float]) -> LineString:
    """Line through points given in widths: along the middle from the first end, and to the left."""
    case = make("rect", 100)
    first, last = case.ends
    u = (last - first) / np.hypot(*(last - first))
    v = np.array([-u[1], u[0]])
    return LineString([first + case.width * (s * u + t * v) for s, t in at])


def failed(line: shapely.Geometry) -> set[str]:
    case = make("rect", 100)
    score = score_of(case, axis_of(case), line, is_exact=False)
    return {name for name, yes in zip(COLUMNS, score.answers, strict=True) if not yes}


def test_middle_of_a_rectangle_is_clean() -> None:
    assert failed(along_rectangle((0, 0), (10, 0))) == set()


def test_each_flaw_fails_its_column() -> None:
    middle = along_rectangle((0, 0), (10, 0))
    spur = along_rectangle((5, 0), (5, 0.4))
    assert failed(MultiLineString([middle, spur])) == {"one line"}
    assert failed(along_rectangle((0, 0), (4, 0), (4, 0.7), (4.1, 0), (10, 0))) == {"inside"}
    off = along_rectangle((0, 0), (0.1, 0.2), (9.9, 0.2), (10, 0))
    assert failed(off) == {"within .1 w"}
    assert failed(along_rectangle((0.1, 0), (9.9, 0))) == {"ends on boundary"}
    assert failed(along_rectangle((0, 0.5), (0.5, 0), (10, 0))) == {"ends in the middle"}
    half = failed(along_rectangle((0, 0), (5, 0)))
    assert half == {"within .1 w", "whole trunk", "ends on boundary", "ends in the middle"}


def test_no_line_fails_everything() -> None:
    assert failed(LineString()) == set(COLUMNS)


def test_offset_is_a_share_of_the_width() -> None:
    case = make("rect", 100)
    line = along_rectangle((0, 0), (0.1, 0.2), (9.9, 0.2), (10, 0))
    score = score_of(case, axis_of(case), line, is_exact=False)
    assert score.offset == pytest.approx(0.2, abs=1e-3)
    assert score.offset_max == pytest.approx(0.2, abs=1e-3)


def test_trunk_of_a_rectangle_runs_from_end_to_end() -> None:
    case = make("rect", 100)
    trunk = axis_of(case).trunk()
    assert trunk.length == pytest.approx(10 * case.width, rel=0.01)
    assert trunk.hausdorff_distance(LineString(case.ends)) < 0.01 * case.width


def ringed() -> Case:
    """A rectangle with an island in its middle."""
    case = make("rect", 100)
    island = shapely.Point(case.ends.mean(axis=0)).buffer(case.width / 4)
    return dataclasses.replace(case, area=case.area.difference(island))


@pytest.mark.parametrize("side", [-1, 1])
def test_trunk_passes_an_island_where_the_line_does(side: int) -> None:
    line = along_rectangle((0, 0), (4.5, 0), (5, 0.4 * side), (5.5, 0), (10, 0))
    trunk = axis_of(ringed()).trunk(line)
    assert trunk.distance(along_rectangle((5, 0.3 * side), (5, 0.5 * side))) == 0


def test_page_and_sheet_of_a_tiny_run(tmp_path) -> None:  # type: ignore[no-untyped-def]
    ways = (MIDRIB,)
    runs = all_runs(("rect", "holes"), (100,), ways)
    text = page(runs, ways)
    assert "## Areas without holes: 1 runs" in text
    assert "## Areas with holes: 1 runs" in text
    assert "| rect 100 | .000 |" in text
    assert runs[0].as_record()["answers"]["inside"]
    draw_sheet([panel(run) for run in runs], tmp_path / "sheet.png")
    assert (tmp_path / "sheet.png").stat().st_size > 0
