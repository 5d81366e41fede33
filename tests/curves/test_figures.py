"""The paper's Figures 3 to 7 on areas with the traits that its text describes.

Source: M. M. Buczek, Geodesy and Cartography 66(1), 2017, sections 3 and 4. The paper gives no
coordinates; the areas are ours, those of the gallery.
"""

from collections.abc import Callable

import numpy as np
import pytest
import shapely
from examples.gallery.shapes import (
    NOTCH,
    chain,
    disjoint,
    disturbed,
    irregular,
    polygonal,
    variants,
)
from numpy.typing import NDArray
from shapely import LineString, Point, box
from shapely.affinity import translate

from midrib import Strip, minimal_radii
from tests.golden_files import difference, read_golden

Lines = dict[str, LineString]
TOLERANCE = 1e-6  # of golden files; the areas are some ten units long


def hidden() -> Strip:
    """Figure 4: the main curve turns back and hides the two nearest auxiliary segments."""
    return Strip(
        chain("0 0, 6 0, 6 4, 2 4, 2 3, 5 3, 5 1, 0 1"),
        chain("0 0, -1 -2, 8 -2, 8 6, 0 6, 0 1"),
    )


def figure_3() -> tuple[Strip, Lines]:
    strip = polygonal()
    return strip, {"curve": minimal_radii(strip, count=24).line}


def figure_1() -> tuple[Strip, Lines]:
    strip = disjoint()
    rules = {"main": "main", "caps": "caps", "radii": "radii"}
    return strip, {
        role: minimal_radii(strip, count=24, ends=rule).line  # type: ignore[arg-type]
        for role, rule in rules.items()
    }


def figure_4() -> tuple[Strip, Lines]:
    strip = hidden()
    return strip, {"curve": minimal_radii(strip, count=60, end_clearance=None).line}


def figure_5() -> tuple[Strip, Lines]:
    lines = {}
    for name, strip in variants().items():
        lines[f"{name}_pure"] = minimal_radii(strip, count=48, end_clearance=None).line
        if name != "long":  # proportions of unlike segments are no help
            lines[f"{name}_kept_clear"] = minimal_radii(strip, count=48).line
    return variants()["even"], lines


def figure_6() -> tuple[Strip, Lines]:
    strip = irregular()
    return strip, {"curve": minimal_radii(strip, count=48).line}


SMOOTH = Strip(chain("0 0, 12 0"), chain("0 2, 12 2"))


def figure_7() -> tuple[Strip, Lines]:
    strip = disturbed()
    lines = {
        "all": minimal_radii(strip, count=60, ends="caps").line,
        "dropped": minimal_radii(strip, count=60, ends="caps", skip=NOTCH).line,
    }
    return strip, lines


FIGURES: dict[str, Callable[[], tuple[Strip, Lines]]] = {
    "figure_1": figure_1,
    "figure_3": figure_3,
    "figure_4": figure_4,
    "figure_5": figure_5,
    "figure_6": figure_6,
    "figure_7": figure_7,
}


@pytest.mark.parametrize("name", FIGURES)
def test_figures_are_as_they_were(name: str) -> None:
    strip, lines = FIGURES[name]()
    golden = read_golden(name)
    assert strip.area.equals(golden.pop("area"))
    assert set(lines) == set(golden)
    for role, line in lines.items():
        off = difference(line, golden[role])
        assert off <= TOLERANCE, f"{role} is {off:g} off: {line.wkt}"


@pytest.mark.parametrize("name", FIGURES)
def test_figures_hold_their_lines(name: str) -> None:
    strip, lines = FIGURES[name]()
    for line in lines.values():
        assert strip.area.covers(line)
        assert line.is_simple


