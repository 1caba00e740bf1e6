"""Multi-layer perceptrons: one alone, or several of equal shape evaluated as one.

`B` batch, `S` networks of a stack.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import torch
from torch import Tensor, nn

from sldr_core.nets.fused import read_out, rectified
from sldr_core.nets.precision import fuses


class Mlp(nn.Module):
    """Map `[..., inputs]` to `[..., outputs]` through hidden layers with ReLU (paper §6.1)."""

    def __init__(self, sizes: Sequence[int], generator: torch.Generator, squash: bool = False) -> None:
        """Make the layers.

        Args:
            sizes: units from the input to the output.
            generator: source of the initial weights.
            squash: whether the output goes through tanh.
        """
        super().__init__()
        self.weights = nn.ParameterList()
        self.biases = nn.ParameterList()
        for inputs, outputs in pairwise(sizes):
            self.weights.append(nn.Parameter(_uniform((outputs, inputs), inputs, generator)))
            self.biases.append(nn.Parameter(_uniform((outputs,), inputs, generator)))
        self._squash = squash

    def forward(self, x: Tensor) -> Tensor:
        """Return `[..., outputs]`."""
        *hidden, (last_weight, last_bias) = zip(self.weights, self.biases, strict=True)
        if fuses(x.device):
            x = rectified(x, hidden)
        else:
            for weight, bias in hidden:
                x = nn.functional.linear(x, weight, bias).relu_()
        x = nn.functional.linear(x, last_weight, last_bias)
        return x.tanh() if self._squash else x


class MlpStack(nn.Module):
    """Evaluate `S` networks of equal shape on one input, in one batched product a layer.

    The last layer is computed in float32 whatever the others are: values as large as 20 lie 1/8 apart in bfloat16, and
    Eq. 8 subtracts two that are nearly equal.
    """

    def __init__(self, count: int, sizes: Sequence[int], generator: torch.Generator) -> None:
        super().__init__()
        self.count = count
        self.weights = nn.ParameterList()
        self.biases = nn.ParameterList()
        for inputs, outputs in pairwise(sizes):
            self.weights.append(nn.Parameter(_uniform((count, inputs, outputs), inputs, generator)))
            self.biases.append(nn.Parameter(_uniform((count, 1, outputs), inputs, generator)))

    def forward(self, x: Tensor) -> Tensor:
        """Return `[S, B, outputs]` of `[B, inputs]`."""
        if fuses(x.device):
            return torch.stack([self._fused(x, index) for index in range(self.count)])
        stacked = x.expand(self.count, *x.shape)
        *hidden, (last_weight, last_bias) = zip(self.weights, self.biases, strict=True)
        for weight, bias in hidden:
            stacked = torch.baddbmm(bias, stacked, weight).relu_()
        with torch.autocast(x.device.type, enabled=False):
            return torch.baddbmm(last_bias, stacked.to(last_weight.dtype), last_weight)

    def _fused(self, x: Tensor, index: int) -> Tensor:
        """Return what one network says, `[B, outputs]`."""
        layers = [(weight[index].t(), bias[index, 0]) for weight, bias in zip(self.weights, self.biases, strict=True)]
        *hidden, (last_weight, last_bias) = layers
        return read_out(rectified(x, hidden), last_weight, last_bias)


def _uniform(shape: tuple[int, ...], inputs: int, generator: torch.Generator) -> Tensor:
    """Draw as `torch.nn.Linear` does: uniform within 1 / sqrt(inputs)."""
    bound = 1.0 / math.sqrt(inputs)
    return torch.empty(shape).uniform_(-bound, bound, generator=generator)
