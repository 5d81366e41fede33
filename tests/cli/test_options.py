"""Options of the command line are those of the library: the same names, choices and defaults."""

import inspect
from enum import StrEnum
from typing import Any, get_args

import pytest
import typer

from midrib.cli import options
from midrib.cli.app import app
from midrib.curves import averaging, construction, joining
from midrib.curves.methods import USUAL

OF_THE_LINE = "How the line is made"
OF_COLLAPSE = {"method", "connect"}  # and of no construction
OF_PYTHON = {"stations"}  # arrays


def literals(kind: Any) -> list[str]:
    """Texts that a type takes, whatever else it takes."""
    if isinstance(kind, str):
        return [kind]
    return [text for part in get_args(kind) for text in literals(part)]


@pytest.mark.parametrize(
    ("choices", "kind"),
    [
        (options.Centring, construction.Centring),
        (options.Holes, construction.Holes),
        (options.Channel, joining.Channel),
        (options.Mean, averaging.Mean),
        (options.EndRule, joining.EndRule),
    ],
)
def test_choices_are_the_library_s(choices: type[StrEnum], kind: Any) -> None:
    assert {choice.value for choice in choices} - {"none"} == {*literals(kind)} - {"none"}


def of_the_line(command: str) -> dict[str, inspect.Parameter]:
    """Options of a command that are of the line."""
    (function,) = (c.callback for c in app.registered_commands if c.callback.__name__ == command)  # type: ignore[union-attr]
    assert function is not None
    found = {}
    for name, parameter in inspect.signature(function).parameters.items():
        _, about = get_args(parameter.annotation)
        if getattr(about, "rich_help_panel", None) == OF_THE_LINE:
            found[name] = parameter
    return found


def test_every_option_of_a_construction_is_one_of_collapse() -> None:
    known = set(inspect.signature(construction.Construction).parameters)
    assert set(of_the_line("collapse")) - OF_COLLAPSE == known - OF_PYTHON
    assert set(of_the_line("profile")) <= set(of_the_line("collapse"))


def test_defaults_are_the_library_s() -> None:
    usual = {
        name: parameter.default
        for name, parameter in inspect.signature(construction.Construction).parameters.items()
    }
    for command in ("collapse", "profile"):
        for name, parameter in of_the_line(command).items():
            if name not in OF_COLLAPSE and parameter.default is not None:
                assert parameter.default == (usual | USUAL)[name]


def test_every_option_has_a_help_text() -> None:
    for name in options.__all__:
        for about in getattr(getattr(options, name), "__metadata__", ()):
            assert isinstance(about, typer.models.ParameterInfo)
            assert about.help
