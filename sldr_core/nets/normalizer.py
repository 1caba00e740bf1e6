"""Running mean and deviation of what was visited, applied to network inputs."""

from __future__ import annotations

from typing import NamedTuple

import torch
from torch import Tensor, nn

INPUT_CLIP = 200.0
"""Inputs are clipped to this before they are normalised."""

OUTPUT_CLIP = 5.0
"""Normalised inputs are clipped to this."""

STD_FLOOR = 0.01
"""Added to every deviation."""


class Drift(NamedTuple):
    """How far an update moved a normaliser, of the entry that moved most, in deviations."""

    shift: Tensor
    """Change of the mean, a scalar."""
    scale: Tensor
    """Change of the deviation, a scalar."""


class Normalizer(nn.Module):
    """Normalise each of `D` entries by the mean and deviation of all values it was shown."""

    count: Tensor
    mean: Tensor
    m2: Tensor
    shift: Tensor
    scale: Tensor

    def __init__(self, size: int) -> None:
        super().__init__()
        self.register_buffer("count", torch.zeros((), dtype=torch.float64))
        self.register_buffer("mean", torch.zeros(size, dtype=torch.float64))
        self.register_buffer("m2", torch.zeros(size, dtype=torch.float64))
        self.register_buffer("shift", torch.zeros(size))
        self.register_buffer("scale", torch.full((size,), 1.0 / STD_FLOOR))

    def forward(self, x: Tensor) -> Tensor:
        """Return normalised values of `[..., D]`."""
        return ((x.clamp(-INPUT_CLIP, INPUT_CLIP) - self.shift) * self.scale).clamp(-OUTPUT_CLIP, OUTPUT_CLIP)

    @torch.no_grad()
    def update(self, x: Tensor) -> Drift:
        """Take `[..., D]` into the statistics (Chan's update of Welford's sums); return how far they moved."""
        shift, scale = self.shift.clone(), self.scale.clone()
        rows = x.reshape(-1, x.shape[-1]).to(torch.float64).clamp(-INPUT_CLIP, INPUT_CLIP)
        count, mean = rows.shape[0], rows.mean(dim=0)
        total = self.count + count
        delta = mean - self.mean
        self.m2 += (rows - mean).square().sum(dim=0) + delta.square() * (self.count * count / total)
        self.mean += delta * (count / total)
        self.count.fill_(total)
        self.shift.copy_(self.mean)
        self.scale.copy_(1.0 / ((self.m2 / total).sqrt() + STD_FLOOR))
        return Drift(((self.shift - shift) * self.scale).abs().max(), (self.scale / scale - 1.0).abs().max())
