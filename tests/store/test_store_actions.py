"""A person can end, hold, resume, retry, release, delete and restore runs, in bulk, each on its own account."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sqlalchemy import update
from store_cases import claim_next, claimed_run, order, put_in_state, queued_run

from backend.store.actions import Action, ActionResult, act_on
from backend.store.claims import Claim
from backend.store.database import Database, current_time
from backend.store.errors import StaleFence
from backend.store.launches import launch, plan_launch
from backend.store.outcomes import Cancelled, Failed, HandedBack, Paused, Succeeded
from backend.store.queue import claim, finish, heartbeat
from backend.store.runs import RunFilter, RunRow, get_run, list_events, list_runs
from backend.store.states import Event, RunState
from backend.store.tables import runs

GATED = order(method="her-sldr", overrides={"sldr": {"gate": 0.95}})


def do(db: Database, action: Action, run_id: str) -> ActionResult:
    (result,) = act_on(db, action, [run_id])
    return result


def done(db: Database, action: Action, run_id: str) -> RunRow:
    result = do(db, action, run_id)
    assert result.done, result.message
    return get_run(db, run_id)


def refused(db: Database, action: Action, run_id: str) -> str:
    before = get_run(db, run_id), list_events(db, run_id)
    result = do(db, action, run_id)
    assert not result.done
    assert (get_run(db, run_id), list_events(db, run_id)) == before
    return result.message


def ids(db: Database, *, deleted: bool = False) -> list[str]:
    return [row.id for row in list_runs(db, RunFilter(deleted=deleted), 50).rows]


def below_gate(db: Database) -> tuple[str, str]:
    locomotion, manipulation = launch(db, GATED)
    finish(db, claim_next(db), Succeeded(0.5))
    return locomotion, manipulation


def failed_run(db: Database) -> Claim:
    claimed = claimed_run(db)
    finish(db, claimed, Failed("The numbers diverged.", retry=False))
    return claimed


def test_each_run_of_a_bulk_action_is_answered_for_in_order(db: Database) -> None:
    ended = failed_run(db).run_id
    waiting, other = queued_run(db), queued_run(db)

    results = act_on(db, Action.CANCEL, [waiting, ended, "nobody", other])

    assert [(result.run_id, result.done) for result in results] == [
        (waiting, True),
        (ended, False),
        ("nobody", False),
        (other, True),
    ]
    assert "is failed" in results[1].message
    assert results[2].message == "There is no run 'nobody'."
    assert get_run(db, other).state is RunState.CANCELLED


def test_a_waiting_run_is_held_at_once_and_resumed(db: Database) -> None:
    run_id = queued_run(db)

    assert done(db, Action.PAUSE, run_id).state is RunState.PAUSED
    assert claim(db, "worker-1") is None
    assert done(db, Action.RESUME, run_id).state is RunState.QUEUED
    assert claim_next(db).run_id == run_id


def test_a_running_run_is_asked_to_pause(db: Database) -> None:
    claimed = claimed_run(db)

    run = done(db, Action.PAUSE, claimed.run_id)

    assert (run.state, run.pause_requested) == (RunState.RUNNING, True)
    assert heartbeat(db, claimed).pause
    finish(db, claimed, Paused())
    run = get_run(db, claimed.run_id)
    assert (run.state, run.pause_requested) == (RunState.PAUSED, False)


def test_pausing_twice_says_so_once_in_the_history(db: Database) -> None:
    claimed = claimed_run(db)
    done(db, Action.PAUSE, claimed.run_id)
    done(db, Action.PAUSE, claimed.run_id)

    assert [event.event for event in list_events(db, claimed.run_id)] == ["created", "claimed", "pause_requested"]


def test_a_pause_can_be_withdrawn_before_it_happens(db: Database) -> None:
    claimed = claimed_run(db)
    done(db, Action.PAUSE, claimed.run_id)

    assert not done(db, Action.RESUME, claimed.run_id).pause_requested
    assert not heartbeat(db, claimed).pause


def test_a_run_that_paused_although_the_pause_was_withdrawn_goes_on(db: Database) -> None:
    claimed = claimed_run(db)
    done(db, Action.PAUSE, claimed.run_id)
    done(db, Action.RESUME, claimed.run_id)
    finish(db, claimed, Paused())

    assert get_run(db, claimed.run_id).state is RunState.QUEUED
    assert claim_next(db).attempt == 2


@pytest.mark.parametrize("outcome", [Failed("It broke.", retry=True), HandedBack("Its worker was asked to end.")])
def test_a_run_that_should_pause_is_not_queued_again(db: Database, outcome) -> None:
    claimed = claimed_run(db)
    done(db, Action.PAUSE, claimed.run_id)
    finish(db, claimed, outcome)

    run = get_run(db, claimed.run_id)
    assert run.state is RunState.PAUSED
    assert (run.reason or "").startswith(outcome.reason)


def test_a_run_that_is_being_cancelled_cannot_be_paused(db: Database) -> None:
    claimed = claimed_run(db)
    done(db, Action.CANCEL, claimed.run_id)

    assert "is being cancelled" in refused(db, Action.PAUSE, claimed.run_id)


def test_a_blocked_run_that_is_resumed_waits_for_what_it_needs(db: Database) -> None:
    locomotion, manipulation = launch(db, GATED)
    assert done(db, Action.PAUSE, manipulation).state is RunState.PAUSED

    run = done(db, Action.RESUME, manipulation)

    assert (run.state, run.reason) == (RunState.BLOCKED, f"Waits for the locomotion run {locomotion}.")


def test_a_run_paused_while_its_needs_were_met_is_queued_when_resumed(db: Database) -> None:
    _, manipulation = launch(db, GATED)
    done(db, Action.PAUSE, manipulation)
    finish(db, claim_next(db), Succeeded(1.0))
    assert get_run(db, manipulation).state is RunState.PAUSED

    assert done(db, Action.RESUME, manipulation).state is RunState.QUEUED


def test_a_run_comes_back_with_the_locomotion_run_that_it_needs(db: Database) -> None:
    locomotion, manipulation = launch(db, GATED)
    done(db, Action.DELETE, manipulation)
    done(db, Action.DELETE, locomotion)

    result = do(db, Action.RESTORE, manipulation)

    assert result.message == f"Run {manipulation} is back, and with it run {locomotion} that it needs."
    assert get_run(db, locomotion).deleted_at is None
    assert claim_next(db).run_id == locomotion


def test_a_run_that_is_tried_again_brings_back_the_locomotion_run_that_it_needs(db: Database) -> None:
    locomotion, manipulation = launch(db, GATED)
    done(db, Action.CANCEL, manipulation)
    done(db, Action.DELETE, locomotion)

    result = do(db, Action.RETRY, manipulation)

    assert result.message.endswith(f" {locomotion}. Brought back with it: run {locomotion}.")
    assert claim_next(db).run_id == locomotion


def test_a_run_that_is_released_brings_back_the_locomotion_run_that_it_needs(db: Database) -> None:
    locomotion, manipulation = below_gate(db)
    with db.write() as conn:  # as an earlier version let it happen
        conn.execute(update(runs).where(runs.c.id == locomotion).values(deleted_at=current_time(conn)))

    done(db, Action.RELEASE, manipulation)

    assert get_run(db, locomotion).deleted_at is None


def test_a_failed_run_is_retried_with_all_its_attempts_and_a_new_fence(db: Database) -> None:
    failed = failed_run(db)

    run = done(db, Action.RETRY, failed.run_id)

    assert (run.state, run.reason, run.ended_at) == (RunState.QUEUED, None, None)
    again = claim_next(db)
    assert (again.run_id, again.attempt) == (failed.run_id, failed.attempt + 1)
    assert again.fence > failed.fence + 1
    finish(db, again, Failed("It broke.", retry=True), backoff_s=0.0)
    assert get_run(db, failed.run_id).state is RunState.QUEUED


def test_a_cancelled_run_is_retried_without_being_cancelled_again(db: Database) -> None:
    claimed = claimed_run(db)
    done(db, Action.CANCEL, claimed.run_id)
    finish(db, claimed, Cancelled())

    assert not done(db, Action.RETRY, claimed.run_id).cancel_requested
    assert not heartbeat(db, claim_next(db)).cancel


def test_late_writes_from_before_a_retry_are_refused(db: Database) -> None:
    failed = failed_run(db)
    done(db, Action.RETRY, failed.run_id)
    claim_next(db)

    with pytest.raises(StaleFence):
        finish(db, failed, Succeeded(1.0))


def test_dependents_wait_again_for_a_locomotion_run_that_is_retried(db: Database) -> None:
    locomotion, manipulation = launch(db, GATED)
    finish(db, claim_next(db), Failed("The numbers diverged.", retry=False))

    done(db, Action.RETRY, locomotion)

    assert get_run(db, manipulation).reason == f"Waits for the locomotion run {locomotion}."
    finish(db, claim_next(db), Succeeded(1.0))
    assert claim_next(db).run_id == manipulation


def test_a_run_that_has_not_ended_cannot_be_retried(db: Database) -> None:
    assert "possible only for runs that are: cancelled, failed" in refused(db, Action.RETRY, queued_run(db))


def test_a_run_below_its_gate_is_released_by_hand(db: Database) -> None:
    _, manipulation = below_gate(db)
    assert get_run(db, manipulation).is_below_gate

    run = done(db, Action.RELEASE, manipulation)

    assert (run.state, run.is_below_gate, run.gate_waived) == (RunState.QUEUED, False, True)
    assert claim_next(db).gate_waived


def test_a_released_run_keeps_its_release(db: Database) -> None:
    _, manipulation = below_gate(db)
    done(db, Action.RELEASE, manipulation)
    done(db, Action.PAUSE, manipulation)

    assert done(db, Action.RESUME, manipulation).state is RunState.QUEUED


def test_releasing_changes_neither_config_nor_hash(db: Database) -> None:
    _, manipulation = below_gate(db)
    before = get_run(db, manipulation)

    after = done(db, Action.RELEASE, manipulation)

    assert (after.config, after.config_hash) == (before.config, before.config_hash)
    assert claim_next(db).config.sldr.gate == 0.95


def test_a_run_without_a_locomotion_model_cannot_be_released(db: Database) -> None:
    locomotion, manipulation = launch(db, GATED)

    assert not get_run(db, manipulation).is_below_gate
    assert refused(db, Action.RELEASE, manipulation) == (
        f"Run {manipulation} has no locomotion model to start with yet: Waits for the locomotion run {locomotion}."
    )


def test_a_run_that_is_not_blocked_cannot_be_released(db: Database) -> None:
    assert "is queued" in refused(db, Action.RELEASE, queued_run(db))


def test_a_deleted_run_is_hidden_and_not_claimed_until_it_is_restored(db: Database) -> None:
    kept, gone = launch(db, order(seeds=(0, 1)))

    assert done(db, Action.DELETE, gone).deleted_at is not None

    assert ids(db) == [kept]
    assert ids(db, deleted=True) == [gone]
    claim_next(db)
    assert claim(db, "worker-1") is None
    run = done(db, Action.RESTORE, gone)
    assert (run.state, run.deleted_at) == (RunState.QUEUED, None)
    assert claim_next(db).run_id == gone


@pytest.mark.parametrize("state", [state for state in RunState if state is not RunState.RUNNING])
def test_deleting_and_restoring_leaves_state_and_reason(db: Database, state: RunState) -> None:
    run_id = queued_run(db)
    put_in_state(db, run_id, state)
    before = get_run(db, run_id)

    done(db, Action.DELETE, run_id)
    after = done(db, Action.RESTORE, run_id)

    assert after == before
    assert [event.event for event in list_events(db, run_id)][-2:] == [Event.DELETED, Event.RESTORED]


def test_a_running_run_cannot_be_deleted(db: Database) -> None:
    assert "cancel it first" in refused(db, Action.DELETE, claimed_run(db).run_id)


def test_a_locomotion_run_cannot_be_deleted_while_others_wait_for_it(db: Database) -> None:
    launched = launch(db, replace(GATED, seeds=(0, 1, 2, 3, 4)))

    message = refused(db, Action.DELETE, launched[0])

    assert f"is needed by runs {', '.join(launched[1:4])} and 2 more" in message


def test_a_locomotion_run_can_be_deleted_once_nothing_waits_for_it(db: Database) -> None:
    locomotion, manipulation = launch(db, GATED)
    done(db, Action.DELETE, manipulation)

    assert done(db, Action.DELETE, locomotion).deleted_at is not None
    assert plan_launch(db, GATED)[0].reused_run_id is None


def test_nothing_can_be_done_to_a_deleted_run_but_restoring_it(db: Database) -> None:
    run_id = queued_run(db)
    done(db, Action.DELETE, run_id)

    for action in set(Action) - {Action.RESTORE}:
        assert "restore it first" in refused(db, action, run_id)


def test_a_run_that_is_not_deleted_cannot_be_restored(db: Database) -> None:
    assert "is not deleted" in refused(db, Action.RESTORE, queued_run(db))
