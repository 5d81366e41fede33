"""Compilers of kernels: of an entry, and of the parts that it may come to.

Parts are of no use to others. While an entry is compiled all flags are ``Settled``, which equal no
others: Numba, which keeps its functions by flags, makes those that the entry uses anew, and never
hands them to code that is compiled otherwise.
"""

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from numba.core import compiler
from numba.core import typed_passes as typed
from numba.core import untyped_passes as untyped
from numba.core.compiler_machinery import PassManager
from numba.core.postproc import PostProcessor, VariableLifetime
from numba.core.registry import cpu_target
from numba.core.sigutils import normalize_signature
from numba.core.targetconfig import ConfigStack
from numba.core.transforms import canonicalize_cfg
from numba.core.types.functions import BaseFunction

from midrib.kernels.lowering import KernelLowering
from midrib.kernels.parts import Part, Whole
from midrib.kernels.records import UNCUT

__all__ = ["PartCompiler", "WholeCompiler", "compile_part", "is_part_wanted"]

# Those of Numba's that kernels need: there are no closures, and no branches on types.
PASSES = (
    (untyped.TranslateByteCode, "bytecode"),
    (untyped.FixupArgs, "arguments"),
    (untyped.IRProcessing, "lifetimes of variables"),
    (untyped.GenericRewrites, "constant indices"),
    (untyped.ReconstructSSA, "a name for each value"),
    (typed.NopythonTypeInference, "types"),
    (typed.PreLowerStripPhis, "values that meet"),
    (typed.NopythonRewrites, "expressions of arrays"),
    (typed.IRLegalization, "lifetimes again"),
    (typed.AnnotateTypes, "annotations"),
    (KernelLowering, "code for LLVM"),
    (typed.NoPythonBackend, "result"),
)


class Settled(compiler.Flags):
    """Flags that are compared a hundred thousand times, and equal none but such."""

    _key: Any = None

    def __init__(self, given: Any = None) -> None:
        super().__init__(given)
        # Functions of Numba's own have doors to C that nobody uses.
        setattr(self, "no_cfunc_wrapper", True)  # noqa: B010

    def __setattr__(self, name: str, value: Any) -> None:
        """Set a flag, and forget the key."""
        if name != "_key":
            self._key = None
        super().__setattr__(name, value)

    @property
    def key(self) -> tuple[Any, ...]:
        """Values of all flags."""
        if self._key is None:
            self._key = tuple(self.values().values())
        return tuple(self._key)

    def __hash__(self) -> int:
        """Return what those who equal each other have in common."""
        return hash(self.nrt)

    def __eq__(self, other: object) -> bool:
        """Whether the other ones are settled too, with the same values."""
        return self is other or (isinstance(other, Settled) and self.key == other.key)


class PartCompiler(compiler.CompilerBase):
    """Compiler of what only an entry calls."""

    def __init__(
        self, typing: Any, target: Any, library: Any, args: Any, back: Any, flags: Any, names: Any
    ) -> None:
        super().__init__(typing, target, library, args, back, Settled(flags), names)

    def define_pipelines(self) -> list[Any]:
        """Return the passes."""
        passes = PassManager("kernel")
        for each in PASSES:
            passes.add_pass(*each)
        passes.finalize()
        return [passes]


class WholeCompiler(PartCompiler):
    """Compiler of kernels that Python calls."""

    def compile_extra(self, func: Any) -> Any:
        """Compile a function with all parts that it may come to."""
        target = self.state.targetctx
        target.data_model_manager = UNCUT
        self.state.library = Whole(target.codegen(), func.__qualname__)
        self.state.library.enable_object_caching()
        with parts_only(target):
            return super().compile_extra(func)


def compile_part(part: Any, signature: Any) -> Any:
    """Compile a kernel for types of arguments; nobody asks how long each of its callers takes."""
    args, back = normalize_signature(signature)
    if args not in part.overloads:
        with part._compiling_counter:
            part.add_overload(part._compiler.compile(args, back))
    return part.overloads[args].entry_point


def is_part_wanted() -> bool:
    """Whether an entry is being compiled."""
    return isinstance(ConfigStack.top_or_none(), Settled)


@contextmanager
def parts_only(target: Any) -> Iterator[None]:
    """Make parts of Numba's own functions too; leave the garbage, which is none, uncollected.

    Numba's lock is held meanwhile, so that nobody else compiles.
    """
    kept, collects = target.cached_internal_func, gc.isenabled()
    others, calls = dict(kept), BaseFunction.get_call_type
    changes: tuple[tuple[Any, str, Any], ...] = (
        (target.codegen(), "_library_class", Part),
        (compiler, "Flags", Settled),
        (cpu_target.target_context, "data_model_manager", UNCUT),
        (BaseFunction, "get_call_type", remembering(calls)),
        (PostProcessor, "run", sparing(PostProcessor.run)),
    )
    usual = [getattr(owner, name) for owner, name, _ in changes]
    kept.clear()
    gc.disable()
    try:
        for owner, name, value in changes:
            setattr(owner, name, value)
        yield
    finally:
        for (owner, name, _), value in zip(changes, usual, strict=True):
            setattr(owner, name, value)
        kept.clear()
        kept.update(others)
        if collects:
            gc.enable()


def remembering(find: Callable[..., Any]) -> Callable[..., Any]:
    """Remember the types of calls of Numba's functions, looked up several times for each call."""
    known: dict[Any, Any] = {}

    def get_call_type(called: Any, context: Any, args: Any, kws: Any) -> Any:
        key = called, tuple(args), tuple(kws.items()), ConfigStack.top_or_none().nrt
        if key not in known:
            signature = find(called, context, args, kws)
            known[key] = signature, called._impl_keys[signature.args]
        signature, code = known[key]
        called._impl_keys[signature.args] = code
        return signature

    return get_call_type


def sparing(run: Callable[..., Any]) -> Callable[..., Any]:
    """Find out which variables live how long only where that is used, not after each pass."""

    def run_sparingly(self: Any, emit_dels: bool = False, extend_lifetimes: bool = False) -> None:
        code = self.func_ir
        if emit_dels or code.is_generator:
            run(self, emit_dels, extend_lifetimes)
            return
        code.blocks = canonicalize_cfg(code.blocks)
        code.variable_lifetime = VariableLifetime(code.blocks)  # found out when it is asked for
        code.generator_info = None

    return run_sparingly
