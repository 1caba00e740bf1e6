"""What docs/troubleshooting.md quotes is what the product says."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/troubleshooting.md").read_text()
GAP = "\0"
"""Stands for whatever a message puts in."""

MESSAGES = [
    message
    for cell in re.findall(r"^\| (`[^|]*`) \|", PAGE, re.MULTILINE)
    for message in re.findall(r"`([^`]+)`", cell)
]


def sentences(tree: ast.AST) -> Iterator[str]:
    """Yield every text of a program; texts side by side are one for Python already."""
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            yield "".join(str(part.value) if isinstance(part, ast.Constant) else GAP for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value


@cache
def said() -> tuple[str, ...]:
    """Return all that programs and scripts can say."""
    sources = [path for room in ("sldr_core", "backend", "worker") for path in (ROOT / room).rglob("*.py")]
    scripts = [path.read_text() for path in (ROOT / ".ci").glob("*.sh")]
    return (*(text for path in sources for text in sentences(ast.parse(path.read_text()))), *scripts)


def is_said(message: str) -> bool:
    """Tell whether one text has the fixed parts of a message, in their order."""
    pattern = re.compile(".*?".join(re.escape(part) for part in message.split("…")), re.DOTALL)
    return any(pattern.search(text) for text in said())


@pytest.mark.parametrize("message", MESSAGES)
def test_the_product_says_so(message: str) -> None:
    assert len(message.replace("…", "").strip()) >= len("became")
    assert is_said(message)


def test_a_message_that_is_gone_is_noticed() -> None:
    assert len(MESSAGES) > 30
    assert not is_said("The moon is not there; … install it.")
