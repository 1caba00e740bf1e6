"""The run state machine: which states there are, which changes are allowed, and the one way to make them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum
from typing import Any

from sqlalchemy import Connection, ScalarSelect, insert, select, update

from backend.store.errors import NotFound, StaleFence, WrongState
from backend.store.tables import AnyRow, run_events, runs


class RunState(StrEnum):
    """Where a run stands."""

    BLOCKED = "blocked"
    """Waits for another run, or its locomotion model missed the gate."""
    QUEUED = "queued"
    """Waits for a free worker."""
    RUNNING = "running"
    """A worker trains it."""
    PAUSED = "paused"
    """Checkpointed, its slot given back, waiting for a person."""
    SUCCEEDED = "succeeded"
    """Trained to its end."""
    FAILED = "failed"
    """Ended by an error that would repeat, or out of attempts."""
    CANCELLED = "cancelled"
    """Ended by a person."""


ENDED = frozenset({RunState.SUCCEEDED, RunState.FAILED, RunState.CANCELLED})
"""The states that nothing leaves but a person's wish to try again."""

WAITING = frozenset({RunState.BLOCKED, RunState.QUEUED, RunState.PAUSED})
"""The states of runs that no worker has and that have not ended."""


class Event(StrEnum):
    """What can happen to a run."""

    CREATED = "created"
    """It was launched."""
    IMPORTED = "imported"
    """It was not trained here: it came with the product, or from another installation."""
    HELD = "held"
    """It stays blocked, and it is known why."""
    UNBLOCKED = "unblocked"
    """All it needs is there."""
    CLAIMED = "claimed"
    """A worker took it."""
    LOST = "lost"
    """Its process was killed from outside, or its worker gave no sign of life."""
    RETRIED = "retried"
    """An attempt failed in a way that may not repeat."""
    HANDED_BACK = "handed_back"
    """Its worker was asked to stop."""
    PAUSE_REQUESTED = "pause_requested"
    """A person wants it to wait; its worker does not know yet."""
    PAUSE_WITHDRAWN = "pause_withdrawn"
    """The person changed their mind before its worker had paused it."""
    PAUSED = "paused"
    """It was checkpointed and gave back its slot, or was held before it began."""
    RESUMED = "resumed"
    """A person let it go on."""
    RELEASED = "released"
    """A person let it start below its gate."""
    RESTARTED = "restarted"
    """A person wants it tried again, from its checkpoint."""
    DELETED = "deleted"
    """A person hid it; it can be restored."""
    RESTORED = "restored"
    """A person brought it back."""
    CANCEL_REQUESTED = "cancel_requested"
    """A person wants it to end; its worker does not know yet."""
    SUCCEEDED = "succeeded"
    """It was trained to its end."""
    FAILED = "failed"
    """It ended by an error."""
    CANCELLED = "cancelled"
    """It ended by a person's wish."""


@dataclass(frozen=True)
class Transition:
    """Say what an event does to a run's state."""

    allowed: frozenset[RunState]
    """The states in which it can happen."""
    to: frozenset[RunState]
    """The states that can follow; none if it leaves the state as it is."""


def _on(*allowed: RunState, to: RunState | tuple[RunState, ...] = ()) -> Transition:
    return Transition(frozenset(allowed), frozenset((to,) if isinstance(to, RunState) else to))


TRANSITIONS: Mapping[Event, Transition] = {
    Event.HELD: _on(RunState.BLOCKED),
    Event.UNBLOCKED: _on(RunState.BLOCKED, to=RunState.QUEUED),
    Event.RELEASED: _on(RunState.BLOCKED, to=RunState.QUEUED),
    Event.CLAIMED: _on(RunState.QUEUED, to=RunState.RUNNING),
    Event.LOST: _on(RunState.RUNNING, to=RunState.QUEUED),
    Event.RETRIED: _on(RunState.RUNNING, to=RunState.QUEUED),
    Event.HANDED_BACK: _on(RunState.RUNNING, to=RunState.QUEUED),
    Event.PAUSE_REQUESTED: _on(RunState.RUNNING),
    Event.PAUSE_WITHDRAWN: _on(RunState.RUNNING),
    Event.PAUSED: _on(RunState.BLOCKED, RunState.QUEUED, RunState.RUNNING, to=RunState.PAUSED),
    Event.RESUMED: _on(RunState.PAUSED, to=(RunState.QUEUED, RunState.BLOCKED)),
    Event.RESTARTED: _on(RunState.FAILED, RunState.CANCELLED, to=(RunState.QUEUED, RunState.BLOCKED)),
    Event.CANCEL_REQUESTED: _on(RunState.RUNNING),
    Event.SUCCEEDED: _on(RunState.RUNNING, to=RunState.SUCCEEDED),
    Event.FAILED: _on(RunState.RUNNING, to=RunState.FAILED),
    Event.CANCELLED: _on(*WAITING, RunState.RUNNING, to=RunState.CANCELLED),
    Event.DELETED: _on(*WAITING, *ENDED),
    Event.RESTORED: _on(*WAITING, *ENDED),
}
"""Every change of state there is; `created` is the way in."""


