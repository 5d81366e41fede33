"""Kernels compiled as parts of entries do what Python does, and leave other code alone."""

import importlib
from typing import Any, NamedTuple

import numba as nb
import numpy as np
import pytest
from numpy.typing import NDArray

from midrib.kernels import jit
from midrib.kernels.jit import njit
from midrib.types import Bools, Floats, Ints

COMPILER: Any = nb
pytestmark = pytest.mark.skipif(
    COMPILER.config.DISABLE_JIT or not jit.IS_KNOWN, reason="nothing is compiled as parts"
)


Cube = NDArray[np.int32]


class Table(NamedTuple):
    """A record of unlike members, with a truth value and an empty row in it."""

    values: Floats  # (n, 2)
    rows: Ints  # (n,)
    is_kept: Bools  # (n,)
    is_open: bool
    nothing: tuple[()]
    scale: float


class Pair(NamedTuple):
    """A record of like members."""

    first: Floats
    second: Floats


@njit()
def sevens(n: int) -> Floats:
    """Return n sevens; np.full is a function of Numba's own that becomes a part."""
    return np.full(n, 7.0)


@njit(borrows=True)
def total(values: Floats, k: int) -> float:
    """Sum of values from k on, one by one: a part that calls itself in turn."""
    return 0.0 if k == values.size else float(values[k]) + total(values, k + 1)


@njit()
def table_of(n: int) -> Table:
    """Return a record."""
    values, rows = np.zeros((n, 2)), np.arange(n)
    for k in range(n):
        values[k, 0], values[k, -1] = k, 10.0 * k
    return Table(values, rows, rows % 2 == 0, n > 2, (), 0.5)


@njit()
def other_of(table: Table, pair: Pair, n: int) -> tuple[Table, Pair]:
    """Return records of some old and some new members; hand the old ones from name to name."""
    here = table
    rows = here.rows
    again = Table(here.values, rows, here.is_kept, not here.is_open, (), 2.0 * here.scale)
    first, second = pair.first, pair.second
    for _ in range(n):
        first, second = second, first
    return again, Pair(first, sevens(n))


@njit(entry=True)
def whole(n: int) -> Floats:
    """Make records, and numbers from them."""
    table, pair = table_of(n), Pair(sevens(n), np.zeros(n))
    for _ in range(3):
        table, pair = other_of(table, pair, n)
    return np.array([
        table.values.sum(), table.rows.sum(), table.is_kept.sum(), table.is_open, table.scale,
        pair.first.sum(), pair.second.sum(), total(pair.first, 0), table.values[-1, 1],
    ])  # fmt: skip


@njit(entry=True)
def elements(x: Floats, grid: Floats, flags: Bools, k: int, small: np.int8) -> Floats:
    """Read and write elements of arrays of any layout, from both ends, by any kind of index."""
    column = grid[:, 1]
    x[k], x[-1], column[-2], flags[small] = 1, x[0] + x[-2], grid[-1, -1], k > 0
    x[np.uint8(small)] += column[k] + flags[-1]
    return np.array([x[k], x[-1], x[small], column[0], grid[-2, 1], grid[k, small], flags[small]])


@njit(borrows=True)
def steps(block: Cube, column: Cube, across: Cube) -> tuple[float, int, int]:
    """Weigh every element by its place; bytes and items of the block: a part that is handed all."""
    total = 0.0
    for i in range(block.shape[0]):
        for j in range(block.shape[1]):
            for k in range(block.shape[2]):
                total += (100 * i + 10 * j + k) * block[i, j, k]
    for i in range(column.size):
        total += i * column[i]
    for i in range(across.shape[0]):
        for j in range(across.shape[1]):
            total += (10 * i + j) * across[i, j]
    return total, block.size * block.itemsize, block.strides[0]


@njit(entry=True)
def stepped(block: Cube) -> Floats:
    """Hand over a block, a column of it and a table that lies crosswise."""
    total, size, step = steps(block, block[1, :, 1], block[0].T)
    return np.array([total, size, step])


@njit(entry=True)
def other_entry(n: int) -> float:
    """Sum by the same parts and by an entry, which is one of them here."""
    return float(whole(n).sum()) + total(sevens(n), 1)


@COMPILER.njit  # type: ignore[untyped-decorator]
def somebody_elses(n: int) -> float:
    """Sum by functions of Numba's own that are parts already."""
    return float(np.full(n, 2.0).sum() + np.zeros(n).sum() + np.arange(n).sum())


