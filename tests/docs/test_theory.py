"""What the theory pages say: messages, formulas, and pictures that are drawn by code."""

import re
from pathlib import Path

import numpy as np
import pytest
from shapely import LineString, Point

from midrib import Strip, minimal_radii
from midrib.errors import ParameterError

pytest.importorskip("matplotlib")

import matplotlib as mpl
import matplotlib.pyplot as plt
from examples.gallery.shapes import disjoint
from tools.theory import CASES, PICTURES, REFUSED, pocket

from midrib.figures.paper import save

mpl.use("Agg")

COLLECTION = re.compile(r'<g id="(\w+Collection_\d+)">(.*?)</g>', re.DOTALL)
NUMBER = r"(?<=[ML xy\"])-?\d+(?:\.\d+)?(?=[\s\"])"
DOCS = Path(__file__).parents[2] / "docs"


def page(name: str) -> str:
    """Text of a theory page."""
    return (DOCS / "theory" / f"{name}.md").read_text("utf-8")


def test_pictures_are_those_that_are_drawn() -> None:
    assert {path.stem for path in (DOCS / "pictures").glob("theory-*")} == set(PICTURES)


def drawn(path: Path) -> dict[str, list[float]]:
    """Coordinates of everything but text, collection by collection, in points."""
    groups = COLLECTION.findall(path.read_text("utf-8"))
    return {name: [float(x) for x in re.findall(NUMBER, body)] for name, body in groups}


@pytest.mark.parametrize("name", PICTURES)
def test_every_picture_is_as_it_is_drawn(name: str, tmp_path: Path) -> None:
    save(PICTURES[name](), tmp_path / "new.svg")
    plt.close("all")
    new, old = drawn(tmp_path / "new.svg"), drawn(DOCS / "pictures" / f"{name}.svg")
    assert new.keys() == old.keys()
    assert len(new) > 4
    for group in new:
        assert new[group] == pytest.approx(old[group], abs=0.02), group


@pytest.mark.parametrize("case", range(1, 1 + len(REFUSED)))
def test_messages_are_those_of_the_page(case: int) -> None:
    message = list(REFUSED.values())[case - 1].message()
    assert f"\n{case}. `{message}`\n" in page("strips")


def test_ends_outside_the_area_are_refused_as_the_page_says() -> None:
    with pytest.raises(ParameterError) as raised:
        minimal_radii(disjoint(), ends=((-5, 0), (10, 1)))
    assert f"`{raised.value}`" in page("ends")


@pytest.mark.parametrize(("beta", "off"), [(10, 0.04), (30, 1.1), (60, 10.9)])
def test_a_wedge_has_the_angle_of_the_page(beta: float, off: float) -> None:
    """The first middles from the tip, in a wedge of 2 long sides."""
    angle = np.radians(beta)
    tip = 20.0 * np.array([np.cos(angle), np.sin(angle)])
    strip = Strip(LineString([(0, 0), (20, 0)]), LineString([(0, 0), tip]))
    curve = minimal_radii(strip, count=100, ends=None, end_clearance=None)
    x, y = curve.points[10]
    phi = np.arctan2(y, x)
    expected = np.sin(angle) * np.cos(angle) / (1.0 + np.cos(angle) ** 2)
    assert np.tan(phi) == pytest.approx(expected)
    assert np.degrees(angle / 2.0 - phi) == pytest.approx(off, abs=0.05)
    centred = minimal_radii(strip, count=100, ends=None, end_clearance=None, centring="centred")
    places = centred.points[5:20]
    assert np.degrees(np.arctan2(*places.T[::-1])) == pytest.approx(beta / 2.0)


def test_the_cases_of_the_picture_are_what_they_are_called() -> None:
    for name, (main, auxiliary, place) in CASES.items():
        strip = Strip(main, auxiliary)
        station = strip.main.project(Point(place))
        curve = minimal_radii(strip, stations=[station], ends=None, end_clearance=None)
        rows = np.flatnonzero(np.abs(curve.stations - station) < 1e-9)
        assert len(rows) == (2 if name.startswith("tie") else 1)
        nearest = auxiliary.distance(Point(place))
        is_hidden = curve.radii[rows[0]] > nearest + 1e-9
        assert is_hidden == name.startswith("graze")
        q = Point(curve.on_auxiliary[rows[0]])
        at_vertex = min(q.distance(Point(v)) for v in auxiliary.coords) < 1e-9
        assert at_vertex == name.startswith("vertex")


def test_the_pocket_has_gaps_and_the_line_is_one() -> None:
    curve = minimal_radii(pocket(), count=90, ends=None, end_clearance=None)
    assert len(curve.gaps) > 0
    assert curve.line.is_simple
    assert curve.strip.area.covers(curve.line)
