"""Lowering of kernels to LLVM, without what LLVM would have to find superfluous.

Numba reads a variable before it writes it, and clears it when it goes, to count references, of
numbers too; counts those that the caller holds anyway once more; and puts an array into memory for
each element that is read. Half of the instructions of the main job were that.
"""

from typing import Any

from numba.core import cgutils, ir, types
from numba.core.compiler_machinery import register_pass
from numba.core.lowering import Lower
from numba.core.runtime.context import NRTContext
from numba.core.typed_passes import NativeLowering
from numba.np.arrayobj import fix_integer_index, load_item, store_item

__all__ = ["KernelLowering"]

DATA, SHAPE, STRIDES = 4, 5, 6  # members of an array


class QuietNRT(NRTContext):
    """Counts references, but for values that the caller holds."""

    is_quiet = False

    def _call_incref_decref(self, builder: Any, kind: Any, value: Any, name: str) -> None:
        """Count a reference up or down."""
        if not self.is_quiet:
            super()._call_incref_decref(builder, kind, value, name)


class LeanLower(Lower):
    """Lowers a kernel."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self.context.nrt = QuietNRT(self.context, self.context.enable_nrt)
        self.borrowed = borrowed_in(self.func_ir.blocks, self.fndesc.typemap)

    def is_counted(self, name: str) -> bool:
        """Whether references in a variable are to be counted."""
        model = self.context.data_model_manager[self.typeof(name)]
        return bool(
            self.context.enable_nrt and name not in self.borrowed and model.contains_nrt_meminfo()
        )

    def alloca_lltype(self, name: str, kind: Any, datamodel: Any = None) -> Any:  # noqa: ARG002
        """Make room for a variable; debuggers are not told how large it is, which takes long."""
        return cgutils.alloca_once(self.builder, kind, name=name)

    def lower_assign(self, kind: Any, inst: Any) -> Any:
        """Lower the right side of an assignment."""
        nrt = self.context.nrt
        nrt.is_quiet = inst.target.name in self.borrowed
        try:
            return super().lower_assign(kind, inst)
        finally:
            nrt.is_quiet = False

    def storevar(self, value: Any, name: str, argidx: Any = None) -> None:
        """Store a value; what was there before is of interest only if it holds references."""
        if self.is_counted(name):
            super().storevar(value, name, argidx)
            return
        self._alloca_var(name, self.typeof(name))
        if name in self._singly_assigned_vars:
            self._blk_local_varmap[name] = value
        else:
            self.builder.store(value, self.getvar(name))

    def delvar(self, name: str) -> None:
        """Let a variable go, which only those notice that hold references."""
        if self.is_counted(name):
            super().delvar(name)
        elif name not in self._blk_local_varmap:
            self._singly_assigned_vars.discard(name)
            self._alloca_var(name, self.typeof(name))

    def lower_getitem(self, kind: Any, expr: Any, value: Any, index: Any, signature: Any) -> Any:
        """Lower the reading of an element."""
        array = self.typeof(value.name)
        if not is_element(array, self.typeof(index.name)):
            return super().lower_getitem(kind, expr, value, index, signature)
        item = load_item(self.context, self.builder, array, self.place(value, index))
        return self.context.cast(self.builder, item, signature.return_type, kind)

    def lower_setitem(self, target: Any, index: Any, value: Any, signature: Any) -> Any:
        """Lower the writing of an element."""
        array, given = self.typeof(target.name), self.typeof(value.name)
        plain = isinstance(given, types.Number | types.Boolean)
        if not (plain and is_element(array, self.typeof(index.name))):
            return super().lower_setitem(target, index, value, signature)
        item = self.context.cast(self.builder, self.loadvar(value.name), given, signature.args[2])
        item = self.context.cast(self.builder, item, signature.args[2], array.dtype)
        return store_item(self.context, self.builder, array, item, self.place(target, index))

    def place(self, value: Any, index: Any) -> Any:
        """Return where an element is."""
        builder, context = self.builder, self.context
        array, kind = self.typeof(value.name), self.typeof(index.name)
        found, at = self.loadvar(value.name), self.loadvar(index.name)
        kinds, places = each_of(kind), [at]
        if isinstance(kind, types.BaseTuple):
            places = cgutils.unpack_tuple(builder, at, len(kinds))
        shape = [builder.extract_value(found, [SHAPE, axis]) for axis in range(array.ndim)]
        strides = []
        if array.layout != "C":
            strides = [builder.extract_value(found, [STRIDES, axis]) for axis in range(array.ndim)]
        places = [
            fix_integer_index(context, builder, *each)
            for each in zip(kinds, places, shape, strict=True)
        ]
        data = builder.extract_value(found, DATA)
        return cgutils.get_item_pointer2(
            context, builder, data, shape, strides, array.layout, places
        )


def each_of(index: Any) -> tuple[Any, ...]:
    """Return the types in the type of an index, one for each axis."""
    is_row: bool = isinstance(index, types.BaseTuple)
    return tuple(index.types) if is_row else (index,)


def is_element(array: Any, index: Any) -> bool:
    """Whether an index tells one element of an array of numbers, by one number for each axis."""
    if not isinstance(array, types.Array) or not isinstance(
        array.dtype, types.Number | types.Boolean
    ):
        return False
    kinds = each_of(index)
    return len(kinds) == array.ndim > 0 and all(isinstance(k, types.Integer) for k in kinds)


def borrowed_in(blocks: Any, kinds: Any) -> set[str]:
    """Return the variables that hold only what the caller holds: arguments and parts of them."""
    given: dict[str, list[Any]] = {}
    for block in blocks.values():
        for inst in block.find_insts(ir.Assign):
            given.setdefault(inst.target.name, []).append(inst.value)
    borrowed = {name for name, values in given.items() if all(map(may_be_borrowed, values))}
    while True:
        left = {
            name
            for name in borrowed
            if all(is_borrowed(value, borrowed, kinds, name) for value in given[name])
        }
        if left == borrowed:
            return borrowed
        borrowed = left


def may_be_borrowed(value: Any) -> bool:
    """Whether a value may come from an argument."""
    return isinstance(value, ir.Arg | ir.Var) or (
        isinstance(value, ir.Expr) and value.op in ("getattr", "static_getitem")
    )


def is_borrowed(value: Any, borrowed: set[str], kinds: Any, name: str) -> bool:
    """Whether a value comes from an argument as it is, if others do."""
    if isinstance(value, ir.Arg):
        return bool(kinds["arg." + value.name] == kinds[name])
    if isinstance(value, ir.Var):
        return value.name in borrowed and kinds[value.name] == kinds[name]
    return value.value.name in borrowed and isinstance(kinds[value.value.name], types.BaseTuple)


@register_pass(mutates_CFG=True, analysis_only=False)
class KernelLowering(NativeLowering):
    """Lowers kernels."""

    _name = "kernel_lowering"

    @property
    def lowering_class(self) -> Any:
        """What lowers them."""
        return LeanLower
