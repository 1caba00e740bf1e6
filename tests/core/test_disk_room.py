"""Room on the disk is asked for before a run starts, by name and amount."""

from __future__ import annotations

import errno
import shutil
from pathlib import Path

import pytest
from small_training import run, tiny_config

from sldr_core.disk import MARGIN, check_room, explain_full_disk
from sldr_core.errors import DiskTooFull
from sldr_core.replay import replay_bytes
from sldr_core.training.build import build_training, recorded_bytes
from sldr_core.training.files import planned_sizes

GB = 10**9


@pytest.fixture
def gigabyte_free(monkeypatch: pytest.MonkeyPatch) -> None:
    usage = shutil._ntuple_diskusage(total=1000 * GB, used=999 * GB, free=GB)  # pyright: ignore
    monkeypatch.setattr(shutil, "disk_usage", lambda _: usage)


@pytest.mark.usefixtures("gigabyte_free")
@pytest.mark.parametrize(("replay", "fits"), [(GB - MARGIN - 1000, True), (GB - MARGIN - 999, False)])
def test_files_fit_that_leave_the_margin_free(replay: int, fits: bool, tmp_path: Path) -> None:
    sizes = {"replay.bin": replay, "checkpoint.pt": 1000}

    if fits:
        check_room(tmp_path, sizes)
    else:
        with pytest.raises(DiskTooFull):
            check_room(tmp_path, sizes)


@pytest.mark.usefixtures("gigabyte_free")
def test_what_is_missing_is_told_with_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(DiskTooFull) as err:
        check_room(tmp_path, {"replay.bin": 3 * GB, "checkpoint.pt": 20 * 10**6})

    assert str(err.value) == (
        f"The run's files in {tmp_path} need 3.1 GB more (3.0 GB of it for replay.bin) and the disk has 1.0 GB free; "
        "lower replay.capacity or free some space (the replay.bin of a finished run is no longer needed)."
    )


@pytest.mark.usefixtures("gigabyte_free")
def test_files_that_are_there_need_no_further_room(tmp_path: Path) -> None:
    with (tmp_path / "replay.bin").open("wb") as file:
        file.truncate(3 * GB)

    check_room(tmp_path, {"replay.bin": 3 * GB})


@pytest.mark.parametrize("phase", ["locomotion", "manipulation"])
def test_no_file_of_a_run_becomes_larger_than_planned(phase: str, tmp_path: Path) -> None:
    config = tiny_config(phase, "her", cycles_per_epoch=6)  # pyright: ignore[reportArgumentType]
    run(config, tmp_path)
    (tmp_path / "planned").mkdir()
    parts = build_training(config, tmp_path / "planned", [])
    learners = [parts.agent.state_dict(), *([parts.inverse.state_dict()] if parts.inverse else [])]

    recorded = recorded_bytes(parts.envs, parts.streams)

    planned = planned_sizes(config, parts.buffer.file_size, recorded, parts.envs.state(), learners)

    # Names and the archive around the numbers weigh more than the tiniest nets; real ones are a hundred times larger.
    archive = 100_000
    for path in tmp_path.glob("[!.]*.*"):
        assert path.stat().st_size <= planned[path.name] + archive
    assert planned["replay.bin"] == (tmp_path / "replay.bin").stat().st_size
    assert replay_bytes({}, 1) == 4


def test_the_system_s_word_for_a_full_disk_becomes_ours_and_other_errors_stay(tmp_path: Path) -> None:
    path = tmp_path / "metrics.jsonl"

    for number in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
        with (
            pytest.raises(DiskTooFull, match=rf"There is no room for {path}: .*free some space"),
            explain_full_disk(path),
        ):
            raise OSError(number, "told by the system")
    with pytest.raises(PermissionError), explain_full_disk(path):
        raise PermissionError(errno.EACCES, "told by the system")
