"""The real thing, small: `python -m worker` trains the object, then the robot."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

from other_processes import wait_until

from backend.store.database import Database
from backend.store.files import list_files
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import read_metrics
from backend.store.runs import get_run
from backend.store.settings import Settings
from backend.store.states import ENDED, RunState

FILES_OF_BOTH = {"checkpoint.pt", "policy-best.pt", "policy-newest.pt"}

REAL_PATIENCE_S = 120.0


def test_object_and_robot_are_trained_one_after_the_other(db: Database, settings: Settings) -> None:
    locomotion, manipulation = launch(db, LaunchOrder("FetchPush", "manipulation", "her-sldr", [0], "smoke"))
    process = subprocess.Popen(
        [sys.executable, "-m", "worker", "--slots", "1"], env={**os.environ, **settings.as_environment()}
    )
    try:
        wait_until(lambda: get_run(db, locomotion).state in ENDED, REAL_PATIENCE_S)
        assert get_run(db, locomotion).state is RunState.SUCCEEDED, get_run(db, locomotion).reason
        wait_until(lambda: get_run(db, manipulation).state in ENDED, REAL_PATIENCE_S)
        assert get_run(db, manipulation).state is RunState.SUCCEEDED, get_run(db, manipulation).reason
    finally:
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=60) == 0

    assert FILES_OF_BOTH | {"locomotion.pt"} <= {row.name for row in list_files(db, locomotion)}
    assert {row.name for row in list_files(db, manipulation)} >= FILES_OF_BOTH
    assert read_metrics(db, manipulation).step == [1, 2, 3, 4]
    assert "critic/sldr/object0/loss" in read_metrics(db, manipulation).values
