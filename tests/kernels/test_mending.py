"""Strokes that would cross choose other directions."""

import numpy as np
import pytest
from shapely import LineString

from midrib import Strip
from midrib.hatching.middle import middle_of
from midrib.kernels.crossings import meet
from midrib.kernels.ladder import Spacing, Strokes, build_ladder, draw_strokes
from midrib.kernels.mending import mend
from midrib.types import Bools


def scrambled(turns: list[float]) -> tuple[Strokes, Bools]:
    """Strokes of a rectangle whose calm directions are turned by so much, mended."""
    strip = Strip(LineString([(0, 10), (100, 10)]), LineString([(0, 0), (100, 0)]))
    middle = middle_of(strip)
    rule = Spacing(0.5, 0.1, np.inf)
    ladder = build_ladder(middle.mesh, middle.top, middle.toe, middle.line, rule, 0.9, 0.0)
    strokes = draw_strokes(ladder, np.arange(5.0, 100.0, 5.0), rule)
    strokes.pivot[4 : 4 + len(turns), 3:5] += np.array(turns)[:, None]
    strokes.on[4 : 4 + len(turns)] = 0  # trouble
    return strokes, mend(ladder, strokes, middle.periods, 0.9, False)


@pytest.mark.parametrize("turns", [[1.0], [0.9, -0.9], [-1.0, 1.0, -1.0], [1.2, 1.2, -1.2, -1.2]])
def test_crossing_directions_are_mended(turns: list[float]) -> None:
    strokes, kept = scrambled(turns)
    assert kept.all()
    assert (np.diff(strokes.chord[:, :2], axis=0) > 0.0).all()
    segments = strokes.chord[:, 2:6].copy()
    first, second = np.triu_indices(len(segments), 1)
    assert not meet(segments, first, second).any()


def test_calm_strokes_stay_what_they_are() -> None:
    strokes, _ = scrambled([0.9, -0.9])
    far = np.r_[0:0, 10:19]
    assert strokes.pivot[far, 4] == pytest.approx(strokes.pivot[far, 3], abs=1e-12)


def test_segments_meet_by_exact_signs() -> None:
    tiny = 2.0**-52
    rows = np.array(
        [
            [0.0, 0.0, 1.0, 1.0],
            [1.0, 0.0, 0.5, 0.5],  # ends on the first one
            [1.0, 0.0, 0.5 + tiny, 0.5],  # just before it
            [2.0, 2.0, 3.0, 3.0],  # on its line, apart
            [0.5, 0.5, 3.0, 3.0],  # on its line, along it
        ]
    )
    found = meet(rows, np.zeros(4, dtype=np.intp), np.arange(1, 5))
    assert found.tolist() == [True, False, False, True]
