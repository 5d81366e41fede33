"""Slopes of a real survey; without the folder of shared data these tests are skipped."""

import sys
from pathlib import Path

import numpy as np
import pytest
import shapely

from midrib import Strip, hatch
from midrib.hatching.measures import measure

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

FOLDER = Path(__file__).parents[2].parent / "shared" / "data"
pytestmark = [
    pytest.mark.shared,
    pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent"),
]


def test_polish_slopes_need_no_repair() -> None:
    pytest.importorskip("pyogrio")
    from hatch_slopes import real_polish

    spacing, turned, count = [], [], 0
    for slope in real_polish():
        hatching = hatch(slope.strip, scale=500)
        found = measure(hatching)
        assert found.crossings == 0, slope.name
        assert shapely.covers(slope.strip.area, hatching.strokes).all(), slope.name
        assert found.short_of_edge == 0, slope.name
        missing = [problem for problem in hatching.problems if problem.kind == "missing"]
        assert len(missing) <= 1, slope.name
        assert len(hatching.problems) <= 2, slope.name
        spacing.append(found.spacing)
        turned.append(found.turns - found.allowed)
        count += found.strokes
    assert count > 18_000
    every = np.concatenate(spacing)
    assert np.mean((every >= 0.9) & (every <= 1.1)) >= 0.99
    assert np.mean(np.concatenate(turned) > 0.5) <= 0.005


def test_the_reference_drawing() -> None:
    """Counts and spacing within a tenth of a published drawing, directions within 5 degrees."""
    pyogrio = pytest.importorskip("pyogrio")
    source = FOLDER / "pl_szkoleniowy_skarpa_kreski.gpkg"
    slope = pyogrio.read_dataframe(source, layer="skarpa").iloc[0]
    ticks = pyogrio.read_dataframe(source, layer="kreski_wzorcowe")
    ring = np.array(slope.geometry.exterior.coords)[:-1, :2]
    ends = [(slope.gora_start_x, slope.gora_start_y), (slope.gora_koniec_x, slope.gora_koniec_y)]
    first, last = (int(np.argmin(np.hypot(*(ring - end).T))) for end in ends)
    n = len(ring)
    top, toe = (
        shapely.LineString(ring[np.arange(a, a + (b - a) % n + 1) % n])
        for a, b in ((first, last), (last, first))
    )
    drawn = ticks.geometry[shapely.get_num_coordinates(ticks.geometry.to_numpy()) == 2]
    start, stop = (np.array([t.coords[k][:2] for t in drawn]) for k in (0, 1))
    step = float(np.median(np.hypot(*np.diff(start, axis=0).T)))
    hatching = hatch(Strip(top, toe, slope.geometry), scale=1000, spacing=step)
    assert len(hatching.strokes) == pytest.approx(len(drawn), rel=0.1)
    assert np.median(hatching.spacing) == pytest.approx(step, rel=0.1)
    theirs = np.degrees(np.arctan2(*(stop - start).T[::-1]))
    ours = np.degrees(np.arctan2(*(hatching.on_toe - hatching.on_top).T[::-1]))
    near = shapely.STRtree(shapely.points(start)).nearest(shapely.points(hatching.on_top))
    off = abs((ours - theirs[near] + 90.0) % 180.0 - 90.0)
    corners = shapely.MultiPoint(shapely.get_coordinates(top))
    is_far = shapely.distance(corners, shapely.points(hatching.on_top)) > 2.0 * hatching.width
    assert np.count_nonzero(is_far) > 30
    assert off[is_far].max() <= 5.0
