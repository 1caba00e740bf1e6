"""Keep what was measured in a page of the documentation, between two marks, with the machine it was measured on."""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

from sldr_core.processor import processor_model

END = "<!-- end of results -->"


def begin_mark(command: str) -> str:
    """Return the mark before the results of a command."""
    return f"<!-- results: written by `{command}` -->"


def write_results(page: Path, command: str, parts: Sequence[str]) -> None:
    """Put paragraphs into a page, after a line that says when and where they were measured: today and here.

    Raises:
        SystemExit: the page has no place for them.
    """
    write_parts(page, command, [measured_on(today(), describe_machine()), *parts])


def write_parts(page: Path, command: str, parts: Sequence[str]) -> None:
    """Put paragraphs into a page, in place of those that the command wrote before.

    Raises:
        SystemExit: the page has no place for them.
    """
    text, begin = page.read_text(), begin_mark(command)
    before, found, rest = text.partition(begin)
    _, mark, after = rest.partition(END)
    if not found or not mark:
        raise SystemExit(f"{page} has no place for results; put '{begin}' and '{END}' where they belong.")
    page.write_text(before + begin + "\n\n" + "\n\n".join(parts) + "\n\n" + END + after)


def measured_on(day: str, machine: str) -> str:
    """Return the line that stands before what was measured."""
    return f"Measured on {day}: {machine}."


def today() -> str:
    """Return the day as YYYY-MM-DD."""
    return datetime.now(UTC).strftime("%Y-%m-%d")


def describe_machine() -> str:
    """Return cores, processor and Python of this machine."""
    model = processor_model() or platform.machine()
    return f"{os.cpu_count()} cores of {model}, Python {platform.python_version()}"
