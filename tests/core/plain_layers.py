"""What fused layers are compared with: the same, one operation of torch after the other."""

from __future__ import annotations

from collections.abc import Sequence

import torch
from torch import Tensor


def linear_and_rectify(x: Tensor, weight: Tensor, bias: Tensor) -> Tensor:
    """Return what oneDNN does at once, on any processor."""
    return torch.nn.functional.linear(x, weight, bias).relu_()


def through_layers(x: Tensor, layers: Sequence[tuple[Tensor, Tensor]]) -> Tensor:
    """Return `[..., H]` in bfloat16 of `[..., inputs]`, by what torch rounds where."""
    hidden = x.bfloat16()
    for weight, bias in layers:
        hidden = torch.nn.functional.linear(hidden, weight.bfloat16(), bias.bfloat16()).relu()
    return hidden
