"""The rule by which others have drawn a slope: it gives their strokes."""

from typing import Any

import numpy as np
import pytest
import shapely

from midrib import hatch, read_slopes, standard

drawn = pytest.importorskip("drawn_by_others")
pytestmark = [
    pytest.mark.shared,
    pytest.mark.skipif(not drawn.SOURCE.exists(), reason="shared test data is absent"),
]


def test_their_rule_gives_the_places_of_their_strokes() -> None:
    (slope,), _ = read_slopes(drawn.SOURCE)
    start, _ = drawn.strokes_of(drawn.SOURCE)
    ours = drawn.starts_along(slope, drawn.gap_of(slope))
    assert len(ours) == len(start)
    off = shapely.distance(shapely.multipoints(ours), shapely.points(start))
    assert off.max() < 2e-3  # the drawing has millimetres


WAYS: dict[str, dict[str, Any]] = {
    "rule": {"standard": "pl-2021-slope-unreinforced", "rule": "mean"},
    "standard": {"standard": "gml-explorer-like"},
}


@pytest.mark.parametrize("way", WAYS)
def test_by_the_rule_of_the_mean_ours_are_theirs(way: str) -> None:
    """Counts and spacing within a tenth, directions within 5 degrees but at one corner of 11."""
    (slope,), _ = read_slopes(drawn.SOURCE)
    start, stop = drawn.strokes_of(drawn.SOURCE)
    step = np.median(np.hypot(*np.diff(start, axis=0).T))
    ours = hatch(slope.strip(), scale=500.0, **WAYS[way])
    assert not ours.problems
    assert len(ours.strokes) == pytest.approx(len(start), rel=0.1)
    assert ours.spacing == pytest.approx(np.full(ours.spacing.size, step), rel=0.1)
    turned = drawn.off(ours, start, stop)
    assert (turned <= 5.0).sum() >= 52
    corner = shapely.Point(slope.top.coords[1])
    (row,) = np.flatnonzero(turned > 5.0)
    assert shapely.distance(corner, shapely.Point(start[row])) < step


def test_short_strokes_of_the_standard_are_theirs() -> None:
    """Theirs begin with a short one, and short ones go half the way to the toe."""
    (slope,), _ = read_slopes(drawn.SOURCE)
    start, stop = drawn.strokes_of(drawn.SOURCE)
    reach = shapely.distance(shapely.points(start), slope.toe)
    share = np.hypot(*(stop - start).T) / reach
    known = standard(drawn.THEIRS)
    wanted = [1.0 if letter == "L" else known.short_ratio for letter in known.pattern]
    assert share[2:-2] == pytest.approx(np.resize(wanted, len(share))[2:-2], abs=0.01)
