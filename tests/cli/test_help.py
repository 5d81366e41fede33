"""Help pages as they are printed, and how soon.

After a change on purpose: ``MIDRIB_REGOLD=1 pytest tests/cli/test_help.py``, and look at the diff.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import midrib

NAMES = (
    "check",
    "collapse",
    "compare",
    "hatch",
    "label",
    "methods",
    "network",
    "partial",
    "points",
    "profile",
    "skeleton",
    "standards",
    "tower",
)
PAGES: dict[str, list[str]] = {"midrib": []} | {name: [name] for name in NAMES}
HEAVY = ("numpy", "shapely", "numba", "pyogrio", "pyarrow", "matplotlib")


def run(*arguments: str) -> str:
    """Output of a command in a terminal of 90 columns without colours."""
    environment = os.environ | {"TERMINAL_WIDTH": "90", "COLUMNS": "90", "NO_COLOR": "1"}
    environment |= {"PYTHONIOENCODING": "utf-8", "_TYPER_FORCE_DISABLE_TERMINAL": "1"}
    done = subprocess.run(
        [sys.executable, *arguments],
        env=environment,
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    return "\n".join(line.rstrip() for line in done.stdout.splitlines()) + "\n"


@pytest.mark.parametrize("page", PAGES)
def test_help_is_as_it_was(page: str) -> None:
    snapshot = Path(__file__).parent / "help" / f"{page}.txt"
    text = run("-m", "midrib", *PAGES[page], "--help")
    if os.environ.get("MIDRIB_REGOLD"):
        snapshot.parent.mkdir(exist_ok=True)
        snapshot.write_text(text, encoding="utf-8")
    assert text == snapshot.read_text(encoding="utf-8")


def test_version_is_the_packages() -> None:
    assert run("-m", "midrib", "--version") == f"midrib {midrib.__version__}\n"


def test_help_waits_for_no_heavy_import() -> None:
    program = "import sys; import midrib.cli.app; import midrib.__main__; print(*sys.modules)"
    assert not set(HEAVY) & set(run("-c", program).split())
