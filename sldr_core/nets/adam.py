"""Adam without PyTorch's compiler, whose import takes longer than everything else before the first update.

`torch.optim` keeps the compiler away from these methods, and loads it for that. Nothing is compiled here, so what lies
beneath is called.
"""

from __future__ import annotations

from collections.abc import Iterable
from inspect import unwrap
from typing import Any

import torch


class Adam(torch.optim.Adam):
    """The same updates to the last bit, ready some seconds sooner; on a GPU they can be captured in a graph."""

    def __init__(self, parameters: Iterable[torch.nn.Parameter], lr: float, fused: bool = False) -> None:
        super().__init__(parameters, lr=lr, fused=fused)
        self._allow_capture()

    step = torch.no_grad()(unwrap(torch.optim.Adam.step))
    zero_grad = unwrap(torch.optim.Adam.zero_grad)
    state_dict = unwrap(torch.optim.Adam.state_dict)
    add_param_group = unwrap(torch.optim.Adam.add_param_group)

    def load_state_dict(self, state_dict: dict[str, Any]) -> None:
        """Go on from what `state_dict` returned, on whatever device that was."""
        unwrap(torch.optim.Adam.load_state_dict)(self, state_dict)
        self._allow_capture()

    def _allow_capture(self) -> None:
        for group in self.param_groups:
            group["capturable"] = group["params"][0].is_cuda
