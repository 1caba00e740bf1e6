"""The command line in this process: what it prints, its exit code, and the store that it finds."""

from __future__ import annotations

import pytest

from backend.store.settings import Settings
from worker.cli import main


def use(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let commands find a store in the environment."""
    for name, value in settings.as_environment().items():
        monkeypatch.setenv(name, value)


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Run a command; return its exit code and what it printed on either stream."""
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    printed = capsys.readouterr()
    assert isinstance(ended.value.code, int)
    return ended.value.code, printed.out, printed.err
