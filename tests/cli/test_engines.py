"""``midrib collapse`` in parts: what is written is what one batch in memory would have written."""

import json
from dataclasses import replace
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import shapely

from midrib.engines.batches import collapse_batch
from midrib.engines.recipe import Recipe
from midrib.errors import MidribError
from midrib.formats.contents import layer_names
from midrib.formats.geoparquet import GeoParquetWriter
from midrib.formats.reading import open_layer
from midrib.formats.writing import Features, write_layer
from tests.cli.commands import Runner
from tests.engines.layers import areas, batch_of, contents, files_up_to, recipe_of, write_areas
from tests.formats.layers import RD_NEW

ENDINGS = ("parquet", "gpkg", "fgb", "geojson", "shp", "gdb", "csv")


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file of areas of several batches."""
    return write_areas(tmp_path_factory.mktemp("areas") / "in.parquet", 2300)


def write_whole(batch: pa.RecordBatch, recipe: Recipe, out: Path) -> None:
    """Collapse a batch in memory and write lines and refused areas, each in one piece."""
    found = collapse_batch(batch, recipe)
    write_piece(out, "in", found.lines, recipe, "LineString")
    has_layers = out.suffix in {".gpkg", ".gdb"}
    refused = out if has_layers else out.with_stem(f"{out.stem}_refused")
    write_piece(refused, "in_refused", found.refused, recipe, "Polygon")


def write_piece(path: Path, name: str, rows: pa.RecordBatch, recipe: Recipe, kind: str) -> None:
    """Write a layer that is in memory."""
    table = pa.Table.from_batches([rows])
    geometries = shapely.from_wkb(table.column(recipe.geometry).to_numpy())
    attributes = table.drop_columns(recipe.geometry)
    write_layer(path, Features(name, attributes, geometries, recipe.geometry, kind, recipe.crs))


def layers(path: Path) -> dict[str, tuple[object, ...]]:
    """Everything that a file holds."""
    found: dict[str, tuple[object, ...]] = {}
    for name in layer_names(path):
        with open_layer(path, name) as layer:
            batches = list(layer.batches())
        table = pa.concat_tables([batch.attributes for batch in batches])
        wkb = [shapely.to_wkb(geometry) for batch in batches for geometry in batch.geometries]
        found[name] = (table.schema, table.to_pylist(), wkb, layer.crs, layer.kind)
    return found


@pytest.fixture
def places(tmp_path: Path) -> tuple[Path, Path]:
    """Two folders."""
    for name in ("parts", "whole"):
        (tmp_path / name).mkdir()
    return tmp_path / "parts", tmp_path / "whole"


@pytest.mark.parametrize("ending", ["parquet", "gpkg"])
def test_a_disk_that_is_full_ends_in_a_sentence(
    ending: str, source: Path, midrib: Runner, tmp_path: Path
) -> None:
    with files_up_to(10_000):
        outcome = midrib("collapse", source, tmp_path / f"out.{ending}", "--quiet")
    assert outcome.code == 2
    assert outcome.err.endswith("part-00000.parquet' cannot be written: File too large\n")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ending", [*ENDINGS, "kml", "mif", "tab", "jml", "dxf", "gml", "sqlite"])
def test_a_file_that_does_not_fit_is_named(ending: str, source: Path, tmp_path: Path) -> None:
    recipe, out = recipe_of(source), tmp_path / f"out.{ending}"
    said = rf"^OUT 'out.{ending}' cannot be written"
    with files_up_to(20_000), pytest.raises(MidribError, match=said):
        write_piece(out, "in", batch_of(source), recipe, "Polygon")


@pytest.mark.parametrize("ending", ["kml", "mif", "jml", "dxf"])
def test_the_last_byte_of_a_file_is_missed(ending: str, source: Path, tmp_path: Path) -> None:
    recipe, areas = recipe_of(source), batch_of(source).slice(0, 30)
    whole, out = tmp_path / f"whole.{ending}", tmp_path / f"out.{ending}"
    write_piece(whole, "in", areas, recipe, "Polygon")
    with files_up_to(whole.stat().st_size - 1), pytest.raises(MidribError, match="cannot be wr"):
        write_piece(out, "in", areas, recipe, "Polygon")
    out.unlink()
    write_piece(out, "in", areas, recipe, "Polygon")
    assert out.read_bytes() == whole.read_bytes()  # nothing of looking for room is left


@pytest.mark.parametrize("ending", ENDINGS)
def test_files_are_those_of_one_piece(
    ending: str, source: Path, midrib: Runner, places: tuple[Path, Path]
) -> None:
    parts, whole = places
    outcome = midrib("collapse", source, parts / f"out.{ending}")
    assert outcome.code == 1, outcome.err
    write_whole(batch_of(source), recipe_of(source), whole / f"out.{ending}")
    written = sorted(path.name for path in whole.iterdir())
    assert sorted(path.name for path in parts.iterdir()) == written
    for name in written:
        if (whole / name).suffix == f".{ending}":
            assert layers(parts / name) == layers(whole / name)
        if ending == "parquet":
            assert (parts / name).read_bytes() == (whole / name).read_bytes()


def test_widths_as_m_values_are_kept(
    source: Path, midrib: Runner, places: tuple[Path, Path]
) -> None:
    out, whole = (place / "out.gpkg" for place in places)
    assert midrib("collapse", source, out, "--width", "m").code == 1
    write_whole(batch_of(source), replace(recipe_of(source), has_m=True), whole)
    found = layers(out)
    assert found == layers(whole)
    assert shapely.has_m(shapely.from_wkb(found["in"][2][0]))  # type: ignore[index]


def test_workers_and_folders_have_the_same_lines(
    source: Path, midrib: Runner, tmp_path: Path
) -> None:
    out, again, parts = (tmp_path / name for name in ("out.parquet", "again.parquet", "parts"))
    assert midrib("collapse", source, out).code == 1
    assert midrib("collapse", source, again, "--workers", 2).code == 1
    assert midrib("collapse", source, parts, "--part-rows", 1000).code == 1
    assert again.read_bytes() == out.read_bytes()
    assert len(contents(parts)) == 6
    names = pq.read_schema(out).names[:-2]  # single lines stay single in parts
    assert pq.read_table(parts).select(names).equals(pq.read_table(out).select(names))
    from_parts = tmp_path / "from_parts.parquet"
    assert midrib("collapse", source, from_parts, "--part-rows", 1000).code == 1
    assert from_parts.read_bytes() == out.read_bytes()


def test_a_folder_of_files_is_one_layer(source: Path, midrib: Runner, tmp_path: Path) -> None:
    folder = tmp_path / "in"
    folder.mkdir()
    table = pa.Table.from_batches([batch_of(source)])
    for k, first in enumerate((0, 700, 1900)):
        rows = table.slice(first, (700, 1200, 400)[k])
        writer = GeoParquetWriter(folder / f"{k}.parquet", rows.schema, "geom", RD_NEW)
        writer.write(rows)
        writer.close()
    assert midrib("collapse", source, tmp_path / "one.parquet").code == 1
    assert midrib("collapse", folder, tmp_path / "several.parquet").code == 1
    one, several = tmp_path / "one.parquet", tmp_path / "several.parquet"
    assert several.read_bytes() == one.read_bytes()
    outcome = midrib("collapse", folder, folder, "--overwrite")
    assert outcome.code == 2
    assert "is IN, expected another folder" in outcome.err
    assert len(list(folder.iterdir())) == 3


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["lines", "--connect"], "--connect excludes a folder as OUT: neighbours have to be in"),
        (["out.gpkg", "--connect", "--workers", "2"], "--connect excludes --workers"),
        (["lines", "--width", "m"], "'lines' is a folder of GeoParquet, which has no place for M"),
        (["lines", "--figure", "x.svg"], "--figure needs all areas in memory, expected a file"),
        (["no/lines"], "OUT 'no/lines' lies in a folder that does not exist"),
        (["lines", "--scheduler", "tcp://x:1"], "--scheduler is an option of --engine dask"),
        (["lines", "--master", "local[2]"], "--master is an option of --engine spark"),
        (["lines", "--engine", "ray"], "'ray' is not one of"),
        (["lines", "--workers", "0"], "greater than or equal to 1"),
    ],
)
def test_options_that_do_not_go_together_are_told(
    options: list[str], said: str, midrib: Runner, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    write_areas(tmp_path / "in.parquet", 4)
    outcome = midrib("collapse", "in.parquet", *options)
    assert outcome.code == 2
    assert said in " ".join(outcome.err.replace("│", " ").split())
    assert [path.name for path in tmp_path.iterdir()] == ["in.parquet"]


INSTALL = {"dask": "needs distributed: pip install midrib[dask]"}
INSTALL["spark"] = "needs pyspark: pip install midrib[spark]"


@pytest.mark.parametrize("engine", INSTALL)
def test_libraries_that_are_missing_are_named(
    engine: str, midrib: Runner, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("midrib.checks.find_spec", lambda _: None)
    source = write_areas(tmp_path / "in.parquet", 4)
    outcome = midrib("collapse", source, tmp_path / "lines", "--engine", engine)
    assert outcome.code == 2
    assert f"--engine {engine} {INSTALL[engine]}" in outcome.err


def test_a_missing_java_is_named(
    midrib: Runner, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("JAVA_HOME", raising=False)
    monkeypatch.setattr("midrib.checks.find_spec", lambda _: True)
    monkeypatch.setattr("shutil.which", lambda _: None)
    source = write_areas(tmp_path / "in.parquet", 4)
    outcome = midrib("collapse", source, tmp_path / "lines", "--engine", "spark")
    assert outcome.code == 2
    assert "--engine spark needs Java 17 or later" in outcome.err


def test_geoparquet_has_boxes_in_row_groups_of_any_tables(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("midrib.formats.geoparquet.GROUP_ROWS", 40)
    monkeypatch.setattr("midrib.formats.geoparquet.GROUP_BYTES", 15_000)
    wkb = pa.array(shapely.to_wkb(areas()), type=pa.binary())
    table = pa.table({"bbox": pa.array(range(110)), "geometry": wkb})
    for name, step in (("one", 110), ("many", 7)):
        writer = GeoParquetWriter(tmp_path / name, table.schema, "geometry", RD_NEW)
        for first in range(0, 110, step):
            writer.write(table.slice(first, step))
        writer.close()
    assert (tmp_path / "one").read_bytes() == (tmp_path / "many").read_bytes()
    file = pq.ParquetFile(tmp_path / "one")
    sizes = [file.metadata.row_group(k).num_rows for k in range(file.num_row_groups)]
    assert sum(sizes) == 110
    assert len(sizes) > 3
    assert max(sizes) <= 40
    boxes = file.read()["bbox_2"].to_pylist()
    assert boxes[33] is None
    for box, area in zip(boxes, areas(), strict=True):
        assert box is None or tuple(box.values()) == area.bounds
    # Readers that look for a window find it in the statistics of row groups.
    group = file.metadata.row_group(1)
    names = [group.column(k).path_in_schema for k in range(group.num_columns)]
    low = group.column(names.index("bbox_2.xmin")).statistics.min
    rows = range(sizes[0], sizes[0] + sizes[1])
    assert low == min(boxes[k]["xmin"] for k in rows if boxes[k])


@pytest.mark.parametrize("options", [(), ("--connect",)])
def test_epoch_and_edges_of_coordinates_are_kept_or_told(
    options: tuple[str, ...], tmp_path: Path, midrib: Runner
) -> None:
    more = {"epoch": 2020.5, "edges": "spherical"}
    path, n = tmp_path / "in.parquet", 5
    table = pa.table({"geom": pa.array(shapely.to_wkb(areas(n)), type=pa.binary())})
    writer = GeoParquetWriter(path, table.schema, "geom", RD_NEW, tuple(more.items()))
    writer.write(table)
    writer.close()
    outs = ["out.parquet", "out_refused.parquet"]
    outcome = midrib("collapse", path, tmp_path / outs[0], *options)
    assert outcome.code == 1, outcome.err  # one area is refused
    if not options:
        assert midrib("collapse", path, tmp_path / "out").code == 1
        outs += ["out/part-00000.parquet", "out/_refused/part-00000.parquet"]
    for out in outs:
        geo = json.loads(pq.read_schema(tmp_path / out).metadata[b"geo"])
        assert geo["columns"]["geom"].items() >= more.items()
    said = midrib("collapse", path, tmp_path / "out.gpkg", *options).err
    assert "note: 'epoch' of IN, 2020.5, is kept in GeoParquet only\n" in said
    assert "note: 'edges' of IN, 'spherical', is kept in GeoParquet only\n" in said
    plain = write_areas(tmp_path / "plain.parquet", n)
    assert "kept in" not in midrib("collapse", plain, tmp_path / "plain.gpkg").err


def test_epochs_of_files_in_a_folder_have_to_be_the_same(tmp_path: Path, midrib: Runner) -> None:
    table = pa.table({"geom": pa.array(shapely.to_wkb(areas(3)), type=pa.binary())})
    (tmp_path / "in").mkdir()
    for name, epoch in (("a", 2020.5), ("b", 2021.0)):
        path = tmp_path / "in" / f"{name}.parquet"
        writer = GeoParquetWriter(path, table.schema, "geom", RD_NEW, (("epoch", epoch),))
        writer.write(table)
        writer.close()
    outcome = midrib("collapse", tmp_path / "in", tmp_path / "out.parquet")
    assert outcome.code == 2
    assert "b.parquet' has other columns or another CRS or epoch than 'a.parquet'" in outcome.err


def test_row_groups_of_long_texts_have_few_rows(
    tmp_path: Path, midrib: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("midrib.formats.geoparquet.GROUP_BYTES", 100_000)
    path = write_areas(tmp_path / "in.parquet", 40)
    table = pq.read_table(path)
    texts = pa.array([str(k) * 6_000 for k in range(40)])
    pq.write_table(table.append_column("text", texts), path)
    assert midrib("collapse", path, tmp_path / "out.parquet").code == 1  # an area is refused
    file = pq.ParquetFile(tmp_path / "out.parquet")
    rows = [file.metadata.row_group(k).num_rows for k in range(file.num_row_groups)]
    lines = file.read()["text"].to_pylist()
    assert [text for text in texts.to_pylist() if text in lines] == lines
    assert sum(rows) == len(lines) >= 38
    assert 5 <= len(rows) <= 10
