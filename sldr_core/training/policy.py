"""A learnt policy: saved small, loaded from any file of a run that holds one."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch

from sldr_core.config import TrainConfig, config_from_dict, config_to_dict
from sldr_core.errors import BadFile, InvalidConfig
from sldr_core.nets.files import UNFIT, load_tensors, one_line, save_tensors
from sldr_core.nets.locomotion_model import KIND as LOCOMOTION_KIND
from sldr_core.nets.mlp import Mlp
from sldr_core.nets.normalizer import Normalizer
from sldr_core.nets.views import view_of
from sldr_core.records import Floats
from sldr_core.training.build import Parts
from sldr_core.training.checkpoint import KIND as CHECKPOINT_KIND
from sldr_core.training.checkpoint import Counters

POLICY_KIND = "policy"


@dataclass(frozen=True)
class Policy:
    """Act as a training did in its tests, without noise.

    Attributes:
        config: what was trained.
        epoch: epochs trained when it was saved; None of a checkpoint or locomotion model.
        success_rate: success of the test that ended its epoch; None of a checkpoint or locomotion model.
    """

    config: TrainConfig
    epoch: int | None
    success_rate: float | None
    normalizer: Normalizer
    actor: Mlp

    @torch.no_grad()
    def act(self, obs: np.ndarray, goal: np.ndarray) -> Floats:
        """Return actions `[N, A]` in [-1, 1] of observations `[N, D]` and goals `[N, G]`."""
        view = view_of(self.config.task_spec, self.config.phase)
        device = self.normalizer.shift.device
        tensors = (torch.as_tensor(np.asarray(part, dtype=np.float32), device=device) for part in (obs, goal))
        return self.actor(self.normalizer(view.features(*tensors))).cpu().numpy()


def write_policy(path: Path, parts: Parts, counters: Counters) -> None:
    """Write the actor that the training is tested by to `path`."""
    save_tensors(
        path,
        {
            "kind": POLICY_KIND,
            "config": config_to_dict(parts.config),
            "epoch": counters.cycle // parts.config.loop.cycles_per_epoch,
            "success_rate": counters.test_success_rate,
            "normalizer": parts.agent.normalizer.state_dict(),
            "actor": parts.agent.averaged_actor.state_dict(),
        },
    )


def load_policy(path: Path, device: str = "cpu") -> Policy:
    """Read the policy out of a policy file, a checkpoint or a locomotion model.

    Raises:
        BadFile: the file is missing, corrupt or holds no policy.
    """
    content = load_tensors(path, POLICY_KIND, CHECKPOINT_KIND, LOCOMOTION_KIND)
    try:
        config = config_from_dict(content["config"])
        normalizer_state, actor_state = _states(content)
        view, task = view_of(config.task_spec, config.phase), config.task_spec
        actions = task.robot_action_size if config.phase == "manipulation" else task.object_action_size
        normalizer = Normalizer(view.size)
        normalizer.load_state_dict(normalizer_state)
        actor = Mlp((view.size, *config.agent.hidden_sizes, actions), torch.Generator(), squash=True)
        actor.load_state_dict(actor_state)
    except (*UNFIT, InvalidConfig) as err:
        raise BadFile(
            f"{path} holds no usable policy ({one_line(err)}); give a policy, a checkpoint or "
            "a locomotion model of a run."
        ) from err
    return Policy(config, content.get("epoch"), content.get("success_rate"), normalizer.to(device), actor.to(device))


def _states(content: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the states of normaliser and actor, wherever this kind of file keeps them."""
    if content["kind"] == POLICY_KIND:
        return content["normalizer"], content["actor"]
    if content["kind"] == CHECKPOINT_KIND:
        agent: dict[str, Any] = content["agent"]
        return agent["normalizer"], agent.get("averaged_actor", agent["actor"])
    nets: dict[str, Any] = content["nets"]
    return _below(nets, "normalizer."), _below(nets, "policy.")


def _below(state: dict[str, Any], prefix: str) -> dict[str, Any]:
    return {name.removeprefix(prefix): value for name, value in state.items() if name.startswith(prefix)}
