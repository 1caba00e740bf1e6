"""A real cluster for the tests of this room, and both executors."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from cluster_cases import Behave, Cluster, ClusterNotStarted
from fake_attempts import fake_command
from other_processes import PATIENCE_S

from backend.store.settings import Settings
from sldr_core.processor import THREADS_VARIABLE
from worker.executors.local import LocalExecutor
from worker.executors.ray_access import cluster_environment, connect, make_token

HERE = Path(__file__).parent
QUICK_TO_NOTICE = {
    "RAY_health_check_initial_delay_ms": "1000",
    "RAY_health_check_period_ms": "500",
    "RAY_health_check_timeout_ms": "15000",
    "RAY_health_check_failure_threshold": "4",
}
"""A node that is killed is missed after some 2 s; a cluster that is not told so takes some 15 s."""
MOST_STARTS = 3
PATIENT_AT_START = {"RAY_agent_register_timeout_ms": "120000", "RAY_worker_register_timeout_seconds": "120"}
SET_BY_SOMEBODY = {THREADS_VARIABLE: "7"}
"""A number that is in the environment of every node, and no attempt's."""


@pytest.fixture(scope="session")
def cluster() -> Iterator[Cluster]:
    """Return a cluster of two nodes, which takes a token and listens on the loopback address only."""
    home = Path(tempfile.mkdtemp(prefix="sldr-ray-"))  # Ray's sockets need a shorter path than pytest's.
    make_token(home)
    environment = {**cluster_environment(home, "127.0.0.1"), **QUICK_TO_NOTICE, **PATIENT_AT_START}
    environment["RAY_TMPDIR"] = str(home)
    with pytest.MonkeyPatch.context() as patch:
        for name, value in environment.items():
            patch.setenv(name, value)
        cluster = start_cluster(home)
        yield cluster
        cluster.end()
    shutil.rmtree(home)


def start_cluster(home: Path) -> Cluster:
    """Start the cluster, again if Ray itself found that it took too long: it waits for 30 s and cannot be told more."""
    failures: list[Exception] = []
    while len(failures) < MOST_STARTS:
        with (home / "cluster.log").open("w") as log:
            process = subprocess.Popen(
                [sys.executable, str(HERE / "two_nodes.py")],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                text=True,
                env={**os.environ, **SET_BY_SOMEBODY},
            )
        try:
            return Cluster(home, process)
        except ClusterNotStarted as err:
            process.communicate()
            failures.append(err)
    raise ExceptionGroup("the cluster did not start", failures)


@pytest.fixture(scope="session")
def connected(cluster: Cluster) -> Iterator[None]:
    """Let this process ask things of the cluster."""
    connect(cluster.address, cluster.home)
    yield
    import ray

    ray.shutdown()


@pytest.fixture(params=["local", pytest.param("ray", marks=pytest.mark.cluster)])
def behave(request: pytest.FixtureRequest, settings: Settings, monkeypatch: pytest.MonkeyPatch) -> Behave:
    """Return a way to make an executor, of each kind, whose children behave as told."""
    if request.param == "local":
        return lambda behaviour: LocalExecutor(settings, fake_command(behaviour))
    request.getfixturevalue("connected")
    from worker.executors import ray_child
    from worker.executors.ray import RayExecutor

    monkeypatch.setattr(ray_child, "PLACEMENT_S", PATIENCE_S)  # A busy machine takes long to start what holds one.
    return lambda behaviour: RayExecutor(settings, 1, fake_command(behaviour))
