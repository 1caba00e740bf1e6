"""`python full_disk.py MECHANISM DIRECTORY`: trainings whose disk is really full, one for each file that it hits.

What happened is printed as JSON; the directories that trainings end with are left in DIRECTORY.
"""

from __future__ import annotations

import json
import os
import resource
import shutil
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol

import torch
from small_training import know_short_push, long_config, run

from sldr_core.errors import DiskTooFull
from sldr_core.records import Step
from sldr_core.training import DirectoryRecorder, train

FULL_AFTER = 21
"""The cycle after which the disk is full: the last checkpoint is of cycle 20, the next file would be that of 30."""

ROOM_FOR_LINES = 20_000
"""Enough for the lines of some cycles, too little for a checkpoint [bytes]."""


class Disk(Protocol):
    """A place for a run's files that can be full."""

    directory: Path

    def fill(self, room: int, directory: Path) -> None:
        """Leave room for so many bytes more in the metrics of a run's directory."""
        ...

    def free(self) -> None:
        """Make room again."""
        ...


class SmallDisk:
    """Fill a small file system of its own with a file."""

    def __init__(self, directory: Path) -> None:
        self.directory = directory
        self._filler = directory / "filler"

    def fill(self, room: int, directory: Path) -> None:
        left = os.statvfs(self.directory)
        with self._filler.open("wb") as file:
            os.posix_fallocate(file.fileno(), 0, left.f_bavail * left.f_frsize - room)

    def free(self) -> None:
        self._filler.unlink()


class SizeLimit:
    """Let the system refuse that files grow beyond a size; for where no file system may be mounted."""

    def __init__(self, directory: Path) -> None:
        self.directory = directory
        self._soft, self._hard = resource.getrlimit(resource.RLIMIT_FSIZE)

    def fill(self, room: int, directory: Path) -> None:
        metrics = directory / "metrics.jsonl"
        held = metrics.stat().st_size if metrics.exists() else 0
        resource.setrlimit(resource.RLIMIT_FSIZE, (held + room, self._hard))

    def free(self) -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (self._soft, self._hard))


class FillingRecorder(DirectoryRecorder):
    """Fill the disk once the line of a cycle is logged."""

    def __init__(self, directory: Path, disk: Disk, room: int) -> None:
        super().__init__(directory)
        self._disk = disk
        self._room = room

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        super().log(step, metrics)
        if step.cycle == FULL_AFTER:
            self._disk.fill(self._room, self.directory)


class SilentFillingRecorder(FillingRecorder):
    """Log nothing once the disk is full, so that the replay file alone is written to."""

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        if step.cycle <= FULL_AFTER:
            super().log(step, metrics)


def train_until_full(recorder: DirectoryRecorder, disk: Disk) -> dict[str, Any]:
    """Train until the disk is full, make room, and train on to the end; tell what was seen in between."""
    directory = recorder.directory
    try:
        train(long_config(), recorder)
    except DiskTooFull as err:
        told = str(err)
    else:
        raise AssertionError("the disk was never full")
    checkpoint = directory / "checkpoint.pt"
    seen = {
        "told": told,
        "checkpoint_cycle": torch.load(checkpoint, weights_only=True)["counters"]["cycle"],
        "files": sorted(path.name for path in directory.iterdir()),
    }
    disk.free()
    run(long_config(), directory)
    return seen


def start_on_a_full_disk(directory: Path, disk: Disk) -> dict[str, Any]:
    """Begin where another program took the room after it had been asked for; make room, and train to the end."""
    directory.mkdir()
    disk.fill(ROOM_FOR_LINES, directory)
    usage, shutil.disk_usage = shutil.disk_usage, lambda _: shutil._ntuple_diskusage(10**12, 0, 10**12)  # pyright: ignore
    try:
        run(long_config(), directory)
    except DiskTooFull as err:
        seen = {"told": str(err), "files": sorted(path.name for path in directory.iterdir())}
    else:
        raise AssertionError("the disk was never full")
    finally:
        shutil.disk_usage = usage
        disk.free()
    run(long_config(), directory)
    return seen


def main(mechanism: str, out: Path) -> None:
    """Run every training and print what was seen, by the name of its directory."""
    know_short_push()
    disk = {"small-disk": SmallDisk, "size-limit": SizeLimit}[mechanism](out / "disk")
    seen = {
        "checkpoint": train_until_full(FillingRecorder(disk.directory / "checkpoint", disk, ROOM_FOR_LINES), disk),
        "metrics": train_until_full(FillingRecorder(disk.directory / "metrics", disk, 0), disk),
        "replay": start_on_a_full_disk(disk.directory / "replay", disk),
    }
    if mechanism == "small-disk":
        recorder = SilentFillingRecorder(disk.directory / "pages", disk, 0)
        seen["pages"] = train_until_full(recorder, disk)
    for name in seen:
        shutil.copytree(disk.directory / name, out / name)
    print(json.dumps(seen))


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
