"""Learning curves: one panel a task, one curve a group, each with what its seeds say together."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from backend.comparison import words
from backend.comparison.groups import Grouping
from backend.comparison.memory import ComparisonMemory, data_version
from backend.comparison.records import (
    Axis,
    CurveComparison,
    CurveLoss,
    GroupCurve,
    LeftOut,
    Member,
    Numbers,
    Panel,
    Statistic,
)
from backend.comparison.selection import Selection, select_runs
from backend.statistics.alignment import Aligned, Curve, align, common_grid, find_losses
from backend.statistics.bands import BANDS, SEEDS_FOR_BAND
from backend.store.compared_runs import ComparedRun, RunChoice
from backend.store.curves import Points
from backend.store.database import Database
from backend.store.states import RunState

PLACES_AT_MOST = 400
"""Places of one curve in an answer; more than a panel has pixels helps nobody."""

SUCCESS_RATE = "test/success_rate"


@dataclass(frozen=True)
class CurveView:
    """Say what is looked at, and how."""

    metric: str = SUCCESS_RATE
    x: Axis = "epoch"
    statistic: Statistic = "median"
    level: float = 0.95
    """Share of the confidence interval, where the statistic has one."""
    with_seeds: bool = False
    """Whether to add each seed's own curve."""
    drop_ended: bool = False
    """Whether a run that is done counts no more behind its end; else its last value does."""
    anonymous: bool = False
    """Whether the names of groups hold no ids, which may tell who made the runs."""


def compare_curves(db: Database, memory: ComparisonMemory, choice: RunChoice, view: CurveView) -> CurveComparison:
    """Return the learning curves of runs."""
    selection = select_runs(db, memory, choice)
    version = data_version((choice, view), selection.runs)
    return memory.answer(version, lambda: _compare(selection, view, version))


def _compare(selection: Selection, view: CurveView, version: str) -> CurveComparison:
    grouping = selection.group(view.anonymous)
    read = selection.memory.curves(selection.db, selection.runs, view.metric)
    panels = [
        Panel(
            task=task,
            curves=[_group_curve(key, runs, read.curves, view) for key, runs in grouping.of_task(task)],
        )
        for task in grouping.tasks
    ]
    return CurveComparison(
        version=version,
        metric=view.metric,
        x=view.x,
        statistic=view.statistic,
        level=view.level,
        words=words.describe(view.metric, view.x, view.statistic, view.level),
        groups=grouping.groups,
        panels=panels,
        runs=len(selection.runs) - len(grouping.left_out),
        unread=selection.unread,
        every=read.every,
        left_out=[*grouping.left_out, *silent_runs(grouping, read.curves, view.metric)],
    )


def _group_curve(key: str, runs: list[ComparedRun], points: Mapping[str, Points], view: CurveView) -> GroupCurve:
    curves = [_curve(run, points[run.id], view) for run in runs if len(points[run.id])]
    aligned = align(curves, common_grid(curves, PLACES_AT_MOST))
    n, n_at = len(curves), aligned.n
    holds = bool((n_at > aligned.measured).any())
    has_band = view.statistic != "seeds" and n >= SEEDS_FOR_BAND
    centre, low, high = _band(aligned, view) if has_band else ([], [], [])
    shows_seeds = view.with_seeds or not has_band
    return GroupCurve(
        group=key,
        n=n,
        x=aligned.x.tolist(),
        centre=centre,
        low=low,
        high=high,
        n_at=n_at.tolist(),
        has_band=has_band,
        losses=_losses(aligned, centre),
        holds=holds,
        legend=words.legend(view.statistic, view.level, n, int(n_at.min(initial=n)), holds),
        members=[_member(run, points[run.id], view.x, shows_seeds) for run in runs],
    )


def _curve(run: ComparedRun, points: Points, view: CurveView) -> Curve:
    return Curve(points.axes[view.x], points.value, run.state is RunState.SUCCEEDED and not view.drop_ended)


def _band(aligned: Aligned, view: CurveView) -> tuple[Numbers, Numbers, Numbers]:
    assert view.statistic != "seeds"
    band = BANDS[view.statistic](aligned.y, view.level)
    return to_numbers(band.centre), to_numbers(band.low), to_numbers(band.high)


def _losses(aligned: Aligned, centre: Numbers) -> list[CurveLoss]:
    places = aligned.x.tolist()
    return [
        CurveLoss(x=loss.x, y=centre[places.index(loss.x)] if centre else None, before=loss.before, after=loss.after)
        for loss in find_losses(aligned)
    ]


def _member(run: ComparedRun, points: Points, x: Axis, shows_itself: bool) -> Member:
    own = thinned(points, PLACES_AT_MOST) if shows_itself else None
    return Member(
        run_id=run.id,
        seed=run.seed,
        state=run.state,
        points=len(points),
        x=None if own is None else own.axes[x].tolist(),
        y=None if own is None else own.value.tolist(),
    )


def thinned(points: Points, most: int) -> Points:
    """Return at most `most` points of a curve, spread evenly, the first and the last among them."""
    if len(points) <= most:
        return points
    kept = np.zeros(len(points), dtype=bool)
    kept[np.round(np.linspace(0, len(points) - 1, most)).astype(np.int64)] = True
    return points.where(kept)


def to_numbers(values: NDArray[np.float64]) -> Numbers:
    """Return an array as a list, null where it is NaN."""
    return [None if value != value else value for value in values.tolist()]


def silent_runs(grouping: Grouping, points: Mapping[str, Points], metric: str) -> list[LeftOut]:
    """Return the runs of a grouping that have nothing to show."""
    return [
        LeftOut(run_id=run.id, task=task, group=key, seed=run.seed, reason=f"It has not logged {metric} yet.")
        for (task, key), runs in grouping.cells.items()
        for run in runs
        if not len(points[run.id])
    ]
