"""Each attempt tells where it ran, how it ended and where it began on the curve; failing is not the same as dying."""

from __future__ import annotations

import pytest
from store_cases import claim_next, claimed_run, queued_run, step

from backend.store.attempts import list_attempts, note_host
from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import NotFound, StaleFence
from backend.store.files import register_file
from backend.store.metrics import MetricPoint, append_metrics, read_metrics
from backend.store.outcomes import MAX_ATTEMPTS, MAX_DEATHS, Failed, HandedBack, Lost, Outcome, Succeeded
from backend.store.queue import finish
from backend.store.runs import get_run
from backend.store.states import RunState
from backend.store.workers import register_worker


def log(db: Database, claim: Claim, *cycles: int) -> None:
    append_metrics(db, claim, [MetricPoint(step(cycle), {"a/x": float(claim.attempt)}) for cycle in cycles])


def checkpoint(db: Database, claim: Claim) -> None:
    register_file(db, claim, "checkpoint.pt", "checkpoint", "runs/x/checkpoint.pt", 1, "0" * 64)


def end(db: Database, claim: Claim, outcome: Outcome) -> RunState:
    finish(db, claim, outcome, backoff_s=0.0)
    return get_run(db, claim.run_id).state


def broke() -> Failed:
    return Failed("It broke.", retry=True)


def killed() -> Lost:
    return Lost("Its process was killed by SIGKILL.")


def test_attempts_are_listed_with_place_outcome_and_first_cycle(db: Database) -> None:
    run_id = queued_run(db)
    first = claim_next(db, register_worker(db, "here", 1, 1))
    log(db, first, 1, 2, 3)
    finish(db, first, HandedBack("Its worker was asked to end."))
    second = claim_next(db, register_worker(db, "there", 1, 1))
    note_host(db, second, "node-7")
    log(db, second, 3)
    finish(db, second, killed(), backoff_s=0.0)
    third = claim_next(db)

    rows = list_attempts(db, run_id)

    assert [(row.attempt, row.fence, row.worker_id, row.host) for row in rows] == [
        (1, 1, first.worker_id, "here"),
        (2, 2, second.worker_id, "node-7"),
        (3, 3, third.worker_id, None),
    ]
    assert [(row.outcome, row.reason, row.first_cycle) for row in rows] == [
        ("handed_back", "Its worker was asked to end.", 1),
        ("lost", "Its process was killed by SIGKILL.", 3),
        (None, None, None),
    ]
    assert rows[0].ended_at is not None
    assert rows[0].started_at <= rows[0].ended_at <= rows[1].started_at
    assert rows[2].ended_at is None


def test_a_run_that_was_never_claimed_has_no_attempts(db: Database) -> None:
    assert list_attempts(db, queued_run(db)) == []


def test_the_attempts_of_no_run_are_refused(db: Database) -> None:
    with pytest.raises(NotFound, match="no run 'nobody'"):
        list_attempts(db, "nobody")


def test_an_attempt_that_is_over_cannot_say_where_it_runs(db: Database) -> None:
    stale = claimed_run(db)
    finish(db, stale, HandedBack("Its worker was asked to end."))

    with pytest.raises(StaleFence):
        note_host(db, stale, "node-7")


def test_a_run_outlives_more_deaths_than_failures(db: Database) -> None:
    queued_run(db)
    states = [end(db, claim_next(db), killed()) for _ in range(MAX_DEATHS)]

    assert MAX_DEATHS > MAX_ATTEMPTS
    assert states == [RunState.QUEUED] * (MAX_DEATHS - 1) + [RunState.FAILED]


def test_failures_count_afresh_after_a_new_checkpoint(db: Database) -> None:
    queued_run(db)
    for _ in range(2 * MAX_ATTEMPTS):
        claimed = claim_next(db)
        checkpoint(db, claimed)
        assert end(db, claimed, broke()) is RunState.QUEUED


def test_a_run_that_always_fails_at_the_same_place_fails(db: Database) -> None:
    queued_run(db)
    claimed = claim_next(db)
    checkpoint(db, claimed)
    states = [end(db, claimed, broke())]
    states += [end(db, claim_next(db), broke()) for _ in range(MAX_ATTEMPTS - 1)]

    assert states == [RunState.QUEUED] * (MAX_ATTEMPTS - 1) + [RunState.FAILED]


def test_a_death_between_failures_does_not_hide_them(db: Database) -> None:
    queued_run(db)
    outcomes = [broke(), killed(), broke(), killed(), broke()]

    assert [end(db, claim_next(db), outcome) for outcome in outcomes][-1] is RunState.FAILED


def test_superseded_points_stay_and_can_be_read(db: Database) -> None:
    first = claimed_run(db)
    log(db, first, 1, 2, 3)
    finish(db, first, killed(), backoff_s=0.0)
    log(db, claim_next(db), 2)

    kept = read_metrics(db, first.run_id)
    everything = read_metrics(db, first.run_id, superseded=True)

    assert list(zip(kept.attempt, kept.step, strict=True)) == [(1, 1), (2, 2)]
    assert list(zip(everything.attempt, everything.step, strict=True)) == [(1, 1), (1, 2), (1, 3), (2, 2)]


def test_points_sent_twice_are_stored_once(db: Database) -> None:
    claimed = claimed_run(db)
    log(db, claimed, 1, 2)
    log(db, claimed, 1, 2, 3)

    columns = read_metrics(db, claimed.run_id)

    assert (columns.step, columns.values) == ([1, 2, 3], {"a/x": [1.0, 1.0, 1.0]})


def test_two_reports_of_one_step_are_put_together(db: Database) -> None:
    claimed = claimed_run(db)
    log(db, claimed, 1)
    append_metrics(db, claimed, [MetricPoint(step(1), {"a/y": 2.0})])

    assert read_metrics(db, claimed.run_id).values == {"a/x": [1.0], "a/y": [2.0]}


def test_an_ended_attempt_can_log_no_more(db: Database) -> None:
    claimed = claimed_run(db)
    finish(db, claimed, Succeeded(1.0))

    with pytest.raises(StaleFence):
        log(db, claimed, 1)
