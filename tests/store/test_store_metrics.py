"""Metrics come back as they were logged, by cursor, and a later attempt supersedes from its first step."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sqlalchemy import func, select
from store_cases import claim_next, claimed_run, step

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import StaleFence
from backend.store.metrics import MetricPoint, append_metrics, read_metrics
from backend.store.outcomes import HandedBack
from backend.store.progress import Progress, find_progress
from backend.store.queue import finish
from backend.store.tables import metric_steps


def log(db: Database, claim: Claim, *cycles: int) -> None:
    append_metrics(db, claim, [MetricPoint(step(cycle), {"train/success_rate": cycle / 100}) for cycle in cycles])


def next_attempt(db: Database, claim: Claim) -> Claim:
    finish(db, claim, HandedBack("Its worker was asked to end."))
    return claim_next(db)


def stored_points(db: Database) -> int:
    with db.read() as conn:
        return conn.execute(select(func.count()).select_from(metric_steps)).scalar_one()


def test_points_come_back_in_columns(db: Database) -> None:
    claim = claimed_run(db)
    append_metrics(
        db, claim, [MetricPoint(step(1), {"a/x": 1.0}), MetricPoint(step(2), {"a/x": 2.0, "test/success_rate": 0.5})]
    )

    columns = read_metrics(db, claim.run_id)

    assert columns.step == [1, 2]
    assert columns.env_steps == [200, 400]
    assert columns.wall_seconds == [0.5, 1.0]
    assert columns.values == {"a/x": [1.0, 2.0], "test/success_rate": [None, 0.5]}


def test_points_and_progress_arrive_together_or_not_at_all(db: Database) -> None:
    claim, halfway = claimed_run(db), Progress(1, 2, 200, 4, 8, 0.5, 0.25, 0.25, 100.0, 50.0, 3.0)
    append_metrics(db, claim, [MetricPoint(step(1), {"a/x": 1.0})], halfway)
    assert (stored_points(db), find_progress(db, claim.run_id)) == (1, halfway)

    next_attempt(db, claim)
    with pytest.raises(StaleFence):
        append_metrics(db, claim, [MetricPoint(step(2), {"a/x": 2.0})], replace(halfway, fraction=1.0))
    assert (stored_points(db), find_progress(db, claim.run_id)) == (1, halfway)


def test_only_the_metrics_asked_for_come_back(db: Database) -> None:
    claim = claimed_run(db)
    append_metrics(db, claim, [MetricPoint(step(1), {"a/x": 1.0, "a/y": 2.0})])

    assert read_metrics(db, claim.run_id, names=["a/y"]).values == {"a/y": [2.0]}


def test_a_cursor_gives_only_what_is_new(db: Database) -> None:
    claim = claimed_run(db)
    log(db, claim, 1, 2)
    cursor = read_metrics(db, claim.run_id).cursor
    log(db, claim, 3)

    columns = read_metrics(db, claim.run_id, after=cursor)

    assert columns.step == [3]
    assert read_metrics(db, claim.run_id, after=columns.cursor).step == []


def test_reading_at_the_end_keeps_the_cursor(db: Database) -> None:
    claim = claimed_run(db)
    log(db, claim, 1)
    cursor = read_metrics(db, claim.run_id).cursor

    assert read_metrics(db, claim.run_id, after=cursor).cursor == cursor


def test_a_later_attempt_supersedes_from_its_first_step(db: Database) -> None:
    first = claimed_run(db)
    log(db, first, 1, 2, 3, 4)
    second = next_attempt(db, first)
    log(db, second, 3)

    columns = read_metrics(db, first.run_id)

    assert list(zip(columns.attempt, columns.step, strict=True)) == [(1, 1), (1, 2), (2, 3)]
    assert stored_points(db) == 5


def test_a_metric_that_only_superseded_points_have_is_none(db: Database) -> None:
    claim = claimed_run(db)
    append_metrics(db, claim, [MetricPoint(step(1), {"a/x": 1.0}), MetricPoint(step(5), {"a/old": 5.0})])
    again = next_attempt(db, claim)
    append_metrics(db, again, [MetricPoint(step(3), {"a/x": 3.0})])

    assert read_metrics(db, claim.run_id).values == {"a/x": [1.0, 3.0]}
    assert read_metrics(db, claim.run_id, superseded=True).values["a/old"] == [None, 5.0, None]


def test_a_third_attempt_supersedes_the_second_and_the_first(db: Database) -> None:
    first = claimed_run(db)
    log(db, first, 1, 2, 3, 4, 5)
    second = next_attempt(db, first)
    log(db, second, 4, 5, 6)
    third = next_attempt(db, second)
    log(db, third, 3, 4)

    columns = read_metrics(db, first.run_id)

    assert list(zip(columns.attempt, columns.step, strict=True)) == [(1, 1), (1, 2), (3, 3), (3, 4)]


def test_the_points_of_another_run_stay_out(db: Database) -> None:
    mine, other = claimed_run(db), claimed_run(db)
    log(db, mine, 1)
    log(db, other, 7)
    log(db, mine, 2)

    assert read_metrics(db, mine.run_id).values == {"train/success_rate": [0.01, 0.02]}


def test_a_batch_is_stored_whole_or_not_at_all(db: Database) -> None:
    stale = claimed_run(db)
    next_attempt(db, stale)

    with pytest.raises(StaleFence):
        log(db, stale, 1, 2)

    assert stored_points(db) == 0


def test_a_number_that_is_not_finite_is_refused_by_name(db: Database) -> None:
    claim = claimed_run(db)

    with pytest.raises(ValueError, match="metric critic/task/loss is nan at cycle 1"):
        append_metrics(db, claim, [MetricPoint(step(1), {"critic/task/loss": float("nan")})])
