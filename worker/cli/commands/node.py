"""`sldr node`: become a node of a Ray cluster that is closed to others."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

import tyro

from backend.store.settings import load_settings
from sldr_core.errors import InvalidConfig
from worker.executors.ray_access import (
    DEFAULT_PORT,
    cluster_environment,
    find_token,
    is_loopback,
    make_token,
    require_ray,
    split_address,
)

OBJECT_STORE_BYTES = 80_000_000
"""Memory for objects that Ray moves between processes, near the smallest it takes: we move none [bytes]."""
LOOPBACK = "127.0.0.1"


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(node, prog="sldr node", args=list(arguments))


def node(
    head: bool = False,
    address: str | None = None,
    listen: str = LOOPBACK,
    port: int = DEFAULT_PORT,
    cores: int | None = None,
    gpus: int | None = None,
) -> int:
    """Make this machine a node of a cluster for `sldr worker --executor ray`, until told to end.

    Args:
        head: Begin a cluster here.
        address: Join the cluster whose head is at host:port.
        listen: Address of this machine at which the others reach it. On 127.0.0.1 the cluster is this machine alone.
        port: Port of the head.
        cores: Cores to lend to runs (default: all).
        gpus: GPUs to lend to runs (default: all).
    """
    require_ray()
    if head == (address is not None):
        raise InvalidConfig({"head": "either begin a cluster with --head, or join one with --address host:port"})
    if address is None:
        place, where = _begin(listen, port), (listen, port)
    else:
        place, where = _join(address, listen), split_address(address)
    home = load_settings().home
    if head:
        make_token(home)
    os.environ.update(cluster_environment(home, where[0]))
    find_token()
    print(
        f"Cluster: {where[0]}:{where[1]}  Token: {os.environ.get('RAY_AUTH_TOKEN_PATH', 'RAY_AUTH_TOKEN')}", flush=True
    )
    limits = [f"--num-{name}={count}" for name, count in (("cpus", cores), ("gpus", gpus)) if count is not None]
    store = f"--object-store-memory={OBJECT_STORE_BYTES}"
    command = ["-m", "ray.scripts.scripts", "start", "--block", "--disable-usage-stats", store, *place, *limits]
    os.execv(sys.executable, [sys.executable, *command])


def _begin(listen: str, port: int) -> list[str]:
    return ["--head", f"--node-ip-address={listen}", f"--port={port}", "--include-dashboard=false"]


def _join(address: str, listen: str) -> list[str]:
    head, _ = split_address(address)
    if is_loopback(head):
        raise InvalidConfig(
            {"address": f"a cluster at {head} is one machine; start its head with --listen and an address of its own"}
        )
    if is_loopback(listen):
        raise InvalidConfig({"listen": "name the address of this machine at which the other nodes reach it"})
    return [f"--address={address}", f"--node-ip-address={listen}"]
