"""The rule by which others have drawn a slope: it gives their strokes."""

import pytest
import shapely

from midrib import hatch, read_slopes

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


def test_with_their_gap_at_right_angles_to_the_top_ours_are_theirs() -> None:
    (slope,), _ = read_slopes(drawn.SOURCE)
    start, stop = drawn.strokes_of(drawn.SOURCE)
    gap = drawn.gap_of(slope)
    ours = hatch(slope.strip(), scale=drawn.SCALE, spacing=gap, top_share=1.0)
    assert len(ours.strokes) == pytest.approx(len(start), rel=0.1)
    near = shapely.STRtree(shapely.points(ours.on_top)).nearest(shapely.points(start))
    turn = drawn.angle(ours.on_toe - ours.on_top)[near] - drawn.angle(stop - start)
    off = abs((turn + 90.0) % 180.0 - 90.0)
    assert (off <= 5.0).sum() >= 52
