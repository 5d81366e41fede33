"""Telling users that kernels are compiled: no sooner than one is that is not kept yet."""

from collections.abc import Callable
from typing import Any

from numba.core import event

__all__ = ["tell_first_compilation"]


class First(event.Listener):
    """Tells of the first compilation of the process, and of no other."""

    def __init__(self, tell: Callable[[], None]) -> None:
        self.tell = tell
        self.is_told = False

    def on_start(self, _: event.Event) -> None:
        """Tell that a kernel, which is not kept or not whole, is compiled now."""
        if not self.is_told:
            self.is_told = True
            self.tell()

    def on_end(self, _: event.Event) -> None:
        """Do nothing when it has been compiled."""


def tell_first_compilation(tell: Callable[[], None]) -> None:
    """Call something as soon as a kernel is compiled that was not loaded."""
    register: Any = event.register
    register("numba:compile", First(tell))
