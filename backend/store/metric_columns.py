"""A metric as a column of the runs table: its newest value, its best, or the mean of its last ones."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from sqlalchemy import ColumnElement, FromClause, and_, case, func, literal

from backend.store.metric_summaries import TAIL_LENGTH
from backend.store.tables import NAME_LENGTH, metric_summaries, runs
from sldr_core.errors import InvalidConfig

LESS_IS_BETTER = ("loss", "error", "distance", "drift")
"""The best value of a metric whose name ends so is its lowest; of any other its highest."""

_WRITTEN = re.compile(r"(?P<name>[^:,]+):(?:(?P<statistic>last|best)|mean(?P<window>\d{1,3}))")

Statistic = Literal["last", "best", "mean"]


@dataclass(frozen=True)
class MetricColumn:
    """Name a metric and what is wanted of it."""

    name: str
    statistic: Statistic = "last"
    window: int = 1
    """Newest values that a mean is taken over, or all if there are fewer."""

    def __str__(self) -> str:
        """Return the column as it is written."""
        return f"{self.name}:{self.statistic}{self.window if self.statistic == 'mean' else ''}"

    def value(self, summary: FromClause) -> ColumnElement[float]:
        """Return the column's value of a run whose summary of the metric is at hand."""
        if self.statistic == "last":
            return summary.c.last
        if self.statistic == "best":
            return summary.c.lowest if self.name.endswith(LESS_IS_BETTER) else summary.c.highest
        total: ColumnElement[float] = literal(0.0)
        for index in range(self.window):
            total += func.coalesce(summary.c.tail[index].as_float(), 0.0)
        few, many = summary.c.points < self.window, summary.c.points >= self.window
        return total / case((few, summary.c.points), (many, self.window))


def parse_column(text: str, field: str = "column") -> MetricColumn:
    """Read a column such as `test/success_rate:last`, `test/success_rate:best` or `critic/task/loss:mean10`.

    Raises:
        InvalidConfig: it is none; `field` is blamed.
    """
    written = _WRITTEN.fullmatch(text)
    window = int(written["window"] or 1) if written else 0
    if written is None or not 1 <= window <= TAIL_LENGTH or len(written["name"]) > NAME_LENGTH:
        problem = f"'{text}' is no column; write a metric with :last, :best or :mean1 to :mean{TAIL_LENGTH}."
        raise InvalidConfig({field: problem})
    statistic: Statistic = "best" if written["statistic"] == "best" else "mean" if written["window"] else "last"
    return MetricColumn(written["name"], statistic, window)


def join_summaries(
    rows: FromClause, columns: Iterable[MetricColumn]
) -> tuple[FromClause, Mapping[MetricColumn, ColumnElement[float]]]:
    """Return rows of runs with the summaries that the columns need beside them, and each column's value."""
    joined: dict[str, FromClause] = {}
    values: dict[MetricColumn, ColumnElement[float]] = {}
    for column in columns:
        if column.name not in joined:
            summary = metric_summaries.alias(f"summary_{len(joined)}")
            rows = rows.outerjoin(summary, and_(summary.c.run_id == runs.c.id, summary.c.name == column.name))
            joined[column.name] = summary
        values[column] = column.value(joined[column.name])
    return rows, values
