"""Locks: one run at a time writes to a folder, and a run that is gone keeps nobody out."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from midrib.engines import parts
from midrib.engines.locks import LOCK, alone_in
from midrib.errors import ParameterError
from tests.engines.layers import job_on, start, write_areas


@pytest.fixture
def other() -> Iterator["subprocess.Popen[bytes]"]:
    """Another process of this machine."""
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as process:
        yield process
        process.kill()


def hold(folder: Path, process: int, host: str) -> Path:
    """Leave the lock of a run."""
    path = folder / LOCK
    path.write_text(json.dumps({"process": process, "host": host}))
    return path


def test_a_lock_is_there_as_long_as_the_block(tmp_path: Path) -> None:
    with alone_in(tmp_path):
        held = json.loads((tmp_path / LOCK).read_text())
        assert held == {"process": os.getpid(), "host": socket.gethostname()}
    assert not list(tmp_path.iterdir())
    with pytest.raises(OSError, match="gone"), alone_in(tmp_path):
        raise OSError("gone")
    assert not list(tmp_path.iterdir())


def test_a_run_that_is_alive_keeps_others_out(
    other: "subprocess.Popen[bytes]", tmp_path: Path
) -> None:
    path = hold(tmp_path, other.pid, socket.gethostname())
    said = rf"another run is writing to .* \(process {other.pid} on .*\), wait for its end"
    with pytest.raises(ParameterError, match=said), alone_in(tmp_path):
        pass
    assert path.exists()
    other.kill()
    other.wait()
    with alone_in(tmp_path):
        assert json.loads(path.read_text())["process"] == os.getpid()


def test_a_run_of_which_nothing_is_known_keeps_others_out(tmp_path: Path) -> None:
    path = hold(tmp_path, os.getpid(), "elsewhere.example")
    with pytest.raises(ParameterError, match=r"on 'elsewhere\.example'"), alone_in(tmp_path):
        pass
    path.write_text("")  # about to be written
    with pytest.raises(ParameterError, match="process unknown"), alone_in(tmp_path):
        pass
    assert path.exists()


def test_a_lock_of_a_container_that_has_begun_anew_is_taken_over(tmp_path: Path) -> None:
    path = hold(tmp_path, os.getpid(), socket.gethostname())
    with alone_in(tmp_path):
        pass
    assert not path.exists()


def test_folders_of_others_get_no_lock(tmp_path: Path) -> None:
    source = write_areas(tmp_path / "in.parquet", 5)
    with (
        pytest.raises(ParameterError, match="no output of an earlier run"),
        job_on(source, tmp_path).alone(),
    ):
        pass
    assert list(tmp_path.iterdir()) == [source]


def test_a_second_command_leaves_the_first_alone(tmp_path: Path) -> None:
    source, out = write_areas(tmp_path / "in.parquet", 300), tmp_path / "lines"
    options = ("--spacing", "0.04", "--part-rows", 20)
    first = start("collapse", source, out, *options)
    while not list(out.glob(f"{parts.UNFINISHED}*")):
        assert first.poll() is None
        time.sleep(0.02)
    first.send_signal(signal.SIGSTOP)
    unfinished = list(out.glob(f"{parts.UNFINISHED}*"))
    for more in ((), ("--overwrite",)):
        second = start("collapse", source, out, *options, *more)
        _, said = second.communicate(timeout=60)
        assert second.returncode == 2
        assert f"another run is writing to {str(out)!r} (process {first.pid} on" in said
    assert [path for path in unfinished if path.exists()] == unfinished
    first.send_signal(signal.SIGCONT)
    _, said = first.communicate(timeout=120)
    assert first.returncode == 1, said  # some areas are refused
    assert len(list(out.glob("part-*"))) == 15
    assert not (out / LOCK).exists()
