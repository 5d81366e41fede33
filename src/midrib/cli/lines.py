"""Options of the line, as the commands take them, read into those of ``collapse``."""

from typing import Any

from midrib.cli.options import Centring, Channel, EndRule, Holes, Mean, SkipRule, chosen
from midrib.errors import ParameterError
from midrib.formats.units import length_in

__all__ = ["options_of_line"]

CLEARANCES = {"station": "station", "proportional": "proportional", "none": None}


def options_of_line(
    crs: str | None,
    *,
    spacing: str | None = None,
    tolerance: str | None = None,
    simplify: str | None = None,
    smooth: bool = False,
    mean: Mean | None = None,
    skip: SkipRule | None = None,
    end_clearance: str | None = None,
    centring: Centring,
    holes: Holes,
    channel: Channel,
    ends: EndRule,
    **others: Any,
) -> dict[str, Any]:
    """Options of ``collapse`` that were given; lengths in its units.

    Raises
    ------
    ParameterError
        If a length is none.
    """
    given = others | {
        "mean": mean and mean.value,
        "smooth": smooth or None,
        "spacing": spacing and length_in(spacing, crs, "--spacing"),
        "tolerance": tolerance and deviation(tolerance, crs, "--tolerance"),
        "simplify": simplify and deviation(simplify, crs, "--simplify"),
    }
    options = {name: value for name, value in given.items() if value is not None}
    options |= chosen(centring=centring, holes=holes, channel=channel, ends=ends)
    if skip is not None:
        options["skip"] = None if skip is SkipRule.none else skip.value
    if end_clearance is not None:
        options["end_clearance"] = clearance(end_clearance, crs)
    return options


def clearance(text: str, crs: str | None) -> str | float | None:
    """Read the clearance at the ends: the name of a rule, None or a length."""
    if text in CLEARANCES:
        return CLEARANCES[text]
    try:
        return length_in(text, crs, "--end-clearance")
    except ParameterError as error:
        msg = f"{error}, or station, proportional, none"
        raise ParameterError(msg) from None


def deviation(text: str, crs: str | None, option: str) -> str | float:
    """Read how far a line may be from another: a percentage as it stands, or a length."""
    if text.strip().endswith("%"):
        return text
    try:
        return length_in(text, crs, option)
    except ParameterError as error:
        msg = f"{error}, or a share of the width: 5%"
        raise ParameterError(msg) from None
