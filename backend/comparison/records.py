"""What a comparison answers: the records of API and figures alike. Arrays are plain lists, null where empty."""

from __future__ import annotations

from typing import Literal

from pydantic import ConfigDict
from pydantic.dataclasses import dataclass

from backend.statistics.bands import Aggregate
from backend.store.states import RunState

RECORD = ConfigDict(extra="forbid", use_attribute_docstrings=True)

Axis = Literal["epoch", "env_steps", "episodes", "updates", "wall_seconds"]
"""What a curve is drawn over."""

Statistic = Literal[Aggregate, "seeds"]
"""How the seeds of a group are shown: one number with a band, or each by itself."""

Numbers = list[float | None]
"""A column; null where there is no number."""

Cell = str | float | int | None


@dataclass(frozen=True, config=RECORD)
class Group:
    """Runs that are the same but for their task and seed."""

    key: str
    """Names the group in every record of the answer, and in addresses."""
    method: str
    variant: str
    """What tells it apart from the method's other groups; empty if there is nothing."""
    label: str
    """Its name for a person: the method's title, and the variant if there is one."""
    color: int
    """Which colour of the palette it has: its method's, everywhere the same, where several methods are compared."""
    dash: int
    """Which dash pattern of the palette it has; variants of a method differ in it."""


@dataclass(frozen=True, config=RECORD)
class Member:
    """One seed of a curve."""

    run_id: str
    seed: int
    state: RunState
    points: int
    """How often it has logged the metric."""
    x: list[float] | None
    """Its own curve, every point of it up to a limit; null if only the aggregate was asked for."""
    y: list[float] | None
    """As long as `x`."""


@dataclass(frozen=True, config=RECORD)
class CurveLoss:
    """Where seeds of a curve end while others go on."""

    x: float
    """The last place that has them all."""
    y: float | None
    """The curve's centre there."""
    before: int
    """Seeds that are still trained there."""
    after: int
    """Seeds that still are behind it."""


@dataclass(frozen=True, config=RECORD)
class GroupCurve:
    """What the seeds of one group say in one task. Columns are as long as `x`."""

    group: str
    """The group's key."""
    n: int
    """Seeds that have logged the metric at all."""
    x: list[float]
    centre: Numbers
    """Empty when each seed is shown by itself."""
    low: Numbers
    """Lower end of the band; null where it has fewer than three seeds."""
    high: Numbers
    n_at: list[int]
    """Seeds that count at each place."""
    has_band: bool
    """False if the seeds' own lines are to be drawn: asked for, or too few for a band."""
    losses: list[CurveLoss]
    holds: bool
    """Whether seeds that are done count on somewhere with their last value."""
    legend: str
    """Statistic, number of seeds and level in words."""
    members: list[Member]


@dataclass(frozen=True, config=RECORD)
class Panel:
    """One task's curves."""

    task: str
    curves: list[GroupCurve]


@dataclass(frozen=True, config=RECORD)
class LeftOut:
    """A run that was asked for and is not in the answer."""

    run_id: str
    task: str
    group: str
    """Its group's key."""
    seed: int
    reason: str
    """Why, in one sentence."""


@dataclass(frozen=True, config=RECORD)
class Words:
    """The view in words, the same on the page, in figures and in tables."""

    metric: str
    """Label of the vertical axis."""
    x: str
    """Label of the horizontal axis."""
    statistic: str
    """What line and band are, with level."""


@dataclass(frozen=True, config=RECORD)
class CurveComparison:
    """Learning curves of groups of runs, one panel a task."""

    version: str
    """Changes when the answer does: the hash of the data that it was computed from."""
    metric: str
    x: Axis
    statistic: Statistic
    level: float
    words: Words
    groups: list[Group]
    """In the order of the legend."""
    panels: list[Panel]
    """In the paper's order of tasks."""
    runs: int
    """Runs in the answer."""
    unread: int
    """Further runs that pass the filters; only the newest are read."""
    every: int
    """1 if each cycle was read, k if every k-th: a metric of so many points is thinned."""
    left_out: list[LeftOut]


@dataclass(frozen=True, config=RECORD)
class MetricNames:
    """What can be compared."""

    metrics: list[str]


