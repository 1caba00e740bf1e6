"""One update, to be read aloud: reward under every stream, then agent, inverse model, streams and targets.

`B` batch.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import torch
from torch import Tensor

from sldr_core.agent import DdpgAgent, InverseLearner
from sldr_core.nets.transitions import Transitions
from sldr_core.replay import Sample
from sldr_core.streams import Stream

LOWEST_REWARD, HIGHEST_REWARD = -1.0, 0.0
"""The limits of rewards for which targets are clipped; a stream that is bounded is bounded by them."""


@dataclass(frozen=True)
class Update:
    """What an update learnt from, and what it tells."""

    batch: Transitions
    rewards: Mapping[str, Tensor]
    """`[B]` by the name of the stream."""
    metrics: Mapping[str, Tensor]
    """Scalars by metric name."""


class MakeUpdate(Protocol):
    """Make one update from a sample; the tensors that are returned hold until the next one."""

    def __call__(self, sample: Sample, sync: bool) -> Update:
        """Learn from the sample, and move the targets afterwards if `sync`."""
        ...


@dataclass(frozen=True)
class Learners:
    """Everything of a training that learns from batches."""

    agent: DdpgAgent
    inverse: InverseLearner | None
    """Learnt beside the object's policy in locomotion."""
    streams: tuple[Stream, ...]

    def update(self, batch: Transitions, sync: bool) -> Update:
        """Learn from one batch on the device, and move the targets afterwards if `sync`."""
        rewards = {stream.name: stream.reward(batch) for stream in self.streams}
        metrics = _reward_metrics(rewards)
        metrics.update(self.agent.update(batch, torch.stack(list(rewards.values()))))
        if self.inverse is not None:
            metrics.update(self.inverse.update(batch))
        for stream in self.streams:
            metrics.update(stream.learn(batch))
        if sync:
            self.agent.sync_targets()
        return Update(batch, rewards, metrics)

    def states(self) -> dict[str, Any]:
        """Return the state of each, by name."""
        inverse = {} if self.inverse is None else {"inverse": self.inverse.state_dict()}
        streams = {f"stream {stream.name}": stream.state_dict() for stream in self.streams}
        return {"agent": self.agent.state_dict(), **inverse, **streams}


def update_on(learners: Learners, device: torch.device, sample: Sample, sync: bool) -> Update:
    """Make one update, operation by operation."""
    return learners.update(on_device(sample, device), sync)


def on_device(sample: Sample, device: torch.device) -> Transitions:
    """Return a sample as tensors."""
    tensors = {
        name: torch.from_numpy(getattr(sample, name)).to(device)
        for name in ("obs", "next_obs", "goal", "action", "reward")
    }
    extra = {name: torch.from_numpy(values).to(device) for name, values in sample.extra.items()}
    return Transitions(**tensors, extra=extra)


def _reward_metrics(rewards: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Return scalars by metric name, of rewards `[B]` by the name of their stream."""
    metrics: dict[str, Tensor] = {}
    for name, reward in rewards.items():
        metrics[f"stream/{name}/mean"] = reward.mean()
        metrics[f"stream/{name}/clip_low_share"] = (reward <= LOWEST_REWARD).float().mean()
        metrics[f"stream/{name}/clip_high_share"] = (reward >= HIGHEST_REWARD).float().mean()
    return metrics
