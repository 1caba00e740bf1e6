"""What a rule would remove: run by run, file by file, with what it spares and why. Nothing is changed."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import Literal

from sqlalchemy import Connection, select

from backend.store.blocks import read_block_list
from backend.store.database import Database, current_time
from backend.store.errors import FilesUnavailable
from backend.store.files import REPLAY_LIST, FileRow
from backend.store.retention.rule import KEEP_TAGS, Removable, Rule, kind_of, unregistered
from backend.store.settings import Settings
from backend.store.states import ENDED
from backend.store.storage import FileStorage
from backend.store.tables import SHARED, AnyRow, run_files, run_needs, run_tags, runs
from sldr_core.errors import SldrError

log = logging.getLogger(__name__)

Spared = Literal["young", "kept", "needed"]
"""Why an ended run loses nothing: it ended too lately, is tagged to be kept, or others learn from it."""


@dataclass(frozen=True)
class Doomed:
    """One file that may go."""

    kind: Removable
    name: str
    place: str
    """Where it lies: below the data directory, or with `SHARED` before it at the place that machines share."""
    size: int
    """Length [bytes]."""
    is_registered: bool
    """Whether a row of the store holds it."""


@dataclass(frozen=True)
class RunShare:
    """What one run would lose."""

    run_id: str
    task: str
    phase: str
    method: str
    seed: int
    state: str
    ended_at: datetime
    fence: int
    files: tuple[Doomed, ...]

    @property
    def size(self) -> int:
        """Length of all its files that would go [bytes]."""
        return sum(file.size for file in self.files)


@dataclass(frozen=True)
class RetentionPlan:
    """Hold all that a rule would remove."""

    rule: Rule
    runs: list[RunShare]
    """Runs that would lose something, the largest share first."""
    spared: Mapping[Spared, int]
    """Ended runs that lose nothing, by why."""

    def totals(self) -> dict[Removable, tuple[int, int]]:
        """Return how many files of each kind would go, and their length [bytes]."""
        files = [file for share in self.runs for file in share.files]
        return {
            kind: (sum(file.kind is kind for file in files), sum(file.size for file in files if file.kind is kind))
            for kind in sorted(self.rule.kinds)
        }


_TOLD = tuple(runs.c[name] for name in ("id", "task", "phase", "method", "seed", "state", "ended_at", "fence"))
"""What is read of a run: not its config, which takes longer than all the rest."""


def plan_retention(db: Database, settings: Settings, rule: Rule) -> RetentionPlan:
    """Return what a rule would remove now."""
    with db.read() as conn:
        at = current_time(conn)
        ended = conn.execute(select(*_TOLD).where(runs.c.state.in_(ENDED)).order_by(runs.c.number)).all()
        protected = find_protected(conn)
        old = [row for row in ended if is_old_enough(row.ended_at, rule, at)]
        registered = _registered(conn, {row.id for row in old if row.id not in protected})
    # Not in the transaction, which must not stand still while the shared place answers.
    storage = FileStorage(settings)
    shares = [_share(settings, storage, row, registered[row.id], rule) for row in old if row.id in registered]
    why = Counter(protected[row.id] for row in old if row.id in protected)
    spared: dict[Spared, int] = {"young": len(ended) - len(old), "kept": why["kept"], "needed": why["needed"]}
    found = [share for share in shares if share.files]
    return RetentionPlan(rule, sorted(found, key=lambda share: -share.size), spared)


def find_protected(conn: Connection, run_ids: Sequence[str] | None = None) -> dict[str, Spared]:
    """Return the runs that lose nothing however old they are, by id.

    Args:
        run_ids: the runs in question; all if None.
    """
    dependent = runs.alias("dependent")
    needed = (
        select(run_needs.c.needs_run_id)
        .join(dependent, dependent.c.id == run_needs.c.run_id)
        .where(dependent.c.deleted_at.is_(None))
    )
    kept = select(run_tags.c.run_id).where(run_tags.c.tag.in_(KEEP_TAGS))
    if run_ids is not None:
        needed = needed.where(run_needs.c.needs_run_id.in_(run_ids))
        kept = kept.where(run_tags.c.run_id.in_(run_ids))
    found: dict[str, Spared] = {run_id: "needed" for run_id in conn.execute(needed).scalars()}
    found.update((run_id, "kept") for run_id in conn.execute(kept).scalars())
    return found


def is_old_enough(ended_at: datetime | None, rule: Rule, at: datetime) -> bool:
    """Tell whether a run ended long enough before a time."""
    return ended_at is not None and ended_at <= at - timedelta(days=rule.older_than_days)


def _registered(conn: Connection, run_ids: Collection[str]) -> dict[str, list[FileRow]]:
    """Return the registered files of ended runs, by run id."""
    # In one query whatever their number: thousands of short ones take seconds.
    ended = select(runs.c.id).where(runs.c.state.in_(ENDED))
    query = select(run_files).where(run_files.c.run_id.in_(ended)).order_by(run_files.c.run_id, run_files.c.name)
    found: dict[str, list[FileRow]] = {run_id: [] for run_id in run_ids}
    for row in conn.execute(query).mappings():
        if row["run_id"] in found:
            found[row["run_id"]].append(FileRow(**row))
    return found


def _share(
    settings: Settings, storage: FileStorage, row: AnyRow, registered: Sequence[FileRow], rule: Rule
) -> RunShare:
    try:
        blocks = _blocks(storage, registered, rule)
    except (SldrError, FilesUnavailable) as err:
        # Without the list, nobody could ever remove the blocks.
        log.warning("The replay file of run %s stays: %s", row.id, err)
        blocks, rule = [], replace(rule, kinds=rule.kinds - {Removable.REPLAY})
    files = [doomed for file in registered for doomed in _places(settings, file, rule, storage.shared is not None)]
    left = (_left(settings, row.id, name) for name in unregistered(rule))
    return RunShare(
        run_id=row.id,
        task=row.task,
        phase=row.phase,
        method=row.method,
        seed=row.seed,
        state=row.state,
        ended_at=row.ended_at,
        fence=row.fence,
        files=(*files, *(doomed for doomed in left if doomed is not None), *blocks),
    )


def _blocks(storage: FileStorage, registered: Sequence[FileRow], rule: Rule) -> list[Doomed]:
    """Return the blocks that a run's replay file is kept as at the shared place, if the file goes.

    Raises:
        BadFile: the list of them is damaged.
        FileGone: it is gone.
        FilesUnavailable: the shared place cannot be read just now.
    """
    if storage.shared is None or Removable.REPLAY not in rule.kinds:
        return []
    found = [read_block_list(storage.bring(file)) for file in registered if file.name == REPLAY_LIST]
    return [
        Doomed(Removable.REPLAY, "block", f"{SHARED}{path}", blocks.block_size, is_registered=False)
        for blocks in found
        for path in sorted(blocks.paths)
    ]


def _places(settings: Settings, row: FileRow, rule: Rule, shared: bool) -> Sequence[Doomed]:
    """Return every place where a registered file lies, if it may go."""
    kind = kind_of(row.name, row.kind)
    if kind is None or kind not in rule.kinds:
        return ()
    if not shared:
        return (Doomed(kind, row.name, row.path, row.size, is_registered=True),)
    here = (settings.run_directory(row.run_id) / row.name, settings.fetched_directory / row.run_id / row.name)
    copies = [
        Doomed(kind, row.name, str(path.relative_to(settings.home)), path.stat().st_size, is_registered=False)
        for path in here
        if path.is_file()
    ]
    return (Doomed(kind, row.name, f"{SHARED}{row.path}", row.size, is_registered=True), *copies)


def _left(settings: Settings, run_id: str, name: str) -> Doomed | None:
    path: Path = settings.run_directory(run_id) / name
    if not path.is_file():
        return None
    place = str(path.relative_to(settings.home))
    # What is on the disk counts: a replay file is as long as it may become from its first day on.
    return Doomed(Removable.REPLAY, name, place, path.stat().st_blocks * 512, is_registered=False)
