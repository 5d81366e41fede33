"""Lengths with units."""

import json

import pytest

from midrib.errors import ParameterError
from midrib.formats.units import Unit, is_geographic, length_in, unit_of

FOOT = {"type": "LinearUnit", "name": "US survey foot", "conversion_factor": 1200 / 3937}
GRAD = {"type": "AngularUnit", "name": "grad", "conversion_factor": 0.015707963267949}


def crs_text(unit: object, subtype: str = "Cartesian") -> str:
    """PROJJSON with one unit on both axes."""
    return json.dumps({"coordinate_system": {"subtype": subtype, "axis": [{"unit": unit}] * 2}})


METRES, FEET = crs_text("metre"), crs_text(FOOT)
DEGREES = crs_text("degree", "ellipsoidal")


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("2m", 2.0),
        ("2", 2.0),
        (" 50 cm ", 0.5),
        ("0.5km", 500.0),
        ("10ft", 3.048),
        ("1e3mm", 1.0),
        (".5m", 0.5),
        ("-2m", -2.0),
        ("1nmi", 1852.0),
    ],
)
def test_lengths_become_metres(text: str, metres: float) -> None:
    assert length_in(text, METRES, "--spacing") == pytest.approx(metres)
    assert length_in(text, DEGREES, "--spacing") == pytest.approx(metres)


def test_lengths_become_units_of_the_crs() -> None:
    assert length_in("1usft", FEET, "--spacing") == pytest.approx(1.0)
    assert length_in("0.3048m", FEET, "--spacing") == pytest.approx(1.0, rel=1e-5)
    assert length_in("7", FEET, "--spacing") == 7.0


@pytest.mark.parametrize("text", ["", "m", "2 parsecs", "2 M", "two", "1m2", "2,5m", "nan", "1_0"])
def test_what_is_no_length_is_refused(text: str) -> None:
    with pytest.raises(ParameterError, match=r"--spacing is '.*', expected a number, alone"):
        length_in(text, METRES, "--spacing")


@pytest.mark.parametrize("crs", [None, "{}", crs_text("unity")])
def test_units_need_a_crs_that_has_one(crs: str | None) -> None:
    assert unit_of(crs) is None
    assert length_in("2", crs, "--spacing") == 2.0
    with pytest.raises(ParameterError, match="IN has no CRS with a unit"):
        length_in("2m", crs, "--spacing")


def test_the_horizontal_part_of_a_crs_counts() -> None:
    height = json.loads(crs_text("metre", "vertical"))
    compound = json.dumps({"components": [json.loads(DEGREES), height]})
    bound = json.dumps({"source_crs": json.loads(FEET)})
    assert is_geographic(compound)
    assert unit_of(bound) == Unit("US survey foot", 1200 / 3937)


def test_degrees_are_the_only_angles() -> None:
    with pytest.raises(ParameterError, match="units of 'grad', expected degrees"):
        is_geographic(crs_text(GRAD, "ellipsoidal"))
