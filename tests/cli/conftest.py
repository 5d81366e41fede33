"""Fixtures of the command line's tests."""

import pytest

from tests.cli.commands import Runner


@pytest.fixture
def midrib(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Runner:
    """Return what runs a command."""
    return Runner(monkeypatch, capsys)
