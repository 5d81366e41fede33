"""Standards: the presets that come with midrib, files of the user's, and what is wrong there."""

import re
import runpy
from pathlib import Path
from typing import Any

import pytest

import midrib
from midrib import Standard, standard, standards
from midrib.errors import ParameterError
from midrib.hatching.keys import CONFIDENCES, RULES
from midrib.hatching.standards import FOLDER, standard_for, standards_named

OWN = 'title = "Mine"\nsource = "me"\nconfidence = "read"\n'
WHOLE = OWN + 'kinds = ["slope"]\nsymbol = "line"\nstroke_width = 0.2\nspacing = 1.5\n'


def written(folder: Path, text: str, name: str = "mine") -> Path:
    """File of a standard."""
    path = folder / f"{name}.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_every_file_is_a_standard_that_is_listed() -> None:
    names = [known.name for known in standards()]
    assert names == sorted(path.stem for path in FOLDER.iterdir())
    assert len(names) == 17
    assert [standard(name) for name in names] == standards()
    assert len({*standards()}) == 17


@pytest.mark.parametrize("known", standards(), ids=lambda known: known.name)
def test_a_preset_says_where_it_is_from_and_how_sure_that_is(known: Standard) -> None:
    assert known.title
    assert known.source
    assert known.confidence in CONFIDENCES
    assert set(known.assumed) <= set(RULES)
    if known.confidence == "assumed":
        assert known.assumed
    if "not found" in known.source:
        assert known.confidence == "assumed"


@pytest.mark.parametrize("known", standards(), ids=lambda known: known.name)
def test_a_preset_is_readable_on_paper(known: Standard) -> None:
    for scale in (250, 500, 1000, 2000):
        there = known.at(scale)
        for apart in (there.spacing, there.min_spacing or None):
            assert apart is None or apart >= 2.0 * there.stroke_width
        assert there.at(scale) == there


@pytest.mark.parametrize(
    ("name", "values"),
    [
        (f"pl-2015-{kind}", {"factor": 0.5, "min_spacing": 0.7, "stroke_width": 0.18, "code": code})
        for kind, code in (
            ("slope-reinforced", "BUBZ03"),
            ("slope-unreinforced", "BUBZ02"),
            ("dyke", "BUBZ01"),
            ("cutting", "BUBZ01"),
        )
    ]
    + [
        (f"pl-2021-slope-{kind}", {"factor": 0.5, "min_spacing": 0.72, "outline_dash": dash})
        for kind, dash in (("reinforced", ()), ("unreinforced", (2.0, 1.0)))
    ]
    + [
        ("pl-2021-wall", {"spacing": 11.0, "pair": 1.0, "angle": 45.0}),
        ("pl-2021-stairs", {"spacing": 1.0}),
        ("gml-explorer-like", {"rule": "mean", "factor": 0.5, "pattern": "SL"}),
        (
            "de-general",
            {"factor": 0.5, "gentle_factor": 1.0, "gentle_run": 1.5, "wedge_below": 1.0},
        ),
        ("iof-104", {"stroke_width": 0.14, "short_ratio": 1.0, "spacing": 0.5, "outline": "top"}),
    ],
)
def test_a_preset_has_the_figures_of_its_source(name: str, values: dict[str, Any]) -> None:
    known = standard(name)
    assert {key: getattr(known, key) for key in values} == values


def test_figures_change_with_scale() -> None:
    dashes = {
        s: standard("pl-2015-slope-unreinforced").at(s).outline_dash for s in (500, 700, 1000)
    }
    assert dashes == {500: (2.5, 1.0), 700: (2.5, 1.0), 1000: (1.8, 0.7)}
    wall = standard("pl-2021-wall")
    assert (wall.at(1000).spacing, wall.at(1000).pair) == (8.25, 0.75)
    assert wall.at(2000) == wall.at(1000)
    assert wall.at(100) == wall.at(500)


def test_a_value_of_the_callers_holds_at_every_scale() -> None:
    mine = standard("pl-2021-wall", spacing=5.0)
    assert [mine.at(scale).spacing for scale in (500, 1000)] == [5.0, 5.0]
    assert mine.at(1000).pair == 0.75


def test_spacing_and_factor_replace_each_other() -> None:
    fixed = standard("pl-2021-slope-unreinforced", spacing=2)
    assert (fixed.factor, fixed.spacing) == (None, 2)
    rule = standard("iof-104", factor=0.5)
    assert (rule.factor, rule.spacing) == (0.5, None)


def test_a_family_has_one_for_each_kind() -> None:
    codes = {"slope-reinforced": "BUBZ03", "embankment": "BUBZ01", "slope-unreinforced": "BUBZ02"}
    found = {kind: standard_for("pl-2015", kind) for kind in codes}
    assert {kind: known.code for kind, known in found.items() if known is not None} == codes
    assert standard_for("pl-2021", "conveyor") is None
    assert standard_for("iof-104", "wall") is None
    assert len(standards_named("pl-2021")) == 4
    with pytest.raises(ParameterError, match="standard is 'fr', expected one of arcgis-like"):
        standards_named("fr")


