"""Dask: the same bytes as on this machine, and nothing lost with a worker."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pandas as pd
import pytest

from midrib.engines import dask, local
from midrib.engines.frames import collapse_rows
from midrib.errors import ParameterError
from tests.engines.layers import batch_of, contents, job_on, made, recipe_of, write_areas

distributed = pytest.importorskip("distributed", reason="Dask is not installed")


@pytest.fixture(scope="module")
def cluster() -> Iterator[str]:
    """Two workers on this machine: the address of their scheduler."""
    with dask.client_of(None, 2) as client:
        yield client.scheduler.address


@pytest.fixture
def source(tmp_path: Path) -> Path:
    """A file of areas."""
    return write_areas(tmp_path / "in.parquet", 400)


def test_parts_are_those_of_this_machine_although_a_worker_is_killed(
    source: Path, cluster: str, tmp_path: Path
) -> None:
    here = job_on(source, tmp_path / "here", spacing=0.1)
    missing, _ = here.begin(overwrite=False)
    assert made(local.run(here.work, missing, lambda _: None, workers=1)) == list(range(20))
    there = job_on(source, tmp_path / "there", spacing=0.1)
    missing, _ = there.begin(overwrite=False)
    heard: list[int] = []
    running = dask.run(there.work, missing, heard.append, scheduler=cluster)
    numbers = [next(running).number]
    with distributed.Client(cluster) as client:
        workers = client.run(os.getpid)
    assert len(workers) == 2
    os.kill(min(workers.values()), signal.SIGKILL)  # its nanny starts another one
    numbers += made(running)
    assert sorted(numbers) == list(range(20))
    assert sum(heard) == 400
    assert contents(there.folder) == contents(here.folder)


def test_partitions_that_fail_are_tried_again_then_told_in_a_sentence(
    source: Path, cluster: str, tmp_path: Path
) -> None:
    job = job_on(source, tmp_path / "lines")
    missing, _ = job.begin(overwrite=False)
    source.unlink()
    with pytest.raises(ParameterError, match="cannot be read"):
        list(dask.run(job.work, missing, lambda _: None, scheduler=cluster))


def test_frames_have_the_lines_of_batches(source: Path, cluster: str) -> None:
    frames = pytest.importorskip("dask.dataframe", reason="Dask has no frames here")
    config = pytest.importorskip("dask").config
    batch = batch_of(source)
    with distributed.Client(cluster), config.set({"dataframe.convert-string": False}):
        frame = frames.from_pandas(batch.to_pandas(), npartitions=3)
        found = dask.collapse_frame(frame, "geom").compute()
    expected = collapse_rows(batch, recipe_of(source)).to_pandas()
    assert found.columns.tolist() == expected.columns.tolist()
    pd.testing.assert_frame_equal(found, expected, check_dtype=False, check_exact=True)
    with pytest.raises(ParameterError, match="geometry is 'x', expected a column: number"):
        dask.collapse_frame(frame, "x")


def test_schedulers_that_do_not_answer_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dask, "PATIENCE", 0.5)
    with (
        pytest.raises(ParameterError, match=r"--scheduler 'tcp://127.0.0.1:9' does not answer"),
        dask.client_of("tcp://127.0.0.1:9", None),
    ):
        pass
