"""What an attack has found, printed as a table and kept in the documentation."""

from __future__ import annotations

from dataclasses import dataclass

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


def as_markdown(finding: Finding) -> str:
    """Return a finding for the documentation."""
    rows = "\n".join(f"| {label} | {value} |" for label, value in finding.rows)
    return f"### {finding.name}\n\n| what | measured |\n|---|---|\n{rows}\n\n" + "\n".join(_verdict(finding))


def _verdict(finding: Finding) -> list[str]:
    if not finding.complaints:
        return ["Nothing was lost, and nothing was done twice."]
    more = len(finding.complaints) - NAMED_AT_MOST
    shown = [f"- {complaint}" for complaint in finding.complaints[:NAMED_AT_MOST]]
    return ["FAILED:", *shown, *([f"- and {more} more"] if more > 0 else [])]
