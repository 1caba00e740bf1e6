"""One metric of many runs: what counts of it, what is new, and which runs a comparison is about."""

from __future__ import annotations

import pytest
from sqlalchemy import text
from store_cases import claim_next, order, step
from study_cases import small_spec

from backend.store import curves
from backend.store.actions import Action, act
from backend.store.claims import Claim
from backend.store.compared_runs import ComparedRun, RunChoice, find_compared_runs, read_configs
from backend.store.curves import list_metric_names, read_points, without_superseded
from backend.store.database import Database
from backend.store.errors import NotFound
from backend.store.launches import launch
from backend.store.metrics import MetricPoint, append_metrics, read_metrics
from backend.store.outcomes import HandedBack
from backend.store.queue import finish
from backend.store.studies.launch import create_study

SUCCESS = "test/success_rate"


def log(db: Database, claim: Claim, *cycles: int, value: float = 0.5) -> None:
    """Log a test at even cycles, and a loss at each."""
    points = [
        MetricPoint(step(cycle), {"critic/task/loss": 1.0} | ({SUCCESS: value + cycle} if cycle % 2 == 0 else {}))
        for cycle in cycles
    ]
    append_metrics(db, claim, points)


def next_attempt(db: Database, claim: Claim) -> Claim:
    finish(db, claim, HandedBack("Its worker was asked to end."))
    return claim_next(db)


def found(db: Database, **choice) -> list[ComparedRun]:
    return find_compared_runs(db, RunChoice(**choice)).runs


def curve(db: Database, run: ComparedRun, metric: str = SUCCESS) -> dict[int, float]:
    """Return what counts of a metric, by cycle."""
    page = read_points(db, [run], metric, {})
    points = without_superseded(page.points[run.id], page.firsts.get(run.id, {}))
    return dict(zip(map(int, points.axes["step"]), points.value, strict=True))


def test_one_metric_of_several_runs_is_read_at_once(db: Database) -> None:
    first, second, silent = launch(db, order(seeds=(0, 1, 2)))
    log(db, claim_next(db), 1, 2, 3, 4)
    log(db, claim_next(db), 2, value=0.25)
    page = read_points(db, found(db), SUCCESS, {})
    assert page.points[first].value.tolist() == [2.5, 4.5]
    assert page.points[first].axes["env_steps"].tolist() == [400, 800]
    assert page.points[first].axes["wall_seconds"].tolist() == [1.0, 2.0]
    assert page.points[second].value.tolist() == [2.25]
    assert len(page.points[silent]) == 0


def test_superseded_points_do_not_count_as_in_the_run_s_own_curves(db: Database) -> None:
    launch(db, order())
    first = claim_next(db)
    log(db, first, 1, 2, 3, 4, 5, 6, value=0.1)
    second = next_attempt(db, first)
    log(db, second, 5, 6, 7, 8, value=0.2)
    third = next_attempt(db, second)
    log(db, third, 3, 4, value=0.3)
    [run] = found(db)
    assert curve(db, run) == pytest.approx({2: 2.1, 4: 4.3})
    own = read_metrics(db, run.id, names=[SUCCESS])
    assert list(curve(db, run).values()) == [value for value in own.values[SUCCESS] if value is not None]


def test_a_later_attempt_supersedes_even_by_what_it_has_not_measured_yet(db: Database) -> None:
    launch(db, order())
    first = claim_next(db)
    log(db, first, 2, 4)
    log(db, next_attempt(db, first), 3)
    assert curve(db, found(db)[0]) == {2: 2.5}


def test_of_a_run_that_goes_on_only_what_is_new_is_read(db: Database) -> None:
    launch(db, order())
    claim = claim_next(db)
    log(db, claim, 2)
    [before] = found(db)
    log(db, claim, 4)
    [run] = found(db)
    assert run.newest_step_id > before.newest_step_id
    page = read_points(db, [run], SUCCESS, {run.id: before.newest_step_id})
    assert page.points[run.id].value.tolist() == [4.5]


