"""The replay buffer keeps what it was given, forgets the oldest, and survives its process."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from sldr_core.errors import DiskTooFull
from sldr_core.records import Episodes
from sldr_core.replay import ReplayBuffer

LENGTH = 4
SHAPES = {"obs": (LENGTH + 1, 2), "achieved": (LENGTH + 1, 3), "goal": (3,), "action": (LENGTH, 1), "w": (LENGTH, 2)}


def episodes(first: int, count: int) -> Episodes:
    """Return episodes whose every entry says which episode and step it is from: 100 episode + step."""
    number = 100.0 * np.arange(first, first + count, dtype=np.float32)

    def tell(*shape: int, offset: float = 0.0) -> np.ndarray:
        steps = np.arange(shape[0], dtype=np.float32).reshape(-1, *[1] * (len(shape) - 1))
        return np.broadcast_to(number.reshape(-1, *[1] * len(shape)) + steps + offset, (count, *shape)).copy()

    goal = np.repeat(number[:, None], 3, axis=1) + 99
    extra = {"w": tell(LENGTH, 2, offset=0.75)}
    return Episodes(tell(LENGTH + 1, 2), tell(LENGTH + 1, 3, offset=0.25), goal, tell(LENGTH, 1, offset=0.5), extra)


def stored_episodes(buffer: ReplayBuffer) -> list[int]:
    """Return which episodes can be drawn, oldest first."""
    slots = buffer.slot_of(np.arange(len(buffer)))
    return [int(value) // 100 for value in buffer.arrays["obs"][slots, 0, 0]]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "replay.bin"


def test_what_is_stored_can_be_read(path: Path) -> None:
    buffer = ReplayBuffer(path, SHAPES, capacity=10, slack=5)
    given = episodes(0, 3)

    buffer.store(given)

    parts = {"obs": given.obs, "achieved": given.achieved, "goal": given.goal, "action": given.action, **given.extra}
    for name, values in parts.items():
        np.testing.assert_array_equal(buffer.arrays[name][buffer.slot_of(np.arange(3))], values)


def test_a_full_buffer_forgets_the_oldest_first(path: Path) -> None:
    buffer = ReplayBuffer(path, SHAPES, capacity=7, slack=2)

    held = []
    for first in range(0, 60, 3):
        buffer.store(episodes(first, 3))
        held.append(stored_episodes(buffer))

    assert held == [list(range(max(0, written - 7), written)) for written in range(3, 61, 3)]


def test_an_empty_buffer_holds_nothing(path: Path) -> None:
    assert len(ReplayBuffer(path, SHAPES, capacity=7, slack=2)) == 0


def test_what_a_checkpoint_needs_outlives_as_many_stores_as_there_is_slack(path: Path) -> None:
    buffer = ReplayBuffer(path, SHAPES, capacity=7, slack=6)
    for first in range(0, 33, 3):
        buffer.store(episodes(first, 3))
    checkpoint, needed = buffer.written, stored_episodes(buffer)

    buffer.store(episodes(900, 3))
    buffer.store(episodes(903, 3))
    buffer.written = checkpoint

    assert stored_episodes(buffer) == needed


def test_a_reopened_file_continues_where_the_checkpoint_was(path: Path) -> None:
    before = ReplayBuffer(path, SHAPES, capacity=7, slack=3)
    for first in range(0, 12, 3):
        before.store(episodes(first, 3))
    before.flush()

    after = ReplayBuffer(path, SHAPES, capacity=7, slack=3)
    after.written = before.written
    after.store(episodes(12, 3))

    assert stored_episodes(after) == list(range(8, 15))


def test_a_file_of_another_size_is_begun_anew(path: Path) -> None:
    ReplayBuffer(path, SHAPES, capacity=7, slack=3).store(episodes(1, 3))

    bigger = ReplayBuffer(path, SHAPES, capacity=20, slack=3)

    assert all(not array.any() for array in bigger.arrays.values())


def test_a_full_disk_is_told_with_what_is_needed_and_what_to_do(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def nearly_full(_: Path) -> object:
        return shutil._ntuple_diskusage(total=10**12, used=10**12 - 10**9, free=10**9)  # pyright: ignore

    monkeypatch.setattr(shutil, "disk_usage", nearly_full)

    with pytest.raises(DiskTooFull, match=r"needs .* GB and its disk has 1\.0 GB free; lower replay\.capacity"):
        ReplayBuffer(path, {**SHAPES, "obs": (LENGTH + 1, 1000)}, capacity=10**6, slack=0)
    assert not path.exists()


def test_a_file_that_is_there_needs_no_further_disk(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ReplayBuffer(path, SHAPES, capacity=7, slack=3)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: shutil._ntuple_diskusage(1, 1, 0))  # pyright: ignore

    assert len(ReplayBuffer(path, SHAPES, capacity=7, slack=3)) == 0
