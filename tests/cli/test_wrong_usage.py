"""Wrong usage: exit code 2, one sentence that says what was found and wanted, no file."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from midrib.errors import InvariantError
from tests.cli.commands import Outcome, Runner
from tests.formats.layers import write

STRIP = "POLYGON ((0 0, 90 0, 90 20, 0 20, 0 0))"

# Arguments after the command, and what the sentence says.
WRONG: dict[str, tuple[list[str], str]] = {
    "missing file": (["no.gpkg", "out.gpkg"], "IN 'no.gpkg' does not exist"),
    "no vector file": (["text.gpkg", "out.gpkg"], "IN 'text.gpkg' cannot be read"),
    "lines": (["lines.gpkg", "out.gpkg"], "holds LineString, expected areas"),
    "unknown layer": (["in.gpkg", "out.gpkg", "--layer", "x"], "--layer is 'x', expected a layer"),
    "unknown ending": (["in.gpkg", "out.png"], "OUT 'out.png' ends in '.png', expected one of"),
    "existing output": (["in.gpkg", "lines.gpkg"], "OUT 'lines.gpkg' exists, give --overwrite"),
    "output is input": (["in.gpkg", "in.gpkg", "--overwrite"], "OUT 'in.gpkg' is IN"),
    "refused areas are input": (
        ["x_refused.parquet", "x.parquet", "--overwrite"],
        "OUT 'x_refused.parquet' is IN",
    ),
    "folder in the place": (
        ["in.gpkg", "keep.fgb", "--overwrite"],
        "OUT 'keep.fgb' is a folder, expected a file or nothing there",
    ),
    "no geodatabase": (
        ["in.gpkg", "keep.gdb", "--overwrite"],
        "OUT 'keep.gdb' is a folder, but no geodatabase that could be replaced",
    ),
    "file in the place": (
        ["in.gpkg", "file.gdb", "--overwrite"],
        "OUT 'file.gdb' is a file, expected a folder or nothing there",
    ),
    "figure's folder": (
        ["in.gpkg", "out.gpkg", "--figure", "keep.svg", "--overwrite"],
        "--figure 'keep.svg' is a folder",
    ),
    "no folder": (["in.gpkg", "no/out.gpkg"], "lies in a folder that does not exist"),
    "spacing": (["in.gpkg", "out.gpkg", "--spacing", "2x"], "--spacing is '2x', expected a number"),
    "no spacing": (
        ["in.gpkg", "out.gpkg", "--spacing", "0"],
        "spacing is 0.0, expected a positive",
    ),
    "too dense": (
        ["in.gpkg", "out.gpkg", "--spacing", "1e-9"],
        "an interval of 1e-09 asks for 9e+10 stations, expected fewer",
    ),
    "too many": (
        ["in.gpkg", "out.gpkg", "--count", "1000000000"],
        "count is 1000000000, expected at most 50,000,000",
    ),
    "two intervals": (
        ["in.gpkg", "out.gpkg", "--spacing", "2", "--count", "3"],
        "spacing and count exclude each other",
    ),
    "clearance": (
        ["in.gpkg", "out.gpkg", "--end-clearance", "wide"],
        "--end-clearance is 'wide', expected",
    ),
    "simplify": (
        ["in.gpkg", "out.gpkg", "--simplify", "much"],
        "--simplify is 'much', expected a number",
    ),
    "simplify by less than nothing": (
        ["in.gpkg", "out.gpkg", "--simplify", "-5%"],
        "simplify is '-5%', expected a length",
    ),
    "width": (["in.gpkg", "out.gpkg", "--width", "z"], "'z' is not one of"),
    "width in parquet": (
        ["in.gpkg", "out.parquet", "--width", "m"],
        "OUT 'out.parquet' has no place for M values",
    ),
    "method": (["in.gpkg", "out.gpkg", "--method", "magic"], "method is 'magic', expected"),
    "main": (["in.gpkg", "out.gpkg", "--main", "x"], "--main is 'x', expected a layer of IN"),
    "main field": (["in.gpkg", "out.gpkg", "--main", "in:x"], "--main names the field 'x'"),
    "figure": (["in.gpkg", "out.gpkg", "--figure", "a.gif"], "--figure 'a.gif' ends in '.gif'"),
    "existing figure": (["in.gpkg", "out.gpkg", "--figure", "a.svg"], "--figure 'a.svg' exists"),
    "unknown option": (["in.gpkg", "out.gpkg", "--spicing", "2"], "No such option"),
    "missing argument": (["in.gpkg"], "Missing argument 'OUT'"),
    "rule for ends": (["in.gpkg", "out.gpkg", "--ends", "odd"], "'odd' is not one of"),
}
WRONG_PROFILE: dict[str, tuple[list[str], str]] = {
    "missing file": (["no.gpkg", "out.csv"], "IN 'no.gpkg' does not exist"),
    "lines": (["lines.gpkg", "out.csv"], "holds LineString, expected areas"),
    "unknown ending": (["in.gpkg", "out.txt"], "OUT 'out.txt' ends in '.txt', expected one of"),
    "drawing": (["in.gpkg", "out.dxf"], "ends in '.dxf', which holds no table"),
    "existing output": (["in.gpkg", "lines.gpkg"], "OUT 'lines.gpkg' exists, give --overwrite"),
    "output is input": (["in.gpkg", "in.gpkg", "--overwrite"], "OUT 'in.gpkg' is IN"),
    "spacing": (["in.gpkg", "out.csv", "--spacing", "2x"], "--spacing is '2x', expected a number"),
    "no spacing": (["in.gpkg", "out.csv", "--spacing", "0"], "spacing is 0.0, expected a positive"),
    "too dense": (["in.gpkg", "out.csv", "--spacing", "1e-12"], "stations, expected fewer"),
    "identifier": (["in.gpkg", "out.csv", "--id", "x"], "--id is 'x', expected a field of layer"),
    "method": (["in.gpkg", "out.csv", "--method", "magic"], "method is 'magic', expected"),
    "figure": (["in.gpkg", "out.csv", "--figure", "a.gif"], "--figure 'a.gif' ends in '.gif'"),
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Return a folder with some files, which the test must leave as it is."""
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "in.gpkg", [STRIP], layer="in")
    write(tmp_path / "lines.gpkg", ["LINESTRING (0 0, 1 1)"])
    (tmp_path / "text.gpkg").write_text("no vector file")
    (tmp_path / "a.svg").write_text("an old picture")
    (tmp_path / "file.gdb").write_text("no geodatabase")
    write(tmp_path / "x_refused.parquet", [STRIP])
    for name in ("keep.gdb", "keep.fgb", "keep.svg"):
        (tmp_path / name / "sub").mkdir(parents=True)
        (tmp_path / name / "sub" / "f").write_text("of the user's own")
    before = contents(tmp_path)
    yield tmp_path
    assert contents(tmp_path) == before


