"""`sldr node` and `sldr worker --executor ray`: what they refuse, and a real training through both."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from cluster_cases import queue_run
from other_processes import wait_until

from backend.store.database import Database
from backend.store.runs import get_run
from backend.store.settings import Settings
from backend.store.states import ENDED, RunState
from worker.cli import main

START_S = 120.0
REAL_PATIENCE_S = 240.0


@pytest.fixture
def short_path() -> Iterator[str]:
    """Return a directory whose path leaves room for the names of Ray's sockets."""
    with tempfile.TemporaryDirectory(prefix="sldr-ray-", ignore_cleanup_errors=True) as path:
        yield path


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["node"], "head: either begin a cluster with --head, or join one with --address host:port"),
        (["node", "--head", "--address", "10.1.0.1:6379"], "head: either begin a cluster with --head, or join one"),
        (["node", "--address", "127.0.0.1:6379"], "address: a cluster at 127.0.0.1 is one machine"),
        (["node", "--address", "10.1.0.1:6379"], "listen: name the address of this machine at which the other nodes"),
        (["worker", "--address", "10.1.0.1:6379"], "address: only a cluster has one; add --executor ray"),
        (["worker", "--slots", "0"], "slots: a worker needs at least 1, got 0"),
    ],
)
def test_what_does_not_go_together_is_named(
    arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(arguments)

    assert ended.value.code == 2
    assert sentence in capsys.readouterr().err


def test_a_worker_on_a_cluster_has_to_be_told_where_it_is(settings: Settings) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "worker.cli", "worker", "--executor", "ray"],
        env={**os.environ, **settings.as_environment()},
        capture_output=True,
        text=True,
        check=False,
    )

    assert done.returncode == 2
    assert done.stderr.splitlines()[-1].startswith("address: name the cluster's head as host:port; `sldr node --head`")


@pytest.mark.cluster
@pytest.mark.slow
def test_a_real_run_is_trained_on_a_cluster_begun_by_the_command(
    db: Database, settings: Settings, tmp_path: Path, short_path: str, free_port: int
) -> None:
    environment = {**os.environ, **settings.as_environment(), "RAY_TMPDIR": short_path}
    for name in ("RAY_AUTH_TOKEN", "RAY_AUTH_TOKEN_PATH"):
        environment.pop(name, None)
    command = [sys.executable, "-m", "worker.cli"]
    said = tmp_path / "node.txt"
    with said.open("w") as output:
        node = subprocess.Popen(
            [*command, "node", "--head", "--port", str(free_port), "--cores", "1"],
            env=environment,
            stdout=output,
            stderr=output,
        )
    worker = None
    try:
        wait_until(lambda: "Ray runtime started" in said.read_text(), START_S)
        address = ["--address", f"127.0.0.1:{free_port}"]
        worker = subprocess.Popen([*command, "worker", "--executor", "ray", *address, "--cores", "1"], env=environment)
        run_id = queue_run(db)
        wait_until(lambda: get_run(db, run_id).state in ENDED, REAL_PATIENCE_S)
        worker.send_signal(signal.SIGTERM)
        assert worker.wait(timeout=60) == 0
    finally:
        for process in filter(None, (worker, node)):
            process.terminate()
        node.wait(timeout=60)

    assert get_run(db, run_id).state is RunState.SUCCEEDED, get_run(db, run_id).reason
