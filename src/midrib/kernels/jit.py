"""How kernels are compiled: one decorator, one cache folder that can always be written.

Numba refuses to import a cached function when neither the package folder nor its own default
folder is writable, and it does not notice that a function called from another file has changed.
Both are settled here: the folder lies where NUMBA_CACHE_DIR says, in the user's cache, or in the
temporary folder where that is read-only, and its name carries a digest of the kernels' sources.
Numba asks for the folder when a function is decorated; other people's functions keep theirs.
"""

import hashlib
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import numba as nb

__all__ = ["cache_folder", "njit"]


def cache_folder() -> Path:
    """Return the folder that holds compiled kernels, made if it is missing."""
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.read_bytes())
    name = f"kernels-{digest.hexdigest()[:16]}"
    named = [os.environ.get(name) for name in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME")]
    roots = [Path(root) for root in named if root]
    roots += [Path("~/.cache").expanduser(), Path(tempfile.gettempdir())]
    for root in roots:
        folder = root / "midrib" / name
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(folder, os.W_OK):
            return folder
    return Path(tempfile.mkdtemp(prefix="midrib-"))


CACHE_FOLDER = str(cache_folder())
WITHIN = {"cache": False, "nogil": False, "no_cpython_wrapper": True}
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
        try:
            dispatcher: Any = nb.njit(kernel, **options)
        finally:
            config.CACHE_DIR = usual
        # To kernels an entry is one of them: they have no use for its door to Python.
        inner = nb.njit(kernel, **(options | WITHIN)) if entry else dispatcher
        dispatcher.get_call_template = of_plain_types(inner.get_call_template)
        dispatcher.get_overload = inner.get_overload
        return dispatcher

    return compiled
