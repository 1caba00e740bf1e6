"""A run is claimed once, kept by heartbeats, and comes back when its worker is gone."""

from __future__ import annotations

import os
import subprocess
import sys
import time

import pytest
from sqlalchemy import update
from store_cases import claim_next, claimed_run, order, queued_run

from backend.store.actions import Action, act_on, request_cancel
from backend.store.claims import claim_from_json, claim_to_json
from backend.store.database import Database
from backend.store.errors import StaleFence, WrongState
from backend.store.files import register_file
from backend.store.launches import launch
from backend.store.metrics import append_metrics
from backend.store.outcomes import MAX_ATTEMPTS, Cancelled, Failed, HandedBack, Paused, Succeeded
from backend.store.progress import Progress
from backend.store.queue import claim, finish, heartbeat, read_requests, reap_expired
from backend.store.runs import get_run, list_events
from backend.store.settings import Settings
from backend.store.states import RunState
from backend.store.tables import runs

WORK_S = 0.005
"""How long a claimer is busy with each run, so that one alone cannot empty the queue before the others begin [s]."""

CLAIM_ALL = """
import sys
import time
from backend.store.database import open_database
from backend.store.queue import claim
from backend.store.settings import load_settings

db = open_database(load_settings())
print("ready", flush=True)
sys.stdin.readline()
while (claimed := claim(db, sys.argv[1])) is not None:
    print(claimed.run_id)
    time.sleep(float(sys.argv[2]))
"""


