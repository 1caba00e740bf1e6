"""Nobody gets into a cluster without its token, and no worker into a cluster that asks for none."""

from __future__ import annotations

import importlib.util
import os
import stat
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import psutil
import pytest
from cluster_cases import Cluster

from sldr_core.errors import InvalidConfig
from worker.executors import ray_access
from worker.executors.ray_access import (
    ClusterUnavailable,
    cluster_environment,
    connect,
    is_loopback,
    make_token,
    split_address,
)

CONNECT = (
    "import sys; from pathlib import Path; from worker.executors.ray_access import connect; "
    "connect(sys.argv[1], Path(sys.argv[2]))"
)
TIMEOUT_S = 120
LEAST_DOORS = 6
"""The head and two nodes have more, or the test does not see them."""
OPEN_HEAD = """
import sys
from ray.cluster_utils import Cluster
from two_nodes import SMALL
cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 0, **SMALL})
print(cluster.address, flush=True)
sys.stdin.read()
cluster.shutdown()
"""


@pytest.fixture(autouse=True)
def own_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep what a test does to Ray's variables from the others."""
    for name in (*cluster_environment(Path("home"), "127.0.0.1"), *ray_access.TOKEN_VARIABLES):
        monkeypatch.setenv(name, os.environ.get(name, ""))


@pytest.fixture
def without_token(own_environment: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Forget the token of the cluster that other tests use."""
    for name in ray_access.TOKEN_VARIABLES:
        monkeypatch.delenv(name)


@pytest.mark.parametrize("address", ["127.0.0.1", "127.0.0.1:", ":6379", "head:port"])
def test_an_address_without_host_or_port_is_named(address: str) -> None:
    with pytest.raises(InvalidConfig, match=f"address: '{address}' is not of the form host:port"):
        split_address(address)


def test_an_address_may_be_of_version_6() -> None:
    assert split_address("[fd00::2]:6379") == ("fd00::2", 6379)


@pytest.mark.parametrize(
    ("host", "is_so"), [("127.0.0.1", True), ("::1", True), ("localhost", True), ("10.1.0.1", False)]
)
def test_addresses_of_this_machine_alone_are_told_apart(host: str, is_so: bool) -> None:
    assert is_loopback(host) is is_so


def test_a_cluster_of_several_machines_may_listen_to_them(without_token: None, tmp_path: Path) -> None:
    assert cluster_environment(tmp_path, "10.1.0.1") == {
        "RAY_AUTH_MODE": "token",
        "RAY_AUTH_TOKEN_PATH": str(tmp_path / "cluster-token"),
        "RAY_USAGE_STATS_ENABLED": "0",
        "RAY_worker_niceness": "0",
    }


def test_a_node_s_owner_says_how_nice_its_trainings_are(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RAY_worker_niceness", "12")
    assert cluster_environment(tmp_path, "127.0.0.1")["RAY_worker_niceness"] == "12"


def test_a_new_token_is_for_its_owner_only_and_stays(without_token: None, tmp_path: Path) -> None:
    make_token(tmp_path / "home")
    path = tmp_path / "home" / "cluster-token"
    token = path.read_text()
    make_token(tmp_path / "home")

    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert len(token) == 2 * ray_access.TOKEN_BYTES
    assert path.read_text() == token


def test_a_missing_token_is_named_with_the_way_out(without_token: None, tmp_path: Path) -> None:
    with pytest.raises(ClusterUnavailable, match=f"no token in {tmp_path}/cluster-token; copy"):
        connect("127.0.0.1:6379", tmp_path)


def test_a_head_that_does_not_listen_is_named(without_token: None, tmp_path: Path, free_port: int) -> None:
    make_token(tmp_path)

    with pytest.raises(ClusterUnavailable, match=f"No cluster answers at 127.0.0.1:{free_port} .*`sldr node --head`"):
        connect(f"127.0.0.1:{free_port}", tmp_path)


def test_a_missing_ray_is_named_with_the_way_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)

    with pytest.raises(ClusterUnavailable, match=r"pip install '\.\[ray\]'"):
        connect("127.0.0.1:6379", tmp_path)


@pytest.mark.cluster
@pytest.mark.slow
def test_a_wrong_token_is_refused(cluster: Cluster, without_token: None, tmp_path: Path) -> None:
    make_token(tmp_path)

    done = subprocess.run(
        [sys.executable, "-c", CONNECT, cluster.address, str(tmp_path)],
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=False,
    )

    assert "did not let this worker in: its token may be another" in done.stderr


@pytest.mark.cluster
@pytest.mark.slow
def test_a_cluster_that_asks_for_no_token_is_not_used(without_token: None, tmp_path: Path) -> None:
    make_token(tmp_path)
    environment = {**os.environ, **cluster_environment(tmp_path, "127.0.0.1"), "RAY_AUTH_MODE": "disabled"}
    environment |= {"PYTHONPATH": f"{Path(__file__).parent}:{os.environ.get('PYTHONPATH', '')}"}
    head = subprocess.Popen(
        [sys.executable, "-c", OPEN_HEAD], env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    try:
        assert head.stdout is not None
        address = head.stdout.readline().strip()
        with pytest.raises(ClusterUnavailable, match=f"{address} obeys anybody who reaches it"):
            connect(address, tmp_path)
    finally:
        head.communicate(timeout=TIMEOUT_S)


@pytest.mark.cluster
def test_nothing_of_a_cluster_listens_to_other_machines(cluster: Cluster, connected: None) -> None:
    listening: list[str] = []
    for process in [psutil.Process(), *psutil.Process().children(recursive=True)]:
        with suppress(psutil.NoSuchProcess):  # Idle ones end by themselves.
            doors = [door for door in process.net_connections("inet") if door.status == psutil.CONN_LISTEN]
            listening += [door.laddr.ip.removeprefix("::ffff:") for door in doors]

    assert len(listening) > LEAST_DOORS
    assert {ip for ip in listening if not is_loopback(ip)} == set()
