"""One batch of areas to one batch of lines: what it says, and that divisions do not matter."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

import midrib
from midrib.engines.batches import Collapsed, Counts, collapse_batch
from midrib.engines.frames import collapse_rows, frame_recipe
from midrib.engines.recipe import Recipe
from midrib.errors import ParameterError
from midrib.formats.guides import FieldGuides
from tests.engines.layers import areas, batch_of, recipe_of, write_areas


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file of areas."""
    return write_areas(tmp_path_factory.mktemp("areas") / "in.parquet")


@pytest.fixture(scope="module")
def whole(source: Path) -> Collapsed:
    """All of it in one batch."""
    return collapse_batch(batch_of(source), recipe_of(source))


def test_lines_are_those_of_collapse(source: Path, whole: Collapsed) -> None:
    lines, problems = midrib.collapse(areas(), on_error="report")
    refused = [p.index for p in problems if p.status == "refused"]
    rows = np.setdiff1d(np.arange(len(lines)), refused)
    assert whole.rows.tolist() == rows.tolist()
    assert whole.refused_rows.tolist() == refused
    assert whole.lines["geom"].to_pylist() == [*shapely.to_wkb(lines[rows])]
    assert whole.lines["number"].to_pylist() == rows.tolist()
    length = whole.lines["length_2"].to_numpy(zero_copy_only=False)  # "length" is an attribute
    assert np.allclose(length, shapely.length(lines[rows]), equal_nan=True)
    assert whole.lines.schema.equals(recipe_of(source).lines)
    assert whole.refused.schema.equals(recipe_of(source).refused)


def test_every_row_is_in_one_of_both_and_counted(whole: Collapsed) -> None:
    both = np.concatenate([whole.rows, whole.refused_rows])
    assert sorted(both) == list(range(110))
    counts = whole.counts
    assert (counts.features, counts.refused, counts.repaired) == (110, 3, 2)
    assert counts.lines == 110 - 3 - 2  # two had no geometry
    assert counts.length == pytest.approx(
        sum(filter(None, whole.lines["length_2"].to_pylist())), rel=1e-12
    )
    status = dict(
        zip(whole.lines["number"].to_pylist(), whole.lines["status"].to_pylist(), strict=True)
    )
    assert status[33] == "no geometry"
    assert status[0] == "ok"
    assert status[13].startswith("repaired: ")


@given(cuts=st.lists(st.integers(0, 110), max_size=4))
def test_divisions_do_not_matter(source: Path, whole: Collapsed, cuts: list[int]) -> None:
    recipe, batch = recipe_of(source), batch_of(source)
    stops = [0, *sorted(cuts), 110]
    parts = [collapse_batch(batch.slice(a, b - a), recipe) for a, b in pairwise(stops)]
    assert pa.Table.from_batches([p.lines for p in parts]).equals(
        pa.Table.from_batches([whole.lines])
    )
    assert pa.Table.from_batches([p.refused for p in parts]).equals(
        pa.Table.from_batches([whole.refused])
    )
    total = Counts()
    for part in parts:
        total.add(part.counts)
    assert vars(total) == pytest.approx(vars(whole.counts))


def test_what_cannot_be_read_is_refused_with_the_reason() -> None:
    rows = [shapely.box(0, 0, 9, 2).wkb, b"\x01\x03", shapely.Point(1, 1).wkb]
    batch = pa.RecordBatch.from_pydict({"geometry": pa.array(rows, type=pa.binary())})
    found = collapse_batch(batch, Recipe(pa.schema([])))
    assert found.rows.tolist() == [0]
    assert found.refused_rows.tolist() == [1, 2]
    unreadable, point = found.refused["reason"].to_pylist()
    assert unreadable.startswith("the geometry cannot be read: ")
    assert point.startswith("is a Point, expected a Polygon")


def test_an_area_whose_guide_cannot_be_read_is_refused_and_has_no_line() -> None:
    wkb = pa.array([shapely.box(0, 0, 9, 2).wkb] * 2, type=pa.binary())
    batch = pa.RecordBatch.from_pydict({"side": ["LINESTRING (0 0, 9 0)", "left"], "wkb": wkb})
    recipe = Recipe(pa.schema([("side", pa.string())]), "wkb", guides=FieldGuides("side"))
    found = collapse_batch(batch, recipe)
    assert found.rows.tolist() == [0]
    assert found.refused_rows.tolist() == [1]
    assert found.refused["reason"][0].as_py().startswith("the field 'side' is 'left', expected")


def test_frames_keep_their_rows_and_say_why_a_line_is_missing(source: Path) -> None:
    recipe, batch = recipe_of(source), batch_of(source)
    rows = collapse_rows(batch, recipe)
    assert rows.schema.equals(recipe.lines)
    assert rows["number"].to_pylist() == list(range(110))
    assert rows["geom"][3].as_py() is None
    assert rows["status"][3].as_py().startswith("refused: ")
    assert rows["geom"][0].as_py() == midrib.collapse(areas()[0]).wkb


def test_degrees_give_metres() -> None:
    area = shapely.box(20.0, 50.0, 20.01, 50.001)
    batch = pa.RecordBatch.from_pydict({"wkb": pa.array([area.wkb], type=pa.binary())})
    rows = collapse_rows(batch, frame_recipe(["wkb"], "wkb", geographic=True))
    assert rows["length"][0].as_py() == pytest.approx(717.0, rel=1e-2)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"spacing": -1.0}, "spacing is -1.0, expected a positive"),
        ({"width": "z"}, "width is 'z', expected one of columns, m"),
        ({"method": "magic"}, "method is 'magic', expected"),
    ],
)
def test_frames_refuse_wrong_options_at_once(options: dict[str, object], said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        frame_recipe(["geometry"], **options)  # type: ignore[arg-type]
