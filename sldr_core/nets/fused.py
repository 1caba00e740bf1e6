"""Layers in bfloat16 on a processor with instructions for it, with their way back written out.

There a product takes so little time that what torch does around it weighs as much: the bias is copied into place, what
comes out is read and written again to be rectified, and all that the last layer needs in float32 passes through memory.
Here oneDNN adds the bias and rectifies while it multiplies, and float32 comes in pieces that stay in the cache.

`B` batch, `H` units of the last hidden layer.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import Any

import torch
from torch import Tensor

PIECE_ROWS = 1024
"""Transitions that are converted to float32 at a time."""


def rectified(x: Tensor, layers: Sequence[tuple[Tensor, Tensor]]) -> Tensor:
    """Return `[..., H]` in bfloat16 of `[..., inputs]`, through hidden layers that each rectify.

    Args:
        x: in any precision.
        layers: weight `[outputs, inputs]` and bias `[outputs]` of each.
    """
    hidden: Tensor = _Rectified.apply(x.reshape(-1, x.shape[-1]), *chain.from_iterable(layers))
    return hidden.reshape(*x.shape[:-1], -1)


def read_out(hidden: Tensor, weight: Tensor, bias: Tensor) -> Tensor:
    """Return a value `[B, 1]` in float32 of `[B, H]` in bfloat16, by a layer that is not rounded.

    Args:
        hidden: what `rectified` returns.
        weight: `[1, H]`.
        bias: `[1]`.
    """
    return _ReadOut.apply(hidden, weight, bias)


class _Rectified(torch.autograd.Function):
    """Hidden layers as one operation, of `x` and then the weight and bias of each."""

    @staticmethod
    def forward(ctx: Any, x: Tensor, *parameters: Tensor) -> Tensor:
        rounded = [parameter.bfloat16() for parameter in parameters]
        weights, biases = rounded[::2], rounded[1::2]
        seen = [x.bfloat16()]
        for weight, bias in zip(weights, biases, strict=True):
            seen.append(_linear_and_rectify(seen[-1], weight, bias))
        ctx.save_for_backward(*seen, *weights)
        return seen[-1]

    @staticmethod
    def backward(ctx: Any, *grads: Tensor) -> tuple[Tensor | None, ...]:
        layers = len(ctx.saved_tensors) // 2
        seen, weights = ctx.saved_tensors[: layers + 1], ctx.saved_tensors[layers + 1 :]
        wants_x, learns = ctx.needs_input_grad[:2]
        grad = torch.ops.aten.threshold_backward(*grads, seen[layers], 0)
        found: list[Tensor | None] = []
        for layer in reversed(range(layers)):
            found += [grad.sum(dim=0).float(), (grad.t() @ seen[layer]).float()] if learns else [None, None]
            if layer > 0:
                grad = grad @ weights[layer]
                torch.ops.aten.threshold_backward(grad, seen[layer], 0, grad_input=grad)
        return ((grad @ weights[0]).float() if wants_x else None, *reversed(found))


class _ReadOut(torch.autograd.Function):
    """The last layer as one operation, of what is hidden, its weight and its bias."""

    @staticmethod
    def forward(ctx: Any, hidden: Tensor, weight: Tensor, bias: Tensor) -> Tensor:
        ctx.save_for_backward(hidden, weight)
        with _no_rounding():
            return torch.cat([torch.addmm(bias, piece.float(), weight.t()) for piece in hidden.split(PIECE_ROWS)])

    @staticmethod
    def backward(ctx: Any, *grads: Tensor) -> tuple[Tensor | None, ...]:
        hidden, weight = ctx.saved_tensors
        (grad,) = grads
        of_hidden = grad.bfloat16() * weight.bfloat16()
        if not ctx.needs_input_grad[1]:
            return of_hidden, None, None
        of_weight = torch.zeros_like(weight)
        with _no_rounding():
            for of_values, piece in zip(grad.split(PIECE_ROWS), hidden.split(PIECE_ROWS), strict=True):
                of_weight.addmm_(of_values.t(), piece.float())
        return of_hidden, of_weight, grad.sum(dim=0)


def _linear_and_rectify(x: Tensor, weight: Tensor, bias: Tensor) -> Tensor:
    """Return the rectified `x weight^T + bias`, rounded once. torch calls this when it compiles a network."""
    return torch.ops.mkldnn._linear_pointwise(x, weight, bias, "relu", [], "")


def _no_rounding() -> torch.autocast:
    """Leave numbers in the precision that they have."""
    return torch.autocast("cpu", enabled=False)
