"""Keeping the files of an attempt: in the store's list, and where other machines find them if several share files.

At a shared place a checkpoint is of use elsewhere only with the replay file it was made with, so that goes first.
The replay file only ever gains episodes beside those that an older checkpoint needs: whichever of the two is put
last, the pair that other machines find can be resumed from.
"""

from __future__ import annotations

import logging
import shutil
from collections.abc import Collection
from pathlib import Path

from backend.store.blocks import EMPTY, BlockList, put_blocks, read_block_list
from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.episodes import forget_episodes, register_episodes
from backend.store.errors import FilesUnavailable, NotFound
from backend.store.files import LOG_FILE, REPLAY_FILE, REPLAY_LIST, FileRow, find_file, list_files, register_file
from backend.store.outcomes import CHECKPOINT_KIND
from backend.store.storage import FileStorage, SharedPlace, attempt_directory, checksum
from sldr_core.episodes import RecordedTest, episodes_file
from worker.patience import FILES_PATIENCE_S, insist

log = logging.getLogger(__name__)


class FileKeeper:
    """Keep what one attempt writes."""

    def __init__(self, db: Database, storage: FileStorage, claim: Claim, patience_s: float = FILES_PATIENCE_S) -> None:
        self._patience_s = patience_s
        self._db = db
        self._storage = storage
        self._claim = claim
        self._replay: BlockList | None = None

    def keep(self, name: str, kind: str, path: Path) -> None:
        """Keep a file that was written in the run's directory, with what it needs.

        Raises:
            StaleFence: the run was given to another worker.
            StoreUnavailable: store or shared place could not be used for minutes.
        """
        shared = self._storage.shared
        if shared is not None and kind == CHECKPOINT_KIND:
            self._keep_replay(shared, path.with_name(REPLAY_FILE))
        self._keep(name, kind, path, self._patience_s)

    def keep_log(self, path: Path) -> None:
        """Let other machines read the run's log. A run must not fail for that, so it is tried once."""
        if self._storage.shared is None or not path.is_file():
            return
        # A copy, because the log itself may grow between its checksum and its upload.
        copy = path.with_stem(f"{path.stem}-sent")
        try:
            shutil.copyfile(path, copy)
            self._keep(LOG_FILE, "log", copy, patience_s=0.0)
        except (FilesUnavailable, OSError) as err:
            log.warning("The log stays on this machine: %s", err)
        finally:
            copy.unlink(missing_ok=True)

    def keep_episodes(self, test: RecordedTest, kept_epochs: Collection[int]) -> None:
        """List the episodes whose file is kept already, and drop those of earlier tests that are not to stay.

        Raises:
            StaleFence: the run was given to another worker.
            StoreUnavailable: the store could not be used for minutes.
        """
        newest = test.origin.epoch
        summaries = test.summaries()
        insist(lambda: register_episodes(self._db, self._claim, episodes_file(newest), summaries))
        for dropped in insist(lambda: forget_episodes(self._db, self._claim, newest, kept_epochs)):
            self._forget(dropped.path)

    def sweep(self) -> None:
        """Remove what earlier attempts put at the shared place without living to register it."""
        shared, claim = self._storage.shared, self._claim
        if shared is None or claim.attempt == 1:
            return
        rows = insist(lambda: list_files(self._db, claim.run_id))
        held = {row.path for row in rows} | self._known_replay().paths
        for attempt in range(1, claim.attempt):
            directory = attempt_directory(claim.run_id, attempt)
            try:
                left = [path for path in shared.paths_below(directory) if path not in held]
            except FilesUnavailable as err:
                log.warning("Left behind: %s", err)
                return
            for path in left:
                self._forget(path)

    def _keep(self, name: str, kind: str, path: Path, patience_s: float) -> None:
        claim = self._claim
        size, digest = path.stat().st_size, checksum(path)
        place = insist(lambda: self._storage.keep(claim.run_id, claim.attempt, path, digest), patience_s=patience_s)
        before = insist(lambda: register_file(self._db, claim, name, kind, place, size, digest))
        if before is not None:
            self._forget(before)

    def _keep_replay(self, shared: SharedPlace, replay: Path) -> None:
        if not replay.is_file():
            return
        known = self._known_replay()
        directory = f"{attempt_directory(self._claim.run_id, self._claim.attempt)}/replay"
        fresh = insist(lambda: put_blocks(shared, replay, directory, known), patience_s=self._patience_s)
        path = replay.with_name(REPLAY_LIST)
        path.write_text(fresh.to_json())
        self._keep(REPLAY_LIST, "replay", path, self._patience_s)
        self._replay = fresh
        for left in known.paths - fresh.paths:
            self._forget(left)

    def _forget(self, path: str) -> None:
        """Remove what no row holds any more; if that cannot be done it is litter, and no harm."""
        try:
            self._storage.forget(path)
        except FilesUnavailable as err:
            log.warning("Left behind: %s", err)

    def _known_replay(self) -> BlockList:
        """Return the newest list of blocks that was registered, by this attempt or one before."""
        if self._replay is None:
            row = self._find(REPLAY_LIST)
            self._replay = EMPTY if row is None else read_block_list(self._bring(row))
        return self._replay

    def _bring(self, row: FileRow) -> Path:
        return insist(lambda: self._storage.bring(row), patience_s=self._patience_s)

    def _find(self, name: str) -> FileRow | None:
        try:
            return insist(lambda: find_file(self._db, self._claim.run_id, name))
        except NotFound:
            return None
