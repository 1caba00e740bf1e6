"""The pages that are written from the code say what it says today."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from sldr_core.presets import methods_page, settings_page

ROOT = Path(__file__).parents[2]
TIMEOUT_S = 60

PAGES: dict[Callable[[], str], tuple[Path, str]] = {
    methods_page.methods_page: (methods_page.PAGE, methods_page.COMMAND),
    settings_page.settings_page: (settings_page.PAGE, settings_page.COMMAND),
}
"""What writes a page, where it lies, and the command that does so."""


@pytest.mark.parametrize("write", PAGES)
def test_a_page_that_is_written_from_the_code_is_up_to_date(write: Callable[[], str]) -> None:
    page, command = PAGES[write]
    assert (ROOT / page).read_text(encoding="utf-8") == write(), f"run: {command}"


@pytest.mark.parametrize("write", PAGES)
def test_the_command_that_writes_a_page_is_the_one_it_names(write: Callable[[], str], tmp_path: Path) -> None:
    page, command = PAGES[write]
    (tmp_path / page.parent).mkdir()
    arguments = [sys.executable, *command.split()[1:]]

    subprocess.run(arguments, cwd=tmp_path, timeout=TIMEOUT_S, check=True, env={"PYTHONPATH": str(ROOT)})

    assert (tmp_path / page).read_text(encoding="utf-8") == write()
