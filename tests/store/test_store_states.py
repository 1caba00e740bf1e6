"""The state machine allows what its table says, and nothing else."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from store_cases import put_in_state, queued_run
from store_engines import Stores

from backend.store.database import Database, current_time, open_database
from backend.store.errors import NotFound, StaleFence, WrongState
from backend.store.runs import get_run, list_events
from backend.store.states import ENDED, TRANSITIONS, Event, RunState, change_state

EXPECTED = {
    (RunState.BLOCKED, Event.HELD): RunState.BLOCKED,
    (RunState.BLOCKED, Event.UNBLOCKED): RunState.QUEUED,
    (RunState.BLOCKED, Event.RELEASED): RunState.QUEUED,
    (RunState.BLOCKED, Event.PAUSED): RunState.PAUSED,
    (RunState.BLOCKED, Event.CANCELLED): RunState.CANCELLED,
    (RunState.BLOCKED, Event.DELETED): RunState.BLOCKED,
    (RunState.BLOCKED, Event.RESTORED): RunState.BLOCKED,
    (RunState.QUEUED, Event.CLAIMED): RunState.RUNNING,
    (RunState.QUEUED, Event.PAUSED): RunState.PAUSED,
    (RunState.QUEUED, Event.CANCELLED): RunState.CANCELLED,
    (RunState.QUEUED, Event.DELETED): RunState.QUEUED,
    (RunState.QUEUED, Event.RESTORED): RunState.QUEUED,
    (RunState.RUNNING, Event.LOST): RunState.QUEUED,
    (RunState.RUNNING, Event.RETRIED): RunState.QUEUED,
    (RunState.RUNNING, Event.HANDED_BACK): RunState.QUEUED,
    (RunState.RUNNING, Event.PAUSE_REQUESTED): RunState.RUNNING,
    (RunState.RUNNING, Event.PAUSE_WITHDRAWN): RunState.RUNNING,
    (RunState.RUNNING, Event.PAUSED): RunState.PAUSED,
    (RunState.RUNNING, Event.CANCEL_REQUESTED): RunState.RUNNING,
    (RunState.RUNNING, Event.SUCCEEDED): RunState.SUCCEEDED,
    (RunState.RUNNING, Event.FAILED): RunState.FAILED,
    (RunState.RUNNING, Event.CANCELLED): RunState.CANCELLED,
    (RunState.PAUSED, Event.RESUMED): (RunState.QUEUED, RunState.BLOCKED),
    (RunState.PAUSED, Event.CANCELLED): RunState.CANCELLED,
    (RunState.PAUSED, Event.DELETED): RunState.PAUSED,
    (RunState.PAUSED, Event.RESTORED): RunState.PAUSED,
    (RunState.SUCCEEDED, Event.DELETED): RunState.SUCCEEDED,
    (RunState.SUCCEEDED, Event.RESTORED): RunState.SUCCEEDED,
    (RunState.FAILED, Event.RESTARTED): (RunState.QUEUED, RunState.BLOCKED),
    (RunState.FAILED, Event.DELETED): RunState.FAILED,
    (RunState.FAILED, Event.RESTORED): RunState.FAILED,
    (RunState.CANCELLED, Event.RESTARTED): (RunState.QUEUED, RunState.BLOCKED),
    (RunState.CANCELLED, Event.DELETED): RunState.CANCELLED,
    (RunState.CANCELLED, Event.RESTORED): RunState.CANCELLED,
}
"""Every allowed change, written out by hand; several states where what follows hangs on the run's needs."""

LEADING_TO = [
    (state, event, to)
    for (state, event), follows in EXPECTED.items()
    for to in (follows if isinstance(follows, tuple) else (follows,))
]
BEGINNINGS = {Event.CREATED, Event.IMPORTED}
"""Events that nothing comes before."""
PAIRS = [(state, event) for state in RunState for event in Event if event not in BEGINNINGS]
FORBIDDEN = [pair for pair in PAIRS if pair not in EXPECTED]


@pytest.fixture(scope="module")
def shared_db(stores: Stores, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Database]:
    with stores.fresh(tmp_path_factory.mktemp("states")) as settings:
        database = open_database(settings)
        yield database
        database.close()


def happen(db: Database, run_id: str, event: Event, to: RunState | None = None, fence: int | None = None) -> None:
    with db.write() as conn:
        change_state(conn, run_id, event, at=current_time(conn), reason="because", to=to, fence=fence)


def test_every_event_but_creation_is_in_the_table() -> None:
    assert set(TRANSITIONS) == set(Event) - BEGINNINGS


@pytest.mark.parametrize(("state", "event", "to"), LEADING_TO)
def test_an_allowed_change_is_made_and_written_down(
    shared_db: Database, state: RunState, event: Event, to: RunState
) -> None:
    run_id = queued_run(shared_db)
    put_in_state(shared_db, run_id, state)

    happen(shared_db, run_id, event, to if isinstance(EXPECTED[state, event], tuple) else None)

    last = list_events(shared_db, run_id)[-1]
    assert get_run(shared_db, run_id).state is to
    assert (last.event, last.state, last.detail) == (event, to, "because")


@pytest.mark.parametrize(("state", "event"), FORBIDDEN)
def test_a_forbidden_change_is_refused_and_leaves_no_trace(shared_db: Database, state: RunState, event: Event) -> None:
    run_id = queued_run(shared_db)
    put_in_state(shared_db, run_id, state)

    with pytest.raises(WrongState, match=f"Run {run_id} is {state}; '{event}' is possible only"):
        happen(shared_db, run_id, event, next(iter(TRANSITIONS[event].to), None))

    assert get_run(shared_db, run_id).state is state
    assert [event.event for event in list_events(shared_db, run_id)] == [Event.CREATED]


def test_nothing_but_trying_again_leaves_an_ended_state() -> None:
    leaving = {(state, event) for state, event, to in LEADING_TO if state in ENDED and to is not state}

    assert leaving == {(RunState.FAILED, Event.RESTARTED), (RunState.CANCELLED, Event.RESTARTED)}


def test_an_event_does_not_lead_where_it_cannot(db: Database) -> None:
    with pytest.raises(ValueError, match="'claimed' leads to running, not to paused"):
        happen(db, queued_run(db), Event.CLAIMED, RunState.PAUSED)


def test_a_change_of_no_run_names_the_id(db: Database) -> None:
    with pytest.raises(NotFound, match="no run 'nobody'"):
        happen(db, "nobody", Event.CLAIMED)


def test_a_change_with_an_old_fence_is_refused(db: Database) -> None:
    run_id = queued_run(db)
    put_in_state(db, run_id, RunState.RUNNING)

    with pytest.raises(StaleFence):
        happen(db, run_id, Event.SUCCEEDED, fence=7)
