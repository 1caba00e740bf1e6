"""The ways that objects would have taken by themselves, beside recorded episodes of the robot.

`T` steps.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray

from sldr_core.config import config_from_dict
from sldr_core.episodes import Origin, RecordedEpisode
from sldr_core.nets.locomotion_model import load_locomotion_model
from worker.viewer.demonstration import PartDemonstration
from worker.viewer.simulated import Moment

_OBJECT = "object"


class Demonstrations:
    """Let every part of a task demonstrate from the starts of recorded episodes."""

    def __init__(self, origin: Origin, robot_scene: mujoco.MjModel, locomotion_models: Sequence[Path]) -> None:
        """Build the parts' scenes; none without the models of all parts.

        Raises:
            BadFile: a model cannot be read.
        """
        config = config_from_dict(dict(origin.config))
        models = {model.config.task: model for model in map(load_locomotion_model, locomotion_models)}
        task = config.task_spec
        is_known = config.phase == "manipulation" and all(part.locomotion_task in models for part in task.parts)
        self._parts = [
            PartDemonstration(task, part, models[part.locomotion_task], robot_scene)
            for part in (task.parts if is_known else ())
        ]

    def ways(self, episode: RecordedEpisode) -> Mapping[str, NDArray[np.float64]]:
        """Return each part's way from an episode's start, for as long as the episode, `[T+1, 3]` [m]."""
        start = Moment(episode.qpos[0], episode.qvel[0], episode.obs[0], episode.achieved[0], episode.goal)
        return {part.part.name: _way(part.model, part.run(start, episode.length)) for part in self._parts}


def _way(model: mujoco.MjModel, qpos: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return where the first object is at joint positions `[T+1, nq]`."""
    body = next(at for at in range(model.nbody) if model.body(at).name.startswith(_OBJECT))
    data, way = mujoco.MjData(model), np.empty((len(qpos), 3))
    for at, joints in enumerate(qpos):
        data.qpos[:] = joints
        mujoco.mj_kinematics(model, data)
        way[at] = data.xpos[body]
    return way
