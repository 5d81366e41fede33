"""What a report on a tower says and draws."""

from dataclasses import replace

import numpy as np
import pytest

from midrib.figures.tower_plots import shape_outline
from midrib.figures.tower_report import Content, notes, rows_of_levels, summary_lines, table_sheet
from midrib.towers.cloud import ArrayCloud
from midrib.towers.pipeline import Options, axis_of
from midrib.towers.records import TowerAxis
from midrib.towers.simulate import Tower
from tests.towers.scans import dirty

OVAL = Tower(height=40.0, base_radius=2.5, top_radius=1.5, lean=0.1, oval=0.03, twist=30.0)


@pytest.fixture(scope="module")
def oval() -> TowerAxis:
    """Axis of an oval tower."""
    return axis_of(ArrayCloud(dirty(OVAL).points()), Options())


def told(axis: TowerAxis, name: str) -> str:
    """One entry of the summary."""
    return next(text for key, text in summary_lines(axis) if key == name)


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
    levels["flag"] = "sections have 5 lobes of 12.3 mm, which a circle does not have"
    rows = rows_of_levels(replace(oval, levels=levels))
    assert {row[2] for row in rows} == {"0.0000"}
    figure = table_sheet(rows[:5]).figure
    right = figure.bbox.x1
    assert all(text.get_window_extent().x1 < right for text in figure.texts)


def test_notes_tell_of_sigma_and_azimuth(oval: TowerAxis) -> None:
    text = notes(Content("a", oval, None, "a.laz", ", with levelling, 0.1 mm/m"))
    assert "with levelling, 0.1 mm/m. Azimuths are clockwise from y" in text
