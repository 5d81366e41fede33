"""The errors a caller can meet, each with one sentence that says what was found and wanted."""

__all__ = [
    "GeometryTypeError",
    "InvalidAreaError",
    "InvariantError",
    "MidribError",
    "MissingDependencyError",
    "ParameterError",
    "RepairedAreaWarning",
    "TooManyStationsError",
]


class MidribError(Exception):
    """Base of every error that midrib raises on purpose."""


class GeometryTypeError(MidribError, TypeError):
    """A geometry is of a kind that the argument does not take."""


class ParameterError(MidribError, ValueError):
    """An option has a value that it cannot have."""


class TooManyStationsError(ParameterError):
    """An interval is absurdly small for an area: the option is at fault, not the area."""


class InvalidAreaError(MidribError, ValueError):
    """An area, or its division into two curves, breaks a rule; the message names the place."""


class MissingDependencyError(MidribError, ImportError):
    """An optional library is needed; the message has the command that installs it."""


class InvariantError(MidribError):
    """Something that cannot happen has happened: an error of midrib's own, please report it."""


class RepairedAreaWarning(UserWarning):
    """An area was not valid and has been repaired where there was no doubt how."""
