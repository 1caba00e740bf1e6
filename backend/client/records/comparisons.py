"""Comparisons over seeds as the service answers: curves, best models, and plain tables."""

from __future__ import annotations

from pydantic.dataclasses import dataclass

from backend.client.records import RECORD

Numbers = list[float | None]
"""A column; None where there is no number."""


@dataclass(frozen=True, config=RECORD)
class Group:
    """Runs that are the same but for their task and seed."""

    key: str
    method: str
    variant: str
    label: str
    """Its name for a person."""


@dataclass(frozen=True, config=RECORD)
class Member:
    """One seed of a curve."""

    run_id: str
    seed: int
    state: str
    points: int
    x: list[float] | None
    """Its own curve, if seeds were asked for."""
    y: list[float] | None


@dataclass(frozen=True, config=RECORD)
class Curve:
    """What the seeds of one group say in one task. Columns are as long as `x`."""

    group: str
    n: int
    """Seeds that have logged the metric at all."""
    x: list[float]
    centre: Numbers
    low: Numbers
    """Lower end of the band; None where it has fewer than three seeds."""
    high: Numbers
    n_at: list[int]
    """Seeds that count at each place."""
    holds: bool
    """Whether seeds that are done count on somewhere with their last value."""
    legend: str
    """Statistic, number of seeds and level in words."""
    members: list[Member]


@dataclass(frozen=True, config=RECORD)
class Panel:
    """One task's curves."""

    task: str
    curves: list[Curve]


@dataclass(frozen=True, config=RECORD)
class LeftOut:
    """A run that was asked for and is not in the answer."""

    run_id: str
    task: str
    group: str
    seed: int
    reason: str


@dataclass(frozen=True, config=RECORD)
class CurveComparison:
    """Learning curves of groups of runs, one panel a task."""

    version: str
    metric: str
    x: str
    statistic: str
    level: float
    groups: list[Group]
    panels: list[Panel]
    runs: int
    left_out: list[LeftOut]


@dataclass(frozen=True, config=RECORD)
class SeedScore:
    """The best test of one seed."""

    run_id: str
    seed: int
    state: str
    best: float
    epoch: float


@dataclass(frozen=True, config=RECORD)
class BestScore:
    """What the best models of one group reach in one task."""

    task: str
    group: str
    n: int
    centre: float | None
    low: float | None
    """Lower end of the interval; None below three seeds."""
    high: float | None
    seeds: list[SeedScore]


@dataclass(frozen=True, config=RECORD)
class Improvement:
    """How probably a run of one group beats a run of another, in a task drawn at random."""

    first: str
    second: str
    tasks: int
    probability: float
    low: float | None
    high: float | None


@dataclass(frozen=True, config=RECORD)
class Column:
    """One column of a plain table."""

    title: str


@dataclass(frozen=True, config=RECORD)
class Table:
    """What a chart shows, as rows."""

    name: str
    title: str
    columns: list[Column]
    rows: list[list[str | float | int | None]]


@dataclass(frozen=True, config=RECORD)
class BestModels:
    """The best models of groups of runs, compared."""

    version: str
    statistic: str
    level: float
    groups: list[Group]
    scores: list[BestScore]
    improvements: list[Improvement]
    tables: list[Table]
    runs: int
    left_out: list[LeftOut]
