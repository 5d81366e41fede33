"""Plots of profiles: a panel each up to a page, the same each time."""

from pathlib import Path
from typing import Any

import pytest
from shapely import LineString, box

from midrib import profile

pytest.importorskip("matplotlib")

from midrib.figures.profiles import MOST_PANELS, Panel, draw_profiles

PANEL = Panel("feature 0", profile(LineString([(1, 1), (5, 1), (9, 1)]), box(0, 0, 10, 4)))


@pytest.mark.parametrize("count", [1, 3, 4, 5, MOST_PANELS])
def test_every_profile_has_a_panel(count: int) -> None:
    figure = draw_profiles([PANEL] * count, unit="m")
    assert len(figure.axes) == count
    assert [text.get_text() for text in figure.texts] == [""]
    assert figure.axes[0].get_xlabel() == "station (m)"


@pytest.mark.parametrize(
    ("count", "sentence"),
    [
        (0, "No feature has a profile."),
        (MOST_PANELS + 1, "1 more profile is in the table, not drawn."),
        (MOST_PANELS + 9, "9 more profiles are in the table, not drawn."),
    ],
)
def test_what_is_left_out_is_said(count: int, sentence: str) -> None:
    figure = draw_profiles([PANEL] * count)
    assert len(figure.axes) == min(count, MOST_PANELS)
    assert [text.get_text() for text in figure.texts] == [sentence]


def test_panels_do_not_overlap() -> None:
    figure = draw_profiles([PANEL] * MOST_PANELS)
    figure.draw_without_rendering()
    boxes: list[Any] = [axes.get_tightbbox() for axes in figure.axes]
    assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i])
    page = figure.bbox
    assert all(page.x0 <= b.x0 and b.x1 <= page.x1 and page.y0 <= b.y0 for b in boxes)


def test_the_same_profile_gives_the_same_bytes(tmp_path: Path) -> None:
    for name in ("one.svg", "other.svg"):
        draw_profiles([PANEL], tmp_path / name)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "other.svg").read_bytes()