@dataclass(frozen=True, config=RECORD)
class SeedScore:
    """The best test of one seed."""

    run_id: str
    seed: int
    state: RunState
    best: float
    """Its highest value."""
    epoch: float
    """When it was first reached."""
    tests: int
    """Tests that the highest was taken from."""


@dataclass(frozen=True, config=RECORD)
class BestScore:
    """What the best models of one group reach in one task."""

    task: str
    group: str
    n: int
    centre: float | None
    low: float | None
    """Lower end of the interval; null below three seeds."""
    high: float | None
    seeds: list[SeedScore]


@dataclass(frozen=True, config=RECORD)
class OverallScore:
    """What the best models of one group reach over all tasks that every group has."""

    group: str
    tasks: int
    n: int
    """Runs, over all tasks."""
    iqm: float | None
    low: float | None
    high: float | None


@dataclass(frozen=True, config=RECORD)
class Improvement:
    """How probably a run of one group beats a run of another, in a task drawn at random."""

    first: str
    """Key of the group that may be better."""
    second: str
    """Key of the group that it is compared with."""
    tasks: int
    """Tasks that both have."""
    probability: float
    """Ties count half."""
    low: float | None
    """Lower end of the bootstrap interval; null if a task has fewer than three seeds of either."""
    high: float | None


@dataclass(frozen=True, config=RECORD)
class Profile:
    """Which share of a group's runs is better than each threshold, every task weighing the same."""

    group: str
    tasks: int
    n: int
    thresholds: list[float]
    share: list[float]
    low: Numbers
    high: Numbers


@dataclass(frozen=True, config=RECORD)
class SeedReach:
    """When one seed first reached a threshold."""

    run_id: str
    seed: int
    reached: float | None
    """Null if it has not."""
    observed: float
    """How long it has been watched."""


@dataclass(frozen=True, config=RECORD)
class Efficiency:
    """How much one group needs in one task until a test first reaches a threshold."""

    task: str
    group: str
    threshold: float
    axis: Literal["env_steps", "wall_seconds"]
    n: int
    reached: int
    """Seeds that have reached it."""
    median: float | None
    """Null if half of the seeds or more have not reached it."""
    low: float | None
    """First quartile, likewise."""
    high: float | None
    """Third quartile, likewise."""
    seeds: list[SeedReach]


@dataclass(frozen=True, config=RECORD)
class TableColumn:
    """One column of a plain table."""

    title: str


@dataclass(frozen=True, config=RECORD)
class PlainTable:
    """What a chart shows, as rows."""

    name: str
    title: str
    columns: list[TableColumn]
    rows: list[list[Cell]]


@dataclass(frozen=True, config=RECORD)
class BestModels:
    """The best models of groups of runs, compared."""

    version: str
    """Changes when the answer does."""
    statistic: Statistic
    level: float
    words: Words
    groups: list[Group]
    scores: list[BestScore]
    """The bars of the paper's figure."""
    overall: list[OverallScore]
    overall_tasks: list[str]
    """The tasks that every group has; `overall` and `profiles` are over them."""
    improvements: list[Improvement]
    profiles: list[Profile]
    efficiency: list[Efficiency]
    tables: list[PlainTable]
    """A plain table behind each chart."""
    runs: int
    unread: int
    left_out: list[LeftOut]


@dataclass(frozen=True, config=RECORD)
class ComparedConfig:
    """One run of a comparison of configs."""

    run_id: str
    task: str
    phase: str
    method: str
    seed: int
    preset: str


@dataclass(frozen=True, config=RECORD)
class Setting:
    """A setting in which runs differ."""

    name: str
    values: list[str | None]
    """As text, one a run; null where a run does not have it."""


@dataclass(frozen=True, config=RECORD)
class MethodSwitch:
    """One thing by which two methods differ."""

    name: str
    title: str
    first: str
    second: str


@dataclass(frozen=True, config=RECORD)
class MethodPair:
    """By what two methods differ."""

    first: str
    second: str
    switches: list[MethodSwitch]


@dataclass(frozen=True, config=RECORD)
class ConfigComparison:
    """By what the configs of runs differ; settings that all share are left out."""

    runs: list[ComparedConfig]
    settings: list[Setting]
    shared: int
    """Settings in which all are alike."""
    methods: list[MethodPair]
    """Each pair of different methods among the runs."""
