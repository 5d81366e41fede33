"""The ``midrib`` command; ``python -m midrib`` is the same."""

import gc
import sys
import warnings

from midrib import interrupts
from midrib.errors import MidribError
from midrib.interrupts import INTERRUPTED

__all__ = ["main"]

WRONG_USAGE = 2
OBJECTS = 10_000  # new ones after which garbage is looked for


def main() -> None:
    """Run the command line and leave with its exit code."""
    interrupts.install()  # before the imports, which take a while
    usual = gc.get_threshold()
    gc.set_threshold(OBJECTS)  # what they make is none, and a sixth of a start went into finding so
    from midrib.cli.app import app

    warnings.formatwarning = lambda message, *_, **__: f"midrib: note: {message}\n"
    try:
        app(prog_name="midrib")
    except MidribError as error:
        leave(str(error), WRONG_USAGE)
    except Exception as error:  # a bug, whatever it is
        leave(f"{type(error).__name__}: {error}\n{report_of(error)}", WRONG_USAGE)
    except SystemExit as ended:
        if ended.code == INTERRUPTED:
            leave("interrupted", INTERRUPTED)
        raise
    finally:
        gc.set_threshold(*usual)


def report_of(error: Exception) -> str:
    """Keep the traceback of an error of our own, and say where it is."""
    import traceback
    from tempfile import NamedTemporaryFile

    text = "".join(traceback.format_exception(error))
    with NamedTemporaryFile("w", prefix="midrib-", suffix=".txt", delete=False) as file:
        file.write(text)
    return f"This is an error of midrib's own, please report it with {file.name}"


def leave(sentence: str, code: int) -> None:
    """Say why on stderr and exit."""
    sys.stderr.write(f"midrib: {sentence}\n")
    raise SystemExit(code)


if __name__ == "__main__":
    main()
