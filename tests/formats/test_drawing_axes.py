"""DXF of a tower's axis: all levels in space, and heights that can be read from above."""

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
import shapely
from ezdxf.bbox import extents
from ezdxf.filemanagement import readfile
from ezdxf.math import BoundingBox
from shapely import Polygon

from midrib.formats.drawing.axes import PAGE, Mark, scale_of, write_axis_dxf
from midrib.types import Floats


def axis(lean: float, bend: float = 0.0) -> Floats:
    """Levels of an axis 40 high that leans and bends."""
    t = np.linspace(0.0, 1.0, 21)
    return np.column_stack([5000.0 + lean * t**2, 7000.0 + bend * t, 200.0 + 40.0 * t])


@pytest.mark.parametrize("lean", [0.0, 0.004, 0.12, -3.0])
@pytest.mark.parametrize("bend", [0.0, 0.05, -1.0])
@pytest.mark.parametrize("unit", [1.0, 1000.0])
def test_no_height_lies_on_another(lean: float, bend: float, unit: float, tmp_path: Path) -> None:
    points = unit * axis(lean, bend)
    write_axis_dxf(tmp_path / "a.dxf", points, unit)
    document = readfile(tmp_path / "a.dxf")
    assert not document.audit().errors
    space = document.modelspace()
    levels = np.array([point.dxf.location for point in space.query("POINT")])
    assert levels == pytest.approx(points)
    texts = [flat(extents([text])) for text in space.query("TEXT")]
    assert not any(one.intersects(other) for one, other in combinations(texts, 2))
    assert space.query("TEXT")[0].dxf.text == "200.00"
    for circle, text in zip(space.query("CIRCLE"), space.query("TEXT"), strict=True):
        assert f"{circle.dxf.center.z / unit:.2f}" == text.dxf.text


def flat(box: BoundingBox) -> Polygon:
    """Box as it is seen from above."""
    return shapely.box(*box.extmin.vec2, *box.extmax.vec2)


@pytest.mark.parametrize(
    ("length", "scale"), [(0.0, 1), (0.1, 1), (0.15, 1), (0.16, 2), (0.31, 5), (0.76, 10), (9, 100)]
)
def test_the_scale_is_the_largest_at_which_the_axis_fits(length: float, scale: float) -> None:
    assert scale_of(axis(length), 1.0) == scale
    assert scale_of(1000.0 * axis(length), 1000.0) == scale
    assert 1000.0 * length / scale <= PAGE * (1.0 + 1e-9)


def test_the_sheet_is_as_large_as_the_axis_at_scale(tmp_path: Path) -> None:
    write_axis_dxf(tmp_path / "a.dxf", axis(0.12), 1.0)
    document = readfile(tmp_path / "a.dxf")
    low, high = (np.array(document.header[name])[:2] for name in ("$EXTMIN", "$EXTMAX"))
    layout = document.paperspace("Layout1")
    assert np.array(layout.dxf.limmax)[:2] == pytest.approx(high - low + 0.02)  # 1 : 1, in metres
    assert document.header["$PSVPSCALE"] == 1.0


def test_marks_have_layers_points_and_texts_apart_from_heights(tmp_path: Path) -> None:
    points = axis(0.12, 0.05)
    marks = [
        Mark("MIDRIB_KINKS", points[5], "kink 3.2 mm/m at 210.00"),
        Mark("MIDRIB_OFFSETS", points[5], "offset 31 mm at 210.00"),
        Mark("MIDRIB_KINKS", points[20], "kink 5.5 mm/m at 240.00"),
    ]
    write_axis_dxf(tmp_path / "a.dxf", points, 1.0, (), marks)
    document = readfile(tmp_path / "a.dxf")
    assert not document.audit().errors
    space = document.modelspace()
    for layer, rows in (("MIDRIB_KINKS", [5, 20]), ("MIDRIB_OFFSETS", [5])):
        found = space.query(f'POINT[layer=="{layer}"]')
        assert np.array([p.dxf.location for p in found]) == pytest.approx(points[rows])
    texts = [text.dxf.text for text in space.query("TEXT") if "HEIGHTS" not in text.dxf.layer]
    assert texts == [marks[0].text, marks[2].text]  # the one between is in the way
    boxes = [flat(extents([text])) for text in space.query("TEXT")]
    assert not any(one.intersects(other) for one, other in combinations(boxes, 2))
