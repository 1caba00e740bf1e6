"""`sldr worker`: become the supervisor that trains queued runs."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import Literal

import tyro

from sldr_core.errors import InvalidConfig


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(work, prog="sldr worker", args=list(arguments))


def work(
    slots: int | None = None,
    executor: Literal["local", "ray"] = "local",
    address: str | None = None,
    cores: int | None = None,
) -> int:
    """Train queued runs, on this machine or on a cluster, until told to end.

    Args:
        slots: Runs trained at the same time (default: 1; on a cluster: as many as fit when the worker starts).
        executor: Where to train: in processes of this machine, or on the nodes of a Ray cluster.
        address: The cluster's head as host:port; `sldr node --head` prints it.
        cores: Cores of a run on a cluster that names no number of threads (default: 2).
    """
    if slots is not None and slots < 1:
        raise InvalidConfig({"slots": f"a worker needs at least 1, got {slots}"})
    if executor == "local" and address is not None:
        raise InvalidConfig({"address": "only a cluster has one; add --executor ray"})
    if executor == "local" and cores is not None:
        raise InvalidConfig({"cores": "only on a cluster are they set aside for runs; add --executor ray"})
    options = ["--executor", executor]
    options += [] if cores is None else ["--cores", str(cores)]
    options += [] if slots is None else ["--slots", str(slots)]
    options += [] if address is None else ["--address", address]
    os.execv(sys.executable, [sys.executable, "-m", "worker", *options])
