"""The numbers behind figures as CSV: exactly those that are drawn, at full precision."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator, Sequence

from backend.comparison.records import BestModels, Cell, CurveComparison, GroupCurve, PlainTable

BEST_COLUMNS = ("task", "method", "variant", "seed", "best_success", "low", "high", "n", "epoch", "state")


def curves_csv(comparison: CurveComparison) -> str:
    """Return one row a place of each curve; rows of the aggregate have no seed, rows of a seed no interval."""
    groups = {group.key: group for group in comparison.groups}
    columns = ("task", "method", "variant", "seed", comparison.x, comparison.metric, "low", "high", "n")
    rows: Iterator[list[Cell]] = (
        [panel.task, groups[curve.group].method, groups[curve.group].variant, *row]
        for panel in comparison.panels
        for curve in panel.curves
        for row in _curve_rows(curve)
    )
    return write_csv(columns, rows)


def best_csv(best: BestModels) -> str:
    """Return one row a bar, and one for each seed beside it."""
    groups = {group.key: group for group in best.groups}
    rows: list[list[Cell]] = []
    for score in best.scores:
        names: list[Cell] = [score.task, groups[score.group].method, groups[score.group].variant]
        if score.centre is not None:
            rows.append([*names, None, score.centre, score.low, score.high, score.n, None, None])
        rows += [[*names, seed.seed, seed.best, None, None, None, seed.epoch, str(seed.state)] for seed in score.seeds]
    return write_csv(BEST_COLUMNS, rows)


def plain_csv(table: PlainTable) -> str:
    """Return a plain table as CSV."""
    return write_csv([column.title for column in table.columns], table.rows)


def _curve_rows(curve: GroupCurve) -> Iterator[list[Cell]]:
    if curve.has_band:
        for x, centre, low, high, n in zip(curve.x, curve.centre, curve.low, curve.high, curve.n_at, strict=True):
            yield [None, x, centre, low, high, n]
    for member in curve.members:
        if member.x is not None and member.y is not None:
            for x, y in zip(member.x, member.y, strict=True):
                yield [member.seed, x, y, None, None, None]


def write_csv(columns: Sequence[str], rows: Iterable[Sequence[Cell]]) -> str:
    """Return rows as CSV; numbers with all their digits, null as nothing."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([_printed(cell) for cell in row] for row in rows)
    return file.getvalue()


def _printed(cell: Cell) -> str | int:
    if cell is None:
        return ""
    return repr(cell) if isinstance(cell, float) else cell
