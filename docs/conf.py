"""How the documentation is built: ``make docs`` writes it to out/docs."""

import re
import sys
from pathlib import Path

import matplotlib as mpl

import midrib

DOCS = Path(__file__).parent
ROOT = DOCS.parent
MADE_BY_CALLERS = ("midrib.Strip",)
README = re.compile(r"^<!-- README: (.+) -->$", re.MULTILINE)
SCRIPT = re.compile(r"\]\((?:\.\./)+examples/gallery/(plot_\w+)\.py\)")

mpl.use("Agg")
sys.path.insert(0, str(ROOT / "examples" / "gallery"))  # shapes that its figures share

project = "midrib"
author = "The midrib developers"
project_copyright = author
version = release = midrib.__version__


def set_resolution(_settings: dict[str, object], _script: str) -> None:
    """Let figures be as wide as the column of text."""
    mpl.rcParams["savefig.dpi"] = 120


extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
]
templates_path = ["templates"]
exclude_patterns = ["static", "templates"]

myst_enable_extensions = ["attrs_inline"]
myst_heading_anchors = 3

autosummary_generate = True
autodoc_typehints = "none"  # docstrings have the types, with shapes and units
autodoc_member_order = "bysource"
napoleon_use_ivar = True
napoleon_use_param = False  # or every "length" in a type becomes a link to measures.length
napoleon_use_rtype = False

sphinx_gallery_conf = {
    "examples_dirs": str(ROOT / "examples" / "gallery"),
    "gallery_dirs": "gallery",
    "filename_pattern": r"plot_",
    "ignore_pattern": r"shapes\.py",
    "within_subsection_order": "FileNameSortKey",
    "abort_on_example_error": True,
    "min_reported_time": 1e9,  # times depend on the machine
    "write_computation_times": False,
    "show_memory": False,
    "show_signature": False,
    "reset_modules": ("matplotlib", set_resolution),
    "image_srcset": ["2x"],
    "download_all_examples": False,
    "notebook_extensions": set(),  # a notebook would lack shapes.py
}
suppress_warnings = ["config.cache"]  # a regular expression of the gallery's cannot be pickled

html_theme = "pydata_sphinx_theme"
html_title = "midrib"
html_static_path = ["static"]
html_css_files = ["midrib.css"]
html_logo = "static/midrib.svg"
html_favicon = "static/midrib.svg"
html_show_sourcelink = False
html_copy_source = False
html_sidebars: dict[str, list[str]] = {"index": [], "promises": []}
html_theme_options = {
    "logo": {"text": "midrib", "alt_text": "midrib"},
    "navbar_end": ["theme-switcher"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "navigation_with_keys": False,
    "show_toc_level": 2,
    "collapse_navigation": True,
    "header_links_before_dropdown": 6,
}


def section_of_readme(heading: str) -> str:
    """Text below a heading of the README; its links are turned to those of a page in docs/."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    _, found, rest = text.partition(f"\n## {heading}\n")
    if not found:
        msg = f"README.md has no section {heading!r}"
        raise ValueError(msg)
    return rest.partition("\n## ")[0].replace("](docs/", "](")


def fill_in(_app: object, _name: str, source: list[str]) -> None:
    """Put sections of the README in place of the comments that ask for them.

    Links to scripts of the gallery, which serve on a code host, become links to their pages.
    """
    text = README.sub(lambda found: section_of_readme(found[1]), source[0])
    source[0] = SCRIPT.sub(r"](/gallery/\1.rst)", text)


def without_constructor(
    _app: object,
    what: str,
    name: str,
    _object: object,
    _options: object,
    signature: str,
    result: str,
) -> tuple[str, str]:
    """Leave out the signatures of classes that only midrib makes."""
    is_result = what == "class" and name not in MADE_BY_CALLERS
    return ("", "") if is_result else (signature, result)


def setup(app: object) -> None:
    """Listen for pages that are read, and for signatures."""
    connect = app.connect  # type: ignore[attr-defined]
    connect("source-read", fill_in)
    connect("autodoc-process-signature", without_constructor)
