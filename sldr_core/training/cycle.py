"""One cycle of training, to be read aloud: collect, store, draw and relabel, reward, update, sync."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import torch
from torch import Tensor

from sldr_core.errors import TrainingDiverged
from sldr_core.nets.transitions import Transitions
from sldr_core.replay import Sample
from sldr_core.training.build import Parts
from sldr_core.training.rollout import Act, Check, Collected, collect_episodes, numpy_policy


def collect(parts: Parts, check: Check) -> Collected:
    """Run one exploring episode in each simulation and store it."""
    policy = numpy_policy(parts.agent.act)
    return _collect_and_store(parts, parts.exploration.around(policy), check)


def collect_random(parts: Parts, check: Check) -> Collected:
    """Run one episode of uniformly random actions in each simulation and store it."""
    size = parts.envs.action_size
    return _collect_and_store(parts, lambda obs, goal: parts.exploration.random((len(obs), size)), check)


def learn(parts: Parts, updates_before: int, check: Check) -> dict[str, float]:
    """Do one cycle's updates; return their mean metrics.

    Args:
        parts: the training.
        updates_before: updates of all earlier cycles, for the rhythm of target syncs.
        check: called between updates.

    Raises:
        TrainingDiverged: a metric stopped being finite.
    """
    loop = parts.config.loop
    totals: dict[str, Tensor] = {}
    for update in range(updates_before + 1, updates_before + loop.updates_per_cycle + 1):
        batch = _on_device(parts.sampler.sample(loop.batch_size, update - 1), parts.compute.device)
        rewards = torch.stack([stream.reward(batch) for stream in parts.streams])
        metrics = parts.agent.update(batch, rewards)
        if parts.inverse is not None:
            metrics.update(parts.inverse.update(batch))
        for stream in parts.streams:
            metrics.update(stream.learn(batch))
        if update % loop.updates_per_sync == 0:
            parts.agent.sync_targets()
        for name, value in metrics.items():
            totals[name] = totals[name] + value if name in totals else value
        check()
    return _finite({name: float(total) / loop.updates_per_cycle for name, total in totals.items()})


def _collect_and_store(parts: Parts, act: Act, check: Check) -> Collected:
    collected = collect_episodes(parts.envs, act, check)
    episodes = collected.episodes
    obs = torch.from_numpy(episodes.obs)
    goal = torch.from_numpy(episodes.goal)[:, None].expand(*episodes.achieved.shape)
    parts.agent.observe(obs, goal)
    if parts.inverse is not None:
        parts.inverse.observe(obs[:, :-1], obs[:, 1:])
    for stream in parts.streams:
        stream.observe(obs, goal)
    extra = {name: values for stream in parts.streams for name, values in stream.annotate(episodes.obs).items()}
    parts.buffer.store(replace(episodes, extra=extra))
    return collected


def _on_device(sample: Sample, device: torch.device) -> Transitions:
    tensors = {
        name: torch.from_numpy(getattr(sample, name)).to(device)
        for name in ("obs", "next_obs", "goal", "action", "reward")
    }
    extra = {name: torch.from_numpy(values).to(device) for name, values in sample.extra.items()}
    return Transitions(**tensors, extra=extra)


def _finite(metrics: Mapping[str, float]) -> dict[str, float]:
    # Rewards first: a loss only carries on what was wrong with them.
    for name, value in sorted(metrics.items(), key=lambda item: not item[0].startswith("stream/")):
        if not math.isfinite(value):
            raise TrainingDiverged(
                f"{name} became {value}: training was stopped; lower agent.learning_rate or check the task's numbers."
            )
    return dict(metrics)
