"""Small pictures of runs: planned by whoever draws, as policies come in, so that no page has to ask for one."""

from __future__ import annotations

from datetime import datetime, timedelta
from typing import Any

from sqlalchemy import Select, and_, exists, or_, select

from backend.store.database import Database, current_time
from backend.store.media_jobs import MediaJob, MediaOrder, order_media
from backend.store.states import ENDED
from backend.store.tables import media_jobs, run_files, runs

THUMBNAIL_FILE = "thumbnail.webp"
"""The one small picture of a run; a newer one takes its place."""
THUMBNAIL_SOURCE = "policy-newest.pt"
"""The file whose policy a thumbnail shows."""
THUMBNAIL = {"file": THUMBNAIL_SOURCE, "number": 3, "width": 320, "height": 200}
"""How it is drawn: the end of the policy's episode with this seed, at this size [pixels]."""
THUMBNAIL_RENEWAL_S = 600.0
"""While a run trains, its thumbnail is drawn again when it is older than this [s]."""


def plan_thumbnail(db: Database) -> MediaJob | None:
    """Order the thumbnail of the run whose newest policy has none, or an old one; None if all have theirs."""
    with db.read() as conn:
        row = conn.execute(_missing_thumbnail(current_time(conn))).one_or_none()
    if row is None:
        return None
    return order_media(db, MediaOrder(row.run_id, "thumbnail", row.sha256, THUMBNAIL_FILE, dict(THUMBNAIL)))


def _missing_thumbnail(at: datetime) -> Select[Any, Any]:
    policy, thumbnail = run_files.alias("policy"), run_files.alias("thumbnail")
    is_ordered = exists().where(
        media_jobs.c.run_id == policy.c.run_id,
        media_jobs.c.kind == "thumbnail",
        media_jobs.c.source == policy.c.sha256,
    )
    is_due = or_(thumbnail.c.created_at < at - timedelta(seconds=THUMBNAIL_RENEWAL_S), runs.c.state.in_(sorted(ENDED)))
    return (
        select(policy.c.run_id, policy.c.sha256)
        .join(runs, and_(runs.c.id == policy.c.run_id, runs.c.deleted_at.is_(None)))
        .outerjoin(thumbnail, and_(thumbnail.c.run_id == policy.c.run_id, thumbnail.c.name == THUMBNAIL_FILE))
        .where(policy.c.name == THUMBNAIL_SOURCE, ~is_ordered)
        .where(or_(thumbnail.c.run_id.is_(None), and_(thumbnail.c.created_at < policy.c.created_at, is_due)))
        .order_by(policy.c.created_at.desc())
        .limit(1)
    )
