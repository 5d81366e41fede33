"""Parts made on this machine: one after the other, or by several processes.

Processes begin anew rather than as copies of this one, which may have threads by then.
"""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing.connection import wait as wait_for

from midrib import interrupts
from midrib.engines.partitions import Partition
from midrib.engines.parts import Done, Work, make_part
from midrib.errors import MidribError

__all__ = ["largest_first", "run"]

POLL = 0.2  # seconds between two looks for an interrupt


def run(
    work: Work, partitions: list[Partition], said: Callable[[int], None], *, workers: int | None
) -> Iterator[Done]:
    """Make the parts of partitions, in any order; ``said`` hears of features that are done.

    None stands for one process that uses every processor it may, by threads.
    """
    if workers in {None, 1} or len(partitions) < 2:
        for partition in partitions:
            yield make_part(work, partition, said, workers)
        return
    for done in run_in_processes(work, partitions, min(workers or 1, len(partitions))):
        said(done.counts.features)
        yield done


def largest_first(partitions: list[Partition]) -> list[Partition]:
    """Partitions in the order in which they are best begun, so that none is waited for at the end.

    A coast of a million vertices takes as long as thousands of ponds.
    """
    return sorted(partitions, key=lambda partition: -partition.size)


def run_in_processes(work: Work, partitions: list[Partition], workers: int) -> Iterator[Done]:
    """Make parts in processes; an interrupt ends all of them after the feature at hand.

    Raises
    ------
    MidribError
        If one of them is ended from outside.
    """
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, context, initializer=follow_parent) as pool:
        waiting = {pool.submit(make_part, work, some) for some in largest_first(partitions)}
        try:
            while waiting:
                interrupts.check()
                finished, waiting = wait(waiting, POLL, FIRST_COMPLETED)
                for future in finished:
                    yield future.result()
        except BrokenProcessPool:
            msg = (
                "a process of --workers was ended from outside, perhaps for want of memory: give "
                "fewer workers, or smaller --part-rows"
            )
            raise MidribError(msg) from None
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            for child in multiprocessing.active_children():
                os.kill(child.pid or 0, signal.SIGINT)
            raise


def follow_parent() -> None:
    """Let an interrupt end the part at hand, and the end of the parent this process."""
    signal.signal(signal.SIGINT, interrupts.take_note)
    signal.signal(signal.SIGTERM, interrupts.take_note)
    threading.Thread(target=leave_with_parent, daemon=True).start()


def leave_with_parent() -> None:
    """Wait for the end of the parent, which may have been killed, then leave."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait_for([parent.sentinel])
        os._exit(interrupts.INTERRUPTED)
