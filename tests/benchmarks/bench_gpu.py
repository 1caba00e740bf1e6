"""A GPU: updates replayed as graphs against the same ones operation by operation and on the cores, and the
simulations that go on beside them.
"""

from __future__ import annotations

import statistics
import sys
import tempfile
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import torch
from bench_models import paper_training
from bench_rows import Measured, Target, row, time_pairs

from sldr_core.training.build import Parts
from sldr_core.training.cycle import CYCLES
from sldr_core.training.updates import MakeUpdate, update_on

UPDATES = 40
"""Updates that are timed together, as many as a cycle of the paper has."""

CASES = (("FetchPush", "her"), ("FetchPush", "her-sldr"), ("HandEggRotate", "her"), ("HandEggRotate", "her-sldr"))


def measure_gpu() -> Iterator[Measured]:
    """Time updates and whole cycles of the paper's sizes; nothing where torch finds no GPU."""
    if not torch.cuda.is_available():
        print("gpu: torch finds no GPU on this machine, so nothing is measured.", file=sys.stderr)
        return
    with tempfile.TemporaryDirectory() as name:
        for task, method in CASES:
            for precision in ("float32", "bfloat16"):
                yield _replayed(Path(name), task, method, precision)
            yield _cycle(Path(name), task, method)


def _replayed(root: Path, task: str, method: str, precision: str) -> Measured:
    parts = _parts(root, task, method, precision, "cuda")
    by_operation = partial(update_on, parts.learners, parts.compute.device)
    batch_size = parts.config.loop.batch_size
    sample = parts.sampler.sample(batch_size, 0)

    def learn(make: MakeUpdate) -> None:
        for _ in range(UPDATES):
            made = make(sample, False)
        torch.cuda.synchronize()
        assert torch.isfinite(made.metrics["actor/loss"])

    pairs = time_pairs(lambda: learn(parts.make_update), lambda: learn(by_operation))
    replayed, plain = UPDATES / statistics.median(pairs.ours), UPDATES / statistics.median(pairs.theirs)
    return row(
        f"{task}, {method}, {precision}: updates at {batch_size} on the GPU, replayed against operation by operation",
        "x",
        pairs.speedups,
        Target("at least", 1.0),
        f"{replayed:,.0f} against {plain:,.0f} updates a second",
    )


def _cycle(root: Path, task: str, method: str) -> Measured:
    """Compare whole cycles of a training, episodes collected beside the updates, with those on the cores alone."""
    gpu, cores = (_parts(root, task, method, "float32", device) for device in ("cuda", "cpu"))
    told: dict[str, float] = {}

    def run(parts: Parts) -> None:
        told.update(CYCLES["beside"](parts, 0, lambda: None).metrics)

    run(cores)
    pairs = time_pairs(lambda: run(gpu), lambda: run(cores), repetitions=3)
    run(gpu)
    return row(
        f"{task}, {method}: a cycle of the paper's, learner on the GPU against all on the cores",
        "x",
        pairs.speedups,
        Target("at least", 1.0),
        f"{statistics.median(pairs.ours):.2f} s against {statistics.median(pairs.theirs):.2f} s; on the GPU "
        f"{told['speed/updates_per_s']:,.0f} updates and {told['speed/env_steps_per_s']:,.0f} env steps a second, "
        f"of {gpu.compute.threads} threads",
    )


def _parts(root: Path, task: str, method: str, precision: str, device: str) -> Parts:
    settings = {
        "compute": {"precision": precision, "device": device},
        "replay": {"capacity": 50_000},
        "loop": {"collecting": "beside"},
    }
    return paper_training(root, task, method, settings)
