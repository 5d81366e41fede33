"""``midrib tower``: files that are whole, exit codes, sentences."""

from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from ezdxf.filemanagement import readfile
from pyarrow import csv

from midrib import tower_axis
from midrib.formats.contents import layer_names
from midrib.towers import Scan, Tower
from tests.cli.commands import Runner
from tests.formats.layers import read_all
from tests.towers.scans import CONE, dirty

METRES = 6  # $INSUNITS


@pytest.fixture(scope="module")
def scan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Scan of a clean tower."""
    path = tmp_path_factory.mktemp("scans") / "chimney.npy"
    np.save(path, CONE.points())
    return path


def test_report_tables_and_drawing_are_written(scan: Path, midrib: Runner, tmp_path: Path) -> None:
    names = ("report.html", "levels.csv", "axis.dxf", "axis.gpkg", "levels.parquet")
    places = [tmp_path / name for name in names]
    outs = [word for path in places[1:] for word in ("-o", path)]
    outcome = midrib(
        "tower", scan, "--report", places[0], *outs, "--tolerance", "10mm + h/200", "--title", "A<B"
    )
    assert outcome.code == 0, outcome.err
    page = places[0].read_text(encoding="utf-8")
    assert "<h1>A&lt;B</h1>" in page
    assert page.count("<svg") == 4
    assert "0 beyond" not in page
    assert "leans by 2.50 mm/m" in outcome.out
    table = csv.read_csv(places[1])
    assert page.count("<tr") == table.num_rows + 2 + outcome.out.count("\n")
    expected = CONE.axis(np.array(table["z"]))
    assert np.array(table["x"]) == pytest.approx(expected[:, 0], abs=1e-6)
    drawing = readfile(places[2])
    assert drawing.header["$INSUNITS"] == METRES
    layers = Counter(entity.dxf.layer for entity in drawing.modelspace())
    n = table.num_rows
    named = [text.dxf.text for text in drawing.modelspace().query("TEXT")]
    assert layers == {"MIDRIB_AXIS": 1, "MIDRIB_LEVELS": n, "MIDRIB_HEIGHTS": 2 * len(named)}
    assert set(named) <= {f"{z:.2f}" for z in table["z"].to_pylist()}
    assert len(named) > 1
    breaks = ("kinks", "offsets", "radius_steps")
    assert set(layer_names(places[3])) == {"axis", "levels", *breaks}
    assert [len(read_all(places[3], name)[2]) for name in breaks] == [0, 0, 0]
    _, attributes, points = read_all(places[4])
    assert len(points) == table.num_rows
    assert shapely.get_z(points).tolist() == attributes["z"].to_pylist()
    assert not [path for path in tmp_path.iterdir() if path not in places]


def test_files_do_not_bridge_what_was_not_seen(midrib: Runner, tmp_path: Path) -> None:
    points = CONE.points()
    np.save(tmp_path / "a.npy", points[(points[:, 2] < 12.0) | (points[:, 2] > 25.0)])
    outs = [word for name in ("a.dxf", "a.gpkg") for word in ("-o", tmp_path / name)]
    assert midrib("tower", tmp_path / "a.npy", "--step", "0.5m", *outs).code == 1
    drawn: Any = readfile(tmp_path / "a.dxf").modelspace().query("POLYLINE")
    lines = [[tuple(v.dxf.location) for v in line.vertices] for line in drawn]
    _, _, (axis,) = read_all(tmp_path / "a.gpkg", "axis")
    assert axis.geom_type == "MultiLineString"
    for found in (lines, [list(part.coords) for part in axis.geoms]):
        assert len(found) == 2
        rises = np.concatenate([np.diff(np.array(line)[:, 2]) for line in found])
        assert rises == pytest.approx(0.5)


def test_breaks_are_layers_of_points_on_the_axis(midrib: Runner, tmp_path: Path) -> None:
    tower = Tower(60.0, 2.5, 1.5, kink=4.0, kink_spacing=40.0, offset=0.03, offset_height=20.2)
    points = Scan(tower, count=100_000, noise=(0.002, 0.004), seed=5).points()
    # Narrower above 50 m: by 3 cm, towards the axis as it is there.
    (x, y), above = tower.axis([55.0])[0], points[:, 2] > 50.0
    away = points[above, :2] - [x, y]
    points[above, :2] -= 0.03 * away / np.hypot(*away.T)[:, None]
    np.save(tmp_path / "a.npy", points)
    midrib("tower", tmp_path / "a.npy", "-o", tmp_path / "a.gpkg", "-o", tmp_path / "a.dxf")
    found = tower_axis(points)
    drawn = readfile(tmp_path / "a.dxf").modelspace()
    for layer, words in (
        ("KINKS", f"kink {found.kinks[0].turn:.1f} mm"),
        ("OFFSETS", "offset"),
        ("RADIUS_STEPS", "radius -"),
    ):
        (note,) = drawn.query(f'TEXT[layer=="MIDRIB_{layer}"]')
        (point,) = drawn.query(f'POINT[layer=="MIDRIB_{layer}"]')
        assert note.dxf.text.startswith(words)
        assert note.dxf.text.endswith(f"{point.dxf.location.z:.2f}")
    for name, heights in (("kinks", [40.0]), ("offsets", [20.2]), ("radius_steps", [50.0])):
        _, attributes, places = read_all(tmp_path / "a.gpkg", name)
        told = [tuple(row.values()) for row in attributes.to_pylist()]
        assert told == [tuple(one) for one in getattr(found, name)]
        assert attributes["z"].to_pylist() == pytest.approx(heights, abs=1.0)
        z = shapely.get_z(places)
        assert z.tolist() == attributes["z"].to_pylist()
        # In the middle of a step at the most, beside a smooth axis.
        assert shapely.get_coordinates(places) == pytest.approx(tower.axis(z), abs=0.03)


def test_pdf_has_all_pages(scan: Path, midrib: Runner, tmp_path: Path) -> None:
    outcome = midrib("tower", scan, "--report", tmp_path / "a.pdf", "--step", "1m", "-q")
    assert (outcome.code, outcome.out) == (0, ""), outcome.err
    content = (tmp_path / "a.pdf").read_bytes()
    assert content.startswith(b"%PDF")
    assert content.count(b"/Type /Page\n") + content.count(b"/Type /Page ") == 3


def test_every_report_is_written(scan: Path, midrib: Runner, tmp_path: Path) -> None:
    places = [tmp_path / name for name in ("a.html", "a.pdf", "b.html")]
    reports = [word for path in places for word in ("--report", path)]
    outcome = midrib("tower", scan, *reports, "--step", "1m")
    assert outcome.code == 0, outcome.err
    assert sorted(tmp_path.iterdir()) == places
    assert places[1].read_bytes().startswith(b"%PDF")
    assert places[0].read_bytes() == places[2].read_bytes()
    for path in places:
        assert f"written to {path}" in outcome.err


def test_no_file_is_written_if_one_report_cannot_be(
    scan: Path, midrib: Runner, tmp_path: Path
) -> None:
    outcome = midrib("tower", scan, "--report", tmp_path / "a.html", "--report", tmp_path / "a.txt")
    assert outcome.code == 2
    assert "ends in '.txt', expected .html or .pdf" in outcome.err
    assert list(tmp_path.iterdir()) == []


def test_flagged_levels_give_exit_code_one(midrib: Runner, tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", dirty().points())
    outcome = midrib("tower", tmp_path / "a.npy", "-o", tmp_path / "a.csv")
    assert outcome.code == 1
    flags = csv.read_csv(tmp_path / "a.csv")["flag"].to_pylist()
    assert "no data" in flags


def test_planes_and_thinning_are_the_library_s(scan: Path, midrib: Runner, tmp_path: Path) -> None:
    """What the options say is what ``tower_axis`` does with arguments of the same names."""
    cases: list[tuple[Any, list[str], dict[str, Any]]] = [
        ("fan", ["--planes", "4"], {"planes": 4}),
        ("paper", ["--thinning", "average-depth"], {"thinning": "average-depth"}),
    ]
    for name, options, arguments in cases:
        place = tmp_path / f"{name}.csv"
        outcome = midrib("tower", scan, "--mode", name, *options, "-o", place, "-q")
        assert outcome.code in {0, 1}, outcome.err
        levels = tower_axis(scan, name, **arguments).levels
        assert np.array(csv.read_csv(place)["x"]) == pytest.approx(levels["x"], nan_ok=True)
        usual = tower_axis(scan, name).levels
        assert not np.array_equal(levels["sigma"], usual["sigma"], equal_nan=True)


WRONG = {
    "ending": (["--report", "a.txt"], "--report 'a.txt' ends in '.txt', expected .html or .pdf"),
    "tolerance": (["--tolerance", "some"], "--tolerance is 'some', expected a length (50mm)"),
    "near": (["--near", "5"], "--near is '5', expected two numbers: 1.5,3"),
    "step": (["--step", "long"], "--step is 'long', expected a number"),
    "planes": (
        ["--mode", "fan", "--planes", "2"],
        "planes is 2, expected a whole number from 3 to 36",
    ),
    "planes alone": (
        ["--planes", "4"],
        "--planes is of no effect in --mode joint, expected --mode",
    ),
    "thinning": (
        ["--mode", "fan", "--thinning", "average-depth"],
        "--thinning is of no effect in --mode fan, expected --mode paper",
    ),
    "unit": (["--unit", "ells"], "--unit is 'ells', expected one of mm, cm"),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_usage_is_told(
    case: str, scan: Path, midrib: Runner, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    options, sentence = WRONG[case]
    outcome = midrib("tower", scan, *options)
    assert outcome.code == 2
    assert sentence in outcome.err
    assert list(tmp_path.iterdir()) == []


def test_files_that_are_there_stay_unless_told(scan: Path, midrib: Runner, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("mine", encoding="utf-8")
    outcome = midrib("tower", scan, "-o", tmp_path / "a.csv")
    assert outcome.code == 2
    assert "exists, give --overwrite" in outcome.err
    assert (tmp_path / "a.csv").read_text(encoding="utf-8") == "mine"


def test_a_cloud_without_a_tower_is_refused(midrib: Runner, tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", np.random.default_rng(1).uniform(0, 9, (5000, 3)))
    outcome = midrib("tower", tmp_path / "a.npy", "-o", tmp_path / "a.csv")
    assert outcome.code == 2
    assert "no tower was found" in outcome.err
    assert not (tmp_path / "a.csv").exists()
