"""What people write on runs: tags, by which runs are found again, and notes."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from sqlalchemy import Connection, delete, func, insert, select, update

from backend.store.database import Database
from backend.store.errors import NotFound
from backend.store.tables import run_tags, runs
from sldr_core.errors import InvalidConfig

LONGEST_TAG = 40
"""Characters of a tag."""
MOST_TAGS = 30
"""Tags of one run."""
LONGEST_NOTES = 10_000
"""Characters of a run's notes."""


@dataclass(frozen=True)
class TagCount:
    """Say how many runs have a tag."""

    tag: str
    runs: int


def change_tags(db: Database, run_ids: Sequence[str], add: Collection[str], remove: Collection[str]) -> None:
    """Give runs tags and take others away: of all of them or, if one does not allow it, of none.

    Raises:
        InvalidConfig: a tag is none, or a run would have too many.
        NotFound: there is no such run.
    """
    added = {_checked(tag) for tag in add}
    with db.write() as conn:
        _hold_runs(conn, run_ids)
        conn.execute(delete(run_tags).where(run_tags.c.run_id.in_(run_ids), run_tags.c.tag.in_(remove)))
        there = select_tags(conn, run_ids)
        rows = [
            {"run_id": run_id, "tag": tag}
            for run_id in dict.fromkeys(run_ids)
            for tag in sorted(added - set(there.get(run_id, ())))
        ]
        if rows:
            conn.execute(insert(run_tags), rows)
        _check_counts(conn, run_ids)


def set_notes(db: Database, run_id: str, notes: str) -> None:
    """Replace the notes of a run, which are plain text.

    Raises:
        InvalidConfig: they are too long.
        NotFound: there is no such run.
    """
    if len(notes) > LONGEST_NOTES:
        raise InvalidConfig({"notes": f"they have {len(notes)} characters; {LONGEST_NOTES} fit."})
    with db.write() as conn:
        if conn.execute(update(runs).where(runs.c.id == run_id).values(notes=notes or None)).rowcount == 0:
            raise NotFound("run", run_id)


def list_tags(db: Database) -> list[TagCount]:
    """Return every tag that a run has which is not deleted, in the order of the alphabet."""
    query = (
        select(run_tags.c.tag, func.count().label("runs"))
        .join(runs, runs.c.id == run_tags.c.run_id)
        .where(runs.c.deleted_at.is_(None))
        .group_by(run_tags.c.tag)
    )
    with db.read() as conn:
        return sorted((TagCount(row.tag, row.runs) for row in conn.execute(query)), key=lambda count: count.tag)


def select_tags(conn: Connection, run_ids: Collection[str]) -> dict[str, tuple[str, ...]]:
    """Return the tags of those of the runs that have any, each in the order of the alphabet."""
    tags: dict[str, tuple[str, ...]] = {}
    for row in conn.execute(select(run_tags).where(run_tags.c.run_id.in_(run_ids))):
        tags[row.run_id] = tuple(sorted((*tags.get(row.run_id, ()), row.tag)))
    return tags


def _checked(tag: str) -> str:
    tag = tag.strip()
    if not tag or len(tag) > LONGEST_TAG or not tag.isprintable() or "," in tag:
        raise InvalidConfig(
            {"add": f"'{tag}' is no tag; write 1 to {LONGEST_TAG} characters on one line, without a comma."}
        )
    return tag


def _hold_runs(conn: Connection, run_ids: Sequence[str]) -> None:
    """Let nobody else change the tags of these runs until this transaction ends."""
    query = select(runs.c.id).where(runs.c.id.in_(run_ids)).order_by(runs.c.number).with_for_update()
    there = set(conn.execute(query).scalars())
    for run_id in run_ids:
        if run_id not in there:
            raise NotFound("run", run_id)


def _check_counts(conn: Connection, run_ids: Sequence[str]) -> None:
    for run_id, tags in select_tags(conn, run_ids).items():
        if len(tags) > MOST_TAGS:
            raise InvalidConfig({"add": f"run {run_id} would have {len(tags)} tags; {MOST_TAGS} fit."})
