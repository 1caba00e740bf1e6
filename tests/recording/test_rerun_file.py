"""Rerun files: what is written can be read back with Rerun's own reader."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path

import pyarrow
import pytest
from rerun.experimental import RrdReader

from sldr_core.records import Step
from sldr_core.training.directory import LOCK_FILE, alone_in
from worker.recording.content import Recording
from worker.recording.rerun_file import write_recording


def steps(count: int) -> list[Step]:
    return [
        Step(cycle=i, epoch=1 + i // 2, env_steps=1900 * i, episodes=38 * i, updates=40 * i, wall_seconds=1.5 * i)
        for i in range(1, count + 1)
    ]


def read_curve(path: Path, name: str) -> list[tuple[int, int, float, float]]:
    """Return env steps, epoch, wall seconds and value of each point."""
    points: list[tuple[int, int, float, float]] = []
    for chunk in RrdReader(path).stream():
        if chunk.entity_path != f"/{name}" or chunk.is_static:
            continue
        points.extend(
            (row["env_steps"], row["epoch"], row["wall_seconds"].total_seconds(), row["Scalars:scalars"][0])
            for row in chunk.to_record_batch().to_pylist()
        )
    return sorted(points)


def columns_of(batch: pyarrow.RecordBatch) -> list[str]:
    """Return the columns of components, without the times."""
    return [name for name in batch.schema.names if ":" in name]


def test_a_curve_comes_back_on_all_its_timelines(tmp_path):
    path = tmp_path / "curves.rrd"
    write_recording(path, Recording("FetchPush", steps(3), {"test/success_rate": [0.0, 0.5, 1.0]}))
    assert read_curve(path, "test/success_rate") == [
        (1900, 1, 1.5, 0.0),
        (3800, 2, 3.0, 0.5),
        (5700, 2, 4.5, 1.0),
    ]


def test_points_that_were_not_logged_are_left_out(tmp_path):
    path = tmp_path / "curves.rrd"
    write_recording(path, Recording("FetchPush", steps(3), {"test/success_rate": [None, 0.5, math.nan]}))
    assert [value for *_, value in read_curve(path, "test/success_rate")] == [0.5]


def test_the_layout_is_inside_the_file(tmp_path):
    path = tmp_path / "curves.rrd"
    write_recording(path, Recording("FetchPush", steps(2), {"test/success_rate": [0.0, 0.5], "actor/loss": [1.0, 2.0]}))
    blueprint = RrdReader(path).blueprints()[0]
    batches = [chunk.to_record_batch() for chunk in RrdReader(path).stream(store=blueprint)]
    rows = [row for batch in batches for row in batch.select(columns_of(batch)).to_pylist()]
    names = {row["ViewBlueprint:display_name"][0] for row in rows if row.get("ViewBlueprint:display_name")}
    assert names == {"test", "actor"}
    ranges = [row["TimeAxis:view_range"][0] for row in rows if row.get("TimeAxis:view_range")]
    assert len(ranges) == 2
    assert any("TimePanelBlueprint:play_state" in row for row in rows)


def test_a_file_that_is_written_again_holds_everything_and_leaves_nothing_beside_it(tmp_path):
    path = tmp_path / "curves.rrd"
    for count in (2, 5):
        write_recording(path, Recording("FetchPush", steps(count), {"actor/loss": [1.0] * count}))
        assert len(read_curve(path, "actor/loss")) == count
    assert list(tmp_path.iterdir()) == [path]


def test_an_empty_training_still_makes_a_file_that_opens(tmp_path):
    write_recording(tmp_path / "curves.rrd", Recording("FetchPush", [], {}))
    assert len(RrdReader(tmp_path / "curves.rrd").blueprints()) == 1


def test_a_write_that_fails_leaves_the_old_file(tmp_path):
    path = tmp_path / "curves.rrd"
    write_recording(path, Recording("FetchPush", steps(2), {"actor/loss": [1.0, 2.0]}))
    with pytest.raises(IndexError):
        write_recording(path, Recording("FetchPush", steps(2), {"actor/loss": [1.0, 2.0, 3.0]}))
    assert len(read_curve(path, "actor/loss")) == 2
    assert list(tmp_path.iterdir()) == [path]


def test_logging_loads_neither_torch_nor_mujoco():
    code = "import sys, worker.recording.run_recording; sys.exit('torch' in sys.modules or 'mujoco' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


DIE_WHILE_WRITING = """
import os, sys
from pathlib import Path
from sldr_core import disk
from worker.recording.content import Recording
from worker.recording.rerun_file import write_recording

disk.sync = lambda path: os._exit(7)
write_recording(Path(sys.argv[1]), Recording("FetchPush", [], {}))
"""


def test_what_a_killed_writer_leaves_is_removed_by_the_next_training(tmp_path):
    command = [sys.executable, "-c", DIE_WHILE_WRITING, str(tmp_path / "curves.rrd")]
    assert subprocess.run(command, check=False).returncode == 7
    assert len(list(tmp_path.glob(".*.tmp"))) == 1
    with alone_in(tmp_path):
        assert [path.name for path in tmp_path.iterdir()] == [LOCK_FILE]


FULL_DISK = """
import resource, sys
from pathlib import Path
from sldr_core.errors import DiskTooFull
from worker.recording.content import Recording
from worker.recording.rerun_file import write_recording

resource.setrlimit(resource.RLIMIT_FSIZE, (100, resource.RLIM_INFINITY))
try:
    write_recording(Path(sys.argv[1]), Recording("FetchPush", [], {}))
except DiskTooFull as err:
    sys.exit(str(err))
"""
FULL_DISK_S = 120.0
"""What hangs for want of room is found out after this long, also on a busy machine [s]."""


def test_a_full_disk_is_told_and_holds_nobody_up(tmp_path):
    path = tmp_path / "curves.rrd"
    command = [sys.executable, "-c", FULL_DISK, str(path)]
    ended = subprocess.run(command, check=False, stderr=subprocess.PIPE, text=True, timeout=FULL_DISK_S)
    assert (ended.returncode, f"There is no room for {path}" in ended.stderr) == (1, True)
    assert list(tmp_path.iterdir()) == []
