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
    (RunState.BLOCKED, Event.CANCELLED): RunState.CANCELLED,
    (RunState.QUEUED, Event.CLAIMED): RunState.RUNNING,
    (RunState.QUEUED, Event.CANCELLED): RunState.CANCELLED,
    (RunState.RUNNING, Event.LOST): RunState.QUEUED,
    (RunState.RUNNING, Event.RETRIED): RunState.QUEUED,
    (RunState.RUNNING, Event.HANDED_BACK): RunState.QUEUED,
    (RunState.RUNNING, Event.PAUSED): RunState.PAUSED,
    (RunState.RUNNING, Event.CANCEL_REQUESTED): RunState.RUNNING,
    (RunState.RUNNING, Event.SUCCEEDED): RunState.SUCCEEDED,
    (RunState.RUNNING, Event.FAILED): RunState.FAILED,
    (RunState.RUNNING, Event.CANCELLED): RunState.CANCELLED,
    (RunState.PAUSED, Event.RESUMED): RunState.QUEUED,
    (RunState.PAUSED, Event.CANCELLED): RunState.CANCELLED,
}
"""Every allowed change, written out by hand."""

PAIRS = [(state, event) for state in RunState for event in Event if event is not Event.CREATED]
FORBIDDEN = [pair for pair in PAIRS if pair not in EXPECTED]


@pytest.fixture(scope="module")
def shared_db(stores: Stores, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Database]:
    with stores.fresh(tmp_path_factory.mktemp("states")) as settings:
        database = open_database(settings)
        yield database
        database.close()


def happen(db: Database, run_id: str, event: Event, fence: int | None = None) -> None:
    with db.write() as conn:
        change_state(conn, run_id, event, at=current_time(conn), reason="because", fence=fence)


def test_every_event_but_creation_is_in_the_table() -> None:
    assert set(TRANSITIONS) == set(Event) - {Event.CREATED}


@pytest.mark.parametrize(("state", "event"), EXPECTED)
def test_an_allowed_change_is_made_and_written_down(shared_db: Database, state: RunState, event: Event) -> None:
    run_id = queued_run(shared_db)
    put_in_state(shared_db, run_id, state)

    happen(shared_db, run_id, event)

    last = list_events(shared_db, run_id)[-1]
    assert get_run(shared_db, run_id).state is EXPECTED[state, event]
    assert (last.event, last.state, last.detail) == (event, EXPECTED[state, event], "because")


@pytest.mark.parametrize(("state", "event"), FORBIDDEN)
def test_a_forbidden_change_is_refused_and_leaves_no_trace(shared_db: Database, state: RunState, event: Event) -> None:
    run_id = queued_run(shared_db)
    put_in_state(shared_db, run_id, state)

    with pytest.raises(WrongState, match=f"Run {run_id} is {state}; '{event}' is possible only"):
        happen(shared_db, run_id, event)

    assert get_run(shared_db, run_id).state is state
    assert [event.event for event in list_events(shared_db, run_id)] == [Event.CREATED]


def test_nothing_leaves_an_ended_state() -> None:
    assert not [pair for pair in EXPECTED if pair[0] in ENDED]


def test_a_change_of_no_run_names_the_id(db: Database) -> None:
    with pytest.raises(NotFound, match="no run 'nobody'"):
        happen(db, "nobody", Event.CLAIMED)


def test_a_change_with_an_old_fence_is_refused(db: Database) -> None:
    run_id = queued_run(db)
    put_in_state(db, run_id, RunState.RUNNING)

    with pytest.raises(StaleFence):
        happen(db, run_id, Event.SUCCEEDED, fence=7)
