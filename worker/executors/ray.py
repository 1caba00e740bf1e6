"""Running attempts on a Ray cluster: Ray finds a node and tells when it is lost; the store stays the record.

Ray never tries an attempt again by itself: that is the queue's to decide, or two attempts of one run could be alive.
"""

from __future__ import annotations

import logging
import socket
from collections.abc import Sequence
from importlib.metadata import version

import ray

from backend.store.claims import Claim
from backend.store.settings import Settings
from backend.store.workers import Machine
from sldr_core.errors import InvalidConfig
from worker.executors import Child
from worker.executors.attempt_host import AttemptHost, Terms
from worker.executors.ray_access import ClusterUnavailable
from worker.executors.ray_child import RayChild, UnplacedChild
from worker.executors.ray_needs import Resources, alive_resources, count_slots, describe_nodes, needs_of
from worker.executors.shared_home import mark_home

NO_SECOND_TRY = {"max_restarts": 0, "max_task_retries": 0}

log = logging.getLogger(__name__)


class RayExecutor:
    """Place each attempt on a node that has its cores and GPU free. Connect to the cluster before making one."""

    def __init__(self, settings: Settings, cores: int, command: Sequence[str] | None = None) -> None:
        """Prepare for attempts.

        Args:
            cores: what a run gets that names no number of threads.
            command: what to start in place of a real training; tests do.
        """
        if cores < 1:
            raise InvalidConfig({"cores": f"a run needs at least 1, got {cores}"})
        self._cores = cores
        self._terms = Terms(
            environment=settings.as_environment(),
            only_host=socket.gethostname() if settings.database_url.startswith("sqlite") else None,
            home_mark=None if settings.files_url is not None else mark_home(settings.home),
            version=version("sldr"),
            command=command,
        )
        self._newest: Child | None = None

    def count_slots(self) -> int:
        """Return how many runs fit into the cluster at once, as it is now.

        Raises:
            ClusterUnavailable: not one does.
        """
        nodes = self._nodes()
        slots = count_slots(nodes, self._cores)
        if not slots:
            most = max((int(node.get("CPU", 0.0)) for node in nodes), default=0)
            raise ClusterUnavailable(
                f"No node of the cluster has {self._cores} cores for a run, the largest has {most}; "
                "add a node with `sldr node`, or give fewer with --cores."
            )
        return slots

    def describe(self) -> Machine:
        """Return what the nodes have together, as it is now."""
        return describe_nodes(self._nodes())

    def has_room(self) -> bool:
        """Tell whether a node may have room: the one started last has found its place, and enough cores are free."""
        if isinstance(self._newest, RayChild) and not self._newest.is_settled():
            return False
        return self._free().get("CPU", 0.0) >= self._cores

    def has_gpu(self) -> bool:
        """Tell whether a node has a GPU, as it is now."""
        return self.describe().gpu is not None

    def start(self, claim: Claim) -> Child:
        """Ask Ray for a node; the attempt starts there as soon as one has what it needs."""
        self._newest = self._place(claim)
        return self._newest

    def _place(self, claim: Claim) -> Child:
        nodes = self._nodes()
        needs = needs_of(claim.config.compute, self._cores, self._free(), nodes)
        if not any(needs.fits(node) for node in nodes):
            return UnplacedChild(f"It needs {needs}, and no node of the cluster has as much; add one, or cancel it.")
        host = (
            ray.remote(AttemptHost)
            .options(num_cpus=needs.cores, num_gpus=needs.gpus, scheduling_strategy="SPREAD", **NO_SECOND_TRY)
            .remote()
        )
        return RayChild(host, host.start.remote(claim, self._terms, needs), needs, claim.run_id)

    def _nodes(self) -> list[Resources]:
        return alive_resources(ray.nodes())

    def _free(self) -> Resources:
        return ray.available_resources()
