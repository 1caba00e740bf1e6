"""Best models: the paper's bar figure and what else one number a run can say about groups of runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from backend.comparison import words
from backend.comparison.best_tables import make_tables
from backend.comparison.curves import SUCCESS_RATE, CurveView, silent_runs, to_numbers
from backend.comparison.groups import Grouping
from backend.comparison.memory import ComparisonMemory, data_version
from backend.comparison.records import (
    BestModels,
    BestScore,
    Efficiency,
    Improvement,
    OverallScore,
    Profile,
    SeedReach,
    SeedScore,
)
from backend.comparison.selection import Selection, select_runs
from backend.statistics.alignment import Curve
from backend.statistics.bands import BANDS, SEEDS_FOR_BAND
from backend.statistics.efficiency import time_to_reach, times_to_reach
from backend.statistics.scores import Estimate, overall_iqm, performance_profile, probability_of_improvement
from backend.store.compared_runs import ComparedRun, RunChoice
from backend.store.curves import Points
from backend.store.database import Database

REACHED = (0.5, 0.8, 0.9)
"""Test success whose first reaching is timed."""

EFFORTS: tuple[Literal["env_steps", "wall_seconds"], ...] = ("env_steps", "wall_seconds")
"""What is counted until then."""

MOST_PAIRED = 40
"""Beyond so many groups none are set against each other: pairs grow with their square, and each is drawn anew often."""

PROFILE_THRESHOLDS = np.linspace(0.0, 1.0, 101)
"""Test success that a performance profile is read at."""

Floats = NDArray[np.float64]
Cells = Mapping[tuple[str, str], list[ComparedRun]]


@dataclass(frozen=True)
class _Scored:
    """Hold the runs that have been tested, and their tests."""

    grouping: Grouping
    cells: Cells
    points: Mapping[str, Points]

    def scores(self, task: str, group: str) -> Floats:
        """Return the best test success of each seed `[N]`."""
        return np.array([self.points[run.id].value.max() for run in self.cells[task, group]])

    def tasks_of(self, *groups: str) -> list[str]:
        """Return the tasks that all of these groups have, in the paper's order."""
        return [task for task in self.grouping.tasks if all((task, group) in self.cells for group in groups)]


def compare_best(db: Database, memory: ComparisonMemory, choice: RunChoice, view: CurveView) -> BestModels:
    """Compare the best test success of runs; of the view, statistic, level and names count."""
    selection = select_runs(db, memory, choice)
    version = data_version(("best", choice, view.statistic, view.level, view.anonymous), selection.runs)
    return memory.answer(version, lambda: _compare(selection, view, version))


def _compare(selection: Selection, view: CurveView, version: str) -> BestModels:
    grouping = selection.group(view.anonymous)
    points = selection.memory.curves(selection.db, selection.runs, SUCCESS_RATE).curves
    tested = {cell: [run for run in runs if len(points[run.id])] for cell, runs in grouping.cells.items()}
    cells = {cell: runs for cell, runs in tested.items() if runs}
    scored = _Scored(grouping, cells, points)
    groups = [group.key for group in grouping.groups if any(key == group.key for _, key in cells)]
    common = scored.tasks_of(*groups) if groups else []
    scores = [_best_score(scored, task, key, view) for task, key in _ordered(grouping, cells)]
    overall = [_overall(scored, group, common, view.level) for group in groups if common]
    improvements = _improvements(scored, groups, view.level)
    profiles = [_profile(scored, group, common, view.level) for group in groups if common]
    efficiency = [
        _efficiency(scored, task, key, threshold, axis)
        for task, key in _ordered(grouping, cells)
        for axis in EFFORTS
        for threshold in REACHED
    ]
    return BestModels(
        version=version,
        statistic=view.statistic,
        level=view.level,
        words=words.describe("test/best_success_rate", "epoch", view.statistic, view.level),
        groups=grouping.groups,
        scores=scores,
        overall=overall,
        overall_tasks=common,
        improvements=improvements,
        profiles=profiles,
        efficiency=efficiency,
        tables=make_tables(grouping.groups, scores, overall, improvements, profiles, efficiency),
        runs=len(selection.runs) - len(grouping.left_out),
        unread=selection.unread,
        left_out=[*grouping.left_out, *silent_runs(grouping, points, SUCCESS_RATE)],
    )


