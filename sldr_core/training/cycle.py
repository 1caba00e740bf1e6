"""One cycle of training, to be read aloud: collect and store, then draw and relabel, and update."""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from threading import Event

import torch

from sldr_core.training.build import Parts
from sldr_core.training.finite import check_update
from sldr_core.training.gathering import Gathered
from sldr_core.training.rollout import Act, Check, Collected, collect_episodes, numpy_policy


@dataclass(frozen=True)
class Cycle:
    """What one cycle has done."""

    collected: Collected
    metrics: dict[str, float]


def cycle_before(parts: Parts, updates_before: int, check: Check) -> Cycle:
    """Collect and store episodes, then learn from all that is stored (paper Alg. 1)."""
    collected, gathering = collect(parts, check)
    return Cycle(collected, gathering | learn(parts, updates_before, check))


def cycle_beside(parts: Parts, updates_before: int, check: Check) -> Cycle:
    """Collect episodes with the policy as it is, and learn meanwhile from those that are stored; then store the new.

    What comes out does not depend on which of the two is faster: each has generators and networks of its own, and
    they meet at the end of the cycle.
    """
    policy = numpy_policy(parts.agent.frozen_policy())
    abandoned = Event()

    def still_wanted() -> None:
        if abandoned.is_set():
            raise _Abandoned

    with ThreadPoolExecutor(max_workers=1, thread_name_prefix="collecting") as beside:
        collecting = beside.submit(_collect, parts, parts.exploration.around(policy), still_wanted)
        try:
            learning = learn(parts, updates_before, check)
        except BaseException:
            abandoned.set()
            raise
        collected, speed = collecting.result()
    return Cycle(collected, speed | learning | store(parts, collected))


CYCLES: dict[str, Callable[[Parts, int, Check], Cycle]] = {"before": cycle_before, "beside": cycle_beside}
"""How a cycle goes, by what `loop.collecting` says."""


def collect(parts: Parts, check: Check) -> tuple[Collected, dict[str, float]]:
    """Run one exploring episode in each simulation and store it; return metrics as well."""
    policy = numpy_policy(parts.agent.act)
    collected, speed = _collect(parts, parts.exploration.around(policy), check)
    return collected, speed | store(parts, collected)


def collect_random(parts: Parts, check: Check) -> tuple[Collected, dict[str, float]]:
    """Run one episode of uniformly random actions in each simulation and store it; return metrics as well."""
    size = parts.envs.action_size
    collected, speed = _collect(parts, lambda obs, goal: parts.exploration.random((len(obs), size)), check)
    return collected, speed | store(parts, collected)


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
    started = time.monotonic()
    for update in range(updates_before + 1, updates_before + loop.updates_per_cycle + 1):
        sample = parts.sampler.sample(loop.batch_size, update - 1)
        made = parts.make_update(sample, update % loop.updates_per_sync == 0)
        check_update(made.metrics, made.batch, made.rewards, parts.learner_states)
        gathered.add(made.metrics)
        check()
    metrics = gathered.close()
    return {**metrics, "speed/updates_per_s": loop.updates_per_cycle / (time.monotonic() - started)}


def _collect(parts: Parts, act: Act, check: Check) -> tuple[Collected, dict[str, float]]:
    started = time.monotonic()
    collected = collect_episodes(parts.envs, act, check)
    steps = collected.episodes.action.shape[0] * collected.episodes.action.shape[1]
    return collected, {"speed/env_steps_per_s": steps / (time.monotonic() - started)}


def store(parts: Parts, collected: Collected) -> dict[str, float]:
    """Take episodes into the statistics and the replay buffer; return metrics.

    Raises:
        TrainingDiverged: none can be used.
    """
    episodes = collected.usable_episodes()
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
    return metrics


class _Abandoned(Exception):
    """The updates beside which episodes are collected have failed, or are not wanted any more."""
