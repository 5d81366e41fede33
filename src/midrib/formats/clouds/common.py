"""What readers of point clouds have in common."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from midrib.errors import MidribError, ParameterError

__all__ = ["STATIONS", "check_signature", "refusing"]

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


def check_signature(path: Path, signature: bytes, least: int) -> None:
    """Refuse a file that does not begin as its format does, or that is shorter than a header.

    Raises
    ------
    ValueError
        With what it begins with instead; to be called where ``refusing`` looks.
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        found = file.read(len(signature))
    ending = path.suffix.lower()
    if found != signature:
        msg = f"it begins with {found!r}, expected {signature!r}, as {ending} files do"
    elif size < least:
        msg = f"it breaks off after {size} bytes, the header alone has {least}"
    else:
        return
    raise ValueError(msg)
