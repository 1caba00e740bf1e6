"""What a run asks of a node, and whether the cluster has such nodes: plain numbers, without Ray."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from backend.store.workers import Machine
from sldr_core.config import ComputeConfig

CORES_OF_A_RUN = 2
"""What a run gets that names no number of threads, unless the worker is told otherwise."""

Resources = Mapping[str, float]
"""Amounts by Ray's names: `CPU` and `GPU`."""


@dataclass(frozen=True)
class Needs:
    """Say what is set aside for one attempt on its node."""

    cores: int
    gpus: int

    def fits(self, resources: Resources) -> bool:
        """Tell whether so much is there."""
        return resources.get("CPU", 0.0) >= self.cores and resources.get("GPU", 0.0) >= self.gpus

    def __str__(self) -> str:
        gpus = f" and {self.gpus} GPU" if self.gpus else ""
        return f"{self.cores} core{'s' if self.cores > 1 else ''}{gpus}"


def needs_of(compute: ComputeConfig, cores: int, free: Resources, nodes: Sequence[Resources]) -> Needs:
    """Return what a run asks for; `device="auto"` takes a GPU if one is free and its node has the cores as well.

    Args:
        compute: the run's settings.
        cores: what a run gets that names no number of threads.
        free: what nobody uses just now in the whole cluster.
        nodes: what each node has, used or not.
    """
    without, with_gpu = (Needs(compute.threads or cores, gpus) for gpus in (0, 1))
    if compute.device == "cuda":
        return with_gpu
    is_gpu_of_use = free.get("GPU", 0.0) >= 1 and any(with_gpu.fits(node) for node in nodes)
    return with_gpu if compute.device == "auto" and is_gpu_of_use else without


def alive_resources(nodes: Sequence[Mapping[str, Any]]) -> list[Resources]:
    """Return all that each living node has, used or not, from Ray's list of nodes."""
    return [node["Resources"] for node in nodes if node["Alive"]]


def describe_nodes(nodes: Sequence[Resources]) -> Machine:
    """Return what the nodes have together; their memory is not one."""
    gpus = sum(int(node.get("GPU", 0.0)) for node in nodes)
    cores = sum(int(node.get("CPU", 0.0)) for node in nodes)
    return Machine(cores=cores, gpu=f"{gpus} on the cluster" if gpus else None, executor="ray")


def count_slots(nodes: Sequence[Resources], cores: int) -> int:
    """Return how many runs of so many cores fit into the nodes at once."""
    return sum(int(node.get("CPU", 0.0)) // cores for node in nodes)
