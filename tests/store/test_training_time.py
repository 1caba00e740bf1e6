"""A run was trained as long as its attempts took, whatever it waited between them."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest
from sqlalchemy import insert, update
from store_cases import claim_next, order

from backend.store.database import Database
from backend.store.launches import launch
from backend.store.outcomes import HandedBack, Succeeded
from backend.store.queue import finish
from backend.store.run_order import parse_order
from backend.store.runs import RunFilter, RunRow, get_run, list_runs
from backend.store.states import RunState
from backend.store.tables import attempts, runs

START = datetime(2026, 1, 1, tzinfo=UTC)


def minutes(count: float) -> datetime:
    """Return the time so many minutes after the start."""
    return START + timedelta(minutes=count)


def put_attempts(db: Database, run_id: str, *spans: tuple[float, float | None]) -> None:
    """Let the attempts of a run have begun and ended so many minutes after the start."""
    with db.write() as conn:
        conn.execute(attempts.delete().where(attempts.c.run_id == run_id))
        for number, (begin, end) in enumerate(spans, start=1):
            values = {"run_id": run_id, "attempt": number, "fence": number, "worker_id": "w"}
            ended_at = None if end is None else minutes(end)
            conn.execute(insert(attempts).values(**values, started_at=minutes(begin), ended_at=ended_at))
        conn.execute(update(runs).where(runs.c.id == run_id).values(started_at=minutes(spans[0][0])))


def trained(row: RunRow) -> tuple[float, datetime | None]:
    return row.training_time.ended_s, row.training_time.since


def test_pauses_and_waits_do_not_count(db: Database) -> None:
    (run_id,) = launch(db, order())
    finish(db, claim_next(db), HandedBack("Its worker was asked to end."))
    finish(db, claim_next(db), Succeeded(1.0))
    put_attempts(db, run_id, (0, 10), (600, 605))

    assert trained(get_run(db, run_id)) == (15 * 60.0, None)


def test_of_a_run_that_is_trained_the_page_can_count_on(db: Database) -> None:
    (run_id,) = launch(db, order())
    claim_next(db)
    put_attempts(db, run_id, (0, 10), (600, None))

    assert trained(get_run(db, run_id)) == (10 * 60.0, minutes(600))


def test_an_attempt_without_an_end_of_a_run_that_has_ended_trains_no_longer(db: Database) -> None:
    (run_id,) = launch(db, order())
    finish(db, claim_next(db), Succeeded(1.0))
    put_attempts(db, run_id, (0, 10), (20, None))

    assert trained(get_run(db, run_id)) == (10 * 60.0, None)


def test_a_run_that_nobody_has_claimed_was_not_trained(db: Database) -> None:
    (run_id,) = launch(db, order())

    assert trained(get_run(db, run_id)) == (0.0, None)


@pytest.mark.parametrize("descending", [True, False])
def test_runs_are_sorted_by_how_long_they_were_trained(db: Database, descending: bool) -> None:
    long_ago, paused, training, waiting = launch(db, order(seeds=(0, 1, 2, 3)))
    put_attempts(db, long_ago, (0, 30))
    put_attempts(db, paused, (0, 5), (3000, 3005))
    put_attempts(db, training, (0, None))
    with db.write() as conn:
        conn.execute(update(runs).where(runs.c.id == training).values(state=RunState.RUNNING))

    rows = list_runs(db, RunFilter(), 10, order=parse_order("duration", descending)).rows

    by_time = [training, long_ago, paused] if descending else [paused, long_ago, training]
    assert [row.id for row in rows] == [*by_time, waiting]
