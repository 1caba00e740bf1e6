"""What a person can ask of runs: end, hold, go on, try again, start below the gate, hide and bring back."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum

from sqlalchemy import Connection, select

from backend.store.database import Database, current_time
from backend.store.dependents import Held, hold_run, settle_dependents, why_held
from backend.store.errors import NotFound, Refused, Unstorable, WrongState
from backend.store.states import ENDED, Event, RunState, change_state
from backend.store.tables import run_needs, runs

NAMED_AT_MOST = 3
"""A sentence names so many runs and counts the others."""


class Action(StrEnum):
    """What a person can ask of a run."""

    CANCEL = "cancel"
    """End it for good."""
    PAUSE = "pause"
    """Checkpoint it, give its slot back and wait; a waiting run is held at once."""
    RESUME = "resume"
    """Let a paused run go on."""
    RETRY = "retry"
    """Try a failed or cancelled run again, from its checkpoint."""
    RELEASE = "release"
    """Let a run start although its locomotion model missed the gate."""
    DELETE = "delete"
    """Hide it; nothing is lost."""
    RESTORE = "restore"
    """Bring back a deleted run as it was."""


@dataclass(frozen=True)
class ActionResult:
    """Say what became of an action on one run."""

    run_id: str
    done: bool
    """Whether it was done; if not, nothing was changed."""
    message: str
    """What follows, or why it was not done, in one sentence."""


def act_on(db: Database, action: Action, run_ids: Sequence[str]) -> list[ActionResult]:
    """Do something to several runs, each in a transaction of its own; a run that does not allow it says why."""
    return [_try(db, action, run_id) for run_id in run_ids]


def request_cancel(db: Database, run_id: str) -> None:
    """End a run: at once if no worker has it, else as soon as its worker has heard.

    Raises:
        NotFound: there is no such run.
        WrongState: it has ended already.
        Refused: it is deleted.
    """
    act(db, Action.CANCEL, run_id)


def act(db: Database, action: Action, run_id: str) -> str:
    """Do something to one run; return what follows, in one sentence.

    Raises:
        NotFound: there is no such run.
        WrongState: the run's state does not allow it.
        Refused: something else does not allow it.
    """
    with db.write() as conn:
        held = hold_run(conn, run_id)
        if held.run.deleted_at is not None and action is not Action.RESTORE:
            raise Refused(f"Run {run_id} is deleted; restore it first.")
        return _DONE_BY[action](conn, held, current_time(conn))


def _try(db: Database, action: Action, run_id: str) -> ActionResult:
    try:
        return ActionResult(run_id, True, act(db, action, run_id))
    except (NotFound, WrongState, Refused, Unstorable) as err:
        return ActionResult(run_id, False, str(err))


def _cancel(conn: Connection, held: Held, at: datetime) -> str:
    run = held.run
    if run.state != RunState.RUNNING:
        change_state(conn, run.id, Event.CANCELLED, at=at, reason="Cancelled before it began or while it waited.")
        settle_dependents(conn, run.id, at)
        return f"Run {run.id} is cancelled."
    if not run.cancel_requested:
        change_state(conn, run.id, Event.CANCEL_REQUESTED, at=at, changes={"cancel_requested": True})
    return f"Run {run.id} ends within seconds."


def _pause(conn: Connection, held: Held, at: datetime) -> str:
    run = held.run
    if run.state != RunState.RUNNING:
        change_state(conn, run.id, Event.PAUSED, at=at, reason="Held before it began or while it waited.")
        return f"Run {run.id} is paused."
    if run.cancel_requested:
        raise Refused(f"Run {run.id} is being cancelled, so it cannot be paused.")
    if not run.pause_requested:
        change_state(conn, run.id, Event.PAUSE_REQUESTED, at=at, changes={"pause_requested": True})
    return f"Run {run.id} pauses at the end of its cycle."


def _resume(conn: Connection, held: Held, at: datetime) -> str:
    run = held.run
    if run.state == RunState.RUNNING and run.pause_requested:
        change_state(conn, run.id, Event.PAUSE_WITHDRAWN, at=at, changes={"pause_requested": False})
        return f"Run {run.id} goes on."
    return _put_back(conn, held, Event.RESUMED, at, {})


def _retry(conn: Connection, held: Held, at: datetime) -> str:
    run = held.run
    changes = {
        "fence": run.fence + 1,
        "failures": 0,
        "deaths": 0,
        "cancel_requested": False,
        "ended_at": None,
    }
    message = _put_back(conn, held, Event.RESTARTED, at, changes)
    settle_dependents(conn, run.id, at)
    return message


def _put_back(conn: Connection, held: Held, event: Event, at: datetime, changes: Mapping[str, object]) -> str:
    """Let a run wait for a worker, or for what it needs; that is brought back if somebody has deleted it."""
    obstacle = why_held(held)
    to = RunState.QUEUED if obstacle is None else RunState.BLOCKED
    change_state(conn, held.run.id, event, at=at, reason=obstacle, to=to, changes={**changes, "not_before": None})
    message = f"Run {held.run.id} is queued." if obstacle is None else f"Run {held.run.id} waits: {obstacle}"
    back = _bring_back_needed(conn, held, at)
    return f"{message} Brought back with it: {_named(back)}." if back else message


def _release(conn: Connection, held: Held, at: datetime) -> str:
    run = held.run
    if run.state == RunState.BLOCKED:
        unfinished = Held(run, tuple(row for row in held.needed if row.state != RunState.SUCCEEDED))
        obstacle = why_held(unfinished)
        if obstacle is not None:
            raise Refused(f"Run {run.id} has no locomotion model to start with yet: {obstacle}")
    reason = "Released by hand, below its gate."
    change_state(conn, run.id, Event.RELEASED, at=at, reason=reason, changes={"gate_waived": True})
    _bring_back_needed(conn, held, at)
    return f"Run {run.id} is queued, below its gate."


def _delete(conn: Connection, held: Held, at: datetime) -> str:
    run = held.run
    if run.state == RunState.RUNNING:
        raise Refused(f"Run {run.id} is running; cancel it first, then delete it.")
    waiting = _waiting_for(conn, run.id)
    if waiting:
        raise Refused(f"Run {run.id} is needed by {_named(waiting)}; cancel or delete what needs it first.")
    change_state(conn, run.id, Event.DELETED, at=at, changes={"deleted_at": at})
    return f"Run {run.id} is deleted; it can be restored."


def _restore(conn: Connection, held: Held, at: datetime) -> str:
    run = held.run
    if run.deleted_at is None:
        raise Refused(f"Run {run.id} is not deleted.")
    change_state(conn, run.id, Event.RESTORED, at=at, changes={"deleted_at": None})
    needed = _bring_back_needed(conn, held, at)
    return f"Run {run.id} is back{f', and with it {_named(needed)} that it needs' if needed else ''}."


def _bring_back_needed(conn: Connection, held: Held, at: datetime) -> list[str]:
    """Restore what a run needs and somebody has deleted; return the ids: no worker takes what is deleted."""
    deleted = [row.id for row in held.needed if row.deleted_at is not None]
    for run_id in deleted:
        change_state(conn, run_id, Event.RESTORED, at=at, changes={"deleted_at": None})
    return deleted


def _waiting_for(conn: Connection, run_id: str) -> list[str]:
    """Return the ids of the runs that need this one and have not ended."""
    query = (
        select(runs.c.id)
        .join(run_needs, run_needs.c.run_id == runs.c.id)
        .where(run_needs.c.needs_run_id == run_id, runs.c.state.not_in(ENDED), runs.c.deleted_at.is_(None))
        .order_by(runs.c.number)
    )
    return list(conn.execute(query).scalars())


def _named(run_ids: Sequence[str]) -> str:
    named, others = run_ids[:NAMED_AT_MOST], len(run_ids) - NAMED_AT_MOST
    runs_in_words = ("run " if len(run_ids) == 1 else "runs ") + ", ".join(named)
    return f"{runs_in_words} and {others} more" if others > 0 else runs_in_words


_DONE_BY: Mapping[Action, Callable[[Connection, Held, datetime], str]] = {
    Action.CANCEL: _cancel,
    Action.PAUSE: _pause,
    Action.RESUME: _resume,
    Action.RETRY: _retry,
    Action.RELEASE: _release,
    Action.DELETE: _delete,
    Action.RESTORE: _restore,
}
