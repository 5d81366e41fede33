"""Failures of the system while a file is written: a disk that is full, a folder that is gone."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from midrib.errors import MidribError

__all__ = ["check_room", "failures_named"]

ROOM = 65_536  # bytes: more than what is written at a time


@contextmanager
def failures_named(name: str) -> Iterator[None]:
    """Say which file could not be written, and why, in one sentence.

    Raises
    ------
    MidribError
        If the system fails.
    """
    try:
        yield
    except OSError as error:
        reason = os.strerror(error.errno) if error.errno else str(error)
        msg = f"{name} cannot be written: {reason}"
        raise MidribError(msg) from error


def check_room(path: Path, name: str) -> None:
    """Refuse a file that could not grow any more: what was written last may be missing.

    Raises
    ------
    MidribError
        If so.
    """
    with failures_named(name), path.open("ab") as file:
        size = file.tell()
        try:
            file.write(bytes(ROOM))
            file.flush()
        finally:
            file.truncate(size)
