"""Code of kernels as it is linked: what an entry calls becomes machine code once, with it.

Numba optimises every function with all those that it calls linked in, and again in each of its
callers, and makes machine code of it at every stage. Here what an entry calls is a part: it stays
as it was lowered. The entry links the parts of its whole tree, each once; then it is optimised.
"""

from collections.abc import Iterator
from typing import Any

from llvmlite import binding as llvm
from numba.core.codegen import JITCodeLibrary
from numba.core.environment import lookup_environment

__all__ = ["Part", "Whole"]

INTERNAL = llvm.Linkage.internal
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
        """Refuse to be linked into anything but an entry."""
        msg = f"{self.name} is a part of entries and cannot be linked into anything else"
        raise RuntimeError(msg)


class Whole(JITCodeLibrary):
    """Code of an entry with that of every function it may come to."""

    def finalize(self) -> None:
        """Link the tree of parts, each once, and make machine code of it."""
        own = {f.name for f in self._final_module.functions if not f.is_declaration}
        for called in called_by(self):
            self._reload_init.update(called._reload_init)
            is_part = isinstance(called, Part)
            module = called._final_module if is_part else called._get_module_for_linking()
            self._final_module.link_in(module, preserve=True)
        # Nobody else calls the others: what is called once is inlined, what is inlined is dropped.
        # Nor may others find them: names are numbered anew in each process, so that those of code
        # that comes from the disk can be names of something else by then.
        for function in self._final_module.functions:
            if not function.is_declaration and function.name not in own:
                function.linkage = INTERNAL
        self._linking_libraries = []
        super().finalize()
        codegen: Any = self._codegen
        for value in self._final_module.global_variables:
            if value.name.startswith(ENVIRONMENT):
                env = lookup_environment(value.name)
                if env is not None:
                    codegen.set_env(value.name, env)

    def _get_module_for_linking(self) -> Any:
        """Return what is kept for others on the disk: names, as they do not link entries."""
        self._ensure_finalized()
        functions = self._final_module.functions
        shown = [f for f in functions if not f.is_declaration and f.linkage != INTERNAL]
        return llvm.parse_assembly(
            "\n".join(f'define void @"{f.name}"() {{ unreachable }}' for f in shown)
        )

    def _optimize_final_module(self) -> None:
        """Optimise in one round; a cheap one before takes a fourth of the time in vain."""
        codegen: Any = self._codegen
        passes, builder = codegen._module_pass_manager()
        passes.run(self._final_module, builder)


def called_by(whole: Whole) -> Iterator[Any]:
    """Give everything that an entry may come to, each once."""
    waiting: list[Any] = [whole]
    seen = set()
    while waiting:
        for called in waiting.pop()._linking_libraries:
            if called not in seen:
                seen.add(called)
                waiting.append(called)
                yield called
