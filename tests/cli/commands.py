"""Running the command line inside the tests."""

import sys
import warnings
from typing import NamedTuple

import pytest

from midrib.__main__ import main

__all__ = ["Outcome", "Runner"]


class Outcome(NamedTuple):
    """What a command left behind."""

    code: int
    out: str
    err: str


class Runner:
    """Runs commands as ``midrib ARGUMENTS`` would."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
        self.monkeypatch, self.capsys = monkeypatch, capsys
        monkeypatch.setattr("signal.signal", lambda *_: None)
        monkeypatch.setattr(warnings, "formatwarning", warnings.formatwarning)

    def __call__(self, *arguments: object) -> Outcome:
        """Run a command and return its exit code and what it printed."""
        self.monkeypatch.setattr(sys, "argv", ["midrib", *map(str, arguments)])
        with pytest.raises(SystemExit) as left:
            main()
        code = left.value.code or 0
        assert isinstance(code, int)
        return Outcome(code, *self.capsys.readouterr())
