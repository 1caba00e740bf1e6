"""Putting the files of a backup where the settings say: below the data directory, or at the shared place."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from backend.store.backups.archive import RUNS
from backend.store.blocks import EMPTY, BlockList, put_blocks
from backend.store.files import LOG_FILE, REPLAY_FILE, REPLAY_LIST
from backend.store.settings import Settings
from backend.store.storage import FileStorage, SharedPlace, attempt_directory, checksum


class FilePlacer:
    """Put files in their places.

    Attributes:
        count: how many were put.
    """

    def __init__(self, settings: Settings, storage: FileStorage, source: Path) -> None:
        self.count = 0
        self._settings = settings
        self._storage = storage
        self._source = source
        self._listed: set[Path] = set()
        self._held: set[str] = set()

    def place(self, run_id: str, name: str, attempt: int, sha256: str) -> str:
        """Put a registered file in its place; return the path for its row.

        Raises:
            FilesUnavailable: the shared place cannot be written just now.
        """
        source = self._source / run_id / name
        self._listed.add(source)
        self.count += 1
        if self._storage.shared is None:
            return self._copy(source, run_id)
        return self._keep(source, run_id, attempt, sha256)

    def place_unlisted(self, attempts: Mapping[str, int]) -> Iterator[dict[str, Any]]:
        """Put all other files of runs in their places; return the rows of those that only a row makes known.

        Args:
            attempts: the newest attempt of each run.
        """
        for source in sorted(self._source.glob("*/*")):
            if source in self._listed:
                continue
            run_id = source.parent.name
            self.count += 1
            if self._storage.shared is None:
                self._copy(source, run_id)
            elif source.name == REPLAY_FILE:
                yield self._place_replay(self._storage.shared, source, attempts[run_id])
            elif source.name == LOG_FILE:
                yield self._row(source, run_id, "log", attempts[run_id])

    def sweep(self, shared: SharedPlace, run_ids: set[str]) -> None:
        """Remove what the shared place still holds of the runs that were there before."""
        for run_id in run_ids:
            for path in shared.paths_below(f"{RUNS}/{run_id}"):
                if path not in self._held:
                    shared.remove(path)

    def _copy(self, source: Path, run_id: str) -> str:
        target = self._settings.run_directory(run_id) / source.name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
        return str(target.relative_to(self._settings.home))

    def _keep(self, source: Path, run_id: str, attempt: int, sha256: str) -> str:
        path = self._storage.keep(run_id, attempt, source, sha256)
        self._held.add(path)
        return path

    def _place_replay(self, shared: SharedPlace, source: Path, attempt: int) -> dict[str, Any]:
        run_id = source.parent.name
        listed: BlockList = put_blocks(shared, source, f"{attempt_directory(run_id, attempt)}/replay", EMPTY)
        self._held |= listed.paths
        # Beside the run's other files on this machine, as a training leaves it.
        path = self._settings.run_directory(run_id) / REPLAY_LIST
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(listed.to_json())
        return self._row(path, run_id, "replay", attempt)

    def _row(self, path: Path, run_id: str, kind: str, attempt: int) -> dict[str, Any]:
        sha256 = checksum(path)
        return {
            "run_id": run_id,
            "name": path.name,
            "kind": kind,
            "path": self._keep(path, run_id, attempt, sha256),
            "size": path.stat().st_size,
            "sha256": sha256,
            "attempt": attempt,
        }
