"""A Ray cluster of two nodes with a core each and a head without any, on this machine: alive while its input is open.

Its first line of output says where: the head's address, and the process of each node. For each line of input it
replaces the nodes that have died, and says so again.
"""

from __future__ import annotations

import json
import sys
from typing import Any

from ray.cluster_utils import Cluster

NODES = 2
MOST_STARTS = 6
PATIENCE_S = 120.0
SMALL: dict[str, Any] = {
    "node_ip_address": "127.0.0.1",
    "object_store_memory": 80_000_000,
    "include_dashboard": False,
    "include_log_monitor": False,
    "no_monitor": True,
}


def complete(cluster: Cluster) -> dict[str, Any]:
    """Start the nodes that are missing, and describe the cluster."""
    for node in [node for node in cluster.worker_nodes if not node.remaining_processes_alive()]:
        cluster.remove_node(node, allow_graceful=False)
    for _ in range(MOST_STARTS):
        if len(cluster.worker_nodes) < NODES:
            start_node(cluster)
    cluster.wait_for_nodes(PATIENCE_S)
    raylets = [node.all_processes["raylet"][0].process.pid for node in cluster.worker_nodes]
    return {"address": cluster.address, "raylets": raylets}


def start_node(cluster: Cluster) -> None:
    """Start a node; on a very busy machine Ray may give up after 30 s, and says so."""
    try:
        cluster.add_node(num_cpus=1, wait=False, **SMALL)
    except Exception as err:
        print(err, file=sys.stderr)


if __name__ == "__main__":
    ours = Cluster(initialize_head=True, head_node_args={"num_cpus": 0, **SMALL})
    print(json.dumps(complete(ours)), flush=True)
    for _ in sys.stdin:
        print(json.dumps(complete(ours)), flush=True)
    ours.shutdown()
