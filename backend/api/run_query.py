"""What a request for runs narrows them to and sorts them by, read from its query string."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from fastapi import Depends, Query

from backend.store.metric_columns import MetricColumn, parse_column
from backend.store.run_filter import RunFilter
from backend.store.run_order import RunOrder, parse_order
from backend.store.states import RunState
from backend.store.tables import NAME_LENGTH
from sldr_core.config import Phase

MOST_NAMES = 50
"""Names that one filter may list."""
MOST_COLUMNS = 12
"""Metrics that one table may show."""
LARGEST_SEED = 2**31 - 1
"""Seeds are below this."""

_Name = Annotated[str, Query(max_length=NAME_LENGTH)]
_Names = tuple[_Name, ...]
SomeNames = Annotated[_Names, Query(max_length=MOST_NAMES)]
SeedBound = Annotated[int | None, Query(ge=0, le=LARGEST_SEED)]
SuccessBound = Annotated[float | None, Query(ge=0.0, le=1.0)]


@dataclass(frozen=True)
class RunQuery:
    """Hold a request's filters; what is left out leaves a question open."""

    state: Annotated[tuple[RunState, ...], Query(max_length=MOST_NAMES)] = ()
    task: SomeNames = ()
    method: SomeNames = ()
    phase: Annotated[tuple[Phase, ...], Query(max_length=MOST_NAMES)] = ()
    preset: SomeNames = ()
    settings: Annotated[
        str | None, Query(max_length=32, description="`settings_hash` of runs that differ in the seed alone.")
    ] = None
    tag: Annotated[_Names, Query(max_length=MOST_NAMES, description="Tags that a run must all have.")] = ()
    any_tag: Annotated[_Names, Query(max_length=MOST_NAMES, description="Tags of which it must have one.")] = ()
    no_tag: Annotated[_Names, Query(max_length=MOST_NAMES, description="Tags of which it must have none.")] = ()
    seed_from: SeedBound = None
    seed_to: SeedBound = None
    success_from: SuccessBound = None
    success_to: SuccessBound = None
    search: Annotated[
        str | None,
        Query(
            max_length=200,
            description="Words that task, method, phase, preset, state, a tag or notes hold, seeds, beginnings of ids.",
        ),
    ] = None
    deleted: Annotated[bool, Query(description="The runs that a person hid, instead of all others.")] = False

    def filter(self) -> RunFilter:
        """Return what the store is asked for."""
        return RunFilter(
            states=self.state,
            tasks=self.task,
            phases=self.phase,
            methods=self.method,
            presets=self.preset,
            settings=self.settings,
            tags=self.tag,
            any_tags=self.any_tag,
            no_tags=self.no_tag,
            seed_from=self.seed_from,
            seed_to=self.seed_to,
            success_from=self.success_from,
            success_to=self.success_to,
            search=self.search,
            deleted=self.deleted,
        )


@dataclass(frozen=True)
class TableQuery:
    """Hold the columns and the order of a request."""

    column: Annotated[
        _Names,
        Query(
            max_length=MOST_COLUMNS,
            description="Metrics to show, such as `test/success_rate:last`, `critic/task/loss:best` or `a/b:mean5`.",
        ),
    ] = ()
    sort: Annotated[
        str,
        Query(
            max_length=NAME_LENGTH,
            description="`launched`, `task`, `phase`, `method`, `seed`, `preset`, `state`, `progress`, `success` (of "
            "the newest test), `best`, `speed`, `left`, `duration`, or a metric written as in `column`.",
        ),
    ] = "launched"
    descending: bool = True

    def columns(self) -> list[MetricColumn]:
        """Return the metrics to show.

        Raises:
            InvalidConfig: one is written wrongly.
        """
        return [parse_column(text) for text in self.column]

    def order(self) -> RunOrder:
        """Return what to sort by.

        Raises:
            InvalidConfig: there is no such column.
        """
        return parse_order(self.sort, self.descending)


WantedRuns = Annotated[RunQuery, Depends()]
WantedTable = Annotated[TableQuery, Depends()]
