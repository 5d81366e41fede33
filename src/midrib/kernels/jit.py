"""How kernels are compiled: one decorator, one cache folder that can always be written.

Numba refuses to import a cached function when neither the package folder nor its own default
folder is writable, and it does not notice that a function called from another file has changed.
``keeping`` settles both. Numba asks for the folder when a function is decorated; other people's
functions keep theirs.

How kernels become code is told in ``compiling`` and ``parts``, which use internals of Numba; with
a version whose internals are not known, they are compiled as everybody's functions are.
"""

from collections.abc import Callable
from functools import cache, partial
from typing import Any, NamedTuple, TypeVar

import numba as nb

from midrib.kernels.keeping import cache_folder, seal

__all__ = ["njit"]

CACHE_FOLDER = str(cache_folder())
IS_KNOWN = nb.__version__.startswith("0.68.")  # its internals
WITHIN = {"cache": False, "nogil": False, "no_cpython_wrapper": True}
if IS_KNOWN:
    from midrib.kernels import compiling
Kernel = TypeVar("Kernel", bound=Callable[..., Any])


def of_plain_types(template: Callable[..., Any]) -> Callable[..., Any]:
    """Have a kernel compiled once, and not once more for every constant that it is called with."""
    unliteral: Callable[[Any], Any] = nb.types.unliteral

    def plain(args: tuple[Any, ...], kws: dict[str, Any]) -> Any:
        return template(
            tuple(map(unliteral, args)), {name: unliteral(kind) for name, kind in kws.items()}
        )

    return plain


def njit(
    *, entry: bool = False, inline: bool = False, borrows: bool = False
) -> Callable[[Kernel], Kernel]:
    """Compile a kernel; an ``entry`` is called from Python and kept on disk.

    Kernels that only other kernels call are compiled into their callers, and LLVM inlines the
    small ones; Python must not call them, they crash it. An ``inline`` one is inlined whatever its
    size: handing over every field of every array takes as long as a short search. One that
    ``borrows`` makes no array and returns none, so it need not count references to those that it
    is given: with a dozen arrays in a record that took half the time of the whole construction.
    Arithmetic stays IEEE (no ``fastmath``): the bounds of the predicates need it.
    """
    options: dict[str, Any] = {
        "cache": entry,
        "nogil": entry,
        "forceinline": inline,
        "_nrt": not borrows,
        "error_model": "numpy",
        # A fifth of the time to compile went into doors to Python and C that nobody uses.
        "no_cpython_wrapper": not entry,
        "no_cfunc_wrapper": True,
    }

    def compiled(kernel: Kernel) -> Kernel:
        config: Any = nb.config
        if config.DISABLE_JIT:
            return kernel
        usual = config.CACHE_DIR
        config.CACHE_DIR = CACHE_FOLDER
        whole = {"pipeline_class": compiling.WholeCompiler} if entry and IS_KNOWN else {}
        try:
            dispatcher: Any = nb.njit(kernel, **(options | whole))
            if entry and IS_KNOWN:
                seal(dispatcher)
        finally:
            config.CACHE_DIR = usual
        within = of_kernel(kernel, options | WITHIN, dispatcher)
        dispatcher.get_call_template = lambda args, kws: within().call(args, kws)
        dispatcher.get_overload = lambda signature: within().code(signature)
        return dispatcher

    return compiled


class Within(NamedTuple):
    """A kernel as other functions call it."""

    call: Callable[..., Any]  # the type of a call
    code: Callable[..., Any]  # what there is for types of arguments


def of_kernel(kernel: Any, options: dict[str, Any], dispatcher: Any) -> Callable[[], Within]:
    """Return what gives a kernel to entries, as a part, and to anybody else, as it is.

    To others an entry is one of the kernels: they have no use for its door to Python.
    """

    @cache
    def of_others() -> Within:
        is_entry = dispatcher.targetoptions["nogil"]
        other = nb.njit(kernel, **options) if is_entry else dispatcher
        usual = type(dispatcher)
        call, code = usual.get_call_template, usual.get_overload
        return Within(of_plain_types(partial(call, other)), partial(code, other))

    @cache
    def of_entries() -> Within:
        part: Any = nb.njit(kernel, **options, pipeline_class=compiling.PartCompiler)
        part.compile = partial(compiling.compile_part, part)
        part._compiling_counter = dispatcher._compiling_counter  # tells calls of itself
        return Within(of_plain_types(part.get_call_template), part.get_overload)

    return lambda: of_entries() if IS_KNOWN and compiling.is_part_wanted() else of_others()
