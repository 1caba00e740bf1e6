"""`sldr runs`: the runs in the store, as the page lists them."""

from __future__ import annotations

import dataclasses
import json as json_format
from collections.abc import Sequence
from typing import Any, get_args

import tyro

from backend.client.records.runs import Phase, Run, State
from sldr_core.errors import InvalidConfig, UnknownName
from worker.cli.service import Server, Wanted, open_service

MOST_ROWS = 10_000
"""Runs listed at once at most."""
HEAD = ("ID", "STATE", "TASK", "PHASE", "METHOD", "SEED", "PRESET", "DONE", "BEST", "CHANGES")


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(show, prog="sldr runs", args=list(arguments))


def show(
    state: str | None = None,
    task: str | None = None,
    method: str | None = None,
    phase: Phase | None = None,
    search: str | None = None,
    limit: int = 20,
    json: bool = False,
    server: Server = None,
) -> int:
    """List runs, the newest first.

    Args:
        state: Only runs in this state, as in running or failed.
        task: Only runs of this task.
        method: Only runs of this method.
        phase: Only runs of this phase.
        search: Words that task, method, phase, preset, state, a tag or the notes hold; a seed; the beginning of an id.
        limit: How many to list.
        json: Print everything known about each, for programs.
        server: The service to ask, as http://127.0.0.1:8000 (default: SLDR_URL, else what runs here, else the store).
    """
    if not 1 <= limit <= MOST_ROWS:
        raise InvalidConfig({"limit": f"it must be between 1 and {MOST_ROWS}, got {limit}"})
    if state is not None and state not in get_args(State):
        raise UnknownName("state", state, get_args(State))
    with open_service(server) as service:
        found = service.list_runs(Wanted(state, task, method, phase, search), limit)
        if json:
            details = [dataclasses.asdict(service.get_run(run.id)) for run in found.runs]
            print(json_format.dumps(details, indent=2, default=str))
            return 0
    print("\n".join(_as_lines(found.runs)))
    if found.next_cursor is not None:
        print(f"{len(found.runs)} of {found.total} runs; --limit shows more.")
    return 0


def _as_lines(rows: Sequence[Run]) -> list[str]:
    if not rows:
        return ["No run matches."]
    cells: list[tuple[Any, ...]] = [HEAD, *(_cells(row) for row in rows)]
    widths = [max(len(str(line[column])) for line in cells) for column in range(len(HEAD))]
    return ["  ".join(f"{cell!s:{width}}" for cell, width in zip(line, widths, strict=True)).rstrip() for line in cells]


def _cells(row: Run) -> tuple[Any, ...]:
    done, best = (row.progress.fraction, row.progress.best_success_rate) if row.progress else (0.0, None)
    told = (f"{done:.0%}", "-" if best is None else f"{best:.1%}")
    return row.id, row.state, row.task, row.phase, row.method, row.seed, row.preset, *told, " ".join(row.changes)
