"""Interrupts: at any time the process ends in one sentence, and no file is half there."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
import shapely

from midrib import collapse, interrupts
from midrib.formats.writing import staged
from tests.formats.layers import write

COMMAND = "from midrib import __main__, interrupts; interrupts.install(); print(1, flush=True); "
BOX = shapely.box(0, 0, 90, 20)


def start(*arguments: object, then: str = "__main__.main()") -> "subprocess.Popen[str]":
    """Start a command, or another piece of Python, that is ready for interrupts."""
    running = subprocess.Popen(
        [sys.executable, "-c", COMMAND + then, *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert running.stdout is not None
    assert running.stdout.readline() == "1\n"
    return running


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Areas that take far longer than the test waits."""
    return write(tmp_path_factory.mktemp("long") / "in.gpkg", [BOX.wkt] * 3000)


# Seconds from the start: among the imports, and while features are worked on.
@pytest.mark.parametrize("after", [0.0, 0.3, 1.0, 2.5, 3.5])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_at_any_time_is_one_sentence(
    number: signal.Signals, after: float, source: Path, tmp_path: Path
) -> None:
    running = start("collapse", source, tmp_path / "out.gpkg", "--spacing", "0.001", "-q")
    time.sleep(after)
    running.send_signal(number)
    _, said = running.communicate(timeout=60)
    assert running.returncode == 130
    assert said == "midrib: interrupted\n"
    assert list(tmp_path.iterdir()) == []


def test_a_second_interrupt_leaves_at_once_and_nothing_behind(tmp_path: Path) -> None:
    stubborn = (
        "import sys, time, pathlib; from midrib.formats.writing import staged; "
        "interrupts.start_work(); stage = staged(pathlib.Path(sys.argv[1])); stage.__enter__(); "
        "print(2, flush=True); [time.sleep(0.01) for _ in range(10_000)]"
    )
    running = start(tmp_path, then=stubborn)
    assert running.stdout is not None
    assert running.stdout.readline() == "2\n"
    assert len(list(tmp_path.iterdir())) == 1
    running.send_signal(signal.SIGINT)
    time.sleep(0.2)
    assert running.poll() is None
    running.send_signal(signal.SIGINT)
    assert running.communicate(timeout=60)[1] == "midrib: interrupted\n"
    assert running.returncode == 130
    assert list(tmp_path.iterdir()) == []


def test_what_is_asked_for_before_files_move_is_heard(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(interrupts.state, "is_asked", True)
    with pytest.raises(KeyboardInterrupt), staged(tmp_path) as stage:
        (stage / "new").write_text("whole")
    assert list(tmp_path.iterdir()) == []


def test_nothing_interrupts_files_that_move(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(interrupts.state, "is_asked", False)
    monkeypatch.setattr(interrupts.state, "has_begun", True)
    with interrupts.shielded():
        interrupts.handle()
        interrupts.handle()  # does not leave
    with pytest.raises(KeyboardInterrupt):
        interrupts.check()


def test_the_library_raises_between_areas_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C while areas are worked on takes effect between two of them."""
    seen: list[object] = []

    def press(*_: object) -> list[object]:
        seen.append(signal.getsignal(signal.SIGINT))
        os.kill(os.getpid(), signal.SIGINT)
        return []

    monkeypatch.setattr("midrib.curves.collapse.valid_parts", press)
    usual = signal.signal(signal.SIGINT, signal.default_int_handler)  # in background it is ignored
    try:
        with pytest.raises(KeyboardInterrupt):
            collapse([BOX, BOX])
        assert seen == [interrupts.take_note]
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    finally:
        signal.signal(signal.SIGINT, usual)
    monkeypatch.undo()
    assert collapse(BOX).length == 90.0


def test_threads_and_handlers_of_the_caller_are_left_alone() -> None:
    handler = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with interrupts.deferred():
            assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, handler)
    lines: list[shapely.LineString] = []
    thread = threading.Thread(target=lambda: lines.append(collapse(BOX)))
    thread.start()
    thread.join()
    assert lines[0].length == 90.0