def test_a_file_of_ones_own_is_named_as_the_file(tmp_path: Path) -> None:
    mine = standard(written(tmp_path, WHOLE, "house-style"))
    assert (mine.name, mine.title, mine.spacing) == ("house-style", "Mine", 1.5)
    assert standard(mine, spacing=3.0).spacing == 3.0


def test_a_file_builds_on_another_one(tmp_path: Path) -> None:
    text = OWN + 'base = "pl-2015-slope-unreinforced"\nspacing = 2.0\n'
    mine = standard(str(written(tmp_path, text)))
    base = standard("pl-2015-slope-unreinforced")
    assert (mine.spacing, mine.factor, mine.min_spacing) == (2.0, None, 0.0)
    assert mine.at(1000).outline_dash == (1.8, 0.7)
    assert (mine.source, mine.assumed) == ("me", base.assumed)
    other = standard(written(tmp_path, OWN + 'base = "mine.toml"\npattern = "LSS"\n', "other"))
    assert (other.spacing, other.pattern) == (2.0, "LSS")


def test_a_base_lends_no_confidence(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="has no key 'title', expected a text"):
        standard(written(tmp_path, 'base = "iof-104"\n'))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("spacing == 2", "is no TOML"),
        (WHOLE + "pitch = 2", "has a key 'pitch', expected one of title, source"),
        (
            WHOLE + 'short_ratio = "half"',
            "key 'short_ratio' is 'half', expected a number from 0.05",
        ),
        (WHOLE + "short_ratio = 1.5", "key 'short_ratio' is 1.5"),
        (WHOLE + "min_spacing = -1", "key 'min_spacing' is -1"),
        (WHOLE + "max_spacing = inf", "key 'max_spacing' is inf"),
        (WHOLE + "factor = true", "key 'factor' is True"),
        (WHOLE + "factor = 0.5", "has both keys 'factor' and 'spacing'"),
        (WHOLE + "gentle_factor = 1", "has one of the keys 'gentle_factor' and 'gentle_run'"),
        (WHOLE + "min_spacing = 2\nmax_spacing = 1", "'max_spacing' below 'min_spacing'"),
        (WHOLE + 'pattern = "SS"', "key 'pattern' is 'SS', expected L for long"),
        (WHOLE + 'colour = "red"', "key 'colour' is 'red', expected a colour: #000000"),
        (WHOLE + "outline_dash = [1, 2, 3]", "key 'outline_dash' is"),
        (WHOLE + 'assumed = ["pitch"]', "'assumed' names 'pitch'"),
        (WHOLE + "[scale.1000]\npitch = 2", r"\[scale.1000\] has a key 'pitch'"),
        (WHOLE + "[scale.1000]\nfactor = 2", r"\[scale.1000\] has both keys"),
        (WHOLE + "[scale.huge]\nspacing = 2", "key 'scale' is"),
        (WHOLE + "base = [3]", r"key 'base' is \[3\]"),
        (WHOLE + 'base = "mine.toml"', "key 'base' is 'mine.toml', which builds on this one"),
        (WHOLE + 'base = "iof"', "key 'base' is 'iof', expected one of arcgis-like"),
        (OWN + 'base = "none.toml"', "none.toml' cannot be read: No such file"),
        (OWN, "has no key 'kinds', expected a list of texts"),
        (WHOLE.replace('"line"', '"zigzag"'), "key 'symbol' is 'zigzag', expected 'line', 'wedge'"),
        (WHOLE.replace('"line"', '"template"'), "no lines in key 'template'"),
        (WHOLE.replace("spacing = 1.5", ""), "neither key 'factor' nor 'spacing'"),
        (WHOLE.replace('"line"', '"ticks"').replace("spacing", "factor"), "and no key 'spacing'"),
        (WHOLE + "template = [[[0, 1]]]", "key 'template' is"),
        (WHOLE + "kinds = []", "is no TOML"),
        (WHOLE.replace('["slope"]', "[]"), r"key 'kinds' is \[\], expected a list of texts"),
    ],
)
def test_what_is_wrong_is_said_with_file_and_key(tmp_path: Path, text: str, sentence: str) -> None:
    with pytest.raises(ParameterError, match=sentence) as error:
        standard(written(tmp_path, text))
    assert ".toml" in str(error.value)


def test_unknown_names_and_values_are_refused() -> None:
    with pytest.raises(
        ParameterError, match="standard is 'nowhere', expected one of arcgis-like, "
    ):
        standard("nowhere")
    with pytest.raises(ParameterError, match=r"'nowhere.toml' cannot be read: No such file"):
        standard("nowhere.toml")
    with pytest.raises(ParameterError, match="standard 'iof-104' has a key 'pitch'"):
        standard("iof-104", pitch=1.0)
    with pytest.raises(ParameterError, match="scale is 0, expected a number above 0"):
        standard("iof-104").at(0)


def test_public_names() -> None:
    assert midrib.standards is standards
    assert midrib.standard is standard


def test_the_page_of_standards_is_as_the_tool_writes_it() -> None:
    root = Path(__file__).parents[2]
    page = runpy.run_path(str(root / "tools" / "standards.py"))["page"]()
    assert (root / "docs" / "standards.md").read_text(encoding="utf-8") == page
    for name in re.findall(r"\((pictures/.*?)\)", page):
        assert (root / "docs" / name).exists()
