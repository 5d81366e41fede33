"""Slopes with an edge in common: their strokes are in step along it."""

from typing import Any

import numpy as np
import pytest
import shapely
from shapely import LineString, Polygon

from midrib.errors import ParameterError
from midrib.formats.drawing.slopes import draw_slopes
from midrib.hatching.sharing import in_step
from midrib.hatching.slope import Slope

WIDTH = 6.0


def slope(name: str, top: LineString, toe: LineString) -> Slope:
    """Slope between two lines that run beside each other."""
    area = Polygon([*top.coords, *toe.coords[::-1]])
    return Slope(name, "slope-unreinforced", area, top, toe, "")


def level(y: float, length: float, turned: bool = False) -> LineString:
    """Level line."""
    line = LineString([(0, y), (0.3 * length, y), (length, y)])
    return line.reverse() if turned else line


def pair(shared: str, length: float, turned: tuple[bool, bool]) -> list[Slope]:
    """Two slopes on either side of a shared top or toe, whichever way each runs."""
    sides = []
    for name, y, way in (("up", WIDTH, turned[0]), ("down", -WIDTH, turned[1])):
        middle, outside = level(0, length, way), level(y, length, way)
        top, toe = (middle, outside) if shared == "top" else (outside, middle)
        sides.append(slope(name, top, toe))
    return sides


def on_shared_edge(slopes: list[Slope], **options: Any) -> list[dict[float, bool]]:
    """Where the whole strokes of each slope are along the shared edge, and which are long."""
    drawing = draw_slopes(slopes, "pl-2021-slope-unreinforced", **options)
    found = []
    for drawn in drawing.objects:
        x = shapely.get_coordinates(shapely.get_point(drawn.symbols.lines, 0))[:, 0]
        assert drawn.is_long is not None
        found.append(dict(zip(x.round(6).tolist(), drawn.is_long.tolist(), strict=True)))
    return found


@pytest.mark.parametrize("turned", [(False, False), (False, True), (True, False), (True, True)])
@pytest.mark.parametrize("length", [60.0, 63.0], ids=["odd count", "even count"])
@pytest.mark.parametrize("shared", ["top", "toe"])
def test_strokes_of_both_sides_meet_in_those_of_their_kind(
    shared: str, length: float, turned: tuple[bool, bool]
) -> None:
    one, other = on_shared_edge(pair(shared, length, turned))
    assert len(one) > 10
    assert one == other


def test_alone_kinds_depend_on_the_count() -> None:
    """What sharing is for: with an even count long strokes would meet short ones."""
    one, other = on_shared_edge(pair("top", 63.0, (False, True)), shared="apart")
    assert one.keys() == other.keys()
    assert all(one[x] != other[x] for x in one)


@pytest.mark.parametrize("shared", ["top", "toe"])
def test_strokes_of_one_side_are_between_those_of_the_other(shared: str) -> None:
    one, other = (
        np.array([*side])
        for side in on_shared_edge(pair(shared, 60.0, (False, True)), shared="between")
    )
    gap = np.median(abs(np.diff(np.sort(one))))
    apart = abs(one[:, None] - other).min(axis=1)
    assert apart == pytest.approx(gap / 2.0, rel=0.05)


def test_a_row_of_slopes_is_in_step_throughout() -> None:
    """A ditch between two dykes: top, toe, top, toe, each edge of two slopes."""
    slopes = [
        slope("a", level(12, 63), level(18, 63)),
        slope("b", level(12, 63, turned=True), level(6, 63, turned=True)),
        slope("c", level(0, 63), level(6, 63)),
        slope("d", level(0, 63, turned=True), level(-6, 63, turned=True)),
    ]
    first, *others = on_shared_edge(slopes)
    assert all(other == first for other in others)


def test_what_the_user_says_of_ends_holds() -> None:
    slopes = pair("top", 63.0, (False, True))
    for options in ({"start": "first"}, {"start": "last"}, {"rule": "paper", "start": "left"}):
        assert in_step(slopes, options, "meet") == [options, options]
    right = in_step(slopes, {"start": "right"}, "meet")
    assert [own["start"] for own in right] == ["right", "left"]


def test_slopes_that_touch_are_alone() -> None:
    ends = slope("a", level(0, 60), level(6, 60)), slope("b", level(6, 60), level(12, 60))
    corner = slope("c", LineString([(60, 0), (90, 0)]), LineString([(60, 6), (90, 6)]))
    mound = Polygon(
        shapely.Point(0, 99).buffer(9).exterior, [shapely.Point(0, 99).buffer(4).exterior]
    )
    ring = Slope(
        "m", "other", mound, LineString(mound.interiors[0]), LineString(mound.exterior), ""
    )
    told = in_step([*ends, corner, ring, ring], {}, "meet")
    assert {own["start"] for own in told[:3]} == {"left"}


@pytest.mark.parametrize(
    ("first", "last", "is_shared"), [(35, 95, False), (25, 85, True), (20, 30, True)]
)
def test_an_edge_is_shared_if_half_of_the_shorter_one_is(
    first: float, last: float, is_shared: bool
) -> None:
    """If so, the other side starts at the same end, which is on its right."""
    up = slope("a", LineString([(0, 0), (60, 0)]), LineString([(0, 6), (60, 6)]))
    down = slope("b", LineString([(first, 0), (last, 0)]), LineString([(first, -6), (last, -6)]))
    told = [own["start"] for own in in_step([up, down], {}, "meet")]
    assert told == ["left", "right" if is_shared else "left"]


def test_the_longest_part_in_common_decides() -> None:
    """One neighbour is above the edge and one below, so that they start at other ends of it."""
    short = slope("a", LineString([(0, 0), (20, 0)]), LineString([(0, 6), (20, 6)]))
    long = slope("b", LineString([(20, 0), (60, 0)]), LineString([(20, -6), (60, -6)]))
    last = slope("c", LineString([(0, 0), (60, 0)]), LineString([(0, -6), (60, -6)]))
    for others in ([short, long], [long, short]):
        assert in_step([*others, last], {}, "meet")[2]["start"] == "left"
    assert in_step([short, last], {}, "meet")[1]["start"] == "right"


def test_slopes_beside_a_closed_edge_are_alone() -> None:
    ring = LineString([(0, 0), (60, 0), (60, 60), (0, 60), (0, 0)])
    hole = LineString([(20, 20), (40, 20), (40, 40), (20, 40), (20, 20)])
    pit = Slope("r", "other", Polygon(ring, [hole.coords]), hole, ring, "")
    for points in ([(0, 0), (60, 0)], [(60, 0), (0, 0)]):
        below = slope("b", LineString([(x, -6) for x, _ in points]), LineString(points))
        assert [own["start"] for own in in_step([pit, below], {}, "meet")] == ["left"] * 2


def test_every_second_slope_of_a_row_is_half_a_gap_on() -> None:
    ways = ((12.0, 18.0), (12.0, 6.0), (0.0, 6.0), (0.0, -6.0))  # down and up in turn
    row = [slope(f"{top}", level(top, 60), level(toe, 60)) for top, toe in ways]
    for offset, other in ((1.0, 0.5), (0.4, 0.9)):
        told = in_step(row, {"offset": offset}, "between")
        assert [own["offset"] for own in told] == pytest.approx([offset, other] * 2)


def test_no_other_way_is_known() -> None:
    with pytest.raises(ParameterError, match="shared is 'no', expected 'meet' or 'between'"):
        draw_slopes([], shared="no")  # type: ignore[arg-type]
