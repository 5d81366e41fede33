"""Compiled kernels are kept where they can be, and what is damaged is compiled anew."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba as nb
import pytest

from midrib.kernels import jit
from midrib.kernels.keeping import cache_folder, own_folder
from midrib.kernels.telling import tell_first_compilation

CODE = """
from midrib.kernels.telling import tell_first_compilation
tell_first_compilation(lambda: print("compiles"))
from midrib.kernels.stations import default_count
print(default_count(10.0, 1.0, 4))
"""
COMPILER: Any = nb
compiled = pytest.mark.skipif(
    COMPILER.config.DISABLE_JIT or not jit.IS_KNOWN, reason="files are Numba's own"
)


def said(folder: Path) -> list[str]:
    """Compile or load a small kernel in a process of its own; what that says."""
    environment = os.environ | {"NUMBA_CACHE_DIR": str(folder)}
    found = subprocess.run(
        [sys.executable, "-c", CODE], env=environment, capture_output=True, text=True, check=True
    )
    return found.stdout.split()


def cut(content: bytes) -> bytes:
    """Keep half of a file, as a full disk does."""
    return content[: len(content) // 2]


def emptied(_: bytes) -> bytes:
    """Keep nothing of a file."""
    return b""


def changed(content: bytes) -> bytes:
    """Change some bytes near the end, where the code is."""
    at = 9 * len(content) // 10
    return content[:at] + bytes(255 - byte for byte in content[at : at + 64]) + content[at + 64 :]


@compiled
@pytest.mark.parametrize(
    ("suffix", "damaged"), [(".nbi", emptied), (".nbi", cut), (".nbc", cut), (".nbc", changed)]
)
def test_damaged_files_are_made_anew(
    suffix: str, damaged: Callable[[bytes], bytes], tmp_path: Path
) -> None:
    first = said(tmp_path)
    assert first[0] == "compiles"
    assert said(tmp_path) == first[1:]  # loaded
    [file] = tmp_path.rglob(f"*default_count*{suffix}")
    file.write_bytes(damaged(file.read_bytes()))
    assert said(tmp_path) == first


@pytest.fixture
def no_home(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """A user without a home or a place for caches; returns where temporary files go."""

    def unknown() -> Path:
        msg = "Could not determine home directory."
        raise RuntimeError(msg)

    for name in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(Path, "home", unknown)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path


def test_users_without_a_home_have_a_folder_that_stays(no_home: Path) -> None:
    cache_folder.cache_clear()
    try:
        folder = cache_folder()
    finally:
        cache_folder.cache_clear()
    assert folder.parent == own_folder()
    assert folder.parent.parent == no_home
    assert not folder.parent.stat().st_mode & 0o077


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="folders have no owners")
def test_folders_that_others_can_write_to_are_not_believed(no_home: Path) -> None:
    taken = no_home / f"midrib-{os.getuid()}"
    taken.mkdir()
    taken.chmod(0o777)
    assert own_folder() != taken
    taken.rmdir()
    taken.symlink_to(no_home, target_is_directory=True)
    assert own_folder() != taken


@compiled
def test_the_last_who_asked_is_told_of_one_compilation() -> None:
    told: list[str] = []
    tell_first_compilation(lambda: told.append("nobody"))
    tell_first_compilation(lambda: told.append("first"))
    for _ in range(2):
        COMPILER.njit(lambda x: x + 1)(1)
    assert told == ["first"]
