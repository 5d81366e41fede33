"""Call a kernel that only other kernels call: it is compiled without a door for Python."""

from collections.abc import Callable
from typing import Any

import numba as nb

__all__ = ["callable_from_python"]


def callable_from_python(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """Return a kernel of its own that hands everything on."""

    @nb.njit(error_model="numpy")
    def call(*args: Any) -> Any:
        return kernel(*args)

    result: Callable[..., Any] = call
    return result
