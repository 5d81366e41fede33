"""The command ``midrib compare``."""

import csv
from pathlib import Path
from typing import Any

import pytest
import shapely

import midrib as library
from midrib.curves.variants import usual_variants, variant_of
from tests.cli.commands import Runner
from tests.formats.layers import write

AREAS: list[str | None] = [
    "POLYGON ((0 0, 40 0, 40 5, 0 4, 0 0))",
    "POLYGON ((0 9, 9 9, 9 60, 5 60, 5 14, 0 14, 0 9))",
]


@pytest.fixture
def source(tmp_path: Path) -> Path:
    """Two areas in a file."""
    return write(tmp_path / "in.gpkg", AREAS)


@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
def test_a_figure_and_a_table_are_made(
    ending: str, source: Path, tmp_path: Path, midrib: Runner
) -> None:
    out = tmp_path / f"out.{ending}"
    outcome = midrib("compare", source, out, "--feature", "1")
    assert outcome.code == 0
    assert out.stat().st_size > 1000
    rows = outcome.out.strip().splitlines()
    assert [row.split()[0] for row in rows] == [
        "method",
        *usual_variants(),
    ]


def test_a_page_holds_figure_and_table(source: Path, tmp_path: Path, midrib: Runner) -> None:
    out = tmp_path / "out.html"
    options = "--feature", "0", "--methods", "minimal-radii, chordal-axis"
    assert midrib("compare", source, out, *options).code == 0
    page = out.read_text(encoding="utf-8")
    assert page.count("<svg") == 1
    assert page.count("<tr>") == 3
    assert 'data-value="chordal-axis"' in page


def test_a_table_has_every_digit(source: Path, tmp_path: Path, midrib: Runner) -> None:
    out = tmp_path / "out.csv"
    assert midrib("compare", source, out, "--feature", "0").code == 0
    with out.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lengths = {row["method"]: float(row["length"]) for row in rows}
    area = shapely.from_wkt(str(AREAS[0]))
    assert lengths == pytest.approx(
        {name: length_by(area, *variant_of(name)) for name in lengths}, rel=1e-12
    )


def length_by(area: Any, method: str, options: dict[str, Any]) -> float:
    """Length of the line of ``collapse``."""
    length: float = library.collapse(area, method, **options).length
    return length


def test_of_several_parts_the_largest_or_a_chosen_one_is_compared(
    tmp_path: Path, midrib: Runner
) -> None:
    parts = "MULTIPOLYGON (((0 0, 9 0, 9 2, 0 2, 0 0)), ((0 9, 30 9, 30 11, 0 11, 0 9)))"
    source = write(tmp_path / "in.gpkg", [parts])
    lengths = []
    for name, options, said in (
        ("largest", [], "part 1 of 0 to 1, the largest"),
        ("chosen", ["--part", "0"], "part 0 of 0 to 1"),
    ):
        out = tmp_path / f"{name}.csv"
        outcome = midrib("compare", source, out, "--methods", "minimal-radii", *options)
        assert outcome.code == 0
        assert said in outcome.err
        with out.open(encoding="utf-8") as file:
            lengths += [float(row["length"]) for row in csv.DictReader(file)]
    assert lengths == pytest.approx([30.0, 9.0])


def test_a_repair_is_told_in_one_line(tmp_path: Path, midrib: Runner) -> None:
    curl = "POLYGON ((0 0, 10 0, 10 2, 5 2, 5.001 2.001, 5.001 2, 5 2.001, 0 2, 0 0))"
    source = write(tmp_path / "in.gpkg", [curl])
    out = tmp_path / "out.html"
    outcome = midrib("compare", source, out, "--methods", "minimal-radii")
    assert outcome.code == 0
    assert "repaired: Self-intersection at (5" in outcome.err
    assert "Warning" not in outcome.err
    assert "The area: repaired: Self-intersection" in out.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ([], "IN has 2 features, expected one: --feature 0 to 1, or FIELD=VALUE"),
        (["--feature", "7"], "--feature '7' fits 0 features"),
        (["--feature", "x"], "--feature is 'x', expected the number of a feature"),
        (["--feature", "no=1"], "IN has no field 'no', expected one of"),
        (["--feature", "0", "--methods", "no"], "method is 'no', expected"),
        (["--feature", "0", "--methods", "mean-curve:no"], "method is 'mean-curve:no', expected"),
        (["--feature", "0", "--part", "1"], "part is 1, expected 0, the area has one part"),
    ],
)
def test_wrong_usage_is_code_2(
    options: list[str], sentence: str, source: Path, tmp_path: Path, midrib: Runner
) -> None:
    outcome = midrib("compare", source, tmp_path / "out.svg", *options)
    assert outcome.code == 2
    assert sentence in outcome.err
    assert not (tmp_path / "out.svg").exists()


def test_other_endings_are_refused(source: Path, tmp_path: Path, midrib: Runner) -> None:
    outcome = midrib("compare", source, tmp_path / "out.docx", "--feature", "0")
    assert outcome.code == 2
    assert "expected .svg, .png, .pdf, .html, .csv" in outcome.err
