"""One run at a time into a folder: a file in it says which process has it, on which machine."""

import json
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from midrib.errors import ParameterError
from midrib.formats.failures import failures_named

__all__ = ["LOCK", "alone_in"]

LOCK = "_lock.json"


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Keep other runs out of a folder for the length of a block.

    Raises
    ------
    ParameterError
        If another run is writing there. One that has been killed on this machine is none.
    """
    path = folder / LOCK
    holder = {"process": os.getpid(), "host": socket.gethostname()}
    while not create(path, json.dumps(holder)):
        found = read(path)
        if found is None:
            continue
        if not has_ended(found):
            who = f"process {found.get('process', 'unknown')} on {found.get('host', 'unknown')!r}"
            msg = (
                f"another run is writing to {str(folder)!r} ({who}), wait for its end, or remove "
                f"{LOCK!r} there if it has ended"
            )
            raise ParameterError(msg)
        path.unlink(missing_ok=True)
    try:
        yield
    finally:
        path.unlink(missing_ok=True)


def create(path: Path, content: str) -> bool:
    """Write a file that is not there; tell whether that was so."""
    with failures_named(repr(str(path))):
        try:
            with path.open("x", encoding="utf-8") as file:
                file.write(content)
        except FileExistsError:
            return False
    return True


def read(path: Path) -> dict[str, Any] | None:
    """Read who holds a lock: nothing if that is not written yet, None if it is free by now."""
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    except ValueError:
        return {}
    return found


def has_ended(holder: dict[str, Any]) -> bool:
    """Whether a holder is surely gone: a process of this machine that there is no more.

    One with our own number was another, in a container that has begun anew.
    """
    process = holder.get("process")
    if holder.get("host") != socket.gethostname() or not isinstance(process, int):
        return False
    return process == os.getpid() or not is_running(process)


def is_running(process: int) -> bool:
    """Whether there is a process of this number, whoever's it is."""
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    return True
