"""Pictures and videos of runs: ordered by the page or planned by the host, drawn one after the other.

A job's id follows from what is asked for, so the same picture is never drawn twice. A claim raises the job's fence;
what comes from an older claim is refused. A host that ends in good order gives its claim back.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any, Literal

from sqlalchemy import Connection, RowMapping, Update, and_, delete, insert, or_, select, update

from backend.store.database import Database, current_time
from backend.store.errors import NotFound
from backend.store.tables import ID_LENGTH, SHARED, file_removals, media_jobs, run_files, runs

MediaKind = Literal["thumbnail", "video"]
"""What is drawn."""
MediaState = Literal["queued", "running", "done", "failed"]
"""Where a job stands."""

LEASE_S = 60.0
"""A job goes to another host after this long without a sign of life [s]."""
MOST_CLAIMS = 5
"""A job whose hosts died this often is given up."""
GIVEN_UP = f"Whoever drew it died {MOST_CLAIMS} times; the viewer's log says more."

NO_ATTEMPT = 0
"""The attempt of files that none has written: a picture is drawn from files, whoever trains meanwhile."""


@dataclass(frozen=True)
class MediaOrder:
    """Say what is to be drawn."""

    run_id: str
    kind: MediaKind
    source: str
    """Checksum of the file that it is drawn from: other bytes make another picture."""
    file_name: str
    """The file of the run that it becomes."""
    arguments: dict[str, Any]
    """What else decides how it looks, as plain JSON."""

    @property
    def job_id(self) -> str:
        """The id of the job, the same for the same picture."""
        words = [self.run_id, self.kind, self.source, self.file_name, self.arguments]
        return hashlib.sha256(json.dumps(words, sort_keys=True).encode()).hexdigest()[:ID_LENGTH]


@dataclass(frozen=True)
class MediaJob:
    """Describe one picture or video and how far it is."""

    id: str
    run_id: str
    kind: MediaKind
    source: str
    file_name: str
    arguments: dict[str, Any]
    state: MediaState
    reason: str | None
    """Why it failed, in one sentence."""
    fence: int
    """Counts the claims that were not given back; writes of an older one are refused."""
    lease_until: datetime | None
    created_at: datetime
    ended_at: datetime | None


@dataclass(frozen=True)
class MadeFile:
    """Say where a finished file lies."""

    path: str
    """Below the data directory or the place that machines share."""
    size: int
    """Length [bytes]."""
    sha256: str


def order_media(db: Database, order: MediaOrder) -> MediaJob:
    """Ask for a picture; one that is asked for or done already is returned as it is, one that failed is tried again.

    Raises:
        NotFound: there is no such run.
    """
    with db.write() as conn:
        # Whoever orders for this run waits here for the one before.
        if conn.execute(select(runs.c.id).where(runs.c.id == order.run_id).with_for_update()).one_or_none() is None:
            raise NotFound("run", order.run_id)
        row = _find(conn, order.job_id)
        if row is None:
            conn.execute(insert(media_jobs).values(**_values_of(order), created_at=current_time(conn)))
        elif row["state"] == "failed":
            afresh = {"state": "queued", "reason": None, "fence": 0, "lease_until": None, "ended_at": None}
            conn.execute(update(media_jobs).where(media_jobs.c.id == row["id"]).values(afresh))
        return _job(_find(conn, order.job_id))


def claim_media(db: Database, lease_s: float = LEASE_S) -> MediaJob | None:
    """Take the job that has waited longest, or one whose host has died; None if there is nothing to draw."""
    with db.write() as conn:
        while (row := _take_next(conn, lease_s)) is not None:
            if row["fence"] <= MOST_CLAIMS:
                return _job(row)
            conn.execute(_end(row["id"], row["fence"], "failed", GIVEN_UP, current_time(conn)))
    return None


def renew_media(db: Database, job: MediaJob, lease_s: float = LEASE_S) -> bool:
    """Show that a job is being drawn; False if it was given to another host."""
    with db.write() as conn:
        values = {"lease_until": current_time(conn) + timedelta(seconds=lease_s)}
        return conn.execute(_held(job.id, job.fence).values(values)).rowcount > 0


def release_media(db: Database, job: MediaJob) -> None:
    """Put a job back that was not drawn to its end; whoever does so has not died, and writes nothing more of it."""
    with db.write() as conn:
        conn.execute(_held(job.id, job.fence).values(state="queued", lease_until=None, fence=job.fence - 1))


def fail_media(db: Database, job: MediaJob, reason: str) -> bool:
    """Record why a job could not be drawn; False if another host has it by now."""
    with db.write() as conn:
        return conn.execute(_end(job.id, job.fence, "failed", reason, current_time(conn))).rowcount > 0


def finish_media(db: Database, job: MediaJob, made: MadeFile) -> str | None:
    """Record a finished file among the run's files; one of the same name is replaced.

    Returns:
        The path whose bytes no row holds any more, if there is one: the new one, if another host has the job by now
        and has not made the same bytes, nor this one in a try whose answer was lost.
    """
    with db.write() as conn:
        at = current_time(conn)
        if conn.execute(_end(job.id, job.fence, "done", None, at)).rowcount == 0:
            return None if _is_registered(conn, job.run_id, made.path) else made.path
        this = (run_files.c.run_id == job.run_id, run_files.c.name == job.file_name)
        before = conn.execute(select(run_files.c.path).where(*this)).scalar_one_or_none()
        conn.execute(delete(run_files).where(*this))
        values = {"run_id": job.run_id, "name": job.file_name, "kind": job.kind, "attempt": NO_ATTEMPT}
        conn.execute(
            insert(run_files).values(**values, path=made.path, size=made.size, sha256=made.sha256, created_at=at)
        )
        # It may have been drawn anew where an earlier one was to be removed.
        marks = (made.path, f"{SHARED}{made.path}")
        conn.execute(delete(file_removals).where(file_removals.c.run_id == job.run_id, file_removals.c.path.in_(marks)))
        # What the new file has replaced was of an older source: whoever asks for that again gets it drawn again.
        replaced = (media_jobs.c.run_id == job.run_id, media_jobs.c.file_name == job.file_name)
        conn.execute(delete(media_jobs).where(*replaced, media_jobs.c.id != job.id, media_jobs.c.state == "done"))
    return None if before == made.path else before


def _is_registered(conn: Connection, run_id: str, path: str) -> bool:
    held = select(run_files.c.name).where(run_files.c.run_id == run_id, run_files.c.path == path)
    return conn.execute(held).first() is not None


def get_media(db: Database, job_id: str) -> MediaJob:
    """Return one job.

    Raises:
        NotFound: there is no such job.
    """
    with db.read() as conn:
        row = _find(conn, job_id)
    if row is None:
        raise NotFound("picture or video", job_id)
    return _job(row)


def list_media(db: Database, run_id: str, kind: MediaKind) -> list[MediaJob]:
    """Return the jobs of a run, the newest first."""
    query = select(media_jobs).where(media_jobs.c.run_id == run_id, media_jobs.c.kind == kind)
    with db.read() as conn:
        return [
            _job(row)
            for row in conn.execute(query.order_by(media_jobs.c.created_at.desc(), media_jobs.c.id)).mappings()
        ]


def _take_next(conn: Connection, lease_s: float) -> RowMapping | None:
    at = current_time(conn)
    is_left = and_(media_jobs.c.state == "running", media_jobs.c.lease_until < at)
    first = (
        select(media_jobs.c.id)
        .where(or_(media_jobs.c.state == "queued", is_left))
        .order_by(media_jobs.c.created_at, media_jobs.c.id)
        .limit(1)
        .with_for_update(skip_locked=True)
        .scalar_subquery()
    )
    taken = {
        "state": "running",
        "fence": media_jobs.c.fence + 1,
        "lease_until": at + timedelta(seconds=lease_s),
    }
    return (
        conn.execute(update(media_jobs).where(media_jobs.c.id == first).values(taken).returning(*media_jobs.c))
        .mappings()
        .one_or_none()
    )


def _held(job_id: str, fence: int) -> Update:
    return update(media_jobs).where(
        media_jobs.c.id == job_id, media_jobs.c.fence == fence, media_jobs.c.state == "running"
    )


def _end(job_id: str, fence: int, state: MediaState, reason: str | None, at: datetime) -> Update:
    return _held(job_id, fence).values(state=state, reason=reason, lease_until=None, ended_at=at)


def _find(conn: Connection, job_id: str) -> RowMapping | None:
    return conn.execute(select(media_jobs).where(media_jobs.c.id == job_id)).mappings().one_or_none()


def _values_of(order: MediaOrder) -> dict[str, Any]:
    return {
        "id": order.job_id,
        "run_id": order.run_id,
        "kind": order.kind,
        "source": order.source,
        "file_name": order.file_name,
        "arguments": order.arguments,
        "state": "queued",
        "fence": 0,
    }


def _job(row: RowMapping | None) -> MediaJob:
    assert row is not None
    return MediaJob(**row)