def change_state(
    conn: Connection,
    run_id: str,
    event: Event,
    *,
    at: datetime,
    reason: str | None = None,
    to: RunState | None = None,
    fence: int | None = None,
    changes: Mapping[str, Any] | None = None,
) -> AnyRow:
    """Let `event` happen to a run and write it into its history; return the changed row.

    Args:
        reason: why, in one sentence; it stands on the run as long as the state that follows.
        to: the state that follows, where the event has several.
        fence: the change is made only if this is still the run's fence.
        changes: further columns to set.

    Raises:
        NotFound: there is no such run.
        StaleFence: the run has moved on since the attempt with `fence` began.
        WrongState: the run's state does not allow the event.
    """
    row = try_change_state(conn, run_id, event, at=at, reason=reason, to=to, fence=fence, changes=changes)
    if row is not None:
        return row
    found = conn.execute(select(runs.c.state).where(runs.c.id == run_id)).one_or_none()
    if found is None:
        raise NotFound("run", run_id)
    if fence is not None:
        raise StaleFence(run_id, fence)
    raise WrongState(run_id, found.state, event, TRANSITIONS[event].allowed)


def try_change_state(
    conn: Connection,
    run_id: str | ScalarSelect[str],
    event: Event,
    *,
    at: datetime,
    reason: str | None = None,
    to: RunState | None = None,
    fence: int | None = None,
    changes: Mapping[str, Any] | None = None,
) -> AnyRow | None:
    """Let `event` happen to a run in one statement, or return None if it cannot."""
    transition = TRANSITIONS[event]
    following = _following(event, to)
    values = {"state": runs.c.state} if following is None else _arrival(following, at, reason)
    change = (
        update(runs)
        .where(runs.c.id == run_id, runs.c.state.in_(transition.allowed))
        .values({**values, **(changes or {})})
        .returning(*runs.c)
    )
    if fence is not None:
        change = change.where(runs.c.fence == fence)
    row = conn.execute(change).one_or_none()
    if row is not None:
        append_event(conn, row.id, event, RunState(row.state), at=at, attempt=row.attempt, detail=reason)
    return row


def _following(event: Event, to: RunState | None) -> RunState | None:
    """Return the state that follows an event, or None if the run stays where it is."""
    possible = TRANSITIONS[event].to
    if to is None and len(possible) <= 1:
        return next(iter(possible), None)
    if to not in possible:
        raise ValueError(f"'{event}' leads to {', '.join(sorted(possible)) or 'no other state'}, not to {to}")
    return to


def append_event(
    conn: Connection, run_id: str, event: Event, state: RunState, *, at: datetime, attempt: int, detail: str | None
) -> None:
    """Write one line of a run's history."""
    values = {"run_id": run_id, "event": event, "state": state, "at": at, "attempt": attempt, "detail": detail}
    conn.execute(insert(run_events).values(values))


def _arrival(to: RunState, at: datetime, reason: str | None) -> dict[str, Any]:
    """Return what every arrival in a state sets.

    A run that is not running has no worker, no lease and no pause ahead, and one that has ended will not be cancelled:
    the wish came too late for a run that has succeeded.
    """
    values: dict[str, Any] = {"state": to, "reason": reason}
    if to is not RunState.RUNNING:
        values |= {"worker_id": None, "lease_until": None, "pause_requested": False}
    if to in ENDED:
        values |= {"ended_at": at, "cancel_requested": False}
    return values
