"""Spark: the same bytes as on this machine, and lines in frames of one's own."""

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pyarrow as pa
import pytest

from midrib.engines import local, spark
from midrib.engines.frames import collapse_rows
from midrib.errors import ParameterError
from tests.engines.layers import batch_of, contents, job_on, made, recipe_of, write_areas

pytest.importorskip("pyspark", reason="Spark is not installed")
if shutil.which("java") is None:
    pytest.skip("Spark needs Java, which is not installed", allow_module_level=True)
pytestmark = pytest.mark.filterwarnings("ignore")  # Spark's own, of pandas and of sockets


@pytest.fixture(scope="module")
def session() -> Iterator[Any]:
    """Two cores of this machine, once for all tests."""
    found = spark.session_on("local[2,4]")
    yield found
    found.stop()


@pytest.fixture
def source(tmp_path: Path) -> Path:
    """A file of areas."""
    return write_areas(tmp_path / "in.parquet")


def test_parts_are_those_of_this_machine(source: Path, session: Any, tmp_path: Path) -> None:
    here, there = (job_on(source, tmp_path / name) for name in ("here", "there"))
    missing, _ = here.begin(overwrite=False)
    assert made(local.run(here.work, missing, lambda _: None, workers=1)) == list(range(6))
    missing, _ = there.begin(overwrite=False)
    heard: list[int] = []
    assert sorted(made(spark.run_on(session, there.work, missing, heard.append))) == list(range(6))
    assert sum(heard) == 110
    assert contents(there.folder) == contents(here.folder)


def test_frames_have_the_lines_of_batches(source: Path, session: Any) -> None:
    batch = batch_of(source)
    frame = session.createDataFrame(pa.Table.from_batches([batch])).repartition(2)
    lines = spark.collapse_frame(frame, "geom")
    found = pa.Table.from_pylist([row.asDict() for row in lines.collect()])
    expected = pa.Table.from_batches([collapse_rows(batch, recipe_of(source))])
    assert found.column_names == expected.column_names
    assert found.sort_by("number").to_pylist() == expected.to_pylist()
    with pytest.raises(ParameterError, match="geometry is 'x', expected a column: number"):
        spark.collapse_frame(frame, "x")
    with pytest.raises(ParameterError, match=r"spacing is -1.0, expected a positive"):
        spark.collapse_frame(frame, "geom", spacing=-1.0)