def python_of(kernel: Any) -> Any:
    """Function as it was written."""
    return kernel.py_func


def library_of(kernel: Any) -> Any:
    """Code of the only overload."""
    (compiled,) = kernel.overloads.values()
    return compiled.library


def fresh(kernel: Any) -> Any:
    """Entry without the disk, where one that is there already would be loaded."""
    from midrib.kernels.compiling import WholeCompiler

    return COMPILER.njit(
        python_of(kernel), pipeline_class=WholeCompiler, error_model="numpy", no_cfunc_wrapper=True
    )


def test_arrays_come_through_with_their_steps() -> None:
    block = np.arange(24, dtype=np.int32).reshape(2, 3, 4) + 1
    expected = python_of(steps)(block, block[1, :, 1], block[0].T)
    np.testing.assert_array_equal(stepped(block), expected)
    assert stepped(block)[1:].tolist() == [96, 48]


@pytest.mark.parametrize("n", [1, 2, 5, 6])
def test_records_come_through_as_they_are(n: int) -> None:
    expected = [
        11.0 * n * (n - 1) / 2, n * (n - 1) / 2, (n + 1) // 2, not n > 2, 4.0,
        7.0 * n, 7.0 * n, 7.0 * n, 10.0 * (n - 1),
    ]  # fmt: skip
    np.testing.assert_array_equal(whole(n), expected)


@pytest.mark.parametrize("kernel", [elements, fresh(elements) if jit.IS_KNOWN else None])
@pytest.mark.parametrize("order", ["C", "F"])
def test_elements_are_those_of_numpy(kernel: Any, order: Any) -> None:
    def given() -> tuple[Any, ...]:
        grid = np.asarray(np.arange(12.0).reshape(4, 3), order=order)
        return np.arange(5.0), grid, np.array([False, True, False]), 2, np.int8(1)

    found, expected = given(), given()
    np.testing.assert_array_equal(kernel(*found), python_of(elements)(*expected))
    for array, other in zip(found[:3], expected[:3], strict=True):
        np.testing.assert_array_equal(array, other)


def test_references_are_counted_to_the_end() -> None:
    runtime: Any = importlib.import_module("numba.core.runtime")
    rtsys = runtime.rtsys
    runtime._nrt_python.memsys_enable_stats()
    whole(4)
    before = rtsys.get_allocation_stats()
    for n in (1, 4, 5):
        whole(n)
        other_entry(n)
    after = rtsys.get_allocation_stats()
    assert after.alloc > before.alloc
    assert after.alloc - before.alloc == after.free - before.free


def test_entries_call_parts_of_other_entries() -> None:
    assert other_entry(5) == whole(5).sum() + 28.0


def test_entries_show_others_nothing_but_themselves() -> None:
    """Code from the disk has names that are those of other functions in another process."""
    entry = fresh(other_entry)
    assert entry(4) == other_entry(4)
    functions = library_of(entry)._final_module.functions
    shown = [f.name for f in functions if not f.is_declaration and f.linkage.name != "internal"]
    assert shown
    assert all("other_entry" in name for name in shown)


def test_others_get_no_parts() -> None:
    from midrib.kernels.parts import Part, Whole

    @COMPILER.njit  # type: ignore[untyped-decorator]
    def theirs(n: int) -> float:
        return float(sevens(n).sum() + whole(n)[0])

    assert theirs(3) == 21.0 + whole(3)[0]
    assert somebody_elses(3) == 9.0
    libraries = [library_of(theirs), library_of(somebody_elses)]
    while libraries:
        library = libraries.pop()
        assert not isinstance(library, Part | Whole)
        libraries += library._linking_libraries


def test_numba_is_left_as_it_was() -> None:
    from numba.core import compiler
    from numba.core.registry import cpu_target
    from numba.core.types.functions import BaseFunction

    def state() -> tuple[Any, ...]:
        target = cpu_target.target_context
        makes = target.codegen()._library_class
        kept = list(target.cached_internal_func)
        return (
            makes, kept, compiler.Flags, target.data_model_manager, BaseFunction.get_call_type
        )  # fmt: skip

    before = state()
    assert fresh(whole)(2).size == 9
    assert state() == before

    @njit(entry=True)
    def wrong(n: int) -> Any:
        found: Any = sevens(n)
        return found.no_such_thing

    with pytest.raises(COMPILER.TypingError):
        wrong(2)
    assert state() == before
