"""What a kernel promises the compiler has to be true of it."""

import importlib
import pkgutil
import typing
from collections.abc import Iterator
from typing import Any

import numba
import pytest

import midrib.kernels

NUMBERS = (int, float, bool, type(None))


def borrowing() -> Iterator[tuple[str, Any]]:
    """All kernels that do not count references, by name."""
    for module in pkgutil.iter_modules(midrib.kernels.__path__):
        for name, kernel in vars(importlib.import_module(f"midrib.kernels.{module.name}")).items():
            is_kernel = isinstance(kernel, numba.core.dispatcher.Dispatcher)
            if is_kernel and not kernel.targetoptions.get("_nrt", True):
                yield f"{module.name}.{name}", kernel


def is_number(kind: Any) -> bool:
    """Whether a type is a number or a record of numbers."""
    if isinstance(kind, type) and issubclass(kind, tuple):
        return all(is_number(field) for field in typing.get_type_hints(kind).values())
    if typing.get_origin(kind) is tuple:
        return all(is_number(field) for field in typing.get_args(kind))
    return kind in NUMBERS


@pytest.mark.parametrize(("name", "kernel"), list(borrowing()))
def test_kernels_that_borrow_return_numbers(name: str, kernel: Any) -> None:
    """The caller would let go of an array that nobody has counted for it."""
    returned = typing.get_type_hints(kernel.py_func)["return"]
    assert is_number(returned), f"{name} returns {returned}"
