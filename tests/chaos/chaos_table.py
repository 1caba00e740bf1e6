"""What an attack has found, printed as a table and kept in the documentation."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

BEGIN = "<!-- results: written by `make chaos` -->"
END = "<!-- end of results -->"
NAMED_AT_MOST = 20
"""A table names so many complaints."""


@dataclass(frozen=True)
class Finding:
    """Say what one attack measured, and what was wrong."""

    name: str
    rows: list[tuple[str, str]]
    complaints: list[str]


def as_text(finding: Finding) -> str:
    """Return a finding for the terminal."""
    width = max(len(label) for label, _ in finding.rows)
    lines = [f"== {finding.name}", *(f"{label:<{width}}  {value}" for label, value in finding.rows)]
    return "\n".join([*lines, *_verdict(finding)])


def write_results(page: Path, findings: Sequence[Finding]) -> None:
    """Put findings into a page, between its two marks, in place of those before."""
    text = page.read_text()
    before, _, rest = text.partition(BEGIN)
    _, mark, after = rest.partition(END)
    if not mark:
        raise SystemExit(f"{page} has no place for results; put '{BEGIN}' and '{END}' where they belong.")
    when = datetime.now(UTC).strftime("%Y-%m-%d")
    parts = [f"Measured on {when}: {_machine()}.", *(_as_markdown(finding) for finding in findings)]
    page.write_text(before + BEGIN + "\n\n" + "\n\n".join(parts) + "\n\n" + END + after)


def _as_markdown(finding: Finding) -> str:
    rows = "\n".join(f"| {label} | {value} |" for label, value in finding.rows)
    return f"### {finding.name}\n\n| what | measured |\n|---|---|\n{rows}\n\n" + "\n".join(_verdict(finding))


def _verdict(finding: Finding) -> list[str]:
    if not finding.complaints:
        return ["Nothing was lost, and nothing was done twice."]
    more = len(finding.complaints) - NAMED_AT_MOST
    shown = [f"- {complaint}" for complaint in finding.complaints[:NAMED_AT_MOST]]
    return ["FAILED:", *shown, *([f"- and {more} more"] if more > 0 else [])]


def _machine() -> str:
    model = next(
        (line.partition(":")[2].strip() for line in _cpu_lines() if line.startswith("model name")), platform.machine()
    )
    cores = sum(line.startswith("processor") for line in _cpu_lines())
    return f"{cores} cores of {model}, Python {platform.python_version()}"


def _cpu_lines() -> list[str]:
    path = Path("/proc/cpuinfo")
    return path.read_text().splitlines() if path.exists() else []
