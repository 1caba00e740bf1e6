"""What a training will take, from its config alone: control steps, updates, and the disk space of its memory."""

from __future__ import annotations

import math

from sldr_core.config import TrainConfig, find_task

CHECKPOINT_CYCLES = 10
"""A checkpoint is written at least once in so many cycles."""

CHECKPOINTS_KEPT = 2
"""The newest, and the one before for when it is damaged: the replay file serves both."""

FLOAT_BYTES = 4
"""Every number of the replay file is a float32 [bytes]."""


def control_steps(config: TrainConfig) -> int:
    """Return how many control steps a training simulates if nothing ends it early, tests included."""
    loop = config.loop
    test_rounds = loop.epochs * math.ceil(loop.test_episodes / loop.episodes_per_cycle)
    rounds = loop.warmup_cycles + config.total_cycles + test_rounds
    return rounds * loop.episodes_per_cycle * config.task_spec.episode_length


def gradient_updates(config: TrainConfig) -> int:
    """Return how many updates a training makes if nothing ends it early."""
    return config.total_cycles * config.loop.updates_per_cycle


def replay_episodes(config: TrainConfig) -> tuple[int, int]:
    """Return how many episodes the replay file remembers, and how many more it has room for.

    Episodes stored after a checkpoint go to that further room, so that they cannot overwrite what it needs.
    """
    loop = config.loop
    capacity = config.replay.capacity // config.task_spec.episode_length
    slack = (CHECKPOINTS_KEPT * CHECKPOINT_CYCLES + loop.warmup_cycles + 1) * loop.episodes_per_cycle
    return capacity, slack


def replay_file_size(config: TrainConfig) -> int:
    """Return the size of the replay file, by far the largest of a training [bytes]."""
    return FLOAT_BYTES * sum(replay_episodes(config)) * _numbers_of_an_episode(config)


def _numbers_of_an_episode(config: TrainConfig) -> int:
    task, steps, moved = config.task_spec, config.task_spec.episode_length, 1
    if config.phase == "locomotion":
        obs_size, action_size = task.object_state_size, task.object_action_size
    else:
        obs_size, action_size = task.obs_size, task.robot_action_size
    seen = (steps + 1) * (obs_size + task.goal_size)
    return seen + task.goal_size + steps * (action_size + _induced_sizes(config)) + moved


def _induced_sizes(config: TrainConfig) -> int:
    """Return the numbers that every step keeps of what the robot made the objects do."""
    if not config.needs_locomotion:
        return 0
    models = [part.locomotion_task for part in config.task_spec.parts]
    return sum(find_task(task, config.scene.variant).object_action_size for task in models)
