"""Ribbons have the axis they say they have, and offsets from it are what they should be."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
import shapely
from shapely import LineString, MultiLineString
from shapely.affinity import translate

from families import Case, make
from midrib import collapse
from offsets import Known, Offsets, offsets_of
from real_areas import FOLDER, long_areas
from reference import axis_of
from ribbon_shapes import KINDS, WIDTH, make_ribbon
from ribbons import (
    Run,
    centred_table,
    draw_sheets,
    kind_table,
    known_axis,
    left_over,
    off_middle,
    one_run,
    overview,
    p95_of,
    page,
    real_run,
    real_table,
)
from rivals import MIDRIB, available, line_by, variant

from .test_scoreboard import along_rectangle

SOLID = [kind for kind in KINDS if kind != "islands" and "rough" not in kind]


@pytest.mark.parametrize("kind", KINDS)
def test_a_ribbon_is_made_again_as_it_was(kind: str) -> None:
    first, again, other = (make_ribbon(kind, seed) for seed in (3, 3, 4))
    assert first.case.area.equals_exact(again.case.area)
    assert not first.case.area.equals_exact(other.case.area, 1.0)
    assert first.case.area.is_valid


@pytest.mark.parametrize("kind", SOLID)
def test_the_known_axis_is_the_trunk(kind: str) -> None:
    ribbon = make_ribbon(kind, 0)
    trunk = axis_of(ribbon.case).trunk()
    found = offsets_of(ribbon.case, Known(ribbon.axis, ribbon.width), trunk, is_exact=False)
    assert found.median < 0.01
    assert found.p95 < 0.05


@pytest.mark.parametrize("kind", SOLID)
def test_the_known_width_is_the_width(kind: str) -> None:
    ribbon = make_ribbon(kind, 1)
    inner = slice(len(ribbon.axis) // 10, -len(ribbon.axis) // 10)
    points = shapely.points(ribbon.axis[inner])
    width = 2.0 * shapely.distance(points, ribbon.case.area.boundary)
    assert width == pytest.approx(ribbon.width[inner], rel=0.1)


def test_the_trunk_goes_round_a_spit_thinner_than_its_samples() -> None:
    spit = [(20.0, 0.0), (20.01, 6.0), (20.02, 0.0)]
    area = shapely.Polygon([(0, 0), *spit, (40, 0), (40, 10), (0, 10)])
    ends = np.array([(0.0, 5.0), (40.0, 5.0)])
    trunk = axis_of(Case("spit", 7, area, ends, ends, ends), samples_per_width=10).trunk()
    assert area.buffer(1e-6).covers(trunk)
    assert trunk.intersection(LineString([(20.01, 0), (20.01, 10)])).y == pytest.approx(8, abs=0.3)


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
@pytest.mark.parametrize("file", ["geomaps_rivers_americas_poland", "gshhg_rivers_lakes_americas"])
def test_lines_of_real_lakes_and_rivers_are_near_their_trunks(file: str) -> None:
    areas = long_areas(FOLDER / f"{file}.parquet", None)[::25]
    runs = [
        real_run(file, area, line, None) for area, line in zip(areas, collapse(areas), strict=True)
    ]
    p95 = p95_of(runs)
    assert p95.size >= 30
    assert np.mean(p95 <= 0.1) >= 0.97
    assert np.median(p95) <= 0.02


def test_a_ribbon_ends_where_its_axis_does() -> None:
    for kind in KINDS:
        ribbon = make_ribbon(kind, 2)
        ends = shapely.points(ribbon.case.ends)
        assert shapely.distance(ends, ribbon.case.area.exterior).max() < 0.1 * WIDTH


def held(line: shapely.Geometry) -> Offsets:
    case = make("rect", 100)
    known = Known(case.ends, np.full(2, case.width))
    return offsets_of(case, known, line, is_exact=False)


def test_offsets_are_shares_of_the_width() -> None:
    found = held(along_rectangle((0, 0), (0.1, 0.2), (9.9, 0.2), (10, 0)))
    assert found.median == pytest.approx(0.2, abs=1e-6)
    assert found.p95 == pytest.approx(0.2, abs=1e-6)
    assert found.from_ends == pytest.approx(0.0, abs=1e-6)
    assert found.is_one_line
    assert found.is_inside


def test_a_short_line_shows_at_its_ends_only() -> None:
    found = held(along_rectangle((0.8, 0), (9.2, 0)))
    assert found.p95 == pytest.approx(0.0, abs=1e-6)
    assert found.ends == pytest.approx(0.76, abs=0.05)
    assert found.from_ends == pytest.approx(0.8)


def test_flaws_are_seen() -> None:
    middle = along_rectangle((0, 0), (10, 0))
    spur = along_rectangle((5, 0), (5, 0.4))
    assert not held(MultiLineString([middle, spur])).is_one_line
    assert not held(translate(middle, 0, 1e3)).is_inside
    assert held(along_rectangle((0, 0), (5, 0))).p95 > 3.0


def test_widths_are_those_of_the_place() -> None:
    ribbon = make_ribbon("tapering, 1:5", 0)
    aside = LineString(ribbon.axis).offset_curve(0.05 * WIDTH)
    known = Known(ribbon.axis, ribbon.width)
    found = offsets_of(ribbon.case, known, aside, is_exact=False)
    expected = np.percentile(0.05 * WIDTH / ribbon.width[20:-20], [50, 95])
    assert [found.median, found.p95] == pytest.approx(list(expected), rel=0.05)


def test_options_that_are_not_there_are_left_out_with_a_note() -> None:
    ways, notes = available([variant("midrib, by 3", count=3), variant("odd", no_such_option=1)])
    assert [way.name for way in ways] == ["midrib, by 3"]
    assert len(notes) == 1
    assert "no_such_option" in notes[0]


def test_a_line_beside_the_middle_is_off_it() -> None:
    case = make_ribbon("smooth banks, flat ends", 0).case
    line = MIDRIB.run(case.area, case.width)
    shifted = translate(line, 0.0, 0.2 * case.width)
    lean, off = off_middle(case, line)
    assert lean <= 0.02
    assert off <= 0.01
    lean, off = off_middle(case, shifted)
    assert lean == pytest.approx(0.4, abs=0.03)
    assert off == pytest.approx(0.2, abs=0.02)


def test_a_way_that_fails_is_counted() -> None:
    ribbon = make_ribbon("round ends", 0)
    broken = dataclasses.replace(MIDRIB, name="broken", run=lambda *_: 1 / 0)
    assert line_by(broken, ribbon.case) == (None, "ZeroDivisionError")
    run = one_run(ribbon.case, broken, known_axis(ribbon))
    assert not run.is_good
    assert "1 of 1" in kind_table([run], [broken])


def runs_of(*kinds: str) -> list[Run]:
    ribbons = [make_ribbon(kind, 0) for kind in kinds]
    return [one_run(ribbon.case, MIDRIB, known_axis(ribbon)) for ribbon in ribbons]


def test_page_and_sheets_of_a_tiny_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    runs = runs_of("sharp ends", "islands")
    text = page(runs, [MIDRIB], ["a note."], [("some layer", runs)])
    assert "## Sharp ends" in text
    assert "a note." in text
    assert "| some layer | 2 |" in text
    assert runs[0].as_record()["median"] < 0.1
    assert overview(runs, [MIDRIB], "p95") in text
    assert real_table([("some layer", runs)]) in text
    assert centred_table(runs) in text
    assert left_over([("some layer", runs)]) in text
    monkeypatch.setattr("ribbons.OUT", tmp_path)
    draw_sheets(runs, "few")
    assert {path.name for path in tmp_path.iterdir()} == {
        "few_random.png",
        "few_worst_median.png",
        "few_worst_p95.png",
        "few_worst_ends.png",
    }
