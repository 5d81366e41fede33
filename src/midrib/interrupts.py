"""Interrupts: Ctrl-C waits until the feature at hand is done.

An exception that a signal handler raises while arguments are handed to a compiled kernel leaves
them half unpacked, and the process dies of it. So while kernels are called the handler only takes
note, and ``check``, called between features, raises.

    install                      start_work                                    end
       |  first: leave at once       |  first: take note; second: leave at once   |
"""

import os
import shutil
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["INTERRUPTED", "check", "deferred", "install", "rubbish", "shielded", "start_work"]

INTERRUPTED = 130  # 128 + SIGINT, as shells have it
SHOW_CURSOR = b"\x1b[?25h"  # a progress bar hides it


class State:
    """What is known about interrupts of this process; signals belong to a process as well."""

    def __init__(self) -> None:
        self.rubbish: list[str] = []  # folders to remove when leaving at once
        self.reset()

    def reset(self) -> None:
        """Begin anew."""
        self.is_asked = False  # whether the work is to end
        self.has_begun = False  # whether a first interrupt is only taken note of
        self.is_shielded = False  # whether a second one is, too


state = State()


def install() -> None:
    """Handle SIGINT and SIGTERM until the process ends; for programs, not for libraries."""
    state.reset()
    signal.signal(signal.SIGINT, handle)
    signal.signal(signal.SIGTERM, handle)


def start_work() -> None:
    """From now on an interrupt waits for the next ``check``."""
    state.has_begun = True


def handle(*_: object) -> None:
    """Take note of an interrupt, or leave."""
    if not state.is_shielded and (state.is_asked or not state.has_begun):
        for folder in state.rubbish:
            shutil.rmtree(folder, ignore_errors=True)
        cursor = SHOW_CURSOR if os.isatty(2) else b""
        os.write(2, cursor + b"midrib: interrupted\n")
        os._exit(INTERRUPTED)
    state.is_asked = True


def check() -> None:
    """Raise KeyboardInterrupt if an interrupt has been taken note of."""
    if state.is_asked:
        raise KeyboardInterrupt


@contextmanager
def deferred() -> Iterator[None]:
    """Let Ctrl-C wait for ``check``, or for the end of the block, where Python would raise at once.

    Handlers of the caller's own stay, and so does everything in threads other than the main one,
    which Python does not interrupt.
    """
    is_main = threading.current_thread() is threading.main_thread()
    if not is_main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return
    state.is_asked = False
    signal.signal(signal.SIGINT, take_note)
    try:
        yield
        check()
    finally:
        state.is_asked = False
        signal.signal(signal.SIGINT, signal.default_int_handler)


def take_note(*_: object) -> None:
    """Take note of an interrupt."""
    state.is_asked = True


@contextmanager
def shielded() -> Iterator[None]:
    """Let nothing interrupt a block that is short; what was asked for before ends it first."""
    state.is_shielded = True
    try:
        check()
        yield
    finally:
        state.is_shielded = False


@contextmanager
def rubbish(folder: str) -> Iterator[None]:
    """Have a folder removed, should the process be left at once."""
    state.rubbish.append(folder)
    try:
        yield
    finally:
        state.rubbish.remove(folder)
