"""Runs in groups that differ in the seed, or in whatever else is not asked for, with the spread of one metric."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from statistics import quantiles
from typing import Any, Literal

from sqlalchemy import select

from backend.store.database import Database
from backend.store.metric_columns import MetricColumn, join_summaries
from backend.store.progress import with_progress
from backend.store.run_filter import RunFilter, conditions
from backend.store.states import RunState
from backend.store.tables import AnyRow, runs

GroupKey = Literal["task", "phase", "method", "preset", "state", "settings"]
"""What runs can be grouped by; `settings` is the whole config without the seed, by its hash."""

GroupSort = Literal["launched", "task", "phase", "method", "preset", "state", "settings", "runs", "median"]
"""What groups can be sorted by; `launched` is when their newest run was."""

_COLUMNS: Mapping[GroupKey, str] = {"settings": "settings_hash"}
"""Columns that are called otherwise."""


@dataclass(frozen=True)
class Spread:
    """Say where the middle half of some values lies, between neighbours by straight lines."""

    n: int
    """Values; runs without one are left out."""
    lower: float
    """First quartile."""
    median: float
    upper: float
    """Third quartile."""


@dataclass(frozen=True)
class RunGroup:
    """Describe the runs that share what they are grouped by."""

    keys: Mapping[GroupKey, str]
    runs: int
    seeds: tuple[int, ...]
    """Each once, in their order."""
    states: Mapping[RunState, int]
    """Runs in each state that occurs."""
    spread: Spread | None
    """Of the metric asked for; None if no run has logged it."""
    newest: int
    """Number of the run launched last."""


def group_runs(
    db: Database,
    wanted: RunFilter,
    by: Sequence[GroupKey],
    metric: MetricColumn,
    sort: GroupSort = "launched",
    descending: bool = True,
) -> list[RunGroup]:
    """Return the groups of the runs that pass a filter; groups without what they are sorted by stand last."""
    by = tuple(dict.fromkeys(by))
    source, values = join_summaries(with_progress(), (metric,))
    keys = [runs.c[_COLUMNS.get(key, key)].label(f"key_{key}") for key in by]
    query = select(*keys, runs.c.number, runs.c.seed, runs.c.state, values[metric].label("value"))
    members: dict[tuple[str, ...], list[AnyRow]] = {}
    with db.read() as conn:
        for row in conn.execute(query.select_from(source).where(*conditions(wanted))):
            members.setdefault(tuple(getattr(row, f"key_{key}") or "" for key in by), []).append(row)
    groups = [_group(dict(zip(by, key, strict=True)), rows) for key, rows in members.items()]
    return _sorted(groups, sort, descending)


def spread_of(values: Sequence[float]) -> Spread | None:
    """Return the quartiles of some values, as NumPy has them by default; None of none."""
    if not values:
        return None
    if len(values) == 1:
        return Spread(1, values[0], values[0], values[0])
    lower, median, upper = quantiles(values, n=4, method="inclusive")
    return Spread(len(values), lower, median, upper)


def _group(keys: Mapping[GroupKey, str], rows: Sequence[AnyRow]) -> RunGroup:
    states = Counter(RunState(row.state) for row in rows)
    return RunGroup(
        keys=keys,
        runs=len(rows),
        seeds=tuple(sorted({row.seed for row in rows})),
        states={state: states[state] for state in RunState if state in states},
        spread=spread_of([row.value for row in rows if row.value is not None]),
        newest=max(row.number for row in rows),
    )


def _sorted(groups: Sequence[RunGroup], sort: GroupSort, descending: bool) -> list[RunGroup]:
    values: dict[str, Callable[[RunGroup], Any]] = {
        "launched": lambda group: group.newest,
        "runs": lambda group: group.runs,
        "median": lambda group: None if group.spread is None else group.spread.median,
    }
    value = values.get(sort, lambda group: group.keys.get(sort))  # pyright: ignore[reportArgumentType]
    newest_first = sorted(groups, key=lambda group: -group.newest)
    valued = [group for group in newest_first if value(group) is not None]
    # A stable sort, turned round by its key alone, leaves equals newest first both ways.
    return sorted(valued, key=value, reverse=descending) + [group for group in newest_first if value(group) is None]
