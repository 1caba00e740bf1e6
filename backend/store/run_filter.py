"""Which runs a list holds: filters that narrow it, all at once."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from sqlalchemy import ColumnElement, String, cast, or_, select

from backend.store.states import RunState
from backend.store.tables import run_progress, run_tags, runs

SHORTEST_ID_WORD = 4
"""A shorter word is no beginning of an id: a search for seed 2 should not find every id with a 2."""


@dataclass(frozen=True)
class RunFilter:
    """Say which runs are wanted; what is empty or None leaves a question open."""

    states: Collection[RunState] = ()
    tasks: Collection[str] = ()
    phases: Collection[str] = ()
    methods: Collection[str] = ()
    presets: Collection[str] = ()
    settings: str | None = None
    """The hash that runs share which differ in nothing but the seed."""
    tags: Collection[str] = ()
    """Tags that a run must all have."""
    any_tags: Collection[str] = ()
    """Tags of which a run must have one."""
    no_tags: Collection[str] = ()
    """Tags of which a run must have none."""
    seed_from: int | None = None
    seed_to: int | None = None
    """Both ends are included."""
    success_from: float | None = None
    success_to: float | None = None
    """Bounds of the success of the newest test, both included; runs without a test pass neither."""
    search: str | None = None
    """Words that must all occur in task, method, phase, preset, state, a tag or the notes, or be the seed or the
    beginning of the id."""
    deleted: bool = False
    """Whether to return the runs that a person hid, instead of all others."""


def conditions(wanted: RunFilter) -> list[ColumnElement[bool]]:
    """Return what a row of runs, with its progress beside it, must fulfil."""
    one_of = {
        runs.c.state: wanted.states,
        runs.c.task: wanted.tasks,
        runs.c.phase: wanted.phases,
        runs.c.method: wanted.methods,
        runs.c.preset: wanted.presets,
        runs.c.settings_hash: () if wanted.settings is None else (wanted.settings,),
    }
    hidden = runs.c.deleted_at.is_not(None)
    return [
        hidden if wanted.deleted else ~hidden,
        *(column.in_(values) for column, values in one_of.items() if values),
        *_tagged(wanted),
        *_between(runs.c.seed, wanted.seed_from, wanted.seed_to),
        *_between(run_progress.c.success_rate, wanted.success_from, wanted.success_to),
        *(_mentions(word) for word in (wanted.search or "").split()),
    ]


def _tagged(wanted: RunFilter) -> list[ColumnElement[bool]]:
    found = [_has_one_of((tag,)) for tag in wanted.tags]
    if wanted.any_tags:
        found.append(_has_one_of(wanted.any_tags))
    if wanted.no_tags:
        found.append(~_has_one_of(wanted.no_tags))
    return found


def _has_one_of(tags: Collection[str]) -> ColumnElement[bool]:
    return runs.c.id.in_(select(run_tags.c.run_id).where(run_tags.c.tag.in_(tags)))


def _between(
    column: ColumnElement[float] | ColumnElement[int], low: float | None, high: float | None
) -> list[ColumnElement[bool]]:
    bounds = [] if low is None else [column >= low]
    return bounds if high is None else [*bounds, column <= high]


def _mentions(word: str) -> ColumnElement[bool]:
    columns = ("task", "method", "phase", "preset", "state", "notes")
    matches = [runs.c[name].icontains(word, autoescape=True) for name in columns]
    if len(word) >= SHORTEST_ID_WORD:
        matches.append(runs.c.id.istartswith(word, autoescape=True))
    tagged = select(run_tags.c.run_id).where(run_tags.c.tag.icontains(word, autoescape=True))
    return or_(*matches, runs.c.id.in_(tagged), cast(runs.c.seed, String) == word)
