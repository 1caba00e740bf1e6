"""The locomotion model: what an object has learnt, with how well it was measured to do, as one file."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn

from sldr_core.config import TrainConfig, config_from_dict, config_hash, config_to_dict
from sldr_core.errors import BadFile, InvalidConfig
from sldr_core.nets.files import UNFIT, load_tensors, one_line, save_tensors
from sldr_core.nets.mlp import Mlp, MlpStack
from sldr_core.nets.normalizer import Normalizer
from sldr_core.nets.views import transition_features, view_of

KIND = "locomotion model"
"""What such a file calls itself."""


@dataclass(frozen=True)
class Measured:
    """How well a policy did in its test."""

    success_rate: float
    """Share of successful test episodes."""
    episodes: int
    """Test episodes."""


class LocomotionNets(nn.Module):
    """The object's policy nu, its action value Q_nu, the inverse model I and their normalisers (paper §4)."""

    def __init__(self, config: TrainConfig, generator: torch.Generator) -> None:
        super().__init__()
        task, hidden = config.task_spec, config.agent.hidden_sizes
        self.view = view_of(task, "locomotion")
        self.normalizer = Normalizer(self.view.size)
        self.policy = Mlp((self.view.size, *hidden, task.object_action_size), generator, squash=True)
        self.critic = MlpStack(1, (self.view.size + task.object_action_size, *hidden, 1), generator)
        self.transition_normalizer = Normalizer(2 * task.object_state_size)
        self.inverse = Mlp((2 * task.object_state_size, *hidden, task.object_action_size), generator)

    def features(self, state: Tensor, goal: Tensor) -> Tensor:
        """Return normalised features `[..., F]` of object states and goals."""
        return self.normalizer(self.view.features(state, goal))

    def action(self, features: Tensor) -> Tensor:
        """Return u = nu(z, g), `[B, A]`."""
        return self.policy(features)

    def value(self, features: Tensor, action: Tensor) -> Tensor:
        """Return Q_nu(z, u, g), `[B]`."""
        return self.critic(torch.cat([features, action], dim=-1))[0, :, 0]

    def digest(self) -> str:
        """Return what tells these weights from any others."""
        found = hashlib.sha256()
        for name, values in sorted(self.state_dict().items()):
            found.update(name.encode())
            found.update(values.detach().cpu().numpy().tobytes())
        return found.hexdigest()

    def inferred_action(self, state: Tensor, next_state: Tensor) -> Tensor:
        """Return w = I(z, z'), the action that would have made the object move so, `[..., A]`."""
        return self.inverse(self.transition_normalizer(transition_features(state, next_state)))


@dataclass(frozen=True)
class LocomotionModel:
    """A frozen locomotion model with its origin and its measured success."""

    nets: LocomotionNets
    config: TrainConfig
    measured: Measured

    def save(self, path: Path, change: Callable[[dict[str, Tensor]], dict[str, Tensor]] = lambda nets: nets) -> None:
        """Write everything to `path`; `change` is done to the weights before, as keeping them in half precision."""
        save_tensors(
            path,
            {
                "kind": KIND,
                "task": self.config.task,
                "phase": self.config.phase,
                "config": config_to_dict(self.config),
                "config_hash": config_hash(self.config),
                "success_rate": self.measured.success_rate,
                "test_episodes": self.measured.episodes,
                "nets": change(self.nets.state_dict()),
            },
        )


def load_locomotion_model(path: Path) -> LocomotionModel:
    """Read a locomotion model; its config says of which task it is.

    Raises:
        BadFile: it is missing, corrupt or something else, or its networks are not those of its task.
    """
    content: dict[str, Any] = load_tensors(path, KIND)
    try:
        config = config_from_dict(content["config"])
        _check_origin(path, content, config)
        nets = LocomotionNets(config, torch.Generator())
        nets.load_state_dict(content["nets"])
        measured = Measured(float(content["success_rate"]), int(content["test_episodes"]))
    except (*UNFIT, InvalidConfig) as err:
        raise BadFile(f"{path} is no usable locomotion model ({one_line(err)}); train it again.") from err
    nets.requires_grad_(False).eval()
    return LocomotionModel(nets, config, measured)


def _check_origin(path: Path, content: dict[str, Any], config: TrainConfig) -> None:
    """Compare what the file says of itself with its config."""
    said = (content.get("task", config.task), content.get("phase", config.phase))
    if said != (config.task, config.phase) or config.phase != "locomotion":
        raise BadFile(
            f"{path} says it is of {said[0]} ({said[1]}), but its config is of {config.task} ({config.phase}); "
            "train it again."
        )
