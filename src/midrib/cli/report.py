"""What a command says on stderr: that kernels are compiled, how far it is, what came of it."""

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeRemainingColumn,
)
from rich.text import Text
from shapely import box

from midrib import interrupts

if TYPE_CHECKING:
    from midrib.formats.reading import Batch

__all__ = ["Report"]

Work = TypeVar("Work")
WARM_UP = box(0.0, 0.0, 3.0, 1.0)


class Rate(ProgressColumn):
    """Features per second."""

    def render(self, task: Task) -> Text:
        """Show the rate once there is one."""
        speed = task.finished_speed or task.speed
        return Text("" if speed is None else f"{speed:,.0f}/s")


def warm_up() -> None:
    """Collapse an area."""
    from midrib.curves.collapse import collapse

    collapse(WARM_UP)


def size_of(batch: "Batch") -> int:
    """Return the number of features in a batch."""
    return len(batch.geometries)


class Report:
    """Says things on stderr, unless it is quiet."""

    def __init__(self, *, quiet: bool) -> None:
        self.console = Console(stderr=True, quiet=quiet, highlight=False, soft_wrap=True)
        self.started = time.perf_counter()

    def say(self, sentence: str) -> None:
        """Print one line."""
        self.console.print(sentence, markup=False)

    def start(self, work: Callable[[], Any] = warm_up) -> None:
        """Load the kernels by some work, and tell where that takes long; time counts from now."""
        self.announce()
        work()
        interrupts.start_work()
        self.started = time.perf_counter()

    def announce(self) -> None:
        """Tell that kernels are compiled, once, as soon as one is that is not there yet."""
        from midrib.kernels.telling import tell_first_compilation

        sentence = "midrib compiles kernels on first use, the main ones take about 20 seconds …"
        tell_first_compilation(partial(self.say, sentence))

    def track(
        self,
        batches: Iterable[Work],
        count: int | None,
        size: Callable[[Work], int] = size_of,  # type: ignore[assignment]
        doing: str = "collapsing",
    ) -> Iterator[Work]:
        """Show a progress bar while batches are worked on, if there is a terminal."""
        with self.progress(count, doing=doing) as said:
            for batch in batches:
                yield batch
                said(size(batch))

    @contextmanager
    def progress(
        self, count: int | None, done: int = 0, doing: str = "collapsing"
    ) -> Iterator[Callable[[int], None]]:
        """Show a progress bar, if there is a terminal; what it gives takes numbers of features."""
        bar = Progress(
            TextColumn(doing),
            BarColumn(),
            MofNCompleteColumn(),
            Rate(),
            TimeRemainingColumn(compact=True),
            console=self.console,
            transient=True,
            disable=self.console.quiet or not self.console.is_terminal,
        )
        with bar:
            task = bar.add_task("", total=count, completed=done)
            yield lambda features: bar.advance(task, features)

    @property
    def elapsed(self) -> float:
        """Seconds since the kernels were ready."""
        return time.perf_counter() - self.started
