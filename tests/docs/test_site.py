"""The documentation as text: every page is reached, every name is there, every link leads on."""

import re
import runpy
from pathlib import Path
from typing import Any

import pytest

import midrib
from midrib import errors, measures

pytest.importorskip("matplotlib")  # conf.py sets it up

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
GENERATED = ("api", "gallery")
PAGES = sorted(
    path.relative_to(DOCS).with_suffix("").as_posix()
    for ending in ("md", "rst")
    for path in DOCS.rglob(f"*.{ending}")
    if path.relative_to(DOCS).parts[0] not in {*GENERATED, "templates"}
)
DIRECTIVE = re.compile(r"^\.\. (\w+)::\n((?:\n|[ ]+.*\n)*)", re.MULTILINE)
MODULE = re.compile(r"^\.\. module:: (\S+)$", re.MULTILINE)
ENTRY = re.compile(r"^\s+(?:.*<)?([\w/]+)>?$", re.MULTILINE)
LINK = re.compile(r"\]\(([^)#]+)(?:#[^)]*)?\)")


@pytest.fixture(scope="module")
def settings() -> dict[str, Any]:
    """Names that docs/conf.py defines."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(DOCS))  # undoes what conf.py adds
        return runpy.run_path(str(DOCS / "conf.py"))


def entries(text: str, directive: str) -> list[str]:
    """Entries of every directive of a kind."""
    bodies = [body for name, body in DIRECTIVE.findall(text) if name == directive]
    return [entry for body in bodies for entry in ENTRY.findall(body)]


def test_every_page_is_in_one_table_of_contents() -> None:
    listed = [
        entry
        for path in DOCS.glob("*.rst")
        for entry in entries(path.read_text("utf-8"), "toctree")
    ]
    assert len(listed) == len(set(listed))
    assert set(listed) - {"gallery/index"} == set(PAGES) - {"index"}


@pytest.mark.parametrize("module", [midrib, measures, errors])
def test_every_public_name_is_in_the_api_pages(module: Any) -> None:
    chunks = MODULE.split((DOCS / "api.rst").read_text("utf-8"))
    of_module = dict(zip(chunks[1::2], chunks[2::2], strict=True))
    listed = entries(of_module[module.__name__], "autosummary")
    assert len(listed) == len(set(listed))
    assert set(listed) == set(module.__all__) - {"measures"}  # a section of its own


@pytest.mark.parametrize(
    "path", [*DOCS.rglob("*.md"), *ROOT.glob("*.md")], ids=lambda path: path.name
)
def test_every_link_of_a_page_leads_to_a_file(path: Path) -> None:
    for target in LINK.findall(path.read_text("utf-8")):
        if not target.startswith(("http://", "https://")):
            assert (path.parent / target).exists(), target


def test_every_picture_is_shown() -> None:
    shown = "".join(path.read_text("utf-8") for path in DOCS.rglob("*.md"))
    for picture in (DOCS / "pictures").iterdir():
        assert f"pictures/{picture.name})" in shown, picture.name


def test_promises_have_one_source(settings: dict[str, Any]) -> None:
    source = [(DOCS / "promises.md").read_text("utf-8")]
    assert "island" not in source[0]
    settings["fill_in"](None, "promises", source)
    readme = (ROOT / "README.md").read_text("utf-8")
    promises = readme.split("## What midrib does not promise\n")[1].split("\n## ")[0]
    assert promises.replace("](docs/", "](") in source[0]
    assert "](holes.md)" in source[0]
    assert "<!--" not in source[0]


def test_a_section_that_is_gone_is_named(settings: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="no section 'What it promises'"):
        settings["section_of_readme"]("What it promises")


def test_links_to_scripts_become_links_to_their_pages(settings: dict[str, Any]) -> None:
    source = ["see [5](../../examples/gallery/plot_05_ends.py) and [x](../areas.gpkg)"]
    settings["fill_in"](None, "theory/ends", source)
    assert source == ["see [5](/gallery/plot_05_ends.rst) and [x](../areas.gpkg)"]


@pytest.mark.parametrize("name", ["constraints-bench.txt", "constraints-docs.txt"])
def test_locks_have_the_versions_of_the_first_one_hashes_and_no_address(name: str) -> None:
    pinned, more = (
        set(re.findall(r"^[\w.\[\],-]+==\S+", (ROOT / lock).read_text("utf-8"), re.MULTILINE))
        for lock in ("constraints.txt", name)
    )
    assert pinned < more
    text = (ROOT / name).read_text("utf-8")
    for block in re.split(r"\n(?=\S)", text.strip()):
        assert "--hash=sha256:" in block, block.splitlines()[0]
    assert "://" not in text
    assert "--index-url" not in text
