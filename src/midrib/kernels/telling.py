"""Telling users that kernels are compiled: no sooner than one is that is not kept yet."""

from collections.abc import Callable
from typing import Any

from numba.core import event

__all__ = ["tell_first_compilation"]


class First(event.Listener):
    """Tells once of a compilation, then of no other until it is asked to anew."""

    tell: Callable[[], None] | None = None

    def on_start(self, _: event.Event) -> None:
        """Tell that a kernel, which is not kept or not whole, is compiled now."""
        tell, self.tell = self.tell, None
        if tell is not None:
            tell()

    def on_end(self, _: event.Event) -> None:
        """Do nothing when it has been compiled."""


FIRST = First()
register: Any = event.register
register("numba:compile", FIRST)


def tell_first_compilation(tell: Callable[[], None]) -> None:
    """Call something as soon as a kernel is compiled that was not loaded; the last one asked."""
    FIRST.tell = tell
