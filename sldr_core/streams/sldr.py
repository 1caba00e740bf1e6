"""Simulated locomotion demonstration rewards (paper Eq. 7 and 8).

The robot is rewarded for making the object do what the object itself would do, by comparing w = I(z, z'), what the
robot made it do, with u = nu(z, g), what it wanted.
`B` batch, `N` episodes, `T` steps, `F` features, `U` object action.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from typing import Any

import torch
from torch import Tensor

from sldr_core.config import SldrConfig, SldrReward
from sldr_core.errors import BadFile
from sldr_core.nets.descent import slices_of
from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets
from sldr_core.nets.precision import learner_precision
from sldr_core.nets.transitions import Transitions
from sldr_core.nets.views import PartView, part_view
from sldr_core.records import Floats
from sldr_core.streams.stream import FixedStream, ObjectActions, StreamOrder


def advantage(nets: LocomotionNets, features: Tensor, induced: Tensor) -> Tensor:
    """Return q = Q(z, w, g) - Q(z, u, g) (Eq. 8), `[B]`.

    Args:
        nets: the object's networks.
        features: what the object sees, `[B, F]`.
        induced: w, `[B, U]`.
    """
    both = torch.cat([induced, nets.action(features)])
    value_induced, value_wanted = nets.value(features.repeat(2, 1), both).float().chunk(2)
    return value_induced - value_wanted


def action_distance(nets: LocomotionNets, features: Tensor, induced: Tensor) -> Tensor:
    """Return q = -||w - u||^2 (Eq. 7), `[B]`; the arguments are those of `advantage`."""
    return -(induced - nets.action(features).float()).square().sum(dim=-1)


REWARDS: dict[SldrReward, Callable[[LocomotionNets, Tensor, Tensor], Tensor]] = {
    "advantage": advantage,
    "action_distance": action_distance,
}
"""The paper's rewards by their names."""


class SldrStream(FixedStream):
    """Reward a transition by how the induced object action compares with the wanted one.

    Rewards are clipped to [-1, 0], the range of the sparse reward (paper §6.1): the targets of every critic are
    clipped to the returns of such rewards. For Eq. 8 the upper limit cuts off the errors of Q, whose maximum is u.
    Eq. 7 is never above 0 and has no lowest value, as w is not bounded; actions further apart than 1 are all alike.
    """

    def __init__(
        self,
        part: str,
        config: SldrConfig,
        model: LocomotionModel,
        view: PartView,
        device: torch.device,
        autocast: bool,
    ) -> None:
        self.name = f"sldr/{part}"
        self._part = part
        self.weight = config.weight
        self._stored = f"{self.name}/induced_action"
        self.stored_sizes: Mapping[str, int] = {self._stored: model.config.task_spec.object_action_size}
        self._reward = REWARDS[config.reward]
        self._trained_in = model.config.task
        # Once: its state is looked at in every cycle, and frozen nets do not change.
        self._digest = model.nets.digest()
        self._nets = model.nets.to(device)
        self._view = view
        self._device = device
        self._autocast = autocast

    @torch.no_grad()
    def annotate(self, obs: Floats) -> Mapping[str, Floats]:
        """Return w, once per transition: the inverse model needs no goal, so relabelling cannot change it."""
        state = self._view.object_state(torch.from_numpy(obs).to(self._device))
        induced = self._nets.inferred_action(state[:, :-1], state[:, 1:])
        return {self._stored: induced.cpu().numpy()}

    @torch.no_grad()
    def reward(self, batch: Transitions) -> Tensor:
        """Return q in [-1, 0], `[B]`, under the sampled goal."""
        features, induced = self._features(batch), batch.extra[self._stored]
        with self._precision():
            q = [
                self._reward(self._nets, features[rows], induced[rows])
                for rows in slices_of(len(features), self._device)
            ]
        return torch.cat(q).clamp(-1.0, 0.0)

    @torch.no_grad()
    def object_actions(self, batch: Transitions) -> ObjectActions:
        """Return u under the sampled goal, and the stored w."""
        with self._precision():
            wanted = self._nets.action(self._features(batch)).float()
        return ObjectActions(self._part, wanted, batch.extra[self._stored])

    def state_dict(self) -> dict[str, Any]:
        """Return what tells the model from any other: its w are stored, and critics have learnt from its rewards."""
        return {"model": self._digest}

    def load_state_dict(self, state: dict[str, Any]) -> None:
        """Go on with the same model; checkpoints of earlier versions do not say which it was.

        Raises:
            BadFile: it is another one.
        """
        if state.get("model", self._digest) != self._digest:
            raise BadFile(
                f"The run in this directory began with another locomotion model of {self._trained_in}; give that one, "
                "or use another directory."
            )

    def _features(self, batch: Transitions) -> Tensor:
        return self._nets.features(self._view.object_state(batch.obs), self._view.part_goal(batch.goal))

    def _precision(self) -> AbstractContextManager[None]:
        return learner_precision(self._device, self._autocast)


def build_sldr(order: StreamOrder) -> list[SldrStream]:
    """Build one stream for each part of the task."""
    task, config = order.config.task_spec, order.config.sldr
    return [
        SldrStream(
            part.name,
            config,
            order.models[part.locomotion_task],
            part_view(task, part),
            order.device,
            order.autocast,
        )
        for part in task.parts
    ]
