"""One cycle of training, to be read aloud: collect, store, draw and relabel, reward, update, sync."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import torch
from torch import Tensor

from sldr_core.nets.transitions import Transitions
from sldr_core.replay import Sample
from sldr_core.training.build import Parts
from sldr_core.training.finite import check_update
from sldr_core.training.gathering import Gathered
from sldr_core.training.rollout import Act, Check, Collected, collect_episodes, numpy_policy

LOWEST_REWARD, HIGHEST_REWARD = -1.0, 0.0
"""The limits of rewards for which targets are clipped; a stream that is bounded is bounded by them."""


def collect(parts: Parts, check: Check) -> tuple[Collected, dict[str, float]]:
    """Run one exploring episode in each simulation and store it; return metrics as well."""
    policy = numpy_policy(parts.agent.act)
    return _collect_and_store(parts, parts.exploration.around(policy), check)


def collect_random(parts: Parts, check: Check) -> tuple[Collected, dict[str, float]]:
    """Run one episode of uniformly random actions in each simulation and store it; return metrics as well."""
    size = parts.envs.action_size
    return _collect_and_store(parts, lambda obs, goal: parts.exploration.random((len(obs), size)), check)


def learn(parts: Parts, updates_before: int, check: Check) -> dict[str, float]:
    """Do one cycle's updates; return their metrics, gathered.

    Args:
        parts: the training.
        updates_before: updates of all earlier cycles, for the rhythm of target syncs.
        check: called between updates.

    Raises:
        NonFinite: a number of an update is not finite.
    """
    loop = parts.config.loop
    gathered = Gathered()
    for update in range(updates_before + 1, updates_before + loop.updates_per_cycle + 1):
        batch = on_device(parts.sampler.sample(loop.batch_size, update - 1), parts.compute.device)
        rewards = {stream.name: stream.reward(batch) for stream in parts.streams}
        metrics = _reward_metrics(rewards)
        metrics.update(parts.agent.update(batch, torch.stack(list(rewards.values()))))
        if parts.inverse is not None:
            metrics.update(parts.inverse.update(batch))
        for stream in parts.streams:
            metrics.update(stream.learn(batch))
        if update % loop.updates_per_sync == 0:
            parts.agent.sync_targets()
        check_update(metrics, batch, rewards, parts.learner_states)
        gathered.add(metrics)
        check()
    return gathered.close()


def _collect_and_store(parts: Parts, act: Act, check: Check) -> tuple[Collected, dict[str, float]]:
    collected = collect_episodes(parts.envs, act, check)
    episodes = collected.episodes
    obs, action = torch.from_numpy(episodes.obs), torch.from_numpy(episodes.action)
    goal = torch.from_numpy(episodes.goal)[:, None].expand(*episodes.achieved.shape)
    drift = parts.agent.observe(obs, goal)
    metrics = {"normalizer/shift_drift": float(drift.shift), "normalizer/scale_drift": float(drift.scale)}
    if parts.inverse is not None:
        metrics["inverse/fresh_error"] = float(parts.inverse.error(obs[:, :-1], obs[:, 1:], action))
        parts.inverse.observe(obs[:, :-1], obs[:, 1:])
    for stream in parts.streams:
        stream.observe(obs, goal)
    extra = {name: values for stream in parts.streams for name, values in stream.annotate(episodes.obs).items()}
    parts.buffer.store(replace(episodes, extra=extra))
    return collected, metrics


def _reward_metrics(rewards: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Return scalars by metric name, of rewards `[B]` by the name of their stream."""
    metrics: dict[str, Tensor] = {}
    for name, reward in rewards.items():
        metrics[f"stream/{name}/mean"] = reward.mean()
        metrics[f"stream/{name}/clip_low_share"] = (reward <= LOWEST_REWARD).float().mean()
        metrics[f"stream/{name}/clip_high_share"] = (reward >= HIGHEST_REWARD).float().mean()
    return metrics


def on_device(sample: Sample, device: torch.device) -> Transitions:
    """Return a sample as tensors."""
    tensors = {
        name: torch.from_numpy(getattr(sample, name)).to(device)
        for name in ("obs", "next_obs", "goal", "action", "reward")
    }
    extra = {name: torch.from_numpy(values).to(device) for name, values in sample.extra.items()}
    return Transitions(**tensors, extra=extra)
