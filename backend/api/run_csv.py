"""The runs table as CSV: RFC 4180, one header line, full precision."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence

from backend.comparison.variants import changes
from backend.store.metric_columns import MetricColumn
from backend.store.run_groups import GroupKey, RunGroup
from backend.store.runs import RunRow, RunRows

RUN_HEAD = (
    "id",
    "task",
    "phase",
    "method",
    "seed",
    "preset",
    "changes",
    "state",
    "attempt",
    "tags",
    "epoch",
    "epochs",
    "env_steps",
    "success_rate",
    "best_success_rate",
    "created_at",
    "started_at",
    "ended_at",
    "config_hash",
    "settings_hash",
    "notes",
)

_FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r")
"""Spreadsheet programs compute cells that begin so."""


def write_runs(found: RunRows, columns: Sequence[MetricColumn]) -> str:
    """Return one row a run, its metrics last."""
    head = [*RUN_HEAD, *(str(column) for column in columns)]
    rows = zip(found.rows, found.values, strict=True)
    return _table(head, ([*_run_cells(row), *values] for row, values in rows))


def write_groups(groups: Iterable[RunGroup], by: Sequence[GroupKey], metric: MetricColumn) -> str:
    """Return one row a group, with the quartiles of the metric last."""
    head = [*by, "runs", "seeds", "states", *(f"{metric} {part}" for part in ("n", "lower", "median", "upper"))]
    return _table(head, (_group_cells(group, by) for group in groups))


def _table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(head)
    writer.writerows([_harmless(cell) for cell in row] for row in rows)
    return text.getvalue()


def _harmless(cell: object) -> object:
    """Return a cell that no spreadsheet program takes for a formula, whatever people wrote into it."""
    return f"'{cell}" if isinstance(cell, str) and cell.startswith(_FORMULA_STARTS) else cell


def _run_cells(row: RunRow) -> list[object]:
    progress = row.progress
    how_far = (
        [None] * 5
        if progress is None
        else [
            progress.epoch,
            progress.epochs,
            progress.env_steps,
            progress.success_rate,
            progress.best_success_rate,
        ]
    )
    moments = [moment and moment.isoformat() for moment in (row.created_at, row.started_at, row.ended_at)]
    return [
        row.id,
        row.task,
        row.phase,
        row.method,
        row.seed,
        row.preset,
        " ".join(changes(row)),
        row.state.value,
        row.attempt,
        ", ".join(row.tags),
        *how_far,
        *moments,
        row.config_hash,
        row.settings_hash,
        row.notes,
    ]


def _group_cells(group: RunGroup, by: Sequence[GroupKey]) -> list[object]:
    spread = group.spread
    return [
        *(group.keys[key] for key in by),
        group.runs,
        " ".join(str(seed) for seed in group.seeds),
        ", ".join(f"{count} {state.value}" for state, count in group.states.items()),
        *((0, None, None, None) if spread is None else (spread.n, spread.lower, spread.median, spread.upper)),
    ]
