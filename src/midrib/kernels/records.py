"""Arrays and records of arrays as kernels hand them to each other: as one value, uncut.

Numba takes them apart, so that Python can call any function: nine numbers for a table, a hundred
for a mesh, at each of fifteen hundred calls, and puts them together again in what is called. It
takes every member out to count the references in those that have any. That was half of the code
that LLVM had to look through.
"""

from typing import Any

from numba.core import types
from numba.core.datamodel.manager import DataModelManager
from numba.core.datamodel.models import ArrayModel, TupleModel, UniTupleModel
from numba.core.datamodel.registry import default_manager

__all__ = ["UNCUT"]


class Uncut:
    """Ways of a value into a function, out of it and into memory, without taking it apart."""

    get_value_type: Any
    get_data_type: Any
    _dmm: Any
    _has_counts: bool | None = None

    def get_argument_type(self) -> Any:
        """Return the type of the value itself, of none for what is empty."""
        return () if self.is_empty() else self.get_value_type()

    def as_argument(self, builder: Any, value: Any) -> Any:  # noqa: ARG002
        """Return the value itself."""
        return () if self.is_empty() else value

    def from_argument(self, builder: Any, value: Any) -> Any:
        """Return the value itself."""
        known: Any = super()
        return known.from_argument(builder, value) if self.is_empty() else value

    def as_data(self, builder: Any, value: Any) -> Any:
        """Return what is kept in memory."""
        known: Any = super()
        return value if self.is_same_in_memory() else known.as_data(builder, value)

    def from_data(self, builder: Any, value: Any) -> Any:
        """Return the value of what is kept in memory."""
        known: Any = super()
        return value if self.is_same_in_memory() else known.from_data(builder, value)

    def as_return(self, builder: Any, value: Any) -> Any:
        """Return what is handed back."""
        known: Any = super()
        return value if self.is_same_in_memory() else known.as_return(builder, value)

    def from_return(self, builder: Any, value: Any) -> Any:
        """Return the value of what is handed back."""
        known: Any = super()
        return value if self.is_same_in_memory() else known.from_return(builder, value)

    def traverse(self, builder: Any) -> Any:
        """Return ways to the members that have references to count, and to no others."""
        known: Any = super()
        return [way for way in known.traverse(builder) if self._dmm[way[0]].contains_nrt_meminfo()]

    def contains_nrt_meminfo(self) -> bool:
        """Whether there are references to count in it, found out once."""
        if self._has_counts is None:
            known: Any = super()
            self._has_counts = bool(known.contains_nrt_meminfo())
        return self._has_counts

    def is_empty(self) -> bool:
        """Whether it has no members."""
        kind = self.get_value_type()
        return len(kind) == 0

    def is_same_in_memory(self) -> bool:
        """Whether it has no truth values, which are bits here and bytes there."""
        return bool(self.get_value_type() == self.get_data_type())


class UncutArray(Uncut, ArrayModel):
    """An array."""


class UncutRecord(Uncut, TupleModel):
    """A record of this and that."""


class UncutRow(Uncut, UniTupleModel):
    """A record of members of one type."""


UNCUT = DataModelManager().chain(default_manager)
UNCUT.register(types.Array, UncutArray)
UNCUT.register(types.Tuple, UncutRecord)
UNCUT.register(types.NamedTuple, UncutRecord)
UNCUT.register(types.UniTuple, UncutRow)
UNCUT.register(types.NamedUniTuple, UncutRow)
