"""Where the numbers are computed: device, threads, precision."""

from __future__ import annotations

import os
from dataclasses import dataclass

import torch

from sldr_core.config import ComputeConfig
from sldr_core.errors import InvalidConfig


@dataclass(frozen=True)
class Compute:
    """A resolved `ComputeConfig`."""

    device: torch.device
    autocast: bool
    threads: int


def resolve_compute(config: ComputeConfig) -> Compute:
    """Find device and threads, and set torch's number of threads for this process.

    Raises:
        InvalidConfig: a GPU is asked for and there is none.
    """
    has_gpu = torch.cuda.is_available()
    if config.device == "cuda" and not has_gpu:
        raise InvalidConfig({"compute.device": "there is no GPU that torch can use; choose 'auto' or 'cpu'"})
    threads = config.threads or len(os.sched_getaffinity(0))
    torch.set_num_threads(threads)
    return Compute(
        device=torch.device("cuda" if has_gpu and config.device != "cpu" else "cpu"),
        autocast=config.precision == "bfloat16",
        threads=threads,
    )
