"""Failures of the system while a file is written: a disk that is full, a folder that is gone."""

import os
from collections.abc import Iterator
from contextlib import contextmanager

from midrib.errors import MidribError

__all__ = ["failures_named"]


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
