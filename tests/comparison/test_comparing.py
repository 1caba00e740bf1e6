"""Comparisons over a store: what their numbers are, with ragged, resumed, missing and live seeds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import scipy.stats
from numpy.testing import assert_allclose
from store_cases import claim_next, order, step

from backend.comparison import memory as memories
from backend.comparison.best import compare_best
from backend.comparison.configs import compare_configs
from backend.comparison.curves import CurveView, compare_curves
from backend.comparison.memory import ComparisonMemory
from backend.comparison.models import name_models
from backend.comparison.records import CurveComparison, GroupCurve, Numbers, Statistic
from backend.store.claims import Claim
from backend.store.compared_runs import ComparedRun, RunChoice, find_compared_runs
from backend.store.database import Database
from backend.store.errors import NotFound
from backend.store.launches import launch
from backend.store.metrics import MetricPoint, append_metrics, read_metrics
from backend.store.outcomes import Failed, HandedBack, Succeeded
from backend.store.queue import finish
from backend.store.states import RunState
from sldr_core.config import config_to_dict
from sldr_core.presets import make_config

SUCCESS = "test/success_rate"


def log(db: Database, claim: Claim, values: dict[int, float]) -> None:
    append_metrics(db, claim, [MetricPoint(step(cycle), {SUCCESS: value}) for cycle, value in values.items()])


def compare(db: Database, memory: ComparisonMemory | None = None, **view) -> CurveComparison:
    return compare_curves(db, memory or ComparisonMemory(), RunChoice(), CurveView(**{"x": "updates", **view}))


def only_curve(db: Database, memory: ComparisonMemory | None = None, **view) -> GroupCurve:
    [panel] = compare(db, memory, **view).panels
    [curve] = panel.curves
    return curve


def floats(numbers: Numbers) -> np.ndarray:
    """Return numbers as an array, NaN where there is none."""
    return np.array(numbers, dtype=np.float64)


def seeds_of(db: Database, task: str, method: str) -> list[list[float]]:
    """Read each seed's curve the way a run's own page does."""
    runs = find_compared_runs(db, RunChoice(tasks=[task], methods=[method])).runs
    columns = [read_metrics(db, run.id).values[SUCCESS] for run in sorted(runs, key=lambda run: run.seed)]
    return [[value for value in column if value is not None] for column in columns]


def test_the_median_is_that_of_the_runs_own_curves(sample_db: Database):
    comparison = compare(sample_db, x="epoch")
    assert [panel.task for panel in comparison.panels] == ["FetchPush", "FetchSlide"]
    for panel in comparison.panels:
        for curve in panel.curves:
            seeds = np.array(seeds_of(sample_db, panel.task, curve.group))
            assert curve.x == list(range(1, 11))
            assert_allclose(floats(curve.centre), np.median(seeds, axis=0))
            assert_allclose([floats(curve.low), floats(curve.high)], np.percentile(seeds, [25, 75], axis=0))
            assert (curve.n, set(curve.n_at), curve.losses) == (3, {3}, [])


def test_the_legend_says_statistic_number_and_level(sample_db: Database):
    names: tuple[Statistic, ...] = ("median", "mean", "iqm", "seeds")
    views = {name: compare(sample_db, statistic=name, level=0.9) for name in names}
    legends = {name: view.panels[0].curves[0].legend for name, view in views.items()}
    assert legends == {
        "median": "median of 3 seeds, band: quartiles (25 to 75 %)",
        "mean": "mean of 3 seeds, band: 90 % confidence (Student's t)",
        "iqm": "interquartile mean of 3 seeds, band: 90 % confidence (bootstrap over seeds)",
        "seeds": "3 seeds, each by itself",
    }


def test_runs_of_one_config_that_learn_from_different_models_are_two_curves(db: Database):
    models = [launch(db, order(phase="locomotion", seeds=(seed,)))[0] for seed in (1, 2)]
    for _ in models:
        finish(db, claim_next(db), Succeeded(1.0))
    for model in models:
        launch(db, order(method="her-sldr", seeds=(0, 1), locomotion=model))
    for _ in range(4):
        log(db, claim_next(db), {1: 0.5})
    comparison = compare(db)
    assert {group.variant for group in comparison.groups} == {f"locomotion {model}" for model in models}
    assert [curve.n for curve in comparison.panels[0].curves] == [2, 2]
    assert comparison.left_out == []


def test_a_model_that_was_trained_again_or_on_another_machine_is_the_same_model():
    config = config_to_dict(make_config("FetchPush", "locomotion", "her", 0, "smoke"))
    elsewhere = {**config, "compute": {**config["compute"], "threads": 7}}
    other = {**config, "seed": 1}
    run = ComparedRun("a", 1, "FetchPush", "manipulation", "her-sldr", 0, "smoke", 1, "hash", RunState.SUCCEEDED, 5)
    runs = [replace(run, id=needed, needs=(needed,)) for needed in ("first", "second", "third", "gone")]
    names = name_models(runs, {"first": config, "second": elsewhere, "third": other})
    assert names == {"first": "first", "second": "first", "third": "third"}


def test_ragged_seeds_are_counted_where_they_are_and_the_loss_is_marked(db: Database):
    launch(db, order(seeds=(0, 1, 2, 3)))
    for last in (4, 4, 4, 2):
        log(db, claim_next(db), {cycle: cycle / 10 for cycle in range(1, last + 1)})
    curve = only_curve(db)
    assert curve.n_at == [4, 4, 3, 3]
    assert [(loss.x, loss.y, loss.before, loss.after) for loss in curve.losses] == [(8.0, 0.2, 4, 3)]
    assert curve.legend.startswith("median of 3 to 4 seeds")


def test_a_run_that_is_done_keeps_its_last_value_and_one_that_failed_does_not(db: Database):
    launch(db, order(seeds=(0, 1, 2, 3)))
    for last, outcome in (
        (2, Succeeded(0.2)),
        (2, Failed("It broke.", False)),
        (4, Succeeded(0.4)),
        (4, Succeeded(0.4)),
    ):
        claim = claim_next(db)
        log(db, claim, {cycle: cycle / 10 for cycle in range(1, last + 1)})
        finish(db, claim, outcome)

    curve, dropped = only_curve(db), only_curve(db, drop_ended=True)

    assert (curve.n_at, dropped.n_at) == ([4, 4, 3, 3], [4, 4, 2, 2])
    assert curve.centre == pytest.approx([0.1, 0.2, 0.3, 0.4])
    assert curve.low == pytest.approx([0.1, 0.2, 0.25, 0.3])
    assert [(loss.x, loss.before, loss.after) for loss in curve.losses] == [(8.0, 4, 2)]
    assert [(loss.x, loss.before, loss.after) for loss in dropped.losses] == [(8.0, 4, 2)]
    assert curve.legend == (
        "median of 3 to 4 seeds, those that are done with their last value, band: quartiles (25 to 75 %)"
    )
    assert dropped.legend == "median of 2 to 4 seeds, band: quartiles (25 to 75 %)"
    assert (curve.holds, dropped.holds) == (True, False)


def test_below_three_seeds_each_is_drawn_by_itself(db: Database):
    launch(db, order(seeds=(0, 1)))
    for value in (0.2, 0.4):
        log(db, claim_next(db), {1: value, 2: value})
    curve = only_curve(db, statistic="mean")
    assert (curve.has_band, curve.centre, curve.low) == (False, [], [])
    assert [member.y for member in curve.members] == [[0.2, 0.2], [0.4, 0.4]]
    assert curve.legend == "2 seeds, each by itself: too few for a band"


def test_a_band_ends_where_two_seeds_are_left(db: Database):
    launch(db, order(seeds=(0, 1, 2)))
    for last in (2, 2, 1):
        log(db, claim_next(db), {cycle: 0.5 for cycle in range(1, last + 1)})
    curve = only_curve(db)
    assert (curve.centre, curve.low) == ([0.5, 0.5], [0.5, None])


def test_a_seed_that_has_logged_nothing_is_named_and_does_not_count(db: Database):
    ids = launch(db, order(seeds=(0, 1, 2, 3)))
    for _ in range(3):
        log(db, claim_next(db), {1: 0.5})
    comparison = compare(db)
    assert comparison.panels[0].curves[0].n == 3
    assert [(left.run_id, left.seed) for left in comparison.left_out] == [(ids[3], 3)]


def test_a_resumed_seed_counts_with_what_its_last_attempt_says(db: Database):
    launch(db, order())
    first = claim_next(db)
    log(db, first, {1: 0.1, 2: 0.2, 3: 0.3})
    finish(db, first, HandedBack("Its worker was asked to end."))
    log(db, claim_next(db), {2: 0.7})
    [member] = only_curve(db).members
    assert (member.x, member.y) == ([4.0, 8.0], [0.1, 0.7])


def test_a_live_curve_goes_on_in_the_same_memory_as_in_a_fresh_one(db: Database):
    memory = ComparisonMemory()
    launch(db, order())
    first = claim_next(db)
    log(db, first, {1: 0.1, 2: 0.2})
    before = compare(db, memory)
    log(db, first, {3: 0.3, 4: 0.4})
    assert only_curve(db, memory).members == only_curve(db).members
    finish(db, first, HandedBack("Its worker was asked to end."))
    log(db, claim_next(db), {3: 0.9})
    after = compare(db, memory)
    assert after.panels == compare(db).panels
    assert after.version != before.version


def test_the_same_data_are_not_computed_twice(sample_db: Database, monkeypatch: pytest.MonkeyPatch):
    memory = ComparisonMemory()
    first = compare(sample_db, memory)
    assert compare(sample_db, memory, statistic="mean").version != first.version
    monkeypatch.setattr(memories, "read_points", None)
    assert compare(sample_db, memory) is first


def test_memory_is_bounded(sample_db: Database, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(memories, "POINTS_KEPT", 35)
    monkeypatch.setattr(memories, "ANSWERS_KEPT", 2)
    memory = ComparisonMemory()
    expected = compare(sample_db).panels
    for statistic in ("median", "mean", "iqm", "seeds", "median"):
        answer = compare(sample_db, memory, statistic=statistic)
    assert answer.panels == expected
    assert memory.size == (30, 2)


def test_best_scores_are_the_highest_tests_of_each_seed(sample_db: Database):
    best = compare_best(sample_db, ComparisonMemory(), RunChoice(), CurveView(statistic="mean"))
    for score in best.scores:
        highest = [max(seed) for seed in seeds_of(sample_db, score.task, score.group)]
        assert [seed.best for seed in score.seeds] == highest
        interval = scipy.stats.t.interval(0.95, 2, np.mean(highest), scipy.stats.sem(highest))
        assert_allclose(floats([score.centre, score.low, score.high]), [np.mean(highest), *interval])


def test_every_chart_of_best_models_has_its_table(sample_db: Database):
    best = compare_best(sample_db, ComparisonMemory(), RunChoice(), CurveView())
    rows = {table.name: len(table.rows) for table in best.tables}
    assert rows == {"scores": 4, "overall": 2, "improvements": 2, "profiles": 2 * 101, "efficiency": 4 * 2 * 3}
    assert all(len(row) == len(table.columns) for table in best.tables for row in table.rows)
    one, other = best.improvements
    assert one.probability + other.probability == pytest.approx(1)


def test_so_many_groups_are_not_set_against_each_other(sample_db: Database, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("backend.comparison.best.MOST_PAIRED", 1)
    best = compare_best(sample_db, ComparisonMemory(), RunChoice(), CurveView())
    assert (best.improvements, len(best.scores)) == ([], 4)
    assert {table.name: len(table.rows) for table in best.tables}["improvements"] == 0


def test_efficiency_is_where_each_seed_first_reaches_a_success(sample_db: Database):
    best = compare_best(sample_db, ComparisonMemory(), RunChoice(), CurveView())
    for effort in best.efficiency:
        if effort.axis == "env_steps":
            curves = seeds_of(sample_db, effort.task, effort.group)
            first = [next((95_000 * (at + 1) for at, y in enumerate(c) if y >= effort.threshold), None) for c in curves]
            assert [seed.reached for seed in effort.seeds] == first


def test_groups_without_a_shared_task_are_not_compared_over_all(db: Database):
    launch(db, order(method="her"))
    log(db, claim_next(db), {1: 0.5})
    launch(db, order(method="ddpg", task="FetchSlide"))
    log(db, claim_next(db), {1: 0.5})
    best = compare_best(db, ComparisonMemory(), RunChoice(), CurveView())
    assert (best.overall_tasks, best.overall, best.profiles, best.improvements) == ([], [], [], [])
    assert len(best.scores) == 2


def test_an_empty_store_compares_nothing(db: Database):
    assert compare(db).panels == []
    assert compare_best(db, ComparisonMemory(), RunChoice(), CurveView()).scores == []


def test_configs_differ_in_what_is_told_and_share_the_rest(db: Database):
    [first] = launch(db, order())
    second = launch(db, order(method="her-sldr", seeds=(1,), overrides={"agent": {"gamma": 0.9}}))[-1]
    comparison = compare_configs(db, [first, second])
    values = {setting.name: setting.values for setting in comparison.settings}
    assert values == {"method": ["her", "her-sldr"], "seed": ["0", "1"], "agent.gamma": ["0.98", "0.9"]}
    assert comparison.shared > 30
    [pair] = comparison.methods
    assert [(switch.name, switch.first, switch.second) for switch in pair.switches] == [("auxiliary", "none", "sldr")]


def test_a_run_that_does_not_exist_cannot_be_compared(db: Database):
    with pytest.raises(NotFound, match="nope"):
        compare_configs(db, ["nope"])
