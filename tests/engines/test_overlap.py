"""Reading ahead and writing behind: order, bounded memory, errors on either side."""

import threading
import time
from collections.abc import Generator

import pytest

from midrib.engines.overlap import DEPTH, ahead, behind


def test_items_come_in_order_and_the_generator_is_closed() -> None:
    closed = threading.Event()

    def items() -> Generator[int, None, None]:
        try:
            yield from range(100)
        finally:
            closed.set()

    assert list(ahead(items())) == list(range(100))
    assert closed.is_set()


def test_a_reader_is_only_a_few_items_ahead() -> None:
    read: list[int] = []

    def items() -> Generator[int, None, None]:
        for i in range(50):
            read.append(i)
            yield i

    for i in ahead(items()):
        time.sleep(0.001)
        assert len(read) <= i + 1 + DEPTH + 1


def test_a_reader_stops_when_nobody_listens_any_more() -> None:
    closed = threading.Event()

    def items() -> Generator[int, None, None]:
        try:
            while True:
                yield 1
        finally:
            closed.set()

    walk = ahead(items())
    next(walk)
    walk.close()  # type: ignore[attr-defined]
    assert closed.is_set()


def test_errors_of_a_reader_come_after_what_it_has_read() -> None:
    def items() -> Generator[int, None, None]:
        yield 1
        raise OSError("the disk is gone")

    walk = ahead(items())
    assert next(walk) == 1
    with pytest.raises(OSError, match="the disk is gone"):
        next(walk)


def test_a_writer_uses_all_items_in_order_before_the_end() -> None:
    used: list[int] = []

    def use(item: int) -> None:
        time.sleep(0.001)
        used.append(item)

    with behind(use) as hand_over:
        for i in range(30):
            hand_over(i)
    assert used == list(range(30))


@pytest.mark.parametrize("count", [1, 100])
def test_errors_of_a_writer_are_raised_here(count: int) -> None:
    def use(_: int) -> None:
        raise OSError("the disk is full")

    def hand_over_all() -> None:
        with behind(use) as hand_over:
            for i in range(count):
                hand_over(i)

    with pytest.raises(OSError, match="the disk is full"):
        hand_over_all()


def test_an_error_in_between_is_not_covered_up() -> None:
    def fail() -> None:
        with behind(lambda _: None) as hand_over:
            hand_over(1)
            raise KeyError

    with pytest.raises(KeyError):
        fail()
