"""The commands ``midrib network``, ``midrib partial`` and ``midrib skeleton``."""

from pathlib import Path

import numpy as np
import pytest
import shapely

from tests.cli.commands import Runner
from tests.formats.layers import crs_name, read_all, write

CROSS = (
    "POLYGON ((-20 -1, -1 -1, -1 -20, 1 -20, 1 -1, 20 -1, 20 1, 1 1, 1 9, -1 9, -1 1, -20 1, "
    "-20 -1))"
)
EAST = "POLYGON ((20 -1, 40 -1, 40 1, 20 1, 20 -1))"  # touches it
FAR = "POLYGON ((90 0, 99 0, 99 2, 90 2, 90 0))"
BOW_TIE = "POLYGON ((0 50, 8 58, 8 50, 0 58, 0 50))"


@pytest.mark.parametrize("ending", ["gpkg", "parquet", "shp"])
def test_nodes_are_where_their_lines_end(ending: str, midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [CROSS, None, EAST]), tmp_path / f"out.{ending}"
    outcome = midrib("network", source, out)
    assert outcome.code == 0
    assert "1 junctions, 4 dead ends" in outcome.err
    layer, rows, lines = read_all(out)
    assert crs_name(layer.crs) == "Amersfoort / RD New"
    assert rows["number"].to_pylist() == [0, 0, 0, 0, 2]
    place = out if ending == "gpkg" else tmp_path / f"out_nodes.{ending}"
    _, nodes, points = read_all(place, "some_nodes" if ending == "gpkg" else None)
    assert nodes["node"].to_pylist() == list(range(len(points)))
    for name, row in (("from_node", 0), ("to_node", -1)):
        ends = [line.coords[row] for line in lines]
        assert [points[i].coords[0] for i in rows[name].to_pylist()] == ends
    both = np.concatenate([rows["from_node"].to_numpy(), rows["to_node"].to_numpy()])
    assert nodes["ways"].to_pylist() == np.bincount(both).tolist()
    assert sorted(nodes["ways"].to_pylist()) == [1, 1, 1, 1, 2, 4]  # 2: where the roads touch
    assert rows["length"].to_numpy() == pytest.approx(shapely.length(lines))
    assert rows["width_mean"].to_numpy() == pytest.approx([2] * 5, abs=0.25)


def test_areas_are_dissolved_on_request(midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [EAST, CROSS, BOW_TIE, FAR]), tmp_path / "out.gpkg"
    outcome = midrib("network", source, out, "--dissolve")
    assert outcome.code == 1
    assert "5 lines of 3 features, 1 refused" in outcome.err
    _, rows, lines = read_all(out, "some")
    assert "number" not in rows.column_names
    wanted = shapely.from_wkt("MULTILINESTRING ((0 -20, 0 9), (-20 0, 40 0), (90 1, 99 1))")
    assert shapely.hausdorff_distance(shapely.union_all(lines), wanted) < 1e-9
    _, refused, _ = read_all(out, "some_refused")
    assert "more than one way" in refused["reason"].to_pylist()[0]


@pytest.mark.parametrize("ending", ["gpkg", "geojson", "parquet"])
@pytest.mark.parametrize(("areas", "code"), [([], 0), ([None], 0), ([BOW_TIE], 1)])
@pytest.mark.parametrize("options", [[], ["--dissolve"]])
def test_a_network_without_lines_is_written(
    areas: list[str | None],
    code: int,
    options: list[str],
    ending: str,
    midrib: Runner,
    tmp_path: Path,
) -> None:
    source, out = write(tmp_path / "in.gpkg", areas, kind="Polygon"), tmp_path / f"out.{ending}"
    outcome = midrib("network", source, out, *options)
    assert outcome.code == code
    assert "0 junctions, 0 dead ends" in outcome.err
    assert out.exists()


def test_options_reach_the_network(midrib: Runner, tmp_path: Path) -> None:
    staggered = shapely.union_all(
        [shapely.box(-20, -1, 20, 1), shapely.box(-2, -20, 0, 0), shapely.box(0, 0, 2, 4)]
    )
    source = write(tmp_path / "in.gpkg", [staggered.wkt])
    counts: dict[tuple[str, ...], int] = {}
    for options in ((), ("--merge", "0"), ("--min-branch-length", "9m")):
        out = tmp_path / f"out{len(counts)}.gpkg"
        assert midrib("network", source, out, *options).code == 0
        counts[options[:1]] = len(read_all(out, "some")[2])
    assert counts == {(): 4, ("--merge",): 5, ("--min-branch-length",): 3}


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--merge", "-1"], "merge is -1.0, expected a number of 0 or more"),
        (["--method", "mean-curve"], "method is 'mean-curve', expected 'medial-axis' or"),
        (["--min-branch-length", "far"], "--min-branch-length is 'far', expected a number"),
        (["--layer", "x"], "--layer is 'x', expected a layer"),
    ],
)
def test_wrong_usage_is_code_2(
    options: list[str], sentence: str, midrib: Runner, tmp_path: Path
) -> None:
    source, out = write(tmp_path / "in.gpkg", [CROSS]), tmp_path / "out.gpkg"
    outcome = midrib("network", source, out, *options)
    assert outcome.code == 2
    assert sentence in outcome.err
    assert not out.exists()


