"""Compilation as a whole: the kernels that an entry calls become machine code once, with it.

Numba optimises every kernel with all those that it calls linked in, and again in each of its
callers, and makes machine code at every stage. Here what only others call stays as it was lowered,
a part; the entry links the parts of its whole tree, each once, and is optimised then.
"""

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from llvmlite import binding as llvm
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, Flags
from numba.core.environment import lookup_environment

__all__ = ["PartCompiler", "WholeCompiler"]

ENVIRONMENT = "_ZN08NumbaEnv"  # how names of environments begin


class NotLoaded:
    """The code generator as a part sees it, which has no machine code to set anything in."""

    def __init__(self, codegen: Any) -> None:
        self._codegen = codegen

    def __getattr__(self, name: str) -> Any:
        """Return what the code generator has."""
        return getattr(self._codegen, name)

    def set_env(self, name: str, env: Any) -> None:
        """Leave it to the entry that links the part."""


class Part(JITCodeLibrary):
    """Code of one function as it was lowered: neither optimised, nor linked, nor loaded."""

    _linked: Any = None

    @property
    def codegen(self) -> Any:
        """The code generator but for machine code."""
        return NotLoaded(self._codegen)

    def add_llvm_module(self, module: Any) -> None:
        """Take code as it is."""
        self._final_module.link_in(module)

    def finalize(self) -> None:
        """Leave everything to the entry."""
        self._raise_if_finalized()
        # Parts may bring the same helper of Numba's along, of which one will do.
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage == llvm.Linkage.external:
                function.linkage = llvm.Linkage.linkonce_odr
        self._finalize_dynamic_globals()
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:  # noqa: ARG002
        """Return that there is none."""
        self._ensure_finalized()
        return 0

    def _get_module_for_linking(self) -> Any:
        """Return the part with all that it calls, for other people's functions."""
        self._ensure_finalized()
        if self._linked is None:
            self._linked = self._final_module.clone()
            link_parts(self._linked, self)
        return self._linked


def link_parts(module: Any, library: Any) -> None:
    """Link what a library calls into a module, each once."""
    waiting, seen = [library], set()
    while waiting:
        for called in waiting.pop()._linking_libraries:
            if called in seen:
                continue
            seen.add(called)
            library._reload_init.update(called._reload_init)
            if isinstance(called, Part):
                module.link_in(called._final_module, preserve=True)
                waiting.append(called)
            else:
                module.link_in(called._get_module_for_linking(), preserve=True)


class Whole(JITCodeLibrary):
    """Code of an entry with that of every function it may come to."""

    def finalize(self) -> None:
        """Link the tree of parts, each once, and make machine code of it."""
        own = {f.name for f in self._final_module.functions if not f.is_declaration}
        link_parts(self._final_module, self)
        # Nobody else calls the others: what is called once is inlined, what is inlined is dropped.
        # Nor may others find them: names are numbered anew in each process, so that those of code
        # that comes from the disk can be names of something else by then.
        for function in self._final_module.functions:
            if not function.is_declaration and function.name not in own:
                function.linkage = llvm.Linkage.internal
        self._linking_libraries = []
        super().finalize()
        codegen: Any = self._codegen
        for value in self._final_module.global_variables:
            if value.name.startswith(ENVIRONMENT):
                env = lookup_environment(value.name)
                if env is not None:
                    codegen.set_env(value.name, env)


class Settled(Flags):
    """Flags that are compared a hundred thousand times: by what is set, with one hash."""

    _hash: int | None = None

    def __hash__(self) -> int:
        """Return the hash of flags with the same values."""
        if self._hash is None:
            self._hash = super().__hash__()
        return self._hash

    def __eq__(self, other: object) -> bool:
        """Whether the same values are set; or whether all are the same."""
        if isinstance(other, Settled) and self._values == other._values:
            return True
        return bool(super().__eq__(other))


class PartCompiler(Compiler):
    """Compiler of kernels that only others call."""

    def __init__(
        self, typing: Any, target: Any, library: Any, args: Any, back: Any, flags: Any, names: Any
    ) -> None:
        super().__init__(typing, target, library, args, back, Settled(flags), names)

    def compile_extra(self, func: Any) -> Any:
        """Compile a function into a part."""
        self.state.library = Part(self.state.targetctx.codegen(), func.__qualname__)
        return super().compile_extra(func)


class WholeCompiler(Compiler):
    """Compiler of kernels that Python calls."""

    def compile_extra(self, func: Any) -> Any:
        """Compile a function with all parts that it may come to."""
        codegen = self.state.targetctx.codegen()
        self.state.flags = Settled(self.state.flags)
        self.state.library = Whole(codegen, func.__qualname__)
        self.state.library.enable_object_caching()
        with parts_only(codegen):
            return super().compile_extra(func)


@contextmanager
def parts_only(codegen: Any) -> Iterator[None]:
    """Make parts of Numba's own functions too; leave the garbage, which is none, uncollected."""
    usual, collects = codegen._library_class, gc.isenabled()
    codegen._library_class = Part
    gc.disable()
    try:
        yield
    finally:
        codegen._library_class = usual
        if collects:
            gc.enable()
