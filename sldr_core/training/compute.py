"""Where the numbers are computed: device, threads, precision."""

from __future__ import annotations

from dataclasses import dataclass

import torch

from sldr_core.config import ComputeConfig
from sldr_core.errors import InvalidConfig
from sldr_core.processor import granted_threads


@dataclass(frozen=True)
class Compute:
    """A resolved `ComputeConfig`."""

    device: torch.device
    autocast: bool
    threads: int
    """Threads of this training."""
    collecting_threads: int
    """Those of them that step the simulations in which episodes are collected; the learner may use them too."""


def resolve_compute(config: ComputeConfig, beside: bool = False) -> Compute:
    """Find device and threads, and set torch's number of threads for this process.

    Args:
        config: what is asked for.
        beside: whether episodes are collected while the learner works, so that the two share the threads.

    Raises:
        InvalidConfig: a GPU is asked for and there is none.
    """
    has_gpu = torch.cuda.is_available()
    if config.device == "cuda" and not has_gpu:
        raise InvalidConfig({"compute.device": "there is no GPU that torch can use; choose 'auto' or 'cpu'"})
    threads = config.threads or granted_threads()
    device = torch.device("cuda" if has_gpu and config.device != "cpu" else "cpu")
    learning = _learning_threads(threads, device) if beside else threads
    torch.set_num_threads(learning)
    # A thread takes the number that is set when it first needs one, and whoever collects sets another: needed here.
    torch.get_num_threads()
    return Compute(
        device=device,
        autocast=config.precision == "bfloat16",
        threads=threads,
        # A learner of one thread waits for no other, so that simulations may have its core too, as in the warm-up.
        collecting_threads=threads - learning if beside and learning > 1 else threads,
    )


def _learning_threads(threads: int, device: torch.device) -> int:
    """Return how many of the threads the learner gets: half of them, or the one that feeds a GPU."""
    return 1 if device.type == "cuda" else max(1, threads // 2)
