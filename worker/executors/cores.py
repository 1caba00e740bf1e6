"""Cores of this machine that one attempt has to itself: one that takes every core it sees then takes only its own."""

from __future__ import annotations

import fcntl
import os
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import IO


class HeldCores:
    """Hold cores against others of this kind on the machine, until this process ends."""

    def __init__(self, available: Iterable[int], count: int, directory: Path | None = None) -> None:
        """Take the first `count` of the available cores that nobody else holds, or as many as there are.

        Args:
            directory: where the locks lie; the same for all who should not meet.
        """
        self._locks: dict[int, IO[str]] = {}
        directory = directory or Path(tempfile.gettempdir()) / f"sldr-cores-{os.getuid()}"
        directory.mkdir(mode=0o700, exist_ok=True)
        for core in sorted(available):
            if len(self._locks) == count:
                break
            file = (directory / str(core)).open("w")
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                file.close()
            else:
                self._locks[core] = file

    @property
    def numbers(self) -> set[int]:
        """The cores' numbers."""
        return set(self._locks)

    def release(self) -> None:
        """Let others have them."""
        for file in self._locks.values():
            file.close()
        self._locks.clear()
