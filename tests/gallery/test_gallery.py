"""Every script of the gallery runs, and what the paper says of its figure holds.

Source: M. M. Buczek, Geodesy and Cartography 66(1), 2017; quotations are in the docstrings.
"""

import runpy
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from shapely import LineString, Point, Polygon, box

from midrib import Strip, minimal_radii
from midrib.hatching.measures import crossings

pytest.importorskip("matplotlib")

import matplotlib as mpl
import matplotlib.pyplot as plt

mpl.use("Agg")

FOLDER = Path(__file__).parents[2] / "examples" / "gallery"
SCRIPTS = sorted(path.stem for path in FOLDER.glob("plot_*.py"))
NAMED = {
    "plot_14_chimney": {"main curve", "auxiliary curve", "curve of minimal radii"},
    "plot_15_top": {"walls", "curves from either wall", "mean curve", "middles at the same height"},
}
NEARLY = 1e-9  # of shapes some ten units large
Floats = NDArray[np.float64]
Names = dict[str, Any]


@cache
def run(stem: str) -> Names:
    """Names that a script leaves; it draws one figure with a legend."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(FOLDER))
        patch.setattr(plt, "show", lambda: None)
        names = runpy.run_path(str(FOLDER / f"{stem}.py"))
    (number,) = plt.get_fignums()
    figure = plt.figure(number)
    figure.canvas.draw()
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    plt.close(figure)
    assert NAMED.get(stem, {"area", "main curve", "auxiliary curve"}) <= set(texts)
    return names


def figure(number: int) -> Names:
    """Names that the script of a figure leaves."""
    (stem,) = (stem for stem in SCRIPTS if stem.startswith(f"plot_{number:02d}_"))
    return run(stem)


def off_axis(line: LineString, axis: LineString, window: Polygon) -> float:
    """Largest distance between a line and an axis inside a window."""
    return float(line.intersection(window).hausdorff_distance(axis.intersection(window)))


def share_of(crossed: Any, curve: Any, rows: NDArray[np.intp]) -> Floats:
    """Where radii meet a line, from 0 on the main curve to 1 on the auxiliary; the first place."""
    radii = shapely.linestrings(np.stack([curve.on_main[rows], curve.on_auxiliary[rows]], axis=1))
    starts = shapely.points(curve.on_main[rows])
    met = shapely.distance(starts, shapely.intersection(radii, crossed))
    return np.asarray(met / shapely.length(radii))


def test_there_is_a_script_for_each_of_the_fifteen_figures() -> None:
    assert [int(stem.split("_")[1]) for stem in SCRIPTS] == list(range(1, 16))


@pytest.mark.parametrize("stem", SCRIPTS)
def test_every_script_runs(stem: str) -> None:
    title = f"Figure {int(stem.split('_')[1])}: "
    assert run(stem)["__doc__"].startswith(f"\n{title}")


def test_figure_1_ends_halfway_between_ends_of_disjoint_curves() -> None:
    """Overlap median points of the segments between corresponding ends (rule 2)."""
    names = figure(1)
    strip, line = names["strip"], names["curve"].line
    assert strip.main.disjoint(strip.auxiliary)
    for k in (0, -1):
        ends = np.array([strip.main.coords[k], strip.auxiliary.coords[k]])
        assert line.coords[k] == pytest.approx(ends.mean(axis=0))


def test_figure_2_leaves_no_segment_to_neither_curve_or_both() -> None:
    """There cannot be a segment that belongs to neither of these two curves, or to both."""
    names = figure(2)
    strip, boundary = names["strip"], names["area"].exterior
    assert strip.main.length + strip.auxiliary.length == pytest.approx(boundary.length)
    assert shapely.union(strip.main, strip.auxiliary).equals(boundary)
    assert strip.main.intersection(strip.auxiliary).equals(strip.main.boundary)


def test_circles_of_figure_3_touch_and_the_smallest_counts() -> None:
    """For each segment of the auxiliary curve, a circle with a tangent point is found."""
    names = figure(3)
    strip, curve, p = names["strip"], names["curve"], names["p"]
    lengths = [radius.length for radius in names["radii"]]
    assert len(lengths) == len(strip.auxiliary.coords) - 1
    for length, segment in zip(lengths, names["segments"], strict=True):
        assert segment.distance(Point(p).buffer(0.999 * length)) > 0.0
        assert segment.distance(Point(p)) == pytest.approx(length)
    assert curve.radii[8] == pytest.approx(min(lengths))
    assert curve.points == pytest.approx((curve.on_main + curve.on_auxiliary) / 2.0)
    assert shapely.distance(shapely.points(curve.points), curve.line).max() <= NEARLY


def test_radius_of_figure_4_passes_over_hidden_points() -> None:
    """Both segments intersect the main curve; the shortest one that does not is used."""
    names = figure(4)
    strip, candidates, seen = names["strip"], names["candidates"], names["seen"]
    hidden = candidates[names["nearer"]]
    assert len(hidden) == 2
    assert not seen[names["nearer"]].any()
    for way in hidden:
        assert way.difference(Point(names["p"]).buffer(0.1)).intersects(strip.main)
    assert names["minimal"] == pytest.approx(shapely.length(candidates[seen]).min())


def test_the_even_main_curve_of_figure_5_is_nearest_to_the_axis() -> None:
    """The second result is the closest to the anticipations about the symmetry axis."""
    axis = LineString([(0, 1), (12, 1)])
    off = {key: curve.line.hausdorff_distance(axis) for key, curve in figure(5)["curves"].items()}
    for way in figure(5)["CLEARANCES"]:
        assert off["even", way] < min(off["short", way], off["long", way])
    assert off["even", "in proportion"] <= NEARLY < off["even", "plain"]


def test_the_middle_of_figure_5_is_the_same_but_for_the_worst() -> None:
    """In the middle part of an output object, the plot is the same for different conditions."""
    middle, axis = box(3, -1, 9, 3), LineString([(0, 1), (12, 1)])
    off = {key: off_axis(c.line, axis, middle) for key, c in figure(5)["curves"].items()}
    assert off.pop(("long", "in proportion")) > 0.1  # what the page warns of
    assert max(off.values()) <= NEARLY


def test_figure_6_runs_from_tip_to_tip_and_yields_less_than_a_dent() -> None:
    """For strongly irregular shapes, the influence of small disturbances decreases."""
    names = figure(6)
    strip, line = names["strip"], names["curve"].line
    assert [line.coords[k] for k in (0, -1)] == [strip.main.coords[k] for k in (0, -1)]
    corners, depth = np.array(strip.auxiliary.coords), 0.1
    moves = []
    for k in range(1, len(corners)):
        dent = (corners[k - 1] + corners[k]) / 2.0 + [0.0, depth]
        dented = Strip(strip.main, LineString(np.insert(corners, k, dent, axis=0)))
        moves.append(minimal_radii(dented, count=48).line.hausdorff_distance(line))
    assert max(moves[1:]) < depth < moves[0]  # the page names the first segment


def test_leaving_stations_out_mends_figure_7() -> None:
    """The altering of the point set resulted in the local improvement of the results."""
    names = figure(7)
    axis = LineString([(0, 1), (12, 1)])
    notch, spur = box(2, -9, 5, 9), box(6.5, -9, 9, 9)
    assert off_axis(names["mended"].line, axis, notch) <= NEARLY
    assert off_axis(names["plain"].line, axis, notch) > 0.3
    assert off_axis(names["plain"].line, axis, spur) <= 0.3  # resistant to the auxiliary curve's


def test_skeletons_of_figure_8_have_branches_and_the_others_none() -> None:
    """The medial axis and skeletonization results are branched objects."""
    strip, results = figure(8)["strip"], list(figure(8)["results"].values())
    for branched in results[:2]:
        ends = shapely.get_coordinates(shapely.get_parts(shapely.line_merge(branched)).tolist())
        _, counts = np.unique(ends.round(9), axis=0, return_counts=True)
        assert counts.max() >= 3
    for line in results[2:]:
        assert line.geom_type == "LineString"
        assert line.is_simple
        assert strip.area.covers(line)


def rows_between(
    curve: Any, first: tuple[float, float], last: tuple[float, float]
) -> NDArray[np.intp]:
    """Rows whose stations lie strictly between two points of the main curve."""
    low, high = (curve.strip.main.project(Point(place)) for place in (first, last))
    return np.flatnonzero((curve.stations > low + NEARLY) & (curve.stations < high - NEARLY))


def test_the_curve_of_figure_9_lies_between_both_skeletons_in_the_middle_part() -> None:
    """In the same part, both have different shapes. The CMR lays between them."""
    names = figure(9)
    curve = names["curve"]
    corner, sides = Point(4, 10), names["strip"].main.coords
    for k in range(3):  # the chamfer touches the circle on which the sides end
        assert corner.distance(LineString(sides[k : k + 2])) == pytest.approx(4.0)
    rows = rows_between(curve, (0, 10), (4, 6))
    medial, straight = (share_of(names[key].trunk, curve, rows) for key in ("medial", "straight"))
    assert len(rows) > 20
    assert (straight <= 0.5 + NEARLY).all()
    assert (medial >= 0.5 - NEARLY).all()
    chamfer = np.isin(rows, rows_between(curve, names["strip"].main.coords[1], (2, 6.5)))
    assert (medial - straight)[chamfer].max() > 0.05


def test_the_mean_curve_of_figure_9_is_too_close_to_the_auxiliary_curve() -> None:
    """In the middle part, the mean curve lays too close to the auxiliary curve."""
    names = figure(9)
    curve = names["curve"]
    rows = rows_between(curve, (0, 10), (4, 6))
    mean, medial = (share_of(line, curve, rows) for line in (names["mean"], names["medial"].trunk))
    assert (mean > medial).mean() > 0.75


def test_lines_of_figure_9_are_one_in_the_regular_part() -> None:
    """The regular part (upper part) is collinear or very close to them."""
    names = figure(9)
    regular, axis = box(0, 13, 4, 18), LineString([(2, 13), (2, 18)])
    for line in (names["curve"].line, names["medial"].lines, names["straight"].lines):
        assert off_axis(line, axis, regular) <= NEARLY


def test_ends_of_figure_9_run_along_one_branch() -> None:
    """The ends are dividing into a few segments and the CMR is collinear to one of them."""
    names = figure(9)
    corner = box(0, 21, 1, 22)
    end = names["curve"].line.intersection(corner)
    assert end.length == pytest.approx(np.sqrt(2.0))
    for key in ("medial", "straight"):
        assert end.within(names[key].lines.buffer(NEARLY))


def test_the_curve_of_figure_9_cuts_the_second_bend() -> None:
    """What the page says of where it does not lie between them."""
    names = figure(9)
    slot = Point(names["strip"].main.coords[4])
    eastward = LineString([slot, (19.0, slot.y)])
    curve, medial, straight = (
        slot.distance(eastward.intersection(line))
        for line in (names["curve"].line, names["medial"].trunk, names["straight"].trunk)
    )
    assert 0.0 < curve < 0.5 * min(medial, straight)


def test_trimmed_strokes_of_figure_10_cross_less() -> None:
    """Graphical mistakes and mutual intersections may occur in the final result."""
    names = figure(10)
    before, after = crossings(names["untrimmed"]), crossings(names["trimmed"])
    assert 0 < after < before / 5
    ends = shapely.get_point(names["trimmed"], -1)
    is_trimmed = shapely.length(names["trimmed"]) < shapely.length(names["untrimmed"]) - NEARLY
    assert is_trimmed.mean() > 0.8  # the others leave the slope at its ends
    assert shapely.distance(ends[is_trimmed], names["curve"].line).max() <= NEARLY


def test_gaps_of_figure_11_are_those_of_equation_2() -> None:
    """b = (a + c) / 4; every second hatch line is as long as half of the mean of a and c."""
    names = figure(11)
    hatching = names["hatching"]
    x = hatching.on_top[:, 0]
    a, c = hatching.width[:-2], hatching.width[1:-1]  # the last two strokes before each gap
    assert np.diff(x)[1:] == pytest.approx((a + c) / 4.0)
    assert (hatching.is_long[1:] != hatching.is_long[:-1]).all()
    lengths = shapely.length(hatching.strokes)
    assert lengths[hatching.is_long] == pytest.approx(hatching.width[hatching.is_long])
    assert lengths[~hatching.is_long] == pytest.approx(hatching.width[~hatching.is_long] / 2.0)


def test_strokes_of_figure_12_are_trimmed_to_the_curve() -> None:
    """Every second line was trimmed; consecutive hatch lines have similar lengths."""
    names = figure(12)
    for hatching in names["hatchings"].values():
        assert crossings(hatching.strokes) == 0
        ratio = hatching.width[1:] / hatching.width[:-1]
        assert np.maximum(ratio, 1.0 / ratio).max() < 1.5
    paper = names["hatchings"]["the paper's procedure"]
    assert (paper.is_long[1:] != paper.is_long[:-1]).all()
    short = shapely.get_point(paper.strokes[~paper.is_long], -1)
    assert shapely.distance(short, names["curve"].line).max() <= NEARLY


def test_circles_of_figure_13_touch_both_edges_in_turn() -> None:
    """Big circles never intersect the lines, and the small ones lie in the middle between them."""
    names = figure(13)
    strip, circles = names["strip"], names["circles"]
    at, radius = shapely.points(circles.at), circles.size / 2.0
    main, auxiliary = (shapely.distance(at, c) for c in (strip.main, strip.auxiliary))
    assert main == pytest.approx(auxiliary, abs=NEARLY)
    assert radius[::2] == pytest.approx(main[::2], abs=1e-5)  # the first one touches the cap too
    assert (radius[1::2] < 0.6 * main[1::2]).all()


def across(chain: Floats, heights: Floats) -> Floats:
    """How far across a chain (n, 2) is at heights."""
    order = np.argsort(chain[:, 1], kind="stable")
    return np.asarray(np.interp(heights, chain[order, 1], chain[order, 0]), dtype=np.float64)


CALM, DISTURBED = np.arange(3.0, 45.0, 0.1), np.arange(52.5, 57.5, 0.1)  # metres up the chimney


def test_disturbed_walls_of_figure_14_attract_the_curve() -> None:
    """In the bottom part deviations are imperceptible; above, it converges to the main curve."""
    names = figure(14)
    plane, truth = names["plane"], names["truth"]
    low, high = (
        across(plane.from_main, heights) - across(truth, heights) for heights in (CALM, DISTURBED)
    )
    apart = across(plane.auxiliary, CALM) - across(plane.main, CALM)
    assert np.abs(low / apart).max() < 0.005  # a line's width of the figure is one hundredth
    assert plane.main[:, 0].mean() < 0.0
    assert high.min() == pytest.approx(-names["chimney"].__globals__["BULGE"][1] / 2.0, abs=0.005)


def test_the_curve_of_figure_14_ends_halfway_between_ends_of_the_walls() -> None:
    """The author chose the second condition: median points between ends of two disjoint curves."""
    plane = figure(14)["plane"]
    for k in (0, -1):
        ends = (plane.main[k] + plane.auxiliary[k]) / 2.0
        assert np.abs(plane.from_main[[0, -1]] - ends).max(axis=1).min() < 1e-3


def test_both_averages_of_figure_15_are_nearer_to_the_axis_than_either_curve() -> None:
    """Below they are almost the same, at the top not; averages better approximate the axis."""
    names = figure(15)
    kinds = ("from_main", "from_auxiliary", "mean_curve", "same_height")
    most = []
    for plane, truth in zip(names["planes"], names["truths"], strict=True):
        off = {k: across(getattr(plane, k), CALM) - across(truth, CALM) for k in kinds}
        size = {k: np.sqrt(np.mean(v**2)) for k, v in off.items()}
        for average in ("mean_curve", "same_height"):
            assert size[average] < 0.8 * min(size["from_main"], size["from_auxiliary"])
        assert np.abs(off["mean_curve"] - off["same_height"]).max() < 1e-3
        top = across(plane.from_main, DISTURBED) - across(plane.from_auxiliary, DISTURBED)
        low = off["from_main"] - off["from_auxiliary"]
        # Apart from r sin² of the taper, by which either is off towards its wall.
        most.append(np.std(top) / np.std(low))
    assert most[0] > 2.0  # direction X, across the bulge
    assert most[1] < 1.0
