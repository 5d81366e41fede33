"""Sheets of panels: neither flat nor tall, whatever the shape."""

import numpy as np
import pytest
import shapely
from shapely import box

from midrib.figures.sheet import FLATTEST, TALLEST, TITLE, Sheet, sheet_of

SHAPES = {
    "road": (10.0, 3000.0), "column": (1.0, 30.0), "tall": (1.0, 4.0), "square": (1.0, 1.0),
    "flat": (4.0, 1.0), "river": (30.0, 1.0), "wide": (3000.0, 10.0), "thread": (1.0, 1e6),
}  # fmt: skip


def laid_out(shape: str, count: int = 8, width: float = 240.0) -> Sheet:
    return sheet_of(count, np.array(SHAPES[shape]), width, 10.0)


@pytest.mark.parametrize("width", [120.0, 240.0, 420.0])
@pytest.mark.parametrize("count", [2, 3, 8, 14])
@pytest.mark.parametrize("shape", SHAPES)
def test_sheets_are_neither_flat_nor_tall(shape: str, count: int, width: float) -> None:
    sheet = laid_out(shape, count, width)
    assert FLATTEST <= round(sheet.height / sheet.width, 9) <= (TALLEST if width > 120.0 else 2.0)


@pytest.mark.parametrize("count", [2, 3, 8, 14])
@pytest.mark.parametrize("shape", SHAPES)
def test_the_shape_fits_in_panels_apart(shape: str, count: int) -> None:
    sheet = laid_out(shape, count)
    size = np.array(SHAPES[shape])[:: -1 if sheet.is_turned else 1] * sheet.scale
    assert (size <= sheet.panel).all()
    assert (size > 0.9 * sheet.panel).any()
    places = np.array([sheet.place(k) for k in range(count)])
    panels = box(*places[:, :2].T, *(places[:, :2] + places[:, 2:]).T)
    assert shapely.contains_properly(box(0, 0, 1, 1), panels).all()
    titles = box(
        places[:, 0], places[:, 1], places[:, 0] + places[:, 2],
        places[:, 1] + places[:, 3] + 0.99 * TITLE / sheet.height,
    )  # fmt: skip
    assert shapely.STRtree(titles).query(titles, "intersects").shape[1] == count
    assert places[:, 1].min() * sheet.height == pytest.approx(10.0)


def test_only_what_is_much_taller_than_wide_is_turned() -> None:
    turned = {shape for shape in SHAPES if laid_out(shape).is_turned}
    assert turned == {"road", "column", "thread"}


def test_a_turned_shape_is_as_large_as_one_that_lies() -> None:
    assert laid_out("road")._replace(is_turned=False).scale == laid_out("wide").scale
