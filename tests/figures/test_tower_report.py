"""What a report on a tower says and draws."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from midrib.figures.tower_pages import draw_deviation
from midrib.figures.tower_paper import table_sheets
from midrib.figures.tower_plots import shape_outline
from midrib.figures.tower_text import Content, headings_of, notes, rows_of_levels, summary_lines
from midrib.towers.cloud import ArrayCloud
from midrib.towers.kinks import Kink, Offset, RadiusStep
from midrib.towers.pipeline import Options, axis_of
from midrib.towers.records import TowerAxis
from midrib.towers.simulate import Tower
from midrib.towers.tolerance import Tolerance, tolerance_from, verdicts
from tests.towers.scans import dirty

OVAL = Tower(height=40.0, base_radius=2.5, top_radius=1.5, lean=0.1, oval=0.03, twist=30.0)


@pytest.fixture(scope="module")
def oval() -> TowerAxis:
    """Axis of an oval tower."""
    return axis_of(ArrayCloud(dirty(OVAL).points()), Options())


def told(axis: TowerAxis, name: str, tolerance: Tolerance | None = None) -> str:
    """One entry of the summary."""
    return next(text for key, text in summary_lines(axis, tolerance) if key == name)


def test_an_oval_is_described_and_drawn(oval: TowerAxis) -> None:
    text = told(oval, "sections")
    assert text.startswith("oval by 30.0 ± 0.0")
    assert text.endswith("longest towards 60°")
    turn = np.linspace(0.0, 2.0 * np.pi, 73)
    expected = 1.0 + 0.015 * np.cos(2.0 * (turn - np.radians(30.0)))
    assert shape_outline(oval, turn, 2.0) == pytest.approx(expected, abs=2e-4)


def test_stations_are_always_told_of(oval: TowerAxis) -> None:
    assert "could not be checked; registration is in sigma only if given" in told(oval, "stations")
    apart = replace(oval, labels=3)
    assert told(apart, "stations").startswith("3, but they could not be put together")


def test_zeros_have_no_sign_and_flags_stay_on_the_paper(oval: TowerAxis) -> None:
    levels = oval.levels.copy()
    levels["y"] = -1e-7
    levels["flag"] = "uncertain by 12.3 mm; radius from taper prior; stations not put together"
    axis = replace(oval, levels=levels)
    assert {row[2] for row in rows_of_levels(axis)} == {"0.0000"}
    for tolerance in (None, tolerance_from("20mm")):
        sheets = table_sheets(Content("a", axis, tolerance, "", ""))
        assert sum(
            "uncertain" in text.get_text() for s in sheets for text in s.figure.texts
        ) == len(levels)
        for sheet in sheets:
            boxes = [text.get_window_extent() for text in sheet.figure.texts]
            assert max(box.x1 for box in boxes) < sheet.figure.bbox.x1
            assert min(box.y0 for box in boxes) > 15.0 / 297.0 * sheet.figure.bbox.height
            flags = sorted(
                (box for box in boxes if box.x0 > 0.85 * sheet.figure.bbox.x1),
                key=lambda box: box.y0,
            )
            assert all(low.y1 < high.y1 for low, high in pairwise(flags))


def test_levels_are_beyond_undecided_or_within(oval: TowerAxis) -> None:
    """A tolerance at a level's own deviation decides nothing; half an interval more does."""
    levels = oval.levels[oval.is_answered]
    top, base = levels[-1], levels[0]
    half = 1.96 * np.hypot(top["sigma"], base["sigma_inner"])
    for off, expected in (
        (1.01, "within"),
        (0.5, "undecided"),
        (-0.5, "undecided"),
        (-1.01, "beyond"),
    ):
        tolerance = Tolerance("", float(top["deviation"] + off * half), 0.0)
        assert verdicts(levels, tolerance, oval.unit)[-1] == expected
        assert verdicts(levels, tolerance, oval.unit)[0] == "within"
    missing = oval.levels.copy()
    missing["x"][3] = np.nan
    tolerance = tolerance_from("40mm")
    judged = verdicts(missing, tolerance, oval.unit)
    assert judged[3] == ""
    assert set(judged) == {"", "beyond", "undecided", "within"}
    text = told(replace(oval, levels=missing), "tolerance", tolerance)
    for name in ("beyond", "undecided", "within"):
        assert f"{(judged == name).sum()} {name}" in text
    at = headings_of(tolerance).index("tolerance")
    rows = rows_of_levels(replace(oval, levels=missing), tolerance)
    assert [row[at] for row in rows[::-1]] == judged.tolist()
    assert {len(row) for row in rows} == {len(headings_of(tolerance))}


def test_verdicts_do_not_depend_on_the_unit(oval: TowerAxis) -> None:
    large = oval.levels.copy()
    for name in ("x", "y", "z", "deviation", "sigma", "sigma_inner"):
        large[name] *= 1e3
    tolerance = tolerance_from("10mm + h/1000")
    assert (
        verdicts(large, tolerance, 1e3).tolist() == verdicts(oval.levels, tolerance, 1.0).tolist()
    )


def test_notes_tell_of_sigma_and_azimuth(oval: TowerAxis) -> None:
    text = notes(Content("a", oval, None, "a.laz", ", with levelling, 0.1 mm/m"))
    assert "with levelling, 0.1 mm/m. Azimuths are clockwise from y" in text


def test_kinks_and_offsets_are_drawn_on_the_axis(oval: TowerAxis) -> None:
    axis = replace(
        oval,
        kinks=[Kink(12.3, 2.0, 90.0, 0.1)],
        offsets=[Offset(21.2, 0.008, 45.0, 0.0003)],
    )
    assert told(axis, "kinks") == "12 m (2.0 mm/m towards 90°)"
    assert told(axis, "offsets") == "21.2 m (8.0 ± 0.3 mm towards 45°)"
    assert told(oval, "offsets") == "none found"
    stepped = replace(oval, radius_steps=[RadiusStep(14.0, -0.03, 0.0002)])
    assert told(stepped, "steps of the radius") == "14.0 m (-30.0 ± 0.2 mm)"
    assert told(oval, "steps of the radius") == "none found"
    levels = axis.levels[axis.is_answered]
    for index, plot in enumerate(draw_deviation(axis).axes):
        name = "xy"[index]
        marks = {line.get_label(): line.get_xydata() for line in plot.lines}
        for label, z in (("kink", 12.3), ("offset", 21.2)):
            off = 1e3 * (np.interp(z, levels["z"], levels[name]) - levels[name][0])
            assert np.asarray(marks[label]) == pytest.approx(np.array([[off, z]]))
    assert "kink" not in {line.get_label() for line in draw_deviation(oval).axes[0].lines}


def test_the_longest_legend_stays_on_the_paper(oval: TowerAxis) -> None:
    axis = replace(
        oval,
        kinks=[Kink(12.3, 2.0, 90.0, 0.1)],
        offsets=[Offset(21.2, 0.008, 45.0, 0.0003)],
    )
    figure = draw_deviation(axis, tolerance_from("40mm + h/1000"))
    figure.canvas.draw()
    legend = figure.axes[0].get_legend()
    assert legend is not None
    box = legend.get_window_extent()
    assert box.y1 < figure.bbox.y1
    assert box.x1 < figure.bbox.x1
