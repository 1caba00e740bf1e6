"""One step of an optimiser down the mean loss of a batch, which is worked through in slices that a cache can hold.

Of the paper's 4,864 transitions a layer of 256 gives 5 MB, which the next operation would have to fetch from memory
again. The gradients of the slices add up to those of the batch, so an update stays what it is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import pairwise

import torch
from torch import Tensor, nn

from sldr_core.nets.precision import fuses

SLICE_ROWS = 1216
"""Transitions that are worked on at a time, at most: a quarter of the paper's batch."""


def slices_of(rows: int, device: torch.device) -> list[slice]:
    """Return slices that cover a batch of `rows`, all nearly of the same length.

    The batch is left whole where products take little time beside what is done once a slice: on a GPU, and on a
    processor with instructions for bfloat16 while it computes so.
    """
    count = 1 if device.type == "cuda" or fuses(device) else -(-rows // SLICE_ROWS)
    bounds = [rows * index // count for index in range(count + 1)]
    return [slice(start, stop) for start, stop in pairwise(bounds)]


@contextmanager
def held(module: nn.Module) -> Iterator[None]:
    """Let gradients pass through a module, and spare those of its own parameters."""
    module.requires_grad_(False)
    try:
        yield
    finally:
        module.requires_grad_(True)


def descend(
    loss: Callable[[slice], Tensor], slices: list[slice], module: nn.Module, optimiser: torch.optim.Optimizer
) -> Tensor:
    """Take one step on the parameters of `module` alone; nothing else gets a gradient.

    Args:
        loss: gives the mean loss of a slice, or several that are added up, `[]` or `[S]`.
        slices: what they cover is the batch.
        module: what learns.
        optimiser: of its parameters.

    Returns:
        The mean losses of the batch, detached, in the shape that `loss` gives.
    """
    parameters = list(module.parameters())
    rows = slices[-1].stop
    losses: list[Tensor] = []
    optimiser.zero_grad()
    for part in slices:
        share = loss(part) * ((part.stop - part.start) / rows)
        for parameter, gradient in zip(parameters, torch.autograd.grad(share.sum(), parameters), strict=True):
            if parameter.grad is None:
                parameter.grad = gradient
            else:
                parameter.grad += gradient
        losses.append(share.detach())
    optimiser.step()
    return torch.stack(losses).sum(dim=0)
