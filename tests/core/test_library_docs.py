"""What docs/library.md shows works as it says."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

PAGE = (Path(__file__).parents[2] / "docs/library.md").read_text()
BLOCKS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
PRINTED = re.compile(r"^print\(.*\)  # (.*)$", re.MULTILINE)
"""A line that says what it prints."""


def test_the_code_of_the_page_runs_in_its_order_and_prints_what_it_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delenv("SLDR_ZOO")  # The page takes the models that come with the product.
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}

    for block in BLOCKS:
        exec(compile(block, "docs/library.md", "exec"), names)

    told = [text for block in BLOCKS for text in PRINTED.findall(block)]
    lines = iter(capsys.readouterr().out.splitlines())
    assert len(told) >= 7
    assert [text for text in told if text not in lines] == []
