"""What follows for the runs that need another one, once that one has moved on."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime

from sqlalchemy import Connection, select

from backend.store.states import Event, RunState, change_state
from backend.store.tables import AnyRow, run_needs, runs


def settle_dependents(conn: Connection, run_id: str, at: datetime) -> None:
    """Release every blocked run that waited only for this one, and tell the others why they wait on."""
    needs_this = select(run_needs.c.run_id).where(run_needs.c.needs_run_id == run_id)
    query = select(runs).where(runs.c.id.in_(needs_this), runs.c.state == RunState.BLOCKED).order_by(runs.c.number)
    # Locked: when two runs that one dependent needs end at once, the second to look sees the end of both.
    for dependent in conn.execute(query.with_for_update()).all():
        _settle(conn, dependent, at)


def why_blocked(needed: Sequence[AnyRow], gate: float) -> str | None:
    """Return why a run cannot start yet, or None if all it needs is there.

    Args:
        needed: rows of the locomotion runs that it takes its reward from.
        gate: the test success that each of them must have reached.
    """
    reasons = (_obstacle(row, gate) for row in needed)
    return next((reason for reason in reasons if reason is not None), None)


def _settle(conn: Connection, dependent: AnyRow, at: datetime) -> None:
    needed_ids = select(run_needs.c.needs_run_id).where(run_needs.c.run_id == dependent.id)
    needed = conn.execute(select(runs).where(runs.c.id.in_(needed_ids)).order_by(runs.c.number)).all()
    reason = why_blocked(needed, dependent.config["sldr"]["gate"])
    if reason is None:
        change_state(conn, dependent.id, Event.UNBLOCKED, at=at)
    elif reason != dependent.reason:
        change_state(conn, dependent.id, Event.HELD, at=at, reason=reason)


def _obstacle(needed: AnyRow, gate: float) -> str | None:
    state = RunState(needed.state)
    if state in (RunState.FAILED, RunState.CANCELLED):
        ended = "failed" if state is RunState.FAILED else "was cancelled"
        return f"Its locomotion run {needed.id} {ended}, so there is no reward to learn from; launch again."
    if state is not RunState.SUCCEEDED:
        return f"Waits for the locomotion run {needed.id}."
    success = needed.success_rate or 0.0
    if success >= gate:
        return None
    return (
        f"Its locomotion run {needed.id} reached {success:.1%} test success, below the gate of {gate:.1%}; "
        "choose a longer preset, or lower sldr.gate, and launch again."
    )
