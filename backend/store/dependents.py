"""Runs that need others: what they wait for, and what follows for them when one of those moves on.

Rows are always locked in the order of their launch, and a needed run is launched before those that need it. So two
transactions never wait for each other, and of two that end two needed runs at once, the later sees the earlier.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import Connection, or_, select

from backend.store.errors import NotFound
from backend.store.states import Event, RunState, change_state
from backend.store.tables import AnyRow, run_needs, runs


@dataclass(frozen=True)
class Held:
    """Hold a run and those that it needs, locked until the transaction ends."""

    run: AnyRow
    needed: tuple[AnyRow, ...]
    """The locomotion runs that it takes its reward from."""


def hold_run(conn: Connection, run_id: str) -> Held:
    """Lock a run and those that it needs.

    Raises:
        NotFound: there is no such run.
    """
    needed_ids = select(run_needs.c.needs_run_id).where(run_needs.c.run_id == run_id)
    query = select(runs).where(or_(runs.c.id == run_id, runs.c.id.in_(needed_ids))).order_by(runs.c.number)
    rows = conn.execute(query.with_for_update()).all()
    run = next((row for row in rows if row.id == run_id), None)
    if run is None:
        raise NotFound("run", run_id)
    return Held(run, tuple(row for row in rows if row.id != run_id))


def settle_dependents(conn: Connection, run_id: str, at: datetime) -> None:
    """Release every blocked run that waited only for this one, and tell the others why they wait on."""
    needs_this = select(run_needs.c.run_id).where(run_needs.c.needs_run_id == run_id)
    query = select(runs).where(runs.c.id.in_(needs_this), runs.c.state == RunState.BLOCKED).order_by(runs.c.number)
    for dependent in conn.execute(query.with_for_update()).all():
        _settle(conn, dependent, at)


def why_blocked(needed: Sequence[AnyRow], gate: float, waived: bool = False) -> str | None:
    """Return why a run cannot start yet, or None if all it needs is there.

    Args:
        needed: rows of the locomotion runs that it takes its reward from.
        gate: the test success that each of them must have reached.
        waived: whether a person has let the run start below its gate.
    """
    reasons = (_obstacle(row, 0.0 if waived else gate) for row in needed)
    return next((reason for reason in reasons if reason is not None), None)


def why_held(held: Held) -> str | None:
    """Return why a run that is there already cannot start yet, or None if all it needs is there."""
    return why_blocked(held.needed, held.run.config["sldr"]["gate"], held.run.gate_waived)


def _settle(conn: Connection, dependent: AnyRow, at: datetime) -> None:
    needed_ids = select(run_needs.c.needs_run_id).where(run_needs.c.run_id == dependent.id)
    needed = conn.execute(select(runs).where(runs.c.id.in_(needed_ids)).order_by(runs.c.number)).all()
    reason = why_held(Held(dependent, tuple(needed)))
    if reason is None:
        change_state(conn, dependent.id, Event.UNBLOCKED, at=at)
    elif reason != dependent.reason:
        change_state(conn, dependent.id, Event.HELD, at=at, reason=reason, changes={"reason": reason})


def _obstacle(needed: AnyRow, gate: float) -> str | None:
    state = RunState(needed.state)
    if state in (RunState.FAILED, RunState.CANCELLED):
        ended = "failed" if state is RunState.FAILED else "was cancelled"
        return f"Its locomotion run {needed.id} {ended}, so there is no reward to learn from; retry that one."
    if state is not RunState.SUCCEEDED:
        return f"Waits for the locomotion run {needed.id}."
    success = needed.success_rate or 0.0
    if success >= gate:
        return None
    return (
        f"Its locomotion run {needed.id} reached {success:.1%} test success, below the gate of {gate:.1%}; "
        "release it anyway, or launch again with a longer preset or a lower sldr.gate."
    )
