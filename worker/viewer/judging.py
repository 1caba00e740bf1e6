"""Judging simulated transitions as the training's SLDR streams do, with the very same code."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import torch

from sldr_core.config import TrainConfig, find_task
from sldr_core.envs import Envs
from sldr_core.errors import BadFile
from sldr_core.nets.locomotion_model import LocomotionModel, load_locomotion_model
from sldr_core.nets.transitions import Transitions
from sldr_core.streams import StreamOrder, build_sldr
from worker.viewer.simulated import Moment
from worker.viewer.tracks import Floats, Judged


def load_models(config: TrainConfig, paths: Sequence[Path]) -> dict[str, LocomotionModel]:
    """Read the locomotion models that a training's parts need, by task; none where one is missing.

    Raises:
        BadFile: one cannot be used, or is of another task or variant.
    """
    needed = config.task_spec.locomotion_tasks
    models: dict[str, LocomotionModel] = {}
    for path in paths:
        model = load_locomotion_model(path)
        task = model.config.task
        if task not in needed:
            raise BadFile(f"{path} is a locomotion model of {task}; {config.task} needs one of {' and '.join(needed)}.")
        if model.config.task_spec != find_task(task, config.scene.variant):
            raise BadFile(f"{path} is of another variant of {task} than this run; choose one of the same variant.")
        models[task] = model
    return models if set(models) == set(needed) else {}


class StreamJudge:
    """Ask the SLDR streams, built as the training builds them, on the CPU."""

    def __init__(self, config: TrainConfig, models: Mapping[str, LocomotionModel], envs: Envs) -> None:
        order = StreamOrder(config, models, torch.Generator(), torch.device("cpu"), autocast=False)
        self._streams = build_sldr(order)
        self._envs = envs

    def judge(self, now: Moment, later: Moment, action: Floats) -> Judged:
        """Return the task's reward, q of each part, u and w; critics of the robot are not in a policy's file."""
        obs = np.stack([now.obs, later.obs])[None].astype(np.float32)
        extra = {name: values for stream in self._streams for name, values in stream.annotate(obs).items()}
        task_reward = float(self._envs.reward(later.achieved, later.goal))
        batch = Transitions(
            obs=torch.from_numpy(obs[:, 0]),
            next_obs=torch.from_numpy(obs[:, 1]),
            goal=torch.from_numpy(now.goal.astype(np.float32))[None],
            action=torch.from_numpy(action)[None],
            reward=torch.tensor([task_reward]),
            extra={name: torch.from_numpy(values[:, 0]) for name, values in extra.items()},
        )
        actions = [stream.object_actions(batch) for stream in self._streams]
        return Judged(
            {"task": task_reward} | {stream.name: float(stream.reward(batch)[0]) for stream in self._streams},
            {},
            np.stack([pair.wanted[0].numpy() for pair in actions]),
            np.stack([pair.induced[0].numpy() for pair in actions]),
        )
