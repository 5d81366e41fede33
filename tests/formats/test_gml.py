"""Geometries of GML: arcs as near as stated, axes the right way round, files of any length."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree
from shapely import LineString, Point, Polygon

from midrib.errors import InvalidAreaError
from midrib.formats import gml
from midrib.formats.crs import system_of
from tests.formats.gml_files import BDOT_2015, collection, earthwork, ring

GML = 'xmlns:gml="http://www.opengis.net/gml"'
DUTCH = 'srsName="urn:ogc:def:crs:EPSG::28992"'
angles = st.floats(0.05, 6.2)


def element(text: str) -> etree._Element:
    """Element of a text."""
    return etree.fromstring(f"<x {GML}>{text}</x>")


def curve(*segments: str, about: str = "") -> etree._Element:
    """Curve of some segments."""
    return element(
        f"<gml:Curve {about}><gml:segments>{''.join(segments)}</gml:segments></gml:Curve>"
    )


def segment(name: str, points: Sequence[tuple[float, ...]]) -> str:
    """Segment of a curve through some points."""
    text = " ".join(repr(float(c)) for point in points for c in point)
    return f"<gml:{name}><gml:posList>{text}</gml:posList></gml:{name}>"


def on_circle(angle: float, radius: float = 1.0) -> tuple[float, float]:
    """Point of a circle about (3, 4)."""
    return 3.0 + radius * np.cos(angle), 4.0 + radius * np.sin(angle)


@given(begin=angles, one=angles, other=angles, turn=st.sampled_from([1.0, -1.0]))
def test_arcs_lie_on_their_circle(begin: float, one: float, other: float, turn: float) -> None:
    middle, end = sorted((one, other))
    if end - middle < 0.01:
        return
    ways = [begin + turn * a for a in (0.0, middle, end)]
    line = gml.line_in(curve(segment("Arc", [on_circle(a, 7.0) for a in ways])))
    assert line is not None
    points = shapely.get_coordinates(line)
    assert np.hypot(*(points - [3.0, 4.0]).T) == pytest.approx(7.0, rel=1e-6)
    halfway = (points[1:] + points[:-1]) / 2.0
    assert np.hypot(*(halfway - [3.0, 4.0]).T).min() >= 7.0 * (1.0 - 1e-3) - 1e-6
    assert line.length == pytest.approx(7.0 * end, rel=1e-3)
    for a in ways:
        assert np.hypot(*(points - on_circle(a, 7.0)).T).min() < 1e-9


def test_an_arc_on_a_line_is_that_line() -> None:
    line = gml.line_in(curve(segment("Arc", [(0, 0), (1, 1), (3, 3)])))
    assert line == LineString([(0, 0), (1, 1), (3, 3)])


def test_strings_of_arcs_and_chords_join_into_one_line() -> None:
    half = [on_circle(a) for a in (0.0, np.pi / 4, np.pi / 2, 3 * np.pi / 4, np.pi)]
    line = gml.line_in(
        curve(segment("ArcString", half), segment("LineStringSegment", [half[-1], (2, 9)]))
    )
    assert line is not None
    assert line.length == pytest.approx(np.pi + 5.0, rel=1e-3)
    assert len(np.unique(shapely.get_coordinates(line), axis=0)) == len(line.coords)
    assert line.coords[-1] == (2.0, 9.0)


def test_a_circle_is_closed() -> None:
    line = gml.line_in(curve(segment("Circle", [on_circle(a) for a in (0.0, 1.0, 4.0)])))
    assert line is not None
    assert line.is_closed
    assert Polygon(line).area == pytest.approx(np.pi, rel=3e-3)


def test_a_ring_of_arcs_is_an_area() -> None:
    arcs = curve(segment("ArcString", [on_circle(a) for a in (0.0, 1.0, 2.0, 4.0, 0.0)]))[0]
    member = f"<gml:curveMember>{etree.tostring(arcs).decode()}</gml:curveMember>"
    exterior = f"<gml:exterior><gml:Ring>{member}</gml:Ring></gml:exterior>"
    for name in ("Polygon", "PolygonPatch"):
        (area,) = gml.areas_in(element(f"<gml:{name}>{exterior}</gml:{name}>"))
        assert area.area == pytest.approx(np.pi, rel=3e-3)
        assert area.centroid.distance(Point(3, 4)) < 1e-2


def test_a_curve_that_is_turned_runs_backwards() -> None:
    inside = etree.tostring(curve(segment("LineStringSegment", [(0, 0), (1, 0)]))[0]).decode()
    turned = element(
        f'<gml:OrientableCurve orientation="-"><gml:baseCurve>{inside}</gml:baseCurve>'
        "</gml:OrientableCurve>"
    )
    line = gml.line_in(turned)
    assert line == LineString([(1, 0), (0, 0)])


@pytest.mark.parametrize(
    ("name", "is_north_first"),
    [
        ("urn:ogc:def:crs:EPSG::2177", True),
        ("urn:ogc:def:crs:EPSG:9.9.1:2177", True),
        ("http://www.opengis.net/def/crs/EPSG/0/2177", True),
        ("EPSG:2177", False),
        ("http://www.opengis.net/gml/srs/epsg.xml#2177", False),
        ("urn:ogc:def:crs:EPSG::28992", False),
    ],
)
def test_axes_are_in_the_order_of_the_name(name: str, is_north_first: bool) -> None:
    system = system_of(name)
    assert system is not None
    assert system.is_north_first == is_north_first
    point = gml.point_in(
        element(f'<gml:Point srsName="{name}"><gml:pos>1 2 3</gml:pos></gml:Point>')
    )
    assert point is not None
    assert point.tolist() == ([2.0, 1.0, 3.0] if is_north_first else [1.0, 2.0, 3.0])


def test_unknown_systems_are_none() -> None:
    assert system_of("local") is None
    assert system_of("urn:ogc:def:crs:EPSG::999999") is None


def test_coordinates_of_old_gml_are_read() -> None:
    text = "<gml:LineString><gml:coordinates>1,2 3,4 5,6</gml:coordinates></gml:LineString>"
    assert gml.line_in(element(text)) == LineString([(1, 2), (3, 4), (5, 6)])


@pytest.mark.parametrize("text", ["1 2 3", "1 two", ""])
def test_texts_that_are_no_coordinates_are_refused(text: str) -> None:
    line = element(f"<gml:LineString><gml:posList>{text}</gml:posList></gml:LineString>")
    if text:
        with pytest.raises(InvalidAreaError, match="are not rows of 2 numbers"):
            gml.line_in(line)
    else:
        assert gml.line_in(line) is None


def test_features_that_are_done_are_dropped(tmp_path: Path) -> None:
    corners = [(0.0, 0.0), (9.0, 0.0), (9.0, 2.0)]
    many = [earthwork(str(k), ring(corners), corners[0], corners[1]) for k in range(2000)]
    path = collection(tmp_path / "a.gml", BDOT_2015, *many)
    kept = [len(feature.getparent().getparent()) for feature in gml.features(path)]
    assert len(kept) == 2000
    assert max(kept) < 100  # as many as are read at once
