"""Drawing an object by its standard."""

import pytest
import shapely
from shapely import LineString

from midrib import Strip, standard
from midrib.hatching.draw import draw

STRIP = Strip(LineString([(0, 6), (40, 6)]), LineString([(0, 0), (40, 0)]))


def test_strokes_follow_the_standard_and_the_scale() -> None:
    symbols, strokes = draw(STRIP, standard("pl-2021-stairs"), 500.0)
    assert strokes is not None
    assert strokes.spacing == pytest.approx(0.5, rel=0.01)
    _, strokes = draw(STRIP, standard("pl-2021-stairs"), 1000.0)
    assert strokes is not None
    assert strokes.spacing == pytest.approx(0.75, rel=0.02)
    assert strokes.is_long.all()
    assert symbols.lines.size > 70


def test_what_is_not_made_of_strokes_has_none() -> None:
    symbols, strokes = draw(STRIP, standard("pl-2015-conveyor"))
    assert strokes is None
    assert len(symbols.placed) == 1


@pytest.mark.parametrize(
    ("drop", "spacing"), [(None, 3.0), (6.0, 3.0), (4.1, 3.0), (3.9, 6.0), (1.0, 6.0), (-1.0, 3.0)]
)
def test_gentle_slopes_have_wider_gaps_in_german_practice(
    drop: float | None, spacing: float
) -> None:
    _, strokes = draw(STRIP, standard("de-general"), drop=drop)
    assert strokes is not None
    assert strokes.spacing == pytest.approx(spacing, rel=0.12)


def test_feet_are_drawn_as_metres() -> None:
    foot = 0.3048
    there = Strip(
        *(shapely.transform(line, lambda xy: xy / foot) for line in (STRIP.main, STRIP.auxiliary))
    )
    here = draw(STRIP, standard("tadpole")).symbols.flat()
    feet = draw(there, standard("tadpole"), metres_per_unit=foot).symbols.flat()
    assert foot * shapely.get_coordinates(feet.lines) == pytest.approx(
        shapely.get_coordinates(here.lines)
    )
    assert foot**2 * shapely.area(feet.areas) == pytest.approx(shapely.area(here.areas))
