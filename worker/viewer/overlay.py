"""Putting the demonstration of every part of a task together."""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
import viser

from sldr_core.config import TrainConfig
from sldr_core.nets.locomotion_model import LocomotionModel
from worker.viewer.against import Against
from worker.viewer.arrows import HAND_ARROWS, TABLE_ARROWS
from worker.viewer.demonstration import PartDemonstration


def build_against(
    server: viser.ViserServer, config: TrainConfig, model: mujoco.MjModel, models: Mapping[str, LocomotionModel]
) -> Against | None:
    """Return the demonstrations of a manipulation task's parts, or None without their locomotion models."""
    task = config.task_spec
    if not models or config.phase == "locomotion":
        return None
    parts = [PartDemonstration(task, part, models[part.locomotion_task], model) for part in task.parts]
    return Against(server, model, parts, HAND_ARROWS if task.family == "hand" else TABLE_ARROWS)