def test_a_foreign_file_is_not_replaced_by_nodes(midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [CROSS]), tmp_path / "out.parquet"
    foreign = write(tmp_path / "out_nodes.parquet", [CROSS])
    before = foreign.read_bytes()
    outcome = midrib("network", source, out, "--overwrite")
    assert outcome.code == 2
    assert "the place for nodes, has no column 'node'" in outcome.err
    assert foreign.read_bytes() == before
    foreign.unlink()
    for _ in range(2):
        assert midrib("network", source, out, "--overwrite").code == 0


DUMBBELL = "POLYGON ((0 0, 4 0, 4 1, 9 1, 9 0, 13 0, 13 4, 9 4, 9 3, 4 3, 4 4, 0 4, 0 0))"


@pytest.mark.parametrize("ending", ["gpkg", "parquet", "shp"])
def test_wide_parts_and_lines_are_layers(ending: str, midrib: Runner, tmp_path: Path) -> None:
    source = write(tmp_path / "in.gpkg", [FAR, None, DUMBBELL, BOW_TIE])
    out = tmp_path / f"out.{ending}"
    outcome = midrib("partial", source, out, "--narrower-than", "300cm")
    assert outcome.code == 1
    assert "2 lines of 4 features, 1 refused" in outcome.err
    assert "2 areas that are wider" in outcome.err
    _, rows, lines = read_all(out)
    assert rows["number"].to_pylist() == [0, 2]
    assert lines[1].equals(shapely.from_wkt("LINESTRING (4 2, 9 2)"))
    place = out if ending == "gpkg" else tmp_path / f"out_areas.{ending}"
    layer, rows, areas = read_all(place, "some_areas" if ending == "gpkg" else None)
    assert crs_name(layer.crs) == "Amersfoort / RD New"
    assert rows["number"].to_pylist() == [2, 2]
    assert rows["part"].to_pylist() == [0, 1]
    assert shapely.area(areas).tolist() == [16, 16]


def test_narrow_parts_that_stay_areas_are_told(
    midrib: Runner, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("midrib.curves.dividing.cut_across", lambda *_: None)
    source, out = write(tmp_path / "in.gpkg", [FAR, DUMBBELL, BOW_TIE]), tmp_path / "out.gpkg"
    outcome = midrib("partial", source, out, "--narrower-than", "3")
    assert outcome.code == 1
    assert "1 refused" in outcome.err
    assert "1 areas that are wider, narrow parts of 1 features uncut among them" in outcome.err
    _, rows, areas = read_all(out, "some_refused")
    assert rows["number"].to_pylist() == [2, 1]
    assert rows["reason"][1].as_py().startswith("uncut: the narrow part at (")
    assert areas[1].equals(shapely.from_wkt(DUMBBELL))
    assert (
        midrib(
            "partial",
            write(tmp_path / "one.gpkg", [DUMBBELL]),
            tmp_path / "one_out.gpkg",
            "--narrower-than",
            "3",
        ).code
        == 1
    )
    assert read_all(tmp_path / "one_out.gpkg", "some_refused")[1].num_rows == 1


def test_the_width_is_needed_and_is_a_length(midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [DUMBBELL]), tmp_path / "out.gpkg"
    outcome = midrib("partial", source, out)
    assert (outcome.code, "Missing option '--narrower-than'" in outcome.err) == (2, True)
    outcome = midrib("partial", source, out, "--narrower-than", "wide")
    assert (outcome.code, "--narrower-than is 'wide', expected a number" in outcome.err) == (
        2,
        True,
    )
    outcome = midrib("partial", source, out, "--narrower-than", 3, "--method", "chordal-axis")
    assert outcome.code == 2
    assert "method is 'chordal-axis', expected 'medial-axis'" in " ".join(outcome.err.split())
    assert not out.exists()
    options = ("--narrower-than", "3", "--min-length", "8")
    assert midrib("partial", source, out, *options).code == 0
    assert shapely.area(read_all(out, "some_areas")[2]).tolist() == [42]


def test_a_skeleton_is_a_feature_for_each_branch(midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [CROSS, BOW_TIE, EAST]), tmp_path / "out.gpkg"
    pruned = ("--min-significance", 1.5, "--method", "straight-skeleton")
    outcome = midrib("skeleton", source, out, "--radius", "m", *pruned)
    assert outcome.code == 1
    _, rows, lines = read_all(out, "some")
    assert rows["number"].to_pylist() == [0, 0, 0, 0, 2]
    assert rows["branch"].to_pylist() == [0, 1, 2, 3, 0]
    assert rows["tips"].to_pylist() == [1, 1, 1, 1, 2]
    assert rows["length"].to_numpy() == pytest.approx(shapely.length(lines))
    for line, low, high in zip(lines, rows["radius_min"], rows["radius_max"], strict=True):
        radius = shapely.get_coordinates(line, include_m=True)[:, 2]
        assert [radius.min(), radius.max()] == [low.as_py(), high.as_py()]
    _, refused, _ = read_all(out, "some_refused")
    assert refused.num_rows == 1
    assert midrib("skeleton", source, tmp_path / "all.gpkg", "--overwrite").code == 1
    assert len(read_all(tmp_path / "all.gpkg", "some")[2]) > len(lines)
    assert midrib("skeleton", source, out, "--overwrite", "--method", "mean-curve").code == 2
