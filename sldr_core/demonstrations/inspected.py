"""A locomotion model that is looked at: what it acts in, and whose starts and goals it can be given."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sldr_core.config import TASKS, TaskSpec
from sldr_core.demonstrations.landscape import wanted_action
from sldr_core.demonstrations.placing import Placing, joint_pose
from sldr_core.demonstrations.starts import StackStarts, StartSource, TaskStarts
from sldr_core.envs import Envs, make_envs
from sldr_core.errors import UnknownName
from sldr_core.nets.locomotion_model import LocomotionModel, load_locomotion_model
from sldr_core.records import Floats


@dataclass(frozen=True)
class Inspected:
    """Say what can be done with a locomotion model."""

    model: LocomotionModel

    @property
    def task(self) -> TaskSpec:
        """The task in which the object learnt."""
        return self.model.config.task_spec

    @property
    def start_tasks(self) -> tuple[str, ...]:
        """The tasks whose starts and goals it can be given: its own, and stacks of such objects."""
        stacks = [
            task.name for task in TASKS.values() if task.family == "stack" and self.task.name in task.locomotion_tasks
        ]
        return (self.task.name, *stacks)

    def act(self, state: Floats, goal: Floats) -> Floats:
        """Return u = nu(z, g) `[N, A]` of object states `[N, Z]` and goals `[N, G]`."""
        return wanted_action(self.model.nets, state, goal)

    def make_envs(self, num_envs: int) -> Envs:
        """Build simulations of the object as it learnt, on one thread."""
        config = self.model.config
        return make_envs(
            config.task,
            "locomotion",
            num_envs,
            robot=config.scene.locomotion_robot,
            testing=True,
            variant=config.scene.variant,
        )

    def starts(self, task: str, envs: Envs) -> StartSource:
        """Return where starts and goals come from.

        Args:
            task: one of `start_tasks`.
            envs: simulations of the object, as many as starts are drawn at once.

        Raises:
            UnknownName: it is none of them.
        """
        if task not in self.start_tasks:
            raise UnknownName("task with these objects", task, self.start_tasks)
        if task == self.task.name:
            return TaskStarts(self.task, envs)
        stacks = make_envs(task, testing=True, variant=self.model.config.scene.variant)
        return StackStarts(stacks.spec, envs, stacks)

    def placing(self, envs: Envs) -> Placing:
        """Return how object and goal can be put elsewhere."""
        drawn = envs.draw_starts([np.random.default_rng(0)])
        return Placing(self.task, envs.model, drawn.qpos[0, joint_pose(envs.model, 0)][:3].copy())


def load_inspected(path: Path) -> Inspected:
    """Read a locomotion model to look at.

    Raises:
        BadFile: it is missing, corrupt or something else.
    """
    return Inspected(load_locomotion_model(path))
