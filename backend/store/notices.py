"""What people want to hear of: a study has ended, a run has failed. Read from how runs stand, so nothing is missed."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from datetime import datetime
from typing import Literal

from sqlalchemy import Connection, func, select

from backend.store.database import Database
from backend.store.states import ENDED, RunState
from backend.store.tables import runs, studies, study_runs

NoticeEvent = Literal["study_ended", "run_failed"]


@dataclass(frozen=True)
class Notice:
    """Say what has happened to one run or study."""

    event: NoticeEvent
    subject: str
    """Id of the run or study."""
    occasion: str
    """Tells it apart from the same event at another time: a run that failed again, a study that was extended."""
    at: datetime
    message: str
    """What has happened, in one sentence."""

    @property
    def path(self) -> str:
        """Where the page shows it."""
        return f"/studies/{self.subject}" if self.event == "study_ended" else f"/runs/{self.subject}"


def list_notices(db: Database, since: datetime) -> list[Notice]:
    """Return what has happened after a time, oldest first."""
    with db.read() as conn:
        return select_notices(conn, since)


def select_notices(conn: Connection, since: datetime) -> list[Notice]:
    """Return what has happened after a time, oldest first."""
    return sorted([*_failed_runs(conn, since), *_ended_studies(conn, since)], key=lambda notice: notice.at)


def _failed_runs(conn: Connection, since: datetime) -> list[Notice]:
    lately = (runs.c.state == RunState.FAILED, runs.c.ended_at > since, runs.c.deleted_at.is_(None))
    told = (
        runs.c.id,
        runs.c.fence,
        runs.c.ended_at,
        runs.c.reason,
        runs.c.task,
        runs.c.phase,
        runs.c.method,
        runs.c.seed,
    )
    query = select(*told).where(*lately).order_by(runs.c.ended_at)
    return [
        Notice(
            event="run_failed",
            subject=row.id,
            occasion=str(row.fence),
            at=row.ended_at,
            message=f"Run {row.id} failed ({row.task}, {row.phase}, {row.method}, seed {row.seed}): {row.reason}",
        )
        for row in conn.execute(query)
    ]


def _ended_studies(conn: Connection, since: datetime) -> list[Notice]:
    """Return the studies whose last run has ended after a time."""
    of_study = (studies.c.deleted_at.is_(None), runs.c.deleted_at.is_(None))
    joined = studies.join(study_runs, study_runs.c.study_id == studies.c.id).join(
        runs, runs.c.id == study_runs.c.run_id
    )
    lately = (
        select(studies.c.id)
        .select_from(joined)
        .where(*of_study)
        .group_by(studies.c.id)
        .having(func.max(runs.c.ended_at) > since)
    )
    query = (
        select(
            studies.c.id,
            studies.c.name,
            runs.c.state,
            func.count().label("run_count"),
            func.max(runs.c.ended_at).label("at"),
        )
        .select_from(joined)
        .where(*of_study, studies.c.id.in_(lately))
        .group_by(studies.c.id, studies.c.name, runs.c.state)
    )
    tallies: dict[tuple[str, str], list[tuple[RunState, int, datetime | None]]] = {}
    for row in conn.execute(query):
        tallies.setdefault((row.id, row.name), []).append((RunState(row.state), row.run_count, row.at))
    return [
        _study_notice(study_id, name, tally)
        for (study_id, name), tally in tallies.items()
        if all(state in ENDED for state, _, _ in tally)
    ]


def _study_notice(study_id: str, name: str, tally: list[tuple[RunState, int, datetime | None]]) -> Notice:
    at = max(ended_at for _, _, ended_at in tally if ended_at is not None)
    counts = Counter({state: count for state, count, _ in tally})
    told = ", ".join(f"{counts[state]} {state}" for state in sorted(ENDED) if counts[state])
    return Notice("study_ended", study_id, at.isoformat(), at, f"Study '{name}' has ended: {told}.")
