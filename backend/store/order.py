"""The order of the queue: by priority, and within one priority by a position that a person can change."""

from __future__ import annotations

from collections.abc import Sequence

from sqlalchemy import Connection, func, select, update

from backend.store.database import Database
from backend.store.errors import NotFound, Refused
from backend.store.states import WAITING
from backend.store.tables import AnyRow, runs
from sldr_core.errors import InvalidConfig

HIGHEST_PRIORITY = 100
"""Priorities go from minus this to this; runs of a higher one start first, 0 is usual."""

CLAIM_ORDER = (runs.c.rank, runs.c.queue_position, runs.c.number)
"""The order in which workers take runs."""


def set_priority(db: Database, run_ids: Sequence[str], priority: int) -> None:
    """Give runs a priority; all of them or, if one does not exist, none.

    Raises:
        InvalidConfig: there is no such priority.
        NotFound: there is no such run.
    """
    if abs(priority) > HIGHEST_PRIORITY:
        raise InvalidConfig(
            {"priority": f"it must be between {-HIGHEST_PRIORITY} and {HIGHEST_PRIORITY}, got {priority}"}
        )
    with db.write() as conn:
        # In the order of their launch, as all who lock several: two at once would wait for each other.
        query = select(runs.c.id).where(runs.c.id.in_(run_ids)).order_by(runs.c.number)
        there = set(conn.execute(query.with_for_update()).scalars())
        for run_id in run_ids:
            if run_id not in there:
                raise NotFound("run", run_id)
        conn.execute(update(runs).where(runs.c.id.in_(there)).values(rank=-priority))


def move_run(db: Database, run_id: str, before: str | None) -> None:
    """Put a waiting run right before another one, or at the end of the queue.

    It keeps its priority where that fits between its new neighbours; else it takes the nearest that does.

    Raises:
        NotFound: there is no such run.
        Refused: one of the two does not wait.
    """
    if run_id == before:
        return
    with db.write() as conn:
        queue = _waiting_runs(conn)
        places = {row.id: place for place, row in enumerate(queue)}
        for wanted in (run_id, before):
            if wanted is not None and wanted not in places:
                raise _why_not_there(conn, wanted)
        moved = queue[places[run_id]]
        others = [row for row in queue if row.id != run_id]
        place = len(others) if before is None else next(i for i, row in enumerate(others) if row.id == before)
        ahead, behind = others[:place], others[place:]
        rank = _fitting_rank(moved, ahead, behind)
        alike_ahead = [row for row in ahead if row.rank == rank]
        alike_behind = [row for row in behind if row.rank == rank]
        position = _position_between(alike_ahead, alike_behind, moved.queue_position)
        if position is None:
            _number_afresh(conn, [*alike_ahead, moved, *alike_behind], rank)
        else:
            conn.execute(update(runs).where(runs.c.id == run_id).values(rank=rank, queue_position=position))


def last_position(conn: Connection) -> float:
    """Return a position behind every other run."""
    return conn.execute(select(func.coalesce(func.max(runs.c.queue_position), 0.0))).scalar_one() + 1.0


def _waiting_runs(conn: Connection) -> Sequence[AnyRow]:
    columns = (runs.c.id, runs.c.rank, runs.c.queue_position, runs.c.number)
    waiting = (runs.c.state.in_(WAITING), runs.c.deleted_at.is_(None))
    return conn.execute(select(*columns).where(*waiting).order_by(*CLAIM_ORDER)).all()


def _why_not_there(conn: Connection, run_id: str) -> NotFound | Refused:
    state = conn.execute(select(runs.c.state).where(runs.c.id == run_id)).scalar_one_or_none()
    if state is None:
        return NotFound("run", run_id)
    return Refused(f"Run {run_id} is {state} or deleted; only waiting runs have a place in the queue.")


def _fitting_rank(moved: AnyRow, ahead: Sequence[AnyRow], behind: Sequence[AnyRow]) -> int:
    lowest = ahead[-1].rank if ahead else moved.rank
    highest = behind[0].rank if behind else moved.rank
    return min(max(moved.rank, lowest), max(highest, lowest))


def _position_between(ahead: Sequence[AnyRow], behind: Sequence[AnyRow], own: float) -> float | None:
    """Return a position between neighbours of the same priority, or None if no number lies between theirs."""
    if ahead and behind:
        low: float = ahead[-1].queue_position
        high: float = behind[0].queue_position
        middle = (low + high) / 2.0
        return middle if low < middle < high else None
    if behind:
        return behind[0].queue_position - 1.0
    return ahead[-1].queue_position + 1.0 if ahead else own


def _number_afresh(conn: Connection, queue: Sequence[AnyRow], rank: int) -> None:
    # In the order of their launch; see `set_priority`.
    for position, row in sorted(enumerate(queue, start=1), key=lambda placed: placed[1].number):
        conn.execute(update(runs).where(runs.c.id == row.id).values(rank=rank, queue_position=float(position)))
