"""What readers of point clouds have in common."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from midrib.errors import MidribError, ParameterError

__all__ = ["STATIONS", "refusing"]

# What a column that tells the station is called.
STATIONS = ("station", "station_id", "scan", "scan_id", "scanner", "point_source_id", "source_id")


@contextmanager
def refusing(path: Path, *errors: type[Exception]) -> Iterator[None]:
    """Turn errors of a reader into a sentence that names the file.

    Raises
    ------
    ParameterError
        If one of them, or an error of the system, comes up.
    """
    kinds: tuple[type[Exception], ...] = (OSError, EOFError, *errors)
    try:
        yield
    except MidribError:
        raise
    except kinds as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        if isinstance(error, UnicodeDecodeError):
            reason = "it has bytes that are no UTF-8 text where text belongs; is it damaged, or no "
            reason += f"{path.suffix.lower()} file?"
        msg = f"CLOUD {str(path)!r} cannot be read: {reason}"
        raise ParameterError(msg) from error
