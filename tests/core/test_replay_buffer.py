"""The replay buffer keeps what it was given, forgets the oldest, and survives its process."""

from __future__ import annotations

import errno
import fcntl
import os
from pathlib import Path

import numpy as np
import pytest

from sldr_core.errors import DiskTooFull
from sldr_core.records import Episodes
from sldr_core.replay import ReplayBuffer, replay_bytes

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


def fallocate_without_help(descriptor: int, offset: int, size: int) -> None:
    """Do as the C library does where the file system cannot reserve: read every block, and write to what is empty."""
    if fcntl.fcntl(descriptor, fcntl.F_GETFL) & os.O_APPEND:
        raise OSError(errno.EBADF, "told by the C library")
    step = os.fstat(descriptor).st_blksize
    for place in range(offset + (size - 1) % step, offset + size, step):
        if os.pread(descriptor, 1, place) in (b"", b"\0"):
            os.pwrite(descriptor, b"\0", place)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "replay.bin"


def test_steps_of_episodes_are_taken_from_where_they_lie(path: Path) -> None:
    buffer = ReplayBuffer(path, SHAPES, capacity=10, slack=5)
    buffer.store(episodes(0, 12))
    slot, step = np.array([11, 0, 11, 7]), np.array([0, 3, 2, 3])

    for name, offset in (("obs", 0.0), ("achieved", 0.25), ("action", 0.5), ("w", 0.75)):
        taken = buffer.at(name, slot, step)
        assert taken.tolist() == [[100.0 * s + t + offset] * SHAPES[name][1] for s, t in zip(slot, step, strict=True)]


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


def test_every_page_of_the_file_has_its_place_on_the_disk_before_it_is_written(path: Path) -> None:
    buffer = ReplayBuffer(path, {**SHAPES, "obs": (LENGTH + 1, 1000)}, capacity=50, slack=3)

    held = path.stat()

    assert held.st_size == buffer.file_size
    assert held.st_blocks * 512 >= buffer.file_size


def test_the_size_of_the_file_is_known_before_it_is_made(path: Path) -> None:
    # Floats of one episode: 5 x 2 + 5 x 3 + 3 + 4 x 1 + 4 x 2 of the parts, and one that says whether anything moved.
    assert replay_bytes(SHAPES, slots=10) == 10 * 41 * 4
    assert ReplayBuffer(path, SHAPES, capacity=7, slack=3).file_size == path.stat().st_size == 10 * 41 * 4


def test_a_file_with_holes_is_filled(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(replay_bytes(SHAPES, slots=10_000))

    ReplayBuffer(path, SHAPES, capacity=9_000, slack=1_000)

    assert path.stat().st_blocks * 512 >= path.stat().st_size


def test_a_file_system_that_cannot_reserve_holds_the_file_as_well(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "posix_fallocate", fallocate_without_help)

    before = ReplayBuffer(path, SHAPES, capacity=700, slack=3)
    before.store(episodes(1, 200))
    before.flush()
    after = ReplayBuffer(path, SHAPES, capacity=700, slack=3)

    assert path.stat().st_size == after.file_size
    for name, values in before.arrays.items():
        np.testing.assert_array_equal(after.arrays[name], values)


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EOPNOTSUPP])
def test_a_file_that_cannot_be_given_its_room_is_left_only_if_it_was_there(
    number: int, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(descriptor: int, offset: int, size: int) -> None:
        raise OSError(number, "told by the system")

    there = path.with_name("there.bin")
    ReplayBuffer(there, SHAPES, capacity=7, slack=3)
    monkeypatch.setattr(os, "posix_fallocate", refuse)

    for place in (path, there):
        with pytest.raises((OSError, DiskTooFull), match=r"told by the system|no room"):
            ReplayBuffer(place, SHAPES, capacity=7, slack=3)

    assert [left.name for left in path.parent.iterdir()] == ["there.bin"]
