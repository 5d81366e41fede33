"""Jobs: parts are whole, made once, and never mixed with those of another job."""

import json
import os
import signal
import time
from dataclasses import replace
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from midrib.engines import batches, local, parts
from midrib.engines.jobs import Job, logged, plan
from midrib.errors import MidribError, ParameterError
from midrib.formats.reading import open_layer
from tests.engines.layers import contents, files_up_to, job_on, made, recipe_of, start, write_areas


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file of areas."""
    return write_areas(tmp_path_factory.mktemp("areas") / "in.parquet")


@pytest.fixture(scope="module")
def expected(source: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """Parts of a run that nothing has interrupted."""
    folder = tmp_path_factory.mktemp("whole") / "lines"
    run(job_on(source, folder))
    return contents(folder)


def run(job: Job, *, overwrite: bool = False) -> list[int]:
    """Make the parts that are missing, and return their numbers."""
    missing, _ = job.begin(overwrite=overwrite)
    done = local.run(job.work, missing, lambda _: None, workers=1)
    return made(logged(done, job.folder))


def test_parts_are_one_layer_together(
    source: Path, expected: dict[str, bytes], tmp_path: Path
) -> None:
    run(job_on(source, tmp_path / "lines"))
    assert len(expected) == 6 + 3  # three of them have a refused area
    table = pq.read_table(tmp_path / "lines")  # passes over what begins with an underscore
    assert table.column("number").to_pylist() == [i for i in range(110) if i % 50 != 3]
    with open_layer(tmp_path / "lines" / "part-00000.parquet", "part-00000") as part:
        assert "Amersfoort / RD New" in str(part.crs)


def test_a_part_that_fails_leaves_nothing_and_the_others_stay(
    source: Path, expected: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    job = job_on(source, tmp_path / "lines")
    collapse_batch = batches.collapse_batch

    def fail(batch: object, recipe: object, first: int, threads: int | None) -> object:
        if first == 55:
            raise OSError("the network is gone")
        return collapse_batch(batch, recipe, first, threads)  # type: ignore[arg-type]

    monkeypatch.setattr(parts, "collapse_batch", fail)
    with pytest.raises(OSError, match="the network is gone"):
        run(job)
    assert [path.name for path in job.folder.glob("*.parquet")] != []
    assert not list(job.folder.rglob(f"{parts.UNFINISHED}*"))
    assert contents(job.folder).items() < expected.items()
    monkeypatch.undo()
    assert run(job) == [3, 4, 5]
    assert contents(job.folder) == expected
    assert run(job) == []
    log = [json.loads(line) for line in (job.folder / "_log.jsonl").read_text().splitlines()]
    assert sorted(line["part"] for line in log) == list(range(6))


def test_a_disk_that_is_full_is_told_in_a_sentence_and_nothing_half_is_left(
    source: Path, expected: dict[str, bytes], tmp_path: Path
) -> None:
    job = job_on(source, tmp_path / "lines")
    for size in (1_000, 34_000):  # in the first row group, and in the footer of a part
        missing, _ = job.begin(overwrite=False)
        part = rf"{job.folder}/.*part-0000\d.parquet' cannot be written: File too large"
        with files_up_to(size), pytest.raises(MidribError, match=part):
            made(local.run(job.work, missing, lambda _: None, workers=1))
        assert not list(job.folder.rglob(f"{parts.UNFINISHED}*"))
    run(job)
    assert contents(job.folder) == expected
    with files_up_to(100), pytest.raises(MidribError, match=r"_midrib.json' cannot be written: F"):
        job.write_manifest()


def test_what_was_being_written_is_removed(
    source: Path, expected: dict[str, bytes], tmp_path: Path
) -> None:
    job = job_on(source, tmp_path / "lines")
    run(job)
    (job.folder / ".part-00001-77-88").write_bytes(b"half")
    (job.folder / "part-00001.parquet").write_bytes(expected["part-00001.parquet"][:500])
    assert run(job) == [1]
    assert contents(job.folder) == expected
    assert not list(job.folder.glob(".part*"))


def test_parts_of_another_job_are_made_anew(
    source: Path, expected: dict[str, bytes], tmp_path: Path
) -> None:
    job, other = job_on(source, tmp_path / "lines"), job_on(source, tmp_path / "other", spacing=9.0)
    run(job)
    run(other)
    other.work.lines(2).replace(job.work.lines(2))
    assert run(job) == [2]
    assert contents(job.folder) == expected


def test_other_options_or_input_are_another_job(source: Path, tmp_path: Path) -> None:
    copy = tmp_path / "in.parquet"
    copy.write_bytes(source.read_bytes())
    folder = tmp_path / "lines"
    run(job_on(copy, folder))
    with pytest.raises(ParameterError, match=r"parts of another job \(spacing is 9.0, was None\)"):
        job_on(copy, folder, spacing=9.0).begin(overwrite=False)
    before = contents(folder)
    write_areas(copy, seed=2)
    with pytest.raises(ParameterError, match=r"\(input has changed: in.parquet\), give the same"):
        job_on(copy, folder).begin(overwrite=False)
    assert contents(folder) == before
    assert run(job_on(copy, folder), overwrite=True) == list(range(6))
    assert contents(folder) != before


@pytest.mark.parametrize(("side", "old", "new"), [("dbf", b" 5", b" 6"), ("prj", b"RD", b"??")])
def test_side_files_are_input_too(side: str, old: bytes, new: bytes, tmp_path: Path) -> None:
    source = write_areas(tmp_path / "in.shp")
    run(job_on(source, tmp_path / "lines"))
    (tmp_path / "in.txt").write_text("notes of mine are no input")
    assert run(job_on(source, tmp_path / "lines")) == []
    path = source.with_suffix(f".{side}")
    content = path.read_bytes()
    path.write_bytes(content.replace(old, new))
    assert path.read_bytes() != content
    with pytest.raises(ParameterError, match=rf"input has changed: in.{side}\), give the same"):
        job_on(source, tmp_path / "lines").begin(overwrite=False)


def test_another_crs_is_another_job(source: Path, tmp_path: Path) -> None:
    recipe = recipe_of(source)
    plan(tmp_path / "lines", [source], "in", recipe, 20, None).begin(overwrite=False)
    job = plan(tmp_path / "lines", [source], "in", replace(recipe, crs=None), 20, None)
    with pytest.raises(ParameterError, match=r"another job \(the CRS of the input has changed\)"):
        job.begin(overwrite=False)


def test_a_geodatabase_is_all_its_files(tmp_path: Path) -> None:
    source = write_areas(tmp_path / "in.gdb")
    run(job_on(source, tmp_path / "lines"))
    (source / "of_a_reader.lock").touch()
    assert run(job_on(source, tmp_path / "lines")) == []
    table = max(source.glob("*.gdbtable"))
    with table.open("ab") as file:
        file.write(bytes(8))
    changed = rf"input has changed: in.gdb/{table.name}\)"
    with pytest.raises(ParameterError, match=changed):
        job_on(source, tmp_path / "lines").begin(overwrite=False)


@pytest.mark.parametrize("content", ["", "{", "{}", "[]", "null"])
def test_a_damaged_manifest_is_refused_or_overwritten(
    content: str, source: Path, expected: dict[str, bytes], tmp_path: Path
) -> None:
    job = job_on(source, tmp_path / "lines")
    job.begin(overwrite=False)
    (job.folder / "_midrib.json").write_text(content)
    with (
        job.alone(),
        pytest.raises(ParameterError, match=r"_midrib.json' is damaged.* --overwrite begins anew"),
    ):
        job.begin(overwrite=False)
    if not content:
        run(job, overwrite=True)
        assert contents(job.folder) == expected


def test_folders_of_others_are_left_alone(source: Path, tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    (tmp_path / "file").write_text("mine")
    for overwrite in (False, True):
        with pytest.raises(ParameterError, match="is a folder, but no output of an earlier run"):
            job_on(source, tmp_path).begin(overwrite=overwrite)
        with pytest.raises(ParameterError, match="is a file, expected another place"):
            job_on(source, tmp_path / "file").begin(overwrite=overwrite)
    assert (tmp_path / "notes.txt").read_text() == "mine"


def test_processes_make_the_same_parts(
    source: Path, expected: dict[str, bytes], tmp_path: Path
) -> None:
    job = job_on(source, tmp_path / "lines")
    missing, _ = job.begin(overwrite=False)
    heard: list[int] = []
    done = local.run(job.work, missing, heard.append, workers=2)
    assert sorted(made(done)) == list(range(6))
    assert sum(heard) == 110
    assert contents(job.folder) == expected


def test_a_process_that_is_killed_ends_the_run_in_a_sentence(
    source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(local, "make_part", kill_itself)
    job = job_on(source, tmp_path / "lines")
    missing, _ = job.begin(overwrite=False)
    with pytest.raises(MidribError, match="was ended from outside"):
        list(local.run(job.work, missing, lambda _: None, workers=2))


def kill_itself(*_: object) -> None:
    """End this process, as the system does when memory is short."""
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
@pytest.mark.parametrize("workers", [1, 2])
def test_an_interrupted_command_goes_on_where_it_ended(
    number: signal.Signals, workers: int, tmp_path: Path
) -> None:
    source, out = write_areas(tmp_path / "in.parquet", 300), tmp_path / "lines"
    options = ("--spacing", "0.04", "--workers", workers, "--part-rows", 20)
    running = start("collapse", source, out, *options)
    while len(list(out.glob("part-*"))) < 3:
        assert running.poll() is None
        time.sleep(0.02)
    running.send_signal(number)
    _, said = running.communicate(timeout=60)
    first = {path: path.stat().st_mtime_ns for path in out.glob("part-*")}
    assert 3 <= len(first) < 15
    if number is signal.SIGINT:
        assert running.returncode == 130
        assert said == (
            "finished parts are kept, the same command goes on from there\nmidrib: interrupted\n"
        )
        assert not list(out.glob(".part*"))
    again = start("collapse", source, out, *options)
    _, said = again.communicate(timeout=120)
    assert again.returncode == 1  # some areas are refused
    assert f"{len(first)} of 15 parts are there from an earlier run" in said
    assert len(list(out.glob("part-*"))) == 15
    assert {path: path.stat().st_mtime_ns for path in first} == first  # none was made again
    log = [json.loads(line)["part"] for line in (out / "_log.jsonl").read_text().splitlines()]
    assert len(log) == len({*log})
    assert {*range(15)} - {*log} <= {int(path.stem[5:]) for path in first}