def test_what_came_after_the_look_is_left_for_the_next_reading(db: Database) -> None:
    first, _ = launch(db, order(seeds=(0, 1)))
    claims = claim_next(db), claim_next(db)
    log(db, claims[0], 2)
    [before, _] = found(db)
    log(db, claims[0], 4)
    log(db, claims[1], 2)
    [run, other] = found(db)
    early = read_points(db, [before, other], SUCCESS, {})
    late = read_points(db, [run], SUCCESS, {first: before.newest_step_id})
    assert early.points[first].value.tolist() == [2.5]
    assert late.points[first].value.tolist() == [4.5]


def test_of_a_metric_with_too_many_points_every_kth_cycle_is_read(
    db: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    launch(db, order())
    log(db, claim_next(db), *range(1, 11))
    monkeypatch.setattr(curves, "POINTS_AT_MOST", 4)
    page = read_points(db, found(db), "critic/task/loss", {})
    [points] = page.points.values()
    assert (page.every, points.axes["step"].tolist()) == (3, [3, 6, 9])
    assert read_points(db, found(db), SUCCESS, {}).every == 1


def test_the_metrics_of_a_test_are_listed_though_the_newest_point_has_none(db: Database) -> None:
    launch(db, order())
    log(db, claim_next(db), 2, 3)
    assert list_metric_names(db, found(db)) == ["critic/task/loss", SUCCESS]
    assert list_metric_names(db, []) == []


def test_filters_choose_the_runs(db: Database) -> None:
    ids = launch(db, order(method="her-sldr", seeds=(0, 1)))
    ids += launch(db, order(method="ddpg", task="FetchSlide"))
    locomotion, *manipulation = ids
    assert [run.id for run in found(db)] == manipulation
    assert [run.id for run in found(db, phase="locomotion")] == [locomotion]
    assert [run.id for run in found(db, phase=None)] == ids
    assert [run.id for run in found(db, tasks=["FetchSlide"])] == [ids[3]]
    assert [run.id for run in found(db, methods=["her-sldr"], presets=["smoke"])] == ids[1:3]
    assert [run.id for run in found(db, run_ids=[ids[2], "nobody"])] == [ids[2]]


def test_hidden_runs_are_not_compared(db: Database) -> None:
    hidden, shown = launch(db, order(seeds=(0, 1)))
    act(db, Action.DELETE, hidden)
    assert [run.id for run in found(db)] == [shown]


def test_a_study_has_its_runs_and_the_locomotion_runs_that_they_need(db: Database) -> None:
    other = launch(db, order(seeds=(7,)))
    study = create_study(db, "First", small_spec(methods=("her-sldr",)))
    assert other[0] not in {run.id for run in found(db, study_id=study.study_id)}
    assert [run.seed for run in found(db, study_id=study.study_id)] == [0, 1]
    assert [run.task for run in found(db, study_id=study.study_id, phase="locomotion")] == ["FetchPush"]


def test_a_study_that_does_not_exist_is_named(db: Database) -> None:
    with pytest.raises(NotFound, match="study 'nope'"):
        found(db, study_id="nope")


def test_of_too_many_runs_the_newest_are_read_and_the_others_counted(
    db: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    ids = launch(db, order(seeds=(0, 1, 2)))
    monkeypatch.setattr("backend.store.compared_runs.RUNS_AT_MOST", 2)
    runs = find_compared_runs(db, RunChoice())
    assert ([run.id for run in runs.runs], runs.total) == (ids[1:], 3)


def test_configs_come_by_run(db: Database) -> None:
    ids = launch(db, order(seeds=(0, 1)))
    configs = read_configs(db, [*ids, "nobody"])
    assert {run_id: config["seed"] for run_id, config in configs.items()} == {ids[0]: 0, ids[1]: 1}


def test_tests_are_found_by_name_from_their_own_index(db: Database) -> None:
    query = "SELECT step_id FROM metric_values WHERE name = :name AND name >= 'test/' AND name < 'test0'"
    with db.read() as conn:
        if db.engine_name == "sqlite":
            plan = conn.execute(text(f"EXPLAIN QUERY PLAN {query}"), {"name": SUCCESS}).one().detail
        else:
            conn.execute(text("SET LOCAL enable_seqscan = off"))
            plan = "\n".join(conn.execute(text(f"EXPLAIN {query}"), {"name": SUCCESS}).scalars())
    assert "ix_metric_values_tests" in plan
