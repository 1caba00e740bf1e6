"""Every task as a gymnasium environment, by name: `gymnasium.make("sldr/FetchStack2-v0")` after `register_envs()`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import gymnasium

from sldr_core.config import TASKS, Phase, TaskSpec, find_task

ENTRY_POINT = "sldr_core.envs.single:SingleEnv"


@dataclass(frozen=True)
class Registered:
    """Name one environment and say what it is."""

    id: str
    """Its id, as `gymnasium.make` takes it."""
    task: str
    """The task that is simulated."""
    phase: Phase
    """Who acts."""


def registered_envs() -> Iterator[Registered]:
    """List every task, and every task's locomotion: one environment for each task that its parts learn in."""
    for spec in TASKS.values():
        yield Registered(f"sldr/{spec.name}-v0", spec.name, "manipulation")
        if len(spec.locomotion_tasks) == 1:
            yield Registered(f"sldr/{spec.name}-Locomotion-v0", spec.locomotion_tasks[0], "locomotion")
        else:
            yield from _by_part(spec)


def register_envs() -> None:
    """Make the environments known to gymnasium; those that are known already stay as they are."""
    for env in registered_envs():
        if env.id not in gymnasium.registry:
            gymnasium.register(
                env.id,
                entry_point=ENTRY_POINT,
                max_episode_steps=find_task(env.task).episode_length,
                kwargs={"task": env.task, "phase": env.phase},
            )


def _by_part(spec: TaskSpec) -> Iterator[Registered]:
    for part in spec.parts:
        yield Registered(f"sldr/{spec.name}-Locomotion-{part.name.title()}-v0", part.locomotion_task, "locomotion")
