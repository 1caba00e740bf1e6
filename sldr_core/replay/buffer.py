"""The replay buffer: whole episodes in one memory-mapped file, the oldest replaced first.

The file holds more slots than the buffer remembers. So the episodes that a checkpoint needs cannot have been
overwritten by those written after it, and a killed run goes on from its checkpoint with the very same memory.
`N` episodes stored at once, `T` steps, `D`, `G`, `A` as in `sldr_core.records`.
"""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sldr_core.disk import explain_full_disk
from sldr_core.errors import DiskTooFull
from sldr_core.records import Episodes, Floats

MOVED = 0.01
"""An episode has moved something if an entry of its achieved goal changed by more than this [m or quaternion]."""


class ReplayBuffer:
    """Remember the newest `capacity` episodes.

    Attributes:
        arrays: `obs`, `achieved`, `goal`, `action` and every extra, each `[slots, ...]`, views of the file;
            and `moved`, 1 where an achieved goal changed during the episode, else 0.
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
        self.file_size = replay_bytes(shapes, self.slots)
        shapes = {**shapes, "moved": ()}
        sizes = {name: math.prod(shape) for name, shape in shapes.items()}
        _reserve(path, self.file_size)
        floats = np.memmap(path, dtype=np.float32, mode="r+", shape=(self.file_size // 4,))
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
        for name, values in {**parts, **episodes.extra, "moved": has_moved(episodes.achieved)}.items():
            self.arrays[name][slots] = values
        self.written += slots.size

    def slot_of(self, rank: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return where episodes lie, by rank among those that can be drawn: 0 is the oldest."""
        return (self.written - len(self) + rank) % self.slots

    def at(self, name: str, slot: NDArray[np.int64], step: NDArray[np.int64]) -> Floats:
        """Return what an array holds at steps `[B]` of the episodes in slots `[B]`, `[B, ...]`.

        Rows are numbered through and taken by one index, which is three times as fast as by two.
        """
        array = self.arrays[name]
        return array.reshape(-1, *array.shape[2:]).take(slot * array.shape[1] + step, axis=0)

    def flush(self) -> None:
        """Bring the file to the disk."""
        self._file.flush()


def has_moved(achieved: Floats) -> Floats:
    """Return 1 for each episode in which an entry of the achieved goal `[N, T+1, G]` changed by `MOVED`, else 0."""
    return (np.abs(achieved - achieved[:, :1]).max(axis=(1, 2)) > MOVED).astype(np.float32)


def replay_bytes(shapes: Mapping[str, tuple[int, ...]], slots: int) -> int:
    """Return the size of a replay file of so many episodes [bytes], given the shape of one episode's parts."""
    moved = 1
    return np.dtype(np.float32).itemsize * slots * (moved + sum(math.prod(shape) for shape in shapes.values()))


def _reserve(path: Path, size: int) -> None:
    """Make the file, or what is missing of it, so that every page of it has its place on the disk.

    A page without one would end the process by a signal when it is written to on a full disk.
    """
    if path.exists() and path.stat().st_size != size:
        path.unlink()
    is_new = not path.exists()
    path.touch()
    try:
        # Where a file system cannot reserve, the C library reads and writes each block instead: not in a file that is
        # opened to append, or only to write.
        with explain_full_disk(path), path.open("r+b") as file:
            os.posix_fallocate(file.fileno(), 0, size)
    except (DiskTooFull, OSError):
        if is_new:
            path.unlink()
        raise
