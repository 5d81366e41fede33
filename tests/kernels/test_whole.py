"""Kernels compiled as a whole do what Python does, and leave other people's functions alone."""

from typing import Any

import numba as nb
import numpy as np
import pytest

from midrib.kernels.jit import njit
from midrib.kernels.whole import Part, Whole, WholeCompiler
from midrib.types import Floats

COMPILER: Any = nb
pytestmark = pytest.mark.skipif(COMPILER.config.DISABLE_JIT, reason="nothing is compiled")


@njit()
def sevens(n: int) -> Floats:
    """Return n sevens; np.full is a function of Numba's own that becomes a part."""
    return np.full(n, 7.0)


@njit(borrows=True)
def total(values: Floats, k: int) -> float:
    """Sum of values from k on, one by one: a part that calls itself in turn."""
    return 0.0 if k == values.size else values[k] + total(values, k + 1)


@njit()
def doubled(values: Floats) -> Floats:
    """Return the values twice; what np.concatenate may raise has a helper, as below."""
    return np.concatenate((values, values))


@njit()
def tripled(values: Floats) -> Floats:
    """Return the values three times."""
    return np.concatenate((values, values, values))


@njit(entry=True)
def with_helpers(n: int) -> float:
    """Sum of n sevens, five times."""
    return float(doubled(sevens(n)).sum() + tripled(sevens(n)).sum())


@njit(entry=True)
def entry(n: int) -> float:
    """Sum of n sevens and of as many zeros."""
    return float(total(sevens(n), 0) + np.zeros(n).sum())


@njit(entry=True)
def other_entry(n: int) -> float:
    """Sum by the same parts and by the entry above, which is one of them here."""
    return entry(n) + total(sevens(n), 1)


@COMPILER.njit  # type: ignore[untyped-decorator]
def somebody_elses(n: int) -> float:
    """Sum by functions of Numba's own that are parts already."""
    return float(np.full(n, 2.0).sum() + np.zeros(n).sum())


def python_of(kernel: Any) -> Any:
    """Function as it was written."""
    return kernel.py_func


def library_of(kernel: Any) -> Any:
    """Code of the only overload."""
    (compiled,) = kernel.overloads.values()
    return compiled.library


def test_an_entry_comes_to_what_its_parts_do() -> None:
    assert entry(5) == 35.0
    assert with_helpers(2) == 70.0
    assert other_entry(5) == 63.0
    assert somebody_elses(3) == 6.0
    assert entry(0) == 0.0


def test_parts_have_no_machine_code_and_entries_no_parts_left() -> None:
    # Compiled without the disk, where an entry that is there already would be loaded.
    fresh = COMPILER.njit(python_of(other_entry), pipeline_class=WholeCompiler)
    assert fresh(4) == 49.0
    whole = library_of(fresh)
    assert not isinstance(whole, Part)
    names = [f.name for f in whole._final_module.functions if f.is_declaration]
    assert not [name for name in names if "test_whole" in name]


def test_entries_show_others_nothing_but_themselves() -> None:
    """Code from the disk has names that are those of other functions in another process."""
    fresh = COMPILER.njit(python_of(other_entry), pipeline_class=WholeCompiler)
    assert fresh(4) == 49.0
    functions = library_of(fresh)._final_module.functions
    shown = [f.name for f in functions if not f.is_declaration and f.linkage.name != "internal"]
    assert shown
    assert all("other_entry" in name for name in shown)


def test_others_can_call_kernels() -> None:
    @COMPILER.njit  # type: ignore[untyped-decorator]
    def theirs(n: int) -> float:
        return float(sevens(n).sum())

    assert theirs(3) == 21.0
    assert not isinstance(library_of(theirs), Part | Whole)
