"""The recorded episodes of runs: a row for each, beside the row of the file that holds it."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal, cast

from sqlalchemy import ColumnElement, delete, func, insert, select

from backend.store.claims import Claim, hold_fence
from backend.store.database import Database
from backend.store.errors import NotFound
from backend.store.files import FileRow
from backend.store.tables import AnyRow, episodes, run_files
from sldr_core.episodes import KIND, EpisodeSummary, Tag, epoch_of

EpisodeSort = Literal["epoch", "return", "success", "worst_q"]
"""What a list of episodes can be sorted by. Equal ones stand newest test first."""

_SORTED_BY: dict[EpisodeSort, ColumnElement[Any]] = {
    "epoch": episodes.c.epoch,
    "return": episodes.c.task_return,
    "success": episodes.c.success,
    # A run without SLDR has no q at all, and no order then.
    "worst_q": func.coalesce(episodes.c.worst_q, 0.0),
}


@dataclass(frozen=True)
class EpisodeRow:
    """Describe one recorded episode, and where it is found."""

    summary: EpisodeSummary
    file: str
    """Name of the run's file that holds it."""
    attempt: int
    """The attempt that recorded it."""


@dataclass(frozen=True)
class EpisodeFilter:
    """Say which episodes are wanted; None is any."""

    tag: Tag | None = None
    epoch: int | None = None


@dataclass(frozen=True)
class EpisodePage:
    """Hold a piece of a list of episodes."""

    rows: list[EpisodeRow]
    total: int
    """Episodes that the filter lets through."""
    epochs: list[int]
    """Epochs that have any episode, whatever the filter."""


def register_episodes(db: Database, claim: Claim, file: str, summaries: Sequence[EpisodeSummary]) -> None:
    """Record the episodes of one file, all of one epoch; what was recorded of that epoch before is replaced.

    Raises:
        StaleFence: the attempt is over.
    """
    with db.write() as conn:
        hold_fence(conn, claim)
        for epoch in {summary.epoch for summary in summaries}:
            conn.execute(delete(episodes).where(episodes.c.run_id == claim.run_id, episodes.c.epoch == epoch))
        common = {"run_id": claim.run_id, "attempt": claim.attempt, "file": file}
        rows = [asdict(summary) for summary in summaries]
        conn.execute(insert(episodes), [{**common, **row, "number": row.pop("index")} for row in rows])


def forget_episodes(db: Database, claim: Claim, newest: int, kept_epochs: Collection[int]) -> list[FileRow]:
    """Drop the episodes of tests before epoch `newest` that are not of `kept_epochs`, and the rows of their files.

    Returns:
        The files that are no longer registered; their bytes are still there.

    Raises:
        StaleFence: the attempt is over.
    """
    with db.write() as conn:
        hold_fence(conn, claim)
        query = select(run_files).where(run_files.c.run_id == claim.run_id, run_files.c.kind == KIND)
        dropped: list[FileRow] = []
        for row in conn.execute(query).mappings():
            epoch = epoch_of(row["name"])
            if epoch is not None and epoch < newest and epoch not in kept_epochs:
                dropped.append(FileRow(**row))
        names = [row.name for row in dropped]
        conn.execute(delete(run_files).where(run_files.c.run_id == claim.run_id, run_files.c.name.in_(names)))
        conn.execute(delete(episodes).where(episodes.c.run_id == claim.run_id, episodes.c.file.in_(names)))
    return dropped


def list_episodes(
    db: Database, run_id: str, wanted: EpisodeFilter, sort: EpisodeSort, descending: bool, limit: int, offset: int
) -> EpisodePage:
    """Return a piece of a run's list of episodes."""
    of_run = episodes.c.run_id == run_id
    there = [of_run]
    if wanted.tag is not None:
        there.append(episodes.c.tag == wanted.tag)
    if wanted.epoch is not None:
        there.append(episodes.c.epoch == wanted.epoch)
    value = _SORTED_BY[sort]
    order = (value.desc() if descending else value.asc(), episodes.c.epoch.desc(), episodes.c.number)
    with db.read() as conn:
        total = conn.execute(select(func.count()).select_from(episodes).where(*there)).scalar_one()
        rows = conn.execute(select(episodes).where(*there).order_by(*order).limit(limit).offset(offset)).all()
        epochs = conn.execute(select(episodes.c.epoch).where(of_run).distinct().order_by(episodes.c.epoch))
        return EpisodePage([_row(row) for row in rows], total, list(epochs.scalars()))


def find_episode(db: Database, run_id: str, epoch: int, index: int) -> EpisodeRow:
    """Return one episode.

    Raises:
        NotFound: the run has recorded no such episode, or it was dropped.
    """
    this = (episodes.c.run_id == run_id, episodes.c.epoch == epoch, episodes.c.number == index)
    with db.read() as conn:
        row = conn.execute(select(episodes).where(*this)).one_or_none()
    if row is None:
        raise NotFound(f"recorded episode of run {run_id} called", f"{epoch}.{index}")
    return _row(row)


def _row(row: AnyRow) -> EpisodeRow:
    return EpisodeRow(
        EpisodeSummary(
            epoch=row.epoch,
            index=row.number,
            success=row.success,
            tag=cast(Tag, row.tag),
            task_return=row.task_return,
            worst_q=row.worst_q,
            worst_q_step=row.worst_q_step,
            length=row.length,
            resimulates=row.resimulates,
        ),
        file=row.file,
        attempt=row.attempt,
    )
