"""The commands ``midrib label`` and ``midrib points``."""

from pathlib import Path

import numpy as np
import pytest
import shapely

from tests.cli.commands import Runner
from tests.formats.layers import crs_name, read_all, write

LAKE = "POLYGON ((0 0, 60 0, 60 9, 0 9, 0 0))"
POND = "POLYGON ((0 20, 3 20, 3 22, 0 22, 0 20))"
BENT = "POLYGON ((0 40, 50 40, 50 70, 46 70, 46 44, 0 44, 0 40))"


@pytest.mark.parametrize("ending", ["gpkg", "parquet"])
def test_names_have_lines_and_heights(ending: str, midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [LAKE, None, POND]), tmp_path / f"out.{ending}"
    outcome = midrib("label", source, out, "--height", "400cm")
    assert outcome.code == 1
    assert "1 lines of 3 features, 1 refused" in outcome.err
    layer, rows, lines = read_all(out)
    assert crs_name(layer.crs) == "Amersfoort / RD New"
    assert rows["number"].to_pylist() == [0, 1]
    assert rows["height"].to_pylist() == [4.0, None]
    assert rows["length"][0].as_py() == pytest.approx(lines[0].length)
    assert lines[0].length > 50
    place = out if ending == "gpkg" else tmp_path / f"out_refused.{ending}"
    _, refused, _ = read_all(place, "some_refused" if ending == "gpkg" else None)
    assert refused["reason"].to_pylist() == ["there is no place for a name 4 high"]


def test_points_are_vertices_of_the_line(midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [LAKE, BENT]), tmp_path / "out.gpkg"
    assert midrib("points", source, out, "--count", "3").code == 0
    _, rows, points = read_all(out)
    assert {point.geom_type for point in points} == {"Point"}
    feature = rows["number"].to_numpy()
    assert np.bincount(feature).tolist() == [3, 3]
    line = shapely.LineString(points[feature == 1])
    assert shapely.from_wkt(BENT).covers(line)
    assert (np.diff(rows["vertex"].to_numpy()[feature == 1]) > 0).all()
    assert midrib("points", source, tmp_path / "b.csv", "--tolerance", "10cm").code == 0


def test_an_empty_area_has_no_points(midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [LAKE, "POLYGON EMPTY"]), tmp_path / "out.gpkg"
    assert midrib("points", source, out).code == 0
    assert set(read_all(out)[1]["number"].to_pylist()) == {0}


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["label", "--height", "tall"], "--height is 'tall', expected a number"),
        (["label", "--aspect", "0"], "aspect is 0.0, expected a number above 0"),
        (["points", "--count", "1"], "count is 1, expected a whole number of 2 or more"),
        (["points", "--count", "3", "--tolerance", "1"], "count and tolerance exclude each other"),
        (["points", "--method", "magic"], "method is 'magic', expected"),
    ],
)
def test_wrong_usage_is_code_2(
    arguments: list[str], sentence: str, midrib: Runner, tmp_path: Path
) -> None:
    source, out = write(tmp_path / "in.gpkg", [LAKE]), tmp_path / "out.gpkg"
    command, *options = arguments
    outcome = midrib(command, source, out, *options)
    assert outcome.code == 2
    assert sentence in outcome.err
    assert not out.exists()
