"""What options are made of, and how a value looks in a message."""

import sys
from importlib.util import find_spec
from typing import Any

import numpy as np

from midrib.errors import MissingDependencyError, ParameterError

__all__ = ["check_flag", "check_library", "is_number", "shown"]

LONGEST = 60  # characters of a value in a message


def is_number(value: Any) -> bool:
    """Whether a value is a real number, Python's or NumPy's; True and False are none.

    Nor is an integer that no float comes near to.
    """
    if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
        return False
    return not isinstance(value, int) or abs(value) <= sys.float_info.max


def check_flag(value: Any, name: str) -> None:
    """Refuse what is neither True nor False.

    Raises
    ------
    ParameterError
        If it is something else, however true.
    """
    if not isinstance(value, bool | np.bool_):
        msg = f"{name} is {shown(value)}, expected True or False"
        raise ParameterError(msg)


def check_library(name: str, what: str, extra: str) -> None:
    """Refuse what needs a library of an extra that is not installed.

    Raises
    ------
    MissingDependencyError
        If so.
    """
    if find_spec(name) is None:
        msg = f"{what} needs {name}: pip install midrib[{extra}]"
        raise MissingDependencyError(msg)


def shown(value: Any) -> str:
    """Show a value in one line, its beginning if it is long."""
    text = " ".join(repr(value).split())
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"
