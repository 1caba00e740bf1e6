"""How an attempt can end, and what follows for its run: the end, another attempt, or a wait for a person."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any

from sqlalchemy import Connection, exists, select, update

from backend.store.dependents import settle_dependents
from backend.store.states import Event, change_state
from backend.store.tables import AnyRow, attempts, run_files

MAX_ATTEMPTS = 3
"""Attempts that may fail in a row before the run fails. A new checkpoint begins the row afresh."""
MAX_DEATHS = 10
"""Attempts that may be killed or lose their machine in a row; that says little about the run itself."""
RETRY_BACKOFF_S = 2.0
"""Wait before the first retry, doubled for each further one in the row [s]."""
LONGEST_BACKOFF_S = 60.0
"""The wait grows no further than this [s]."""
CHECKPOINT_KIND = "checkpoint"
"""Files of this kind are what another attempt goes on from."""


@dataclass(frozen=True)
class Succeeded:
    """The training came to its end."""

    success_rate: float | None
    """Success of the last test; it decides whether dependents may start."""


@dataclass(frozen=True)
class Failed:
    """The attempt ended by an error."""

    reason: str
    """Why, in one sentence."""
    retry: bool
    """Whether another attempt could do better."""


@dataclass(frozen=True)
class Lost:
    """The attempt's process was killed from outside, or is out of reach for good: its machine is gone."""

    reason: str
    """Why, in one sentence."""


@dataclass(frozen=True)
class Cancelled:
    """The training ended because a person wished so."""


@dataclass(frozen=True)
class Paused:
    """The training is checkpointed and waits for a person."""


@dataclass(frozen=True)
class HandedBack:
    """The worker gives the run back unharmed; any worker may go on with it."""

    reason: str
    """Why, in one sentence."""
    delay_s: float = 0.0
    """How long no worker should take it [s]."""


Outcome = Succeeded | Failed | Lost | Cancelled | Paused | HandedBack
"""How an attempt ended."""


def end_attempt(conn: Connection, row: AnyRow, outcome: Outcome, at: datetime, backoff_s: float) -> None:
    """Record how the attempt of a locked, running run ended, and let follow what follows from it.

    Args:
        row: the run.
        backoff_s: wait before the first retry [s].
    """
    match outcome:
        case Succeeded(success_rate):
            _end(conn, row, Event.SUCCEEDED, at, None, {"success_rate": success_rate})
        case Cancelled():
            _end(conn, row, Event.CANCELLED, at, "Cancelled while it ran.")
        case Failed(reason, retry=False):
            _end(conn, row, Event.FAILED, at, reason)
        case Failed(reason):
            _retry(conn, row, Event.RETRIED, reason, at, backoff_s)
        case Lost(reason):
            _retry(conn, row, Event.LOST, reason, at, backoff_s)
        case Paused() if row.pause_requested:
            _leave(conn, row, Event.PAUSED, at, None, {})
        case Paused():
            _leave(conn, row, Event.HANDED_BACK, at, "It was paused, and resumed before its cycle was over.", {})
        case HandedBack(reason, delay_s):
            _leave(conn, row, Event.HANDED_BACK, at, reason, {"not_before": at + timedelta(seconds=delay_s)})


def lose_attempt(conn: Connection, row: AnyRow, at: datetime, backoff_s: float) -> None:
    """Take a locked, running run from its worker, which gave no sign of life."""
    end_attempt(conn, row, Lost(f"Its worker {row.worker_id} gave no sign of life."), at, backoff_s)


def _retry(conn: Connection, row: AnyRow, event: Event, reason: str, at: datetime, backoff_s: float) -> None:
    failures, deaths = (0, 0) if _has_come_further(conn, row) else (row.failures, row.deaths)
    failures, deaths = (failures, deaths + 1) if event is Event.LOST else (failures + 1, deaths)
    counts = {"failures": failures, "deaths": deaths}
    if failures >= MAX_ATTEMPTS or deaths >= MAX_DEATHS:
        _end(conn, row, Event.FAILED, at, f"{reason} It was tried {failures + deaths} times.", counts)
        return
    wait_s = min(backoff_s * 2 ** (failures + deaths - 1), LONGEST_BACKOFF_S)
    _leave(conn, row, event, at, reason, {**counts, "not_before": at + timedelta(seconds=wait_s)})


def _has_come_further(conn: Connection, row: AnyRow) -> bool:
    """Tell whether the attempt has left a checkpoint of its own."""
    there = (run_files.c.run_id == row.id, run_files.c.kind == CHECKPOINT_KIND, run_files.c.attempt == row.attempt)
    return conn.execute(select(exists().where(*there))).scalar_one()


def _leave(
    conn: Connection, row: AnyRow, event: Event, at: datetime, reason: str | None, changes: dict[str, Any]
) -> None:
    """End the attempt but not the run, unless a person wanted the run to end or to wait meanwhile."""
    if row.cancel_requested:
        _end(conn, row, Event.CANCELLED, at, "Cancelled while it ran.")
        return
    following, why = event, reason
    if row.pause_requested and event is not Event.PAUSED:
        following, why = Event.PAUSED, f"{reason} It is paused, as was asked."
    change_state(conn, row.id, following, at=at, reason=why, fence=row.fence, changes=changes)
    _close_attempt(conn, row, event, reason, at)


def _end(
    conn: Connection,
    row: AnyRow,
    event: Event,
    at: datetime,
    reason: str | None,
    changes: dict[str, Any] | None = None,
) -> None:
    """End attempt and run, and let the runs that need it know."""
    change_state(conn, row.id, event, at=at, reason=reason, fence=row.fence, changes=changes)
    _close_attempt(conn, row, event, reason, at)
    settle_dependents(conn, row.id, at)


def _close_attempt(conn: Connection, row: AnyRow, outcome: Event, reason: str | None, at: datetime) -> None:
    this = (attempts.c.run_id == row.id, attempts.c.attempt == row.attempt)
    conn.execute(update(attempts).where(*this).values(ended_at=at, outcome=outcome, reason=reason))