def contents(folder: Path) -> dict[Path, bytes | None]:
    """Everything in a folder."""
    return {path: path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("case", WRONG)
def test_wrong_usage_is_explained_in_a_sentence(case: str, midrib: Runner) -> None:
    arguments, sentence = WRONG[case]
    outcome = midrib("collapse", *arguments)
    check(outcome, sentence)


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("case", WRONG_PROFILE)
def test_wrong_usage_of_profile_is_explained_in_a_sentence(case: str, midrib: Runner) -> None:
    arguments, sentence = WRONG_PROFILE[case]
    check(midrib("profile", *arguments), sentence)


def check(outcome: Outcome, sentence: str) -> None:
    """Exit code 2 and the sentence."""
    assert outcome.code == 2
    assert sentence in outcome.err
    assert "Traceback" not in outcome.err
    assert outcome.out == ""


@pytest.mark.usefixtures("folder")
def test_interrupts_leave_no_file(midrib: Runner, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("midrib.cli.output.write_tables", interrupt)
    outcome = midrib("collapse", "in.gpkg", "out.gpkg")
    assert (outcome.code, outcome.err) == (130, "midrib: interrupted\n")


@pytest.mark.usefixtures("folder")
def test_our_own_errors_are_a_sentence_too(midrib: Runner, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        message = "the mesh has come apart, please report it"
        raise InvariantError(message)

    monkeypatch.setattr("midrib.engines.batches.collapse", fail)
    outcome = midrib("collapse", "in.gpkg", "out.gpkg")
    assert (outcome.code, outcome.err) == (2, "midrib: the mesh has come apart, please report it\n")


@pytest.mark.usefixtures("folder")
def test_bugs_leave_their_traceback_in_a_file(
    midrib: Runner, monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ZeroDivisionError

    reports = tmp_path_factory.mktemp("reports")
    monkeypatch.setattr("tempfile.tempdir", str(reports))
    monkeypatch.setattr("midrib.engines.batches.collapse", fail)
    outcome = midrib("collapse", "in.gpkg", "out.gpkg")
    (report,) = reports.iterdir()
    assert outcome.code == 2
    assert f"please report it with {report}" in outcome.err
    assert "Traceback" not in outcome.err
    assert "Traceback" in report.read_text()


@pytest.mark.usefixtures("folder")
def test_figures_without_matplotlib_name_the_command_to_install_it(
    midrib: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("midrib.checks.find_spec", lambda _: None)
    outcome = midrib("collapse", "in.gpkg", "out.gpkg", "--figure", "new.svg")
    assert outcome.code == 2
    assert "needs matplotlib: pip install midrib[figures]" in outcome.err
