"""Finding the policy of a run that a 3D session shows, on whichever machine the run is trained."""

from __future__ import annotations

from pathlib import Path

from backend.store.database import Database
from backend.store.errors import FileGone
from backend.store.files import FileRow, list_files
from backend.store.settings import Settings
from backend.store.storage import FileStorage

POLICY_FILES = ("policy-newest.pt", "policy-best.pt")
"""What of a run is shown, the first that there is."""


class NewestPolicies:
    """Bring policies to this machine, and renew the copies of those that another machine writes again and again."""

    def __init__(self, database: Database, settings: Settings) -> None:
        self._database = database
        self._settings = settings
        self._storage = FileStorage(settings)

    def find(self, run_id: str) -> Path | None:
        """Return the file to follow, or None if the run has no policy yet.

        Raises:
            BadFile: the policy at the shared place is damaged.
            StoreUnavailable: store or shared place cannot be used just now.
        """
        directory = self._settings.run_directory(run_id)
        if self._storage.shared is None:
            return next((directory / name for name in POLICY_FILES if (directory / name).is_file()), None)
        row = self._find_row(run_id)
        try:
            return None if row is None else self._storage.bring(row)
        except FileGone:
            return None  # replaced by a newer one in this very moment

    def renew(self, run_id: str, path: Path) -> None:
        """Bring the newest policy again if the one that is followed is a copy.

        Raises:
            BadFile: the policy at the shared place is damaged.
            StoreUnavailable: store or shared place cannot be used just now.
        """
        if path.is_relative_to(self._settings.fetched_directory):
            self.find(run_id)

    def _find_row(self, run_id: str) -> FileRow | None:
        rows = {row.name: row for row in list_files(self._database, run_id)}
        return next((rows[name] for name in POLICY_FILES if name in rows), None)