def test_the_comparer_can_fail() -> None:
    line = figure_3()[1]["curve"]
    points = np.array(line.coords)
    assert difference(line, line) == 0.0
    moved = points.copy()
    moved[len(points) // 2] += 10.0 * TOLERANCE
    assert difference(LineString(moved), line) > TOLERANCE
    assert difference(line.reverse(), line) == np.inf
    assert difference(LineString(points[:-3]), line) == np.inf
    assert difference(translate(line, 2.0 * TOLERANCE), line) > TOLERANCE
    looped = np.concatenate([points[:9], points[7:9], points[8:]])  # there and back again
    assert difference(LineString(looped), line) > TOLERANCE


# -- what the paper says of each ---------------------------------------------------------------


def of_circles(strip: Strip, on_main: NDArray[np.float64], radii: NDArray[np.float64]) -> float:
    """How much the circles reach beyond the auxiliary curve, at most."""
    distance = shapely.distance(shapely.points(on_main), strip.auxiliary)
    return float(np.abs(distance - radii).max())


def test_circles_of_figure_3_touch_the_auxiliary_curve() -> None:
    """For each segment of the auxiliary curve, a circle with a tangent point is found."""
    strip = polygonal()
    curve = minimal_radii(strip, count=24, end_clearance=None)
    assert of_circles(strip, curve.on_main, curve.radii) <= 1e-12
    assert np.array_equal(curve.points, (curve.on_main + curve.on_auxiliary) / 2.0)


def test_ends_of_figure_1_are_those_of_rule_2() -> None:
    """Overlap median points of the segments between corresponding ends."""
    lines = figure_1()[1]
    assert lines["caps"].coords[0] == (-0.5, 1.5)
    assert lines["caps"].coords[-1] == (11.5, 1.75)
    assert lines["main"].coords[0] == (0.0, 0.0)
    middle = box(3, -9, 8, 9)
    assert lines["main"].intersection(middle).equals(lines["radii"].intersection(middle))


def test_radii_of_figure_4_pass_over_hidden_points() -> None:
    """Segment connecting P with the closest point E doesn't meet the topological conditions."""
    strip = hidden()
    curve = minimal_radii(strip, count=60, end_clearance=None)
    nearest = shapely.distance(shapely.points(curve.on_main), strip.auxiliary)
    blocked = curve.radii > nearest + 1e-9
    assert blocked.any()
    for p, q in zip(curve.on_main, curve.on_auxiliary, strict=True):
        assert strip.area.buffer(1e-9).covers(LineString([p, q]))
    for p, distance in zip(curve.on_main[blocked], nearest[blocked], strict=True):
        place = strip.auxiliary.interpolate(strip.auxiliary.project(Point(p)))
        assert Point(p).distance(place) == pytest.approx(distance)
        assert not strip.area.buffer(1e-9).covers(LineString([Point(p), place]))


def test_the_even_variant_of_figure_5_is_nearest_to_the_axis() -> None:
    """In this case the MC and the AC of similar length and shape were used."""
    axis = chain("0 1, 12 1")
    lines = figure_5()[1]
    off = {name: lines[f"{name}_pure"].hausdorff_distance(axis) for name in variants()}
    assert off["even"] < min(off["short"], off["long"])


def test_the_middle_of_figure_5_is_the_same_in_every_variant() -> None:
    """In the middle part of an output object, the plot is the same for different conditions."""
    middle = box(3, -1, 9, 3)
    parts = [line.intersection(middle) for line in figure_5()[1].values()]
    assert all(part.equals(chain("3 1, 9 1")) for part in parts)


def test_initial_conditions_improve_the_ends_of_figure_5() -> None:
    """Right half of the figure: proportional intervals on the first segments."""
    strip = Strip(chain("0 1, 0 0, 12 0, 12 1"), chain("0 1, 0 2, 12 2, 12 1"))
    axis = chain("0 1, 12 1")
    pure = minimal_radii(strip, count=48, end_clearance=None).line
    kept = minimal_radii(strip, count=48, end_clearance="proportional").line
    corner = box(0, 0, 3, 2)
    parts = [line.intersection(corner) for line in (pure, kept)]
    off = [part.hausdorff_distance(axis.intersection(corner)) for part in parts]
    assert off[1] <= off[0]


def test_figure_6_runs_from_tip_to_tip() -> None:
    """If the input shape is a polygon with sharp ends, the first condition gives the best."""
    line = figure_6()[1]["curve"]
    assert line.coords[0] == (0.0, 0.0)
    assert line.coords[-1] == (12.0, 0.5)


def test_small_disturbances_matter_less_than_themselves_in_figure_6() -> None:
    """A dent in the auxiliary curve moves the curve by half its depth at most."""
    strip = irregular()
    points = np.array(strip.auxiliary.coords)
    dented = np.insert(points, 6, (points[5] + points[6]) / 2.0 + [0.0, 0.1], axis=0)
    other = Strip(strip.main, LineString(dented))
    plain, moved = (minimal_radii(s, count=48).line for s in (strip, other))
    assert moved.hausdorff_distance(plain) <= 0.1


def test_dropping_stations_of_figure_7_undoes_the_disturbance() -> None:
    """The altering of the point set resulted in the local improvement of the results."""
    lines = figure_7()[1]
    axis = chain("0 1, 12 1")
    before, after = (lines[role].intersection(box(0, -2, 6, 4)) for role in ("all", "dropped"))
    assert before.hausdorff_distance(axis.intersection(box(0, -2, 6, 4))) > 0.3
    assert after.equals(chain("0 1, 6 1"))


def test_figure_7_resists_disturbances_of_the_auxiliary_curve() -> None:
    """The plot is resistant to disturbances of the AC, but strongly related to the MC."""
    line = figure_7()[1]["all"]
    axis = chain("0 1, 12 1")
    on_main, on_auxiliary = (
        line.intersection(box(*x, 9)).hausdorff_distance(axis.intersection(box(*x, 9)))
        for x in ((2, -9, 5), (6.5, -9, 9))
    )
    assert on_auxiliary < on_main