def test_four_processes_claim_each_of_80_runs_once(db: Database, settings: Settings) -> None:
    launched = launch(db, order(seeds=tuple(range(40)))) + launch(db, order(method="ddpg", seeds=tuple(range(40))))
    processes = [
        subprocess.Popen(
            [sys.executable, "-c", CLAIM_ALL, f"worker-{number}", str(WORK_S)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env={**os.environ, **settings.as_environment()},
        )
        for number in range(4)
    ]
    for process in processes:
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"

    for process in processes:
        assert process.stdin is not None
        process.stdin.write("go\n")
        process.stdin.flush()
    claimed = [process.communicate(timeout=60)[0].split() for process in processes]

    assert sorted(run_id for ids in claimed for run_id in ids) == sorted(launched)
    assert sum(1 for ids in claimed if ids) > 1


def test_runs_are_claimed_in_the_order_of_their_launch(db: Database) -> None:
    launched = launch(db, order(seeds=(3, 1, 2)))

    assert [claim_next(db).run_id for _ in launched] == launched


def test_an_empty_queue_gives_nothing(db: Database) -> None:
    assert claim(db, "worker-1") is None


def test_a_claim_survives_the_way_through_json(db: Database) -> None:
    claimed = claimed_run(db)

    assert claim_from_json(claim_to_json(claimed)) == claimed


def test_each_claim_raises_fence_and_attempt(db: Database) -> None:
    first = claimed_run(db)
    finish(db, first, HandedBack("Its worker was asked to end."))
    second = claim_next(db)

    assert (second.fence, second.attempt) == (first.fence + 1, first.attempt + 1) == (2, 2)


@pytest.mark.parametrize(
    "write",
    [
        lambda db, claim: append_metrics(db, claim, []),
        lambda db, claim: append_metrics(db, claim, [], Progress(1, 2, 3, 4, 5, 0.5, None, None, None, None, None)),
        lambda db, claim: register_file(db, claim, "policy.pt", "policy", "runs/x/policy.pt", 1, "0" * 64),
        lambda db, claim: finish(db, claim, Succeeded(1.0)),
    ],
    ids=["metrics", "progress", "file", "outcome"],
)
def test_a_write_with_a_stale_fence_is_refused(db: Database, write) -> None:
    stale = claimed_run(db)
    finish(db, stale, HandedBack("Its worker was asked to end."))
    claim_next(db)

    with pytest.raises(StaleFence, match=f"of run {stale.run_id} is over"):
        write(db, stale)


def test_an_outcome_can_be_reported_only_once(db: Database) -> None:
    claimed = claimed_run(db)
    finish(db, claimed, Succeeded(1.0))

    with pytest.raises(StaleFence):
        finish(db, claimed, Failed("late", retry=False))


def test_a_heartbeat_renews_the_lease(db: Database) -> None:
    queued_run(db)
    claimed = claim_next(db, lease_s=0.05)
    heartbeat(db, claimed, lease_s=60.0)
    time.sleep(0.06)

    assert reap_expired(db) == []


def test_a_heartbeat_says_when_the_run_went_to_somebody_else(db: Database) -> None:
    stale = claimed_run(db)
    finish(db, stale, HandedBack("Its worker was asked to end."))
    claim_next(db)

    assert not heartbeat(db, stale).alive


def test_a_run_without_heartbeats_is_queued_again(db: Database) -> None:
    queued_run(db)
    lost = claim_next(db, lease_s=0.01)
    time.sleep(0.02)

    assert reap_expired(db, backoff_s=0.0) == [lost.run_id]

    run = get_run(db, lost.run_id)
    assert (run.state, run.reason) == (RunState.QUEUED, "Its worker worker-1 gave no sign of life.")
    assert claim_next(db).attempt == 2


def test_a_run_that_waits_before_its_retry_is_not_claimed(db: Database) -> None:
    claimed = claimed_run(db)
    finish(db, claimed, Failed("It broke.", retry=True), backoff_s=60.0)

    assert claim(db, "worker-1") is None


def test_a_run_fails_after_its_last_attempt(db: Database) -> None:
    run_id = queued_run(db)
    for _ in range(MAX_ATTEMPTS):
        finish(db, claim_next(db), Failed("It broke.", retry=True), backoff_s=0.0)

    run = get_run(db, run_id)
    assert (run.state, run.reason) == (RunState.FAILED, "It broke. It was tried 3 times.")


def test_being_handed_back_costs_no_attempt(db: Database) -> None:
    run_id = queued_run(db)
    for _ in range(MAX_ATTEMPTS + 1):
        finish(db, claim_next(db), HandedBack("Its worker was asked to end."))

    assert get_run(db, run_id).state is RunState.QUEUED


def test_a_failure_that_would_repeat_is_not_retried(db: Database) -> None:
    claimed = claimed_run(db)
    finish(db, claimed, Failed("The numbers diverged.", retry=False))

    assert get_run(db, claimed.run_id).state is RunState.FAILED


def test_a_paused_run_gives_its_slot_back(db: Database) -> None:
    claimed = claimed_run(db)
    act_on(db, Action.PAUSE, [claimed.run_id])
    finish(db, claimed, Paused())

    assert get_run(db, claimed.run_id).state is RunState.PAUSED
    assert claim(db, "worker-1") is None


def test_cancelling_a_waiting_run_ends_it_at_once(db: Database) -> None:
    run_id = queued_run(db)
    request_cancel(db, run_id)

    run = get_run(db, run_id)
    assert run.state is RunState.CANCELLED
    assert run.ended_at is not None


def test_cancelling_a_running_run_tells_its_worker(db: Database) -> None:
    claimed = claimed_run(db)
    request_cancel(db, claimed.run_id)
    request_cancel(db, claimed.run_id)

    assert get_run(db, claimed.run_id).state is RunState.RUNNING
    assert heartbeat(db, claimed).cancel
    assert read_requests(db, claimed).cancel
    assert [event.event for event in list_events(db, claimed.run_id)] == ["created", "claimed", "cancel_requested"]


@pytest.mark.parametrize("outcome", [Cancelled(), Failed("It broke.", retry=True), HandedBack("The end."), Paused()])
def test_a_run_that_should_end_does_not_come_back(db: Database, outcome) -> None:
    claimed = claimed_run(db)
    request_cancel(db, claimed.run_id)
    finish(db, claimed, outcome)

    assert get_run(db, claimed.run_id).state is RunState.CANCELLED


def test_cancelling_an_ended_run_is_refused(db: Database) -> None:
    claimed = claimed_run(db)
    finish(db, claimed, Succeeded(1.0))

    with pytest.raises(WrongState, match="is succeeded"):
        request_cancel(db, claimed.run_id)


def test_a_run_whose_settings_no_longer_fit_fails_with_the_setting(db: Database) -> None:
    old = queued_run(db)
    with db.write() as conn:
        conn.execute(update(runs).where(runs.c.id == old).values(config={"task": "FetchPush", "tempo": 3}))
    new = queued_run(db)

    assert claim_next(db).run_id == new
    assert "tempo" in (get_run(db, old).reason or "")
