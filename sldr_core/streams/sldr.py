"""Simulated locomotion demonstration rewards (paper Eq. 8).

The robot is rewarded for making the object do what the object itself would do: q = Q(z, w, g) - Q(z, u, g) with
w = I(z, z') what the robot made it do and u = nu(z, g) what it wanted. `B` batch, `N` episodes, `T` steps.
"""

from __future__ import annotations

from collections.abc import Mapping

import torch
from torch import Tensor

from sldr_core.nets.locomotion_model import LocomotionModel
from sldr_core.nets.transitions import Transitions
from sldr_core.nets.views import PartView
from sldr_core.records import Floats


class SldrStream:
    """Reward a transition by the advantage of the induced object action over the wanted one."""

    def __init__(
        self,
        part: str,
        weight: float,
        model: LocomotionModel,
        view: PartView,
        device: torch.device,
        autocast: bool,
    ) -> None:
        self.name = f"sldr/{part}"
        self.weight = weight
        self._stored = f"{self.name}/induced_action"
        self.stored_sizes: Mapping[str, int] = {self._stored: model.config.task_spec.object_action_size}
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
        with torch.autocast(self._device.type, dtype=torch.bfloat16, enabled=self._autocast):
            features = self._nets.features(self._view.object_state(batch.obs), self._view.part_goal(batch.goal))
            wanted = self._nets.action(features)
            both = torch.cat([batch.extra[self._stored], wanted])
            value_induced, value_wanted = self._nets.value(features.repeat(2, 1), both).float().chunk(2)
        return (value_induced - value_wanted).clamp(-1.0, 0.0)
