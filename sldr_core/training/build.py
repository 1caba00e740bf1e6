"""The composition root: the one place that knows every part and puts a training together from its config."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import torch

from sldr_core.agent import DdpgAgent, InverseLearner
from sldr_core.config import Auxiliary, SamplerName, TrainConfig, find_task
from sldr_core.disk import check_room
from sldr_core.envs import Envs, TouchSense, make_envs
from sldr_core.episodes import episode_bytes
from sldr_core.errors import BadFile, LocomotionMissing
from sldr_core.nets.locomotion_model import LocomotionModel, load_locomotion_model
from sldr_core.nets.views import view_of
from sldr_core.presets import locomotion_tasks
from sldr_core.presets.budget import replay_episodes
from sldr_core.replay import ReplayBuffer, Sampler, SamplerOrder, build_curriculum, build_hindsight, replay_bytes
from sldr_core.streams import Stream, StreamOrder, TaskStream, build_rnd, build_sldr
from sldr_core.training.compute import Compute, resolve_compute
from sldr_core.training.files import REPLAY_FILE, planned_sizes
from sldr_core.training.graphs import GraphedUpdates
from sldr_core.training.rollout import Exploration
from sldr_core.training.updates import Learners, MakeUpdate, update_on

AUXILIARY: dict[Auxiliary, Callable[[StreamOrder], Sequence[Stream]]] = {"sldr": build_sldr, "rnd": build_rnd}
"""How the streams that a method names are put together."""

SAMPLERS: dict[SamplerName, Callable[[SamplerOrder], Sampler]] = {
    "hindsight": build_hindsight,
    "curriculum": build_curriculum,
}
"""How the sampler that a method names is put together."""

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
    sampler: Sampler
    exploration: Exploration
    learners: Learners
    make_update: MakeUpdate
    """Make one update of everything that learns."""

    @property
    def agent(self) -> DdpgAgent:
        """Who acts and learns."""
        return self.learners.agent

    @property
    def inverse(self) -> InverseLearner | None:
        """What is learnt beside the object's policy in locomotion."""
        return self.learners.inverse

    @property
    def streams(self) -> tuple[Stream, ...]:
        """The reward streams; the task's comes first."""
        return self.learners.streams

    def learner_states(self) -> dict[str, Any]:
        """Return the states of everything that learns, by name."""
        return self.learners.states()


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
        DiskTooFull: the run's files would not fit.
        InvalidConfig: the device does not exist.
    """
    models = _load_models(config, locomotion_models, gate=0.0 if gate_waived else config.sldr.gate)
    compute = resolve_compute(config.compute, beside=config.loop.collecting == "beside")
    task = config.task_spec
    sampling_seed, exploration_seed, weight_seed, stream_seed = np.random.SeedSequence(config.seed).spawn(4)
    weights = _weight_generator(weight_seed)
    streams = _build_streams(config, compute, models, _weight_generator(stream_seed))
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
    inverse = _build_inverse(config, compute, envs, weights) if config.phase == "locomotion" else None
    learners = Learners(agent, inverse, streams)
    buffer = _make_buffer(config, directory, envs, streams, list(learners.states().values()))
    rng = np.random.default_rng(sampling_seed)
    return Parts(
        config=config,
        compute=compute,
        envs=envs,
        test_envs=test_envs,
        buffer=buffer,
        sampler=SAMPLERS[config.method_spec.sampler](
            SamplerOrder(config, buffer, envs.reward, envs.gaps, envs.success, rng)
        ),
        exploration=Exploration(config.exploration, np.random.default_rng(exploration_seed)),
        learners=learners,
        make_update=_update_maker(learners, compute.device),
    )


def _update_maker(learners: Learners, device: torch.device) -> MakeUpdate:
    return GraphedUpdates(learners, device) if device.type == "cuda" else partial(update_on, learners, device)


def _make_buffer(
    config: TrainConfig,
    directory: Path,
    envs: Envs,
    streams: Sequence[Stream],
    learners: Sequence[Mapping[str, Any]],
) -> ReplayBuffer:
    """Make the replay file, once it is known that it and every other file of the run fits."""
    shapes = _episode_shapes(envs, streams)
    capacity, slack = replay_episodes(config)
    planned = planned_sizes(
        config, replay_bytes(shapes, capacity + slack), recorded_bytes(envs, streams), envs.state(), learners
    )
    check_room(directory, planned)
    return ReplayBuffer(directory / REPLAY_FILE, shapes, capacity, slack)


def recorded_bytes(envs: Envs, streams: Sequence[Stream]) -> int:
    """Return what one recorded episode takes before it is packed [bytes]."""
    actions = [size for stream in streams for size in stream.stored_sizes.values()]
    return episode_bytes(
        {
            "T": envs.episode_length,
            "K": envs.simulation.snapshot().shape[1],
            "nq": envs.qpos.shape[1],
            "nv": envs.qvel.shape[1],
            "D": envs.obs_size,
            "G": envs.goal_size,
            "A": envs.action_size,
            "S": len(streams),
            "P": len(actions),
            "U": max(actions, default=0),
            "O": len(TouchSense(envs.model).objects),
        }
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
        if model.config.task_spec != find_task(task, config.scene.variant):
            raise BadFile(
                f"{path} is a locomotion model of {task} in variant '{model.config.scene.variant}', whose numbers "
                f"differ from those of variant '{config.scene.variant}'; train its object there, or set scene.variant."
            )
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


def _weight_generator(seed: np.random.SeedSequence) -> torch.Generator:
    return torch.Generator().manual_seed(int(seed.generate_state(1)[0]))


def _build_streams(
    config: TrainConfig, compute: Compute, models: Mapping[str, LocomotionModel], generator: torch.Generator
) -> tuple[Stream, ...]:
    """Return the task's own stream and those that the method brings."""
    order = StreamOrder(config, models, generator, compute.device, compute.autocast)
    brought = [stream for name in config.method_spec.auxiliary for stream in AUXILIARY[name](order)]
    return (TaskStream(), *brought)


def _build_inverse(config: TrainConfig, compute: Compute, envs: Envs, weights: torch.Generator) -> InverseLearner:
    return InverseLearner(envs.obs_size, envs.action_size, config.agent, weights, compute.device, compute.autocast)


def _build_envs(config: TrainConfig, compute: Compute, seed: int, testing: bool) -> Envs:
    return make_envs(
        config.task,
        config.phase,
        num_envs=config.loop.episodes_per_cycle,
        seed=seed,
        threads=compute.threads if testing else compute.collecting_threads,
        robot=config.scene.locomotion_robot,
        testing=testing,
        variant=config.scene.variant,
        reward=config.method_spec.reward,
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
