"""The composition root: the one place that knows every part and puts a training together from its config."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch

from sldr_core.agent import DdpgAgent, InverseLearner
from sldr_core.config import TrainConfig
from sldr_core.envs import Envs, make_envs
from sldr_core.errors import BadFile, LocomotionMissing
from sldr_core.nets.locomotion_model import LocomotionModel, load_locomotion_model
from sldr_core.nets.views import part_view, view_of
from sldr_core.presets import locomotion_tasks
from sldr_core.replay import HindsightSampler, ReplayBuffer
from sldr_core.streams import SldrStream, Stream, TaskStream
from sldr_core.training.compute import Compute, resolve_compute
from sldr_core.training.rollout import Exploration

REPLAY_FILE = "replay.bin"

CHECKPOINT_CYCLES = 10
"""A checkpoint is written at least once in so many cycles."""

TEST_SEED_OFFSET = 2**31
"""Test episodes draw from generators that no training episode uses."""


@dataclass(frozen=True)
class Parts:
    """Everything one training is made of."""

    config: TrainConfig
    compute: Compute
    envs: Envs
    test_envs: Envs
    buffer: ReplayBuffer
    sampler: HindsightSampler
    exploration: Exploration
    agent: DdpgAgent
    inverse: InverseLearner | None
    """Learnt beside the object's policy in locomotion."""
    streams: tuple[Stream, ...]


def build_training(
    config: TrainConfig, directory: Path, locomotion_models: Sequence[Path], gate_waived: bool = False
) -> Parts:
    """Put a training together.

    Args:
        config: what to train.
        directory: the run's directory, for the replay file.
        locomotion_models: one file for each task of `locomotion_tasks(config)`, in any order.
        gate_waived: whether models below the gate are taken as well.

    Raises:
        LocomotionMissing: the method needs a locomotion model that is not given, or is below its gate.
        BadFile: a locomotion model cannot be used.
        DiskTooFull: the replay file would not fit.
        InvalidConfig: the device does not exist.
    """
    models = _load_models(config, locomotion_models, gate=0.0 if gate_waived else config.sldr.gate)
    compute = resolve_compute(config.compute)
    task, loop = config.task_spec, config.loop
    sampling_seed, exploration_seed, weight_seed = np.random.SeedSequence(config.seed).spawn(3)
    weights = torch.Generator().manual_seed(int(weight_seed.generate_state(1)[0]))
    streams = _build_streams(config, compute, models)
    envs = _build_envs(config, compute, config.seed, testing=False)
    test_envs = _build_envs(config, compute, config.seed + TEST_SEED_OFFSET, testing=True)
    agent = DdpgAgent(
        view_of(task, config.phase),
        envs.action_size,
        [stream.name for stream in streams],
        [stream.weight for stream in streams],
        config.agent,
        weights,
        compute.device,
        compute.autocast,
    )
    locomotion = config.phase == "locomotion"
    inverse = InverseLearner(envs.obs_size, envs.action_size, config.agent, weights, compute.device, compute.autocast)
    buffer = ReplayBuffer(
        directory / REPLAY_FILE,
        _episode_shapes(envs, streams),
        capacity=config.replay.capacity // task.episode_length,
        slack=(CHECKPOINT_CYCLES + loop.warmup_cycles + 1) * loop.episodes_per_cycle,
    )
    rng = np.random.default_rng(sampling_seed)
    return Parts(
        config=config,
        compute=compute,
        envs=envs,
        test_envs=test_envs,
        buffer=buffer,
        sampler=HindsightSampler(
            buffer, envs.reward, config.replay.relabel_probability, config.replay.still_weight, rng
        ),
        exploration=Exploration(config.exploration, np.random.default_rng(exploration_seed)),
        agent=agent,
        inverse=inverse if locomotion else None,
        streams=streams,
    )


def _load_models(config: TrainConfig, paths: Sequence[Path], gate: float) -> dict[str, LocomotionModel]:
    """Read the locomotion models that the method needs, by the task each was trained in."""
    models: dict[str, LocomotionModel] = {}
    needed = locomotion_tasks(config)
    for path in paths if needed else ():
        model = load_locomotion_model(path)
        task = model.config.task
        if task not in needed:
            raise BadFile(f"{path} is a locomotion model of {task}; {config.task} needs {_of_tasks(needed)}.")
        if task in models:
            raise BadFile(f"{path} is a second locomotion model of {task}; give one of each task.")
        if model.measured.success_rate < gate:
            raise LocomotionMissing(
                f"{path} reached {model.measured.success_rate:.1%} test success, below the gate of "
                f"{gate:.1%}; train its object longer, or lower sldr.gate."
            )
        models[task] = model
    missing = [task for task in needed if task not in models]
    if missing:
        raise LocomotionMissing(
            f"Method '{config.method}' needs {_of_tasks(missing)}: train with "
            f"`sldr train --task {missing[0]} --phase locomotion --method her`, then give its locomotion.pt."
        )
    return models


def _of_tasks(tasks: Sequence[str]) -> str:
    return "a locomotion model of " + " and one of ".join(tasks)


def _build_streams(config: TrainConfig, compute: Compute, models: Mapping[str, LocomotionModel]) -> tuple[Stream, ...]:
    """Return the task's own stream and, where the method has locomotion models, one for each part of the task."""
    task = config.task_spec
    auxiliary = [
        SldrStream(
            part.name,
            config.sldr.weight,
            models[part.locomotion_task],
            part_view(task, part),
            compute.device,
            compute.autocast,
        )
        for part in task.parts
        if part.locomotion_task in models
    ]
    return (TaskStream(), *auxiliary)


def _build_envs(config: TrainConfig, compute: Compute, seed: int, testing: bool) -> Envs:
    return make_envs(
        config.task,
        config.phase,
        num_envs=config.loop.episodes_per_cycle,
        seed=seed,
        threads=compute.threads,
        robot=config.scene.locomotion_robot,
        testing=testing,
        variant=config.scene.variant,
    )


def _episode_shapes(envs: Envs, streams: Sequence[Stream]) -> dict[str, tuple[int, ...]]:
    length = envs.episode_length
    shapes: dict[str, tuple[int, ...]] = {
        "obs": (length + 1, envs.obs_size),
        "achieved": (length + 1, envs.goal_size),
        "goal": (envs.goal_size,),
        "action": (length, envs.action_size),
    }
    for stream in streams:
        shapes.update({name: (length, size) for name, size in stream.stored_sizes.items()})
    return shapes
