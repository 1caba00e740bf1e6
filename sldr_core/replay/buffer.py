"""The replay buffer: whole episodes in one memory-mapped file, the oldest replaced first.

The file holds more slots than the buffer remembers. So the episodes that a checkpoint needs cannot have been
overwritten by those written after it, and a killed run goes on from its checkpoint with the very same memory.
`N` episodes stored at once, `T` steps, `D`, `G`, `A` as in `sldr_core.records`.
"""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sldr_core.errors import DiskTooFull
from sldr_core.records import Episodes, Floats

FREE_DISK = 256 * 2**20
"""Disk space left free beside the replay file [bytes]."""


class ReplayBuffer:
    """Remember the newest `capacity` episodes.

    Attributes:
        arrays: `obs`, `achieved`, `goal`, `action` and every extra, each `[slots, ...]`, views of the file.
        written: episodes ever stored; with it alone a buffer over the same file is restored.
        file_size: size of the whole file [bytes].
    """

    def __init__(self, path: Path, shapes: Mapping[str, tuple[int, ...]], capacity: int, slack: int) -> None:
        """Open or create the file.

        Args:
            path: the file.
            shapes: shape of one episode's part, by name.
            capacity: episodes remembered.
            slack: episodes that may be stored after a checkpoint.

        Raises:
            DiskTooFull: the file would not fit on its disk.
        """
        self.capacity = capacity
        self.slots = capacity + slack
        self.written = 0
        sizes = {name: int(np.prod(shape)) for name, shape in shapes.items()}
        self.file_size = 4 * self.slots * sum(sizes.values())
        _check_disk(path, self.file_size)
        floats = np.memmap(path, dtype=np.float32, mode="r+" if path.exists() else "w+", shape=(self.file_size // 4,))
        self._file = floats
        self.arrays: dict[str, Floats] = {}
        begin = 0
        for name, shape in shapes.items():
            end = begin + self.slots * sizes[name]
            self.arrays[name] = np.asarray(floats[begin:end]).reshape(self.slots, *shape)
            begin = end

    def __len__(self) -> int:
        """Return how many episodes can be drawn."""
        return min(self.written, self.capacity)

    def store(self, episodes: Episodes) -> None:
        """Keep N episodes."""
        slots = (self.written + np.arange(episodes.goal.shape[0])) % self.slots
        parts = {"obs": episodes.obs, "achieved": episodes.achieved, "goal": episodes.goal, "action": episodes.action}
        for name, values in {**parts, **episodes.extra}.items():
            self.arrays[name][slots] = values
        self.written += slots.size

    def slot_of(self, rank: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return where episodes lie, by rank among those that can be drawn: 0 is the oldest."""
        return (self.written - len(self) + rank) % self.slots

    def flush(self) -> None:
        """Bring the file to the disk."""
        self._file.flush()


def _check_disk(path: Path, bytes_needed: int) -> None:
    held = path.stat().st_size if path.exists() else 0
    free = shutil.disk_usage(path.parent).free
    if held != bytes_needed and free + held < bytes_needed + FREE_DISK:
        raise DiskTooFull(
            f"The replay file {path} needs {bytes_needed / 1e9:.1f} GB and its disk has {free / 1e9:.1f} GB free; "
            "lower replay.capacity or free some space."
        )
    if path.exists() and held != bytes_needed:
        path.unlink()
