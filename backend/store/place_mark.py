"""Telling a shared directory from the empty one below it, which is all that a machine sees while it is not mounted."""

from __future__ import annotations

from pathlib import Path

MARK_FILE = "sldr-files"
"""Lies at the root of a directory that machines share files through."""
MARK_TEXT = "Machines share files through this directory; one that does not find this file waits until it is mounted.\n"


class PlaceMark:
    """Mark a directory at its first use, and look for the mark from then on."""

    def __init__(self, root: Path, known_file: Path) -> None:
        """Look for marks.

        Args:
            root: the directory.
            known_file: where this machine notes which directory it has used.
        """
        self._root = root
        self._known_file = known_file

    def is_missing(self) -> bool:
        """Tell whether this machine has used the directory before and now finds no mark in it."""
        return self._is_known() and not (self._root / MARK_FILE).is_file()

    def insist(self) -> None:
        """Make sure that files may be written below the directory.

        Raises:
            FileNotFoundError: it is not the one that was used before.
        """
        if self.is_missing():
            raise FileNotFoundError(
                f"{self._root} was used before and now holds no file {MARK_FILE}: mount it again, or remove "
                f"{self._known_file} if it is to begin anew"
            )
        if not self._is_known():
            self._root.mkdir(parents=True, exist_ok=True)
            (self._root / MARK_FILE).write_text(MARK_TEXT)
            self._known_file.parent.mkdir(parents=True, exist_ok=True)
            self._known_file.write_text(str(self._root))

    def _is_known(self) -> bool:
        return self._known_file.is_file() and self._known_file.read_text() == str(self._root)
