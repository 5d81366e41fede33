"""Where compiled kernels are kept, and files of them that are not believed when damaged.

Numba reads what it kept as it is: a file that a full disk cut short, or a byte that has changed,
ends every later run, with SIGILL at worst. Here every file begins with a digest of what follows;
one that does not fit is no file, and the kernel is compiled anew.
"""

import atexit
import hashlib
import os
import pickle
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import numba as nb
from numba.core import runtime
from numba.core.caching import FunctionCache, IndexDataCacheFile

__all__ = ["Sealed", "cache_folder", "seal"]

SEAL = hashlib.sha256().digest_size
WRITABLE_BY_OTHERS = stat.S_IWGRP | stat.S_IWOTH


class Sealed(IndexDataCacheFile):
    """Index and compiled code of one kernel, each behind its digest."""

    def _dump(self, obj: Any) -> bytes:
        """Return what is written of an object."""
        usual: Any = super()
        content: bytes = usual._dump(obj)
        return hashlib.sha256(content).digest() + content

    def _load_data(self, name: str) -> Any:
        """Read an object.

        Raises
        ------
        OSError
            If there is no such file, or it is not as it was written: Numba compiles anew then.
        """
        content = Path(self._cache_path, name).read_bytes()
        if hashlib.sha256(content[SEAL:]).digest() != content[:SEAL]:
            msg = f"{name} is damaged"
            raise OSError(msg)
        return pickle.loads(content[SEAL:])

    def _save_index(self, overloads: dict[Any, str]) -> None:
        """Write which file has the code for which types of arguments."""
        save: Any = self._save_data
        save(self._index_name, (self._source_stamp, overloads))

    def _load_index(self) -> dict[Any, str]:
        """Read it; it is empty if there is none for this source."""
        try:
            stamp, overloads = self._load_data(self._index_name)
        except OSError:
            return {}
        found: dict[Any, str] = overloads if stamp == self._source_stamp else {}
        return found


class Kept(FunctionCache):
    """What is kept of one kernel, in sealed files."""

    def __init__(self, kernel: Any) -> None:
        usual: Any = super()
        sealed: Any = Sealed
        usual.__init__(kernel)
        impl: Any = self._impl
        stamp = impl.locator.get_source_stamp()
        self._cache_file: Any = sealed(self._cache_path, impl.filename_base, stamp)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Load code: without all that Numba knows of functions, which takes a tenth of a start."""
        numba_runtime: Any = runtime
        numba_runtime.rtsys.initialize(target_context)
        load: Any = self._load_overload
        return load(sig, target_context)


def seal(dispatcher: Any) -> None:
    """Have a kernel kept in sealed files."""
    dispatcher._cache = Kept(dispatcher.py_func)


@cache
def cache_folder() -> Path:
    """Return the folder that holds compiled kernels, made if it is missing.

    It lies where NUMBA_CACHE_DIR says, in the user's cache, or in a folder of the user's own among
    temporary ones. Its name carries a digest of the kernels' sources and of Numba's version.
    """
    digest = hashlib.sha256(nb.__version__.encode())
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.read_bytes())
    name = f"kernels-{digest.hexdigest()[:16]}"
    for root in roots():
        folder = root / "midrib" / name
        with suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            if os.access(folder, os.W_OK):
                return folder
    folder = own_folder() / name
    folder.mkdir(exist_ok=True)
    return folder


def roots() -> Iterator[Path]:
    """Give the folders that caches may be in."""
    for variable in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME"):
        if os.environ.get(variable):
            yield Path(os.environ[variable])
    with suppress(RuntimeError):  # there are users without a home
        yield Path.home() / ".cache"


def own_folder() -> Path:
    """Return a temporary folder that nobody else can write to: code is loaded from it.

    The user's own stays for the next process; where somebody else has taken its name, another one
    goes with this process.
    """
    if hasattr(os, "getuid"):
        folder = Path(tempfile.gettempdir()) / f"midrib-{os.getuid()}"
        with suppress(OSError):
            folder.mkdir(mode=0o700, exist_ok=True)
            found = folder.lstat()
            is_own = stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid()
            if is_own and not found.st_mode & WRITABLE_BY_OTHERS and os.access(folder, os.W_OK):
                return folder
    folder = Path(tempfile.mkdtemp(prefix="midrib-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder
