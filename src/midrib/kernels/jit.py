"""How kernels are compiled: one decorator, one cache folder that can always be written.

Numba refuses to import a cached function when neither the package folder nor its own default
folder is writable, and it does not notice that a function called from another file has changed.
Both are settled here, before Numba is imported: the folder lies in the user's cache, or in the
temporary folder where that is read-only, and its name carries a digest of the kernels' sources.
"""

import hashlib
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

__all__ = ["cache_folder", "njit"]


def cache_folder() -> Path:
    """Return the folder that holds compiled kernels, made if it is missing."""
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.read_bytes())
    name = f"kernels-{digest.hexdigest()[:16]}"
    home = os.environ.get("XDG_CACHE_HOME")
    roots = [Path(home) if home else Path("~/.cache").expanduser(), Path(tempfile.gettempdir())]
    for root in roots:
        folder = root / "midrib" / name
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(folder, os.W_OK):
            return folder
    return Path(tempfile.mkdtemp(prefix="midrib-"))


os.environ.setdefault("NUMBA_CACHE_DIR", str(cache_folder()))

import numba as nb  # noqa: E402  # the folder above must be known to Numba when it is imported

Kernel = TypeVar("Kernel", bound=Callable[..., Any])


def njit(*, entry: bool = False) -> Callable[[Kernel], Kernel]:
    """Compile a kernel; an ``entry`` is called from Python and kept on disk.

    Kernels that only other kernels call are compiled into their callers, and LLVM inlines the
    small ones. Arithmetic stays IEEE (no ``fastmath``): the bounds of the predicates need it.
    """
    compiled: Any = nb.njit(cache=entry, nogil=entry, error_model="numpy")
    return compiled
