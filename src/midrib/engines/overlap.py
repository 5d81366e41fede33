"""Reading ahead and writing behind: two threads, and queues that hold a few batches.

      reader thread          this thread           writer thread
    file -> [b b b] -> collapse, batch by batch -> [b b b] -> file

A full queue makes who fills it wait, so that memory does not grow with the file.
"""

import queue
import threading
from collections.abc import Callable, Generator, Iterator
from contextlib import closing, contextmanager
from typing import Any, TypeVar

__all__ = ["ahead", "behind"]

DEPTH = 3  # batches that wait
POLL = 0.1  # seconds after which a thread looks whether it is still wanted

Item = TypeVar("Item")
END = object()


def ahead(items: Generator[Item, None, None]) -> Iterator[Item]:
    """Walk through items that a thread takes out of a generator meanwhile.

    What that raises is raised here.
    """
    waiting: queue.Queue[Any] = queue.Queue(DEPTH)
    is_over = threading.Event()
    failure: list[BaseException] = []

    def fill() -> None:
        try:
            with closing(items):
                for item in items:
                    if not put(waiting, item, is_over):
                        return
        except BaseException as error:  # raised in the other thread
            failure.append(error)
        put(waiting, END, is_over)

    thread = threading.Thread(target=fill, name="midrib-reader", daemon=True)
    thread.start()
    try:
        while (item := waiting.get()) is not END:
            yield item
    finally:
        is_over.set()
        thread.join()
    if failure:
        raise failure[0]


@contextmanager
def behind(use: Callable[[Item], None]) -> Iterator[Callable[[Item], None]]:
    """Hand items to a thread that uses one after the other; at the end all have been used.

    What ``use`` raises is raised when the next item is handed over, or at the end.
    """
    waiting: queue.Queue[Any] = queue.Queue(DEPTH)
    is_over = threading.Event()
    failure: list[BaseException] = []

    def drain() -> None:
        try:
            while (item := waiting.get()) is not END:
                use(item)
        except BaseException as error:  # raised in the other thread
            failure.append(error)
            is_over.set()

    def hand_over(item: Item) -> None:
        if not put(waiting, item, is_over):
            raise failure[0]

    thread = threading.Thread(target=drain, name="midrib-writer", daemon=True)
    thread.start()
    try:
        yield hand_over
    finally:
        put(waiting, END, is_over)
        thread.join()
    if failure:
        raise failure[0]


def put(waiting: "queue.Queue[Any]", item: object, is_over: threading.Event) -> bool:
    """Put an item into a queue unless nobody wants it any more; tell whether it is there."""
    while not is_over.is_set():
        try:
            waiting.put(item, timeout=POLL)
        except queue.Full:
            continue
        return True
    return False
