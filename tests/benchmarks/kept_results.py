"""What benchmarks gave, kept group by group with day and machine, and told as tables of a page."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bench_rows import Measured, as_measured
from measured_page import describe_machine, measured_on, today


@dataclass(frozen=True)
class KeptGroup:
    """Hold the rows of a group that was measured."""

    day: str
    """When, as YYYY-MM-DD."""
    machine: str
    """What it was measured on, in words."""
    rows: tuple[Measured, ...]


def read_results(path: Path) -> dict[str, KeptGroup]:
    """Return what was measured before, by group; nothing if there is no file."""
    if not path.exists():
        return {}
    kept: dict[str, Any] = json.loads(path.read_text())
    return {
        name: KeptGroup(group["day"], group["machine"], tuple(map(as_measured, group["rows"])))
        for name, group in kept.items()
    }


def keep_results(path: Path, results: Mapping[str, KeptGroup]) -> None:
    """Write everything that was measured."""
    path.parent.mkdir(parents=True, exist_ok=True)
    kept = {
        name: {"day": group.day, "machine": group.machine, "rows": [row.as_json() for row in group.rows]}
        for name, group in results.items()
    }
    path.write_text(json.dumps(kept, indent=1) + "\n")


def keep_each(path: Path, name: str, rows: Iterable[Measured]) -> Iterator[Measured]:
    """Pass on the rows of a group, each kept as soon as it is measured: the next one may fail after hours.

    The first one takes the place of what was measured of the group before.
    """
    results = read_results(path)
    kept: tuple[Measured, ...] = ()
    for one in rows:
        kept = (*kept, one)
        keep_results(path, results | {name: KeptGroup(today(), describe_machine(), kept)})
        yield one


def as_tables(results: Mapping[str, KeptGroup], order: Sequence[str]) -> list[str]:
    """Return paragraphs: a line for each day and machine, and the tables of what was measured there then."""
    told: list[str] = []
    before: tuple[str, str] | None = None
    for name in (name for name in order if name in results):
        group = results[name]
        if (group.day, group.machine) != before:
            told.append(measured_on(group.day, group.machine))
            before = (group.day, group.machine)
        told.append(_as_table(group.rows))
    return told


def as_line(measured: Measured) -> str:
    """Return a row as one line of a terminal."""
    return f"{_verdict(measured):<5} {_value(measured):>10}  {measured.what} ({_target(measured)}; {measured.detail})"


def _as_table(rows: Sequence[Measured]) -> str:
    lines = [
        f"| {row.what} | {_target(row)} | **{_value(row)}** ({row.low:.3g} to {row.high:.3g}) | {_verdict(row)} "
        f"| {row.detail} |"
        for row in rows
    ]
    return "\n".join(["| what | target | median (range) | | detail |", "|---|---|---|---|---|", *lines])


def _verdict(measured: Measured) -> str:
    if measured.target is None:
        return ""
    return "met" if measured.is_met else "SHORT"


def _value(measured: Measured) -> str:
    return f"{measured.value:.3g} {measured.unit}"


def _target(measured: Measured) -> str:
    if measured.target is None:
        return "none"
    return f"{measured.target.direction} {measured.target.value:g} {measured.unit}"
