"""The precision that a learner computes in: float32, or bfloat16 on any processor at a bearable speed.

With instructions for bfloat16, layers are fused (`sldr_core.nets.fused`).
Without instructions for bfloat16 torch multiplies such matrices one number at a time, an update of the paper's size
taking twenty to forty times as long as in float32. There the products are made in float32 of the rounded numbers, and
rounded: that is what the instructions do, up to the order in which numbers are added. So a config from a machine that
has them can be run again on one that has not.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from functools import cache
from typing import Any

import torch
from torch import Tensor
from torch.utils._python_dispatch import TorchDispatchMode

_PRODUCTS = frozenset(
    {
        torch.ops.aten.mm.default,
        torch.ops.aten.addmm.default,
        torch.ops.aten.bmm.default,
        torch.ops.aten.baddbmm.default,
    }
)
"""What linear layers and stacks of them come down to, on the way there and on the way back."""


@contextmanager
def learner_precision(device: torch.device, bfloat16: bool) -> Iterator[None]:
    """Compute networks in bfloat16, if asked for, wherever `device` is; weights stay in float32.

    Take gradients within the context too: what the way back multiplies is found there alone.
    """
    slow = bfloat16 and device.type == "cpu" and not _has_instructions()
    with (
        torch.autocast(device.type, dtype=torch.bfloat16, enabled=bfloat16),
        ProductsInFloat32() if slow else nullcontext(),
    ):
        yield


def fuses(device: torch.device) -> bool:
    """Return whether networks on `device` are being computed in bfloat16 by a processor with instructions for it."""
    return device.type == "cpu" and torch.is_autocast_enabled("cpu") and _has_instructions()


class ProductsInFloat32(TorchDispatchMode):
    """Make products of bfloat16 matrices in float32, and round what comes out to bfloat16."""

    def __torch_dispatch__(
        self, func: Any, types: Any, args: tuple[Any, ...] = (), kwargs: dict[str, Any] | None = None
    ) -> Any:
        """Run one operation."""
        named = kwargs or {}
        if func not in _PRODUCTS or args[0].dtype is not torch.bfloat16:
            return func(*args, **named)
        return func(*(arg.float() if isinstance(arg, Tensor) else arg for arg in args), **named).bfloat16()


@cache
def _has_instructions() -> bool:
    """Return whether torch has fast products of bfloat16 for this processor.

    torch asks itself so before it hands such a product to oneDNN, and tells nobody in its public names.
    """
    return torch.ops.mkldnn._is_mkldnn_bf16_supported()