def _ordered(grouping: Grouping, cells: Cells) -> list[tuple[str, str]]:
    return [(task, key) for task in grouping.tasks for key, _ in grouping.of_task(task) if (task, key) in cells]


def _best_score(scored: _Scored, task: str, group: str, view: CurveView) -> BestScore:
    runs, scores = scored.cells[task, group], scored.scores(task, group)
    centre = low = high = None
    if view.statistic != "seeds":
        band = BANDS[view.statistic](scores[:, None], view.level)
        centre, low, high = (to_numbers(end)[0] for end in (band.centre, band.low, band.high))
    return BestScore(
        task=task,
        group=group,
        n=len(runs),
        centre=centre,
        low=low,
        high=high,
        seeds=[_seed_score(run, scored.points[run.id]) for run in runs],
    )


def _seed_score(run: ComparedRun, points: Points) -> SeedScore:
    at = int(points.value.argmax())
    return SeedScore(
        run_id=run.id,
        seed=run.seed,
        state=run.state,
        best=float(points.value[at]),
        epoch=float(points.axes["epoch"][at]),
        tests=len(points),
    )


def _overall(scored: _Scored, group: str, tasks: Sequence[str], level: float) -> OverallScore:
    scores = [scored.scores(task, group) for task in tasks]
    estimate = overall_iqm(scores, level)
    low, high = _interval(estimate, scores)
    return OverallScore(
        group=group, tasks=len(tasks), n=sum(map(len, scores)), iqm=float(estimate.value), low=low, high=high
    )


def _improvements(scored: _Scored, groups: Sequence[str], level: float) -> list[Improvement]:
    if len(groups) > MOST_PAIRED:
        return []
    found: list[Improvement] = []
    for first, second in combinations(groups, 2):
        tasks = scored.tasks_of(first, second)
        if tasks:
            found += _improvement_both_ways(scored, first, second, tasks, level)
    return found


def _improvement_both_ways(
    scored: _Scored, first: str, second: str, tasks: Sequence[str], level: float
) -> list[Improvement]:
    one, other = ([scored.scores(task, group) for task in tasks] for group in (first, second))
    estimate = probability_of_improvement(one, other, level)
    low, high = _interval(estimate, [*one, *other])
    probability = float(estimate.value)
    return [
        Improvement(first, second, len(tasks), probability, low, high),
        Improvement(
            second,
            first,
            len(tasks),
            1.0 - probability,
            None if high is None else 1.0 - high,
            None if low is None else 1.0 - low,
        ),
    ]


def _profile(scored: _Scored, group: str, tasks: Sequence[str], level: float) -> Profile:
    scores = [scored.scores(task, group) for task in tasks]
    estimate = performance_profile(scores, PROFILE_THRESHOLDS, level)
    has_band = min(map(len, scores)) >= SEEDS_FOR_BAND
    low, high = (to_numbers(end if has_band else np.full_like(end, np.nan)) for end in (estimate.low, estimate.high))
    return Profile(
        group=group,
        tasks=len(tasks),
        n=sum(map(len, scores)),
        thresholds=PROFILE_THRESHOLDS.tolist(),
        share=estimate.value.tolist(),
        low=low,
        high=high,
    )


def _efficiency(
    scored: _Scored, task: str, group: str, threshold: float, axis: Literal["env_steps", "wall_seconds"]
) -> Efficiency:
    seeds: list[SeedReach] = []
    for run in scored.cells[task, group]:
        points = scored.points[run.id]
        curve = Curve(points.axes[axis], points.value)
        seeds.append(SeedReach(run.id, run.seed, time_to_reach(curve, threshold), float(curve.x[-1])))
    times = times_to_reach([seed.reached for seed in seeds])
    return Efficiency(
        task=task,
        group=group,
        threshold=threshold,
        axis=axis,
        n=len(seeds),
        reached=times.reached,
        median=times.median,
        low=times.low if len(seeds) >= SEEDS_FOR_BAND else None,
        high=times.high if len(seeds) >= SEEDS_FOR_BAND else None,
        seeds=seeds,
    )


def _interval(estimate: Estimate, scores: Sequence[Floats]) -> tuple[float | None, float | None]:
    """Return an interval, or none if a task has too few seeds for one."""
    if min(map(len, scores)) < SEEDS_FOR_BAND:
        return None, None
    return float(estimate.low), float(estimate.high)
