"""Arrays and records of arrays as kernels hand them to each other: as one value, uncut.

Numba takes them apart, so that Python can call any function: nine numbers for a table, a hundred
for a mesh, at each of fifteen hundred calls, and puts them together again in what is called. It
takes every member out to count the references in those that have any. That was half of the code
that LLVM had to look through.

The value of an array goes without what its type and shape say anyway. What is called finds that
again only if it asks for it; a record of both banks, handed over ten thousand times for a large
area, is half as large.
"""

from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.datamodel.manager import DataModelManager
from numba.core.datamodel.models import ArrayModel, TupleModel, UniTupleModel
from numba.core.datamodel.registry import default_manager
from numba.core.registry import cpu_target

__all__ = ["UNCUT"]

OWNER, PARENT, COUNT, ITEM_SIZE, DATA, SHAPE, STRIDES = range(7)  # members of an array
KEPT = (OWNER, DATA, SHAPE)  # those that its type does not tell


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
    """An array; of one whose items follow each other what is kept."""

    def get_argument_type(self) -> Any:
        """Return the type of what is handed over."""
        kind = self.get_value_type()
        kept = ir.LiteralStructType([kind.elements[k] for k in KEPT])
        return kept if self._fe_type.is_c_contig else kind

    def as_argument(self, builder: Any, value: Any) -> Any:
        """Return what is handed over."""
        if not self._fe_type.is_c_contig:
            return value
        kept = [builder.extract_value(value, k) for k in KEPT]
        return record(builder, self.get_argument_type(), kept)

    def from_argument(self, builder: Any, value: Any) -> Any:
        """Return the array."""
        if not self._fe_type.is_c_contig:
            return value
        kind, context = self.get_value_type(), cpu_target.target_context
        owner, data, shape = members_of(builder, value)
        size = context.get_abi_sizeof(context.get_data_type(self._fe_type.dtype))
        item_size = ir.Constant(kind.elements[ITEM_SIZE], size)
        count, strides = ir.Constant(kind.elements[COUNT], 1), list[Any]()
        for length in reversed(members_of(builder, shape)):
            strides.insert(0, builder.mul(count, item_size))
            count = builder.mul(count, length)
        steps = record(builder, kind.elements[STRIDES], strides)
        nobody = ir.Constant(kind.elements[PARENT], None)
        return record(builder, kind, [owner, nobody, count, item_size, data, shape, steps])


class UncutMembers(Uncut):
    """A record; of each member what is kept."""

    inner_models: Any

    def get_argument_type(self) -> Any:
        """Return the type of what is handed over."""
        if self.is_empty():
            return ()
        models = self.models()
        kinds = [m.get_argument_type() if is_cut_down(m) else m.get_value_type() for m in models]
        return ir.LiteralStructType(kinds)

    def as_argument(self, builder: Any, value: Any) -> Any:
        """Return what is handed over."""
        if self.is_empty():
            return ()
        members = members_of(builder, value)
        for i, model in enumerate(self.models()):
            if is_cut_down(model):
                members[i] = model.as_argument(builder, members[i])
        return record(builder, self.get_argument_type(), members)

    def from_argument(self, builder: Any, value: Any) -> Any:
        """Return the record."""
        if self.is_empty():
            return super().from_argument(builder, value)
        members = members_of(builder, value)
        for i, model in enumerate(self.models()):
            if is_cut_down(model):
                members[i] = model.from_argument(builder, members[i])
        return record(builder, self.get_value_type(), members)

    def models(self) -> list[Any]:
        """Return those of its members."""
        size = len(self.get_value_type())
        models = list(self.inner_models())
        return models if len(models) == size else models * size


class UncutRecord(UncutMembers, TupleModel):
    """A record of this and that."""


class UncutRow(UncutMembers, UniTupleModel):
    """A record of members of one type."""


def is_cut_down(model: Any) -> bool:
    """Whether a member is handed over in another form than it has; others go as they are."""
    return isinstance(model, Uncut) and not model.is_empty()


def members_of(builder: Any, value: Any) -> list[Any]:
    """Return the members of a value."""
    return [builder.extract_value(value, i) for i in range(len(value.type))]


def record(builder: Any, kind: Any, members: list[Any]) -> Any:
    """Return a value of members."""
    value = ir.Constant(kind, ir.Undefined)
    for i, member in enumerate(members):
        value = builder.insert_value(value, member, i)
    return value


UNCUT = DataModelManager().chain(default_manager)
UNCUT.register(types.Array, UncutArray)
UNCUT.register(types.Tuple, UncutRecord)
UNCUT.register(types.NamedTuple, UncutRecord)
UNCUT.register(types.UniTuple, UncutRow)
UNCUT.register(types.NamedUniTuple, UncutRow)
