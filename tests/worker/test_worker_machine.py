"""A worker knows its GPUs, shares them out evenly, and tells its own faults from what comes from outside."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

import pytest
from other_processes import wait_until
from worker_cases import queued_run

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.outcomes import Failed, Lost
from backend.store.queue import claim
from backend.store.settings import Settings
from sldr_core.processor import THREADS_VARIABLE, count_cores, granted_threads, model_in
from worker import machine
from worker.executors.endings import failure_of
from worker.executors.local import LocalExecutor
from worker.machine import Gpu, describe_machine, find_gpus, memory_used, share_of_threads, visible_gpus

LISTED = """\
0, GPU-1f3a0000-aaaa, NVIDIA H200
1, GPU-2b4c0000-bbbb, NVIDIA H200
2, GPU-3d5e0000-cccc, NVIDIA L4
"""

SAY = "import os, sys; sys.stdin.readline(); print(os.environ.get('{}'), flush=True); input()"
SAY_GPU, SAY_THREADS = SAY.format("CUDA_VISIBLE_DEVICES"), SAY.format(THREADS_VARIABLE)


def first_word(settings: Settings, claimed: Claim, executor: LocalExecutor) -> str:
    """Return what an attempt prints first, and end it."""
    child = executor.start(claimed)
    log = settings.run_directory(claimed.run_id) / "log.txt"
    wait_until(lambda: bool(log.read_text()))
    child.kill()
    child.wait()
    return log.read_text().strip()


def test_every_gpu_is_used_unless_some_are_named() -> None:
    assert [gpu.device for gpu in visible_gpus(LISTED, None)] == ["0", "1", "2"]


@pytest.mark.parametrize(
    ("visible", "devices"),
    [("2,0", ["2", "0"]), ("GPU-2b4c", ["GPU-2b4c"]), ("", []), ("7", []), ("GPU-", []), ("-1", [])],
)
def test_only_the_gpus_that_are_named_are_used(visible: str, devices: list[str]) -> None:
    assert [gpu.device for gpu in visible_gpus(LISTED, visible)] == devices


def test_a_driver_that_does_not_answer_shows_no_gpu_and_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "nvidia-smi").write_text("#!/bin/sh\nexec sleep 60\n")
    (tmp_path / "nvidia-smi").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    monkeypatch.setattr(machine, "version", lambda _: "2.13.0")
    monkeypatch.setattr(machine, "QUERY_PATIENCE_S", 0.1)

    assert find_gpus() == []
    assert caplog.messages == [
        "The NVIDIA driver does not answer: nvidia-smi did not end within 0.1 s. Trainings use the processor."
    ]


def test_a_machine_is_described_with_its_gpus() -> None:
    gpus = visible_gpus(LISTED, None)

    assert describe_machine([]).gpu is None
    assert describe_machine(gpus[:1]).gpu == "NVIDIA H200"
    assert describe_machine(gpus).gpu == "3 x NVIDIA H200, NVIDIA L4"


def test_a_machine_knows_its_cores_and_memory() -> None:
    machine = describe_machine([])

    assert machine.cores == count_cores() >= 1
    assert 0 < memory_used() < machine.memory_total


def test_the_kernel_names_the_processors() -> None:
    listed = "processor\t: 0\nvendor_id\t: AuthenticAMD\nmodel name\t: AMD EPYC 7003: 64-Core\n\nprocessor\t: 1\n"

    assert model_in(listed) == "AMD EPYC 7003: 64-Core"


@pytest.mark.parametrize(("told", "model"), [("arm", "arm"), ("", None)])
def test_where_the_kernel_does_not_the_platform_may(
    told: str, model: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("platform.processor", lambda: told)

    assert model_in("processor\t: 0\nBogoMIPS\t: 50.00\n") == model


def test_attempts_are_spread_over_several_gpus(db: Database, settings: Settings) -> None:
    gpus = [Gpu("0", "H200"), Gpu("1", "H200")]
    executor = LocalExecutor(settings, [sys.executable, "-c", SAY_GPU], gpus)
    children = []
    for seed in range(3):
        run_id = queued_run(db, seed)
        claimed = claim(db, "worker-1")
        assert claimed is not None
        children.append((settings.run_directory(run_id) / "log.txt", executor.start(claimed)))
    first_log, first = children[0]
    wait_until(lambda: all(log.read_text() for log, _ in children))
    seen = [log.read_text().strip() for log, _ in children]
    for _, child in children:
        child.kill()
        child.wait()

    assert seen == ["0", "1", "0"]
    assert first.poll() == -signal.SIGKILL
    assert first_log.exists()


def test_a_single_gpu_is_left_to_be_found(db: Database, settings: Settings, tmp_path: Path) -> None:
    queued_run(db)
    claimed = claim(db, "worker-1")
    assert claimed is not None
    executor = LocalExecutor(settings, [sys.executable, "-c", SAY_GPU], [Gpu("0", "H200")])

    assert first_word(settings, claimed, executor) == "None"


@pytest.mark.parametrize(
    ("granted", "slots", "share"), [("4", 1, 4), ("4", 2, 2), ("5", 2, 2), ("2", 4, 1), ("3,2", 1, 3)]
)
def test_slots_share_the_threads(granted: str, slots: int, share: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(THREADS_VARIABLE, granted)

    assert share_of_threads(slots) == share


@pytest.mark.parametrize("told", [None, "", "0", "many"])
def test_where_no_number_is_told_each_core_gets_a_thread(told: str | None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(THREADS_VARIABLE, raising=False)
    if told is not None:
        monkeypatch.setenv(THREADS_VARIABLE, told)

    assert granted_threads() == count_cores()


def test_an_attempt_is_told_its_share_of_the_threads(db: Database, settings: Settings) -> None:
    queued_run(db)
    claimed = claim(db, "worker-1")
    assert claimed is not None
    executor = LocalExecutor(settings, [sys.executable, "-c", SAY_THREADS], threads=3)

    assert first_word(settings, claimed, executor) == "3"


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_a_process_killed_from_outside_is_lost(number: signal.Signals) -> None:
    outcome = failure_of(-number)

    assert isinstance(outcome, Lost)
    assert number.name in outcome.reason


@pytest.mark.parametrize("number", [signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS])
def test_a_process_that_crashes_has_failed(number: signal.Signals) -> None:
    outcome = failure_of(-number)

    assert isinstance(outcome, Failed)
    assert outcome.retry
    assert number.name in outcome.reason


def test_a_process_that_ends_early_has_failed() -> None:
    assert failure_of(3) == Failed("Its process ended early with exit status 3; the log says more.", retry=True)
