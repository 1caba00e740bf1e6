"""Copying the files of runs while they are trained: each whole, and a checkpoint with the replay file it goes with."""

from __future__ import annotations

import shutil
import time
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from backend.store.backups.archive import RUNS
from backend.store.blocks import get_blocks, read_block_list
from backend.store.database import Database
from backend.store.errors import FileGone, NotFound
from backend.store.files import LOG_FILE, REPLAY_FILE, REPLAY_LIST, FileRow, find_file
from backend.store.outcomes import CHECKPOINT_KIND
from backend.store.settings import Settings
from backend.store.storage import FileStorage, checksum
from sldr_core.errors import BadFile

TRIES = 20
"""How often a file is copied again that was replaced meanwhile."""
PAUSE_S = 0.1
"""Between two tries [s]."""
NOT_ARCHIVED = (REPLAY_LIST, LOG_FILE)
"""Registered files that a backup has as plain ones: the replay file is put together, the log still grows."""


class CannotCopy(Exception):
    """Report a registered file of which no whole copy could be had."""


@dataclass
class FileCopier:
    """Copy files into the directory of a backup, and remember which version of each is there."""

    db: Database
    settings: Settings
    stage: Path
    copied: dict[tuple[str, str], FileRow] = field(default_factory=dict[tuple[str, str], FileRow])
    """The row that described each file when it was copied, by run and name."""
    seen: set[tuple[str, str]] = field(default_factory=set[tuple[str, str]])
    """Every registered file that was asked for."""

    def __post_init__(self) -> None:
        """Make ready to read files."""
        self._storage = FileStorage(self.settings)

    def copy(self, row: FileRow, with_replay: bool, exactly: bool = False) -> None:
        """Copy the newest version of a registered file; what was copied before stays until that is done.

        Args:
            with_replay: whether the run may still go on from its checkpoint.
            exactly: whether only the version that `row` describes is wanted; a newer one is left alone.

        Raises:
            CannotCopy: it is gone or damaged, or is replaced faster than it can be copied.
        """
        self.seen.add((row.run_id, row.name))
        if row.name in NOT_ARCHIVED:
            return
        problem = f"{row.name} of run {row.run_id} was replaced faster than it could be copied."
        with TemporaryDirectory(dir=self.stage) as name:
            for _ in range(TRIES):
                newest = self._newest(row)
                if newest is None or (exactly and newest.sha256 != row.sha256):
                    return
                try:
                    self._copy_version(newest, Path(name))
                    if row.kind == CHECKPOINT_KIND and with_replay:
                        self._copy_replay(row.run_id, Path(name))
                except (BadFile, FileGone) as err:
                    problem = str(err)
                    time.sleep(PAUSE_S)
                    continue
                # A newer checkpoint lets the replay file lose what this one needs.
                if row.kind != CHECKPOINT_KIND or self._newest(row) == newest:
                    self._accept(newest, Path(name))
                    return
        raise CannotCopy(problem)

    def copy_unlisted(self, run_id: str) -> None:
        """Copy what lies beside the registered files of a run, such as its log."""
        directory = self.settings.run_directory(run_id)
        if self._storage.shared is not None or not directory.is_dir():
            return
        for path in sorted(directory.iterdir()):
            is_listed = (run_id, path.name) in self.seen or path.name in (REPLAY_FILE, REPLAY_LIST)
            if path.is_file() and not path.name.startswith(".") and not is_listed:
                shutil.copyfile(path, self._target(run_id, path.name))

    def copy_log(self, row: FileRow) -> None:
        """Copy a log that another machine has written."""
        shutil.copyfile(self._storage.bring(row), self._target(row.run_id, row.name))

    def holds(self, row: FileRow) -> bool:
        """Tell whether the very version that a row describes was copied."""
        there = self.copied.get((row.run_id, row.name))
        return there is not None and there.sha256 == row.sha256

    def _newest(self, row: FileRow) -> FileRow | None:
        try:
            return find_file(self.db, row.run_id, row.name)
        except NotFound:
            return None

    def _accept(self, row: FileRow, fresh: Path) -> None:
        for path in fresh.iterdir():
            path.rename(self._target(row.run_id, path.name))
        self.copied[row.run_id, row.name] = row

    def _copy_version(self, row: FileRow, into: Path) -> None:
        target = into / row.name
        here = self._storage.find_here(row)
        if here is not None:
            # One open file is one version of it, whatever is renamed to its name meanwhile.
            shutil.copyfile(here, target)
        elif self._storage.shared is not None:
            self._storage.shared.get(row.path, target, row.sha256)
        else:
            raise FileGone(f"{self.settings.home / row.path} is gone.")
        if checksum(target) != row.sha256:
            raise BadFile(f"{row.name} of run {row.run_id} is not what was registered.")

    def _copy_replay(self, run_id: str, into: Path) -> None:
        shared = self._storage.shared
        if shared is None:
            path = self.settings.run_directory(run_id) / REPLAY_FILE
            if path.is_file():
                shutil.copyfile(path, into / REPLAY_FILE)
            return
        try:
            listed = find_file(self.db, run_id, REPLAY_LIST)
        except NotFound:
            return
        get_blocks(shared, read_block_list(self._storage.bring(listed)), into / REPLAY_FILE)

    def _target(self, run_id: str, name: str) -> Path:
        target = self.stage / RUNS / run_id / name
        target.parent.mkdir(parents=True, exist_ok=True)
        return target
