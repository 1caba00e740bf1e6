"""What runs ask of a node, and cores that two of them do not share."""

from __future__ import annotations

import socket
import subprocess
import sys
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

import pytest
from cluster_cases import queue_run

from backend.store.database import Database
from backend.store.queue import claim
from backend.store.settings import Settings
from backend.store.workers import Machine
from sldr_core.config import ComputeConfig
from worker.executors.attempt_host import AttemptHost, NodeUnfit, Terms, check_node
from worker.executors.cores import HeldCores
from worker.executors.ray_needs import Needs, alive_resources, count_slots, describe_nodes, needs_of
from worker.executors.shared_home import is_same_home, mark_home

GPU_FREE = {"CPU": 8.0, "GPU": 1.0}
NO_GPU = {"CPU": 8.0}


@pytest.mark.parametrize(
    ("compute", "free", "needs"),
    [
        (ComputeConfig(threads=3, device="cpu"), GPU_FREE, Needs(3, 0)),
        (ComputeConfig(threads=0, device="cpu"), GPU_FREE, Needs(2, 0)),
        (ComputeConfig(threads=1, device="auto"), GPU_FREE, Needs(1, 1)),
        (ComputeConfig(threads=1, device="auto"), NO_GPU, Needs(1, 0)),
        (ComputeConfig(threads=1, device="cuda"), NO_GPU, Needs(1, 1)),
    ],
)
def test_needs_follow_the_settings_of_a_run(compute: ComputeConfig, free: dict[str, float], needs: Needs) -> None:
    assert needs_of(compute, 2, free, [free]) == needs


def test_a_run_does_without_a_gpu_whose_node_has_too_few_cores() -> None:
    nodes = [{"CPU": 2.0, "GPU": 1.0}, {"CPU": 16.0}]

    assert needs_of(ComputeConfig(threads=4, device="auto"), 2, {"CPU": 18.0, "GPU": 1.0}, nodes) == Needs(4, 0)


def test_a_node_fits_only_with_all_that_is_needed() -> None:
    assert Needs(8, 1).fits(GPU_FREE)
    assert not Needs(9, 0).fits(GPU_FREE)
    assert not Needs(1, 1).fits(NO_GPU)


def test_slots_are_counted_per_living_node() -> None:
    nodes = [
        {"Alive": True, "Resources": {"CPU": 3.0}},
        {"Alive": True, "Resources": {"CPU": 5.0}},
        {"Alive": True, "Resources": {"memory": 1.0}},
        {"Alive": False, "Resources": {"CPU": 64.0}},
    ]

    assert count_slots(alive_resources(nodes), cores=2) == 1 + 2


def test_a_cluster_is_described_by_what_its_nodes_have_together() -> None:
    assert describe_nodes([GPU_FREE, NO_GPU]) == Machine(cores=16, gpu="1 on the cluster", executor="ray")
    assert describe_nodes([NO_GPU]).gpu is None


@pytest.mark.parametrize(
    ("terms", "reason"),
    [
        ({"version": "0.0.1"}, "has sldr .* and its worker 0.0.1; install the same on both"),
        ({"only_host": "elsewhere"}, "cannot reach the store, which is a file on elsewhere; .* needs PostgreSQL"),
        ({"home_mark": "another"}, "does not see the data directory .* of its worker; share it"),
    ],
)
def test_a_node_that_cannot_run_attempts_says_why(terms: dict[str, str], reason: str, tmp_path: Path) -> None:
    good = Terms({}, socket.gethostname(), mark_home(tmp_path), version("sldr"), None)
    check_node(good, tmp_path)

    with pytest.raises(NodeUnfit, match=f"Node {socket.gethostname()} {reason}"):
        check_node(replace(good, **terms), tmp_path)


@pytest.mark.parametrize(("held", "seen"), [(Needs(1, 0), "''"), (Needs(1, 1), "'3'")])
def test_an_attempt_sees_the_gpu_that_was_set_aside_for_it_and_no_other(
    db: Database, settings: Settings, monkeypatch: pytest.MonkeyPatch, held: Needs, seen: str
) -> None:
    for name, value in {**settings.as_environment(), "CUDA_VISIBLE_DEVICES": "3"}.items():
        monkeypatch.setenv(name, value)
    show = [sys.executable, "-c", "import os; print(repr(os.environ['CUDA_VISIBLE_DEVICES']))"]
    run_id = queue_run(db, {"compute": {"threads": 1}})
    claimed = claim(db, "worker-1")
    assert claimed is not None

    host = AttemptHost()
    host.start(claimed, Terms(settings.as_environment(), None, None, version("sldr"), show), held)
    assert host._child is not None
    host._child.wait()

    assert (settings.run_directory(run_id) / "log.txt").read_text().strip() == seen


def test_two_holders_share_no_core(tmp_path: Path) -> None:
    first, second = HeldCores({4, 5, 6}, 2, tmp_path), HeldCores({4, 5, 6}, 2, tmp_path)
    held = first.numbers, second.numbers
    first.release()
    third = HeldCores({4, 5, 6}, 1, tmp_path)

    assert held == ({4, 5}, {6})
    assert third.numbers == {4}
    second.release()
    third.release()


def test_cores_are_free_again_when_their_holder_has_died(tmp_path: Path) -> None:
    hold_and_die = (
        "import os, sys; from pathlib import Path; from worker.executors.cores import HeldCores; "
        "held = HeldCores({4}, 1, Path(sys.argv[1])); print(held.numbers, flush=True); os._exit(0)"
    )
    done = subprocess.run([sys.executable, "-c", hold_and_die, tmp_path], capture_output=True, text=True, check=True)
    held = HeldCores({4}, 1, tmp_path)

    assert done.stdout.strip() == str({4})
    assert held.numbers == {4}
    held.release()


def test_a_data_directory_is_known_again(tmp_path: Path) -> None:
    mark = mark_home(tmp_path / "ours")
    mark_home(tmp_path / "other")

    assert mark_home(tmp_path / "ours") == mark
    assert is_same_home(tmp_path / "ours", mark)
    assert not is_same_home(tmp_path / "other", mark)
    assert not is_same_home(tmp_path / "none", mark)
