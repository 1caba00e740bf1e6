"""The inverse model: which object action explains a transition (paper Eq. 9, Algorithm 1)."""

from __future__ import annotations

from typing import Any

import torch
from torch import Tensor
from torch.nn.utils import get_total_norm

from sldr_core.config import AgentConfig
from sldr_core.nets.adam import Adam
from sldr_core.nets.descent import descend, slices_of
from sldr_core.nets.mlp import Mlp
from sldr_core.nets.normalizer import Normalizer
from sldr_core.nets.precision import learner_precision
from sldr_core.nets.transitions import Transitions
from sldr_core.nets.views import transition_features


class InverseLearner:
    """Learn w = I(z, z') beside the object's policy, from the same batches.

    Attributes:
        normalizer: running statistics of transition features.
        net: the inverse model.
    """

    def __init__(
        self,
        state_size: int,
        action_size: int,
        config: AgentConfig,
        generator: torch.Generator,
        device: torch.device,
        autocast: bool,
    ) -> None:
        inputs = 2 * state_size
        self.normalizer = Normalizer(inputs).to(device)
        self.net = Mlp((inputs, *config.hidden_sizes, action_size), generator).to(device)
        self._optimiser = Adam(self.net.parameters(), lr=config.learning_rate, fused=True)
        self._device = device
        self._autocast = autocast

    @torch.no_grad()
    def error(self, state: Tensor, next_state: Tensor, action: Tensor) -> Tensor:
        """Return how far the model is from the actions of transitions, as root mean square, in action units."""
        seen = transition_features(state.to(self._device), next_state.to(self._device))
        return (self.net(self.normalizer(seen)) - action.to(self._device)).square().mean().sqrt()

    def observe(self, state: Tensor, next_state: Tensor) -> None:
        """Take visited transitions `[..., Z]` into the running statistics."""
        self.normalizer.update(transition_features(state.to(self._device), next_state.to(self._device)))

    def update(self, batch: Transitions) -> dict[str, Tensor]:
        """Learn from one batch of the object's own transitions; return scalars by metric name."""
        seen = self.normalizer(transition_features(batch.obs, batch.next_obs))

        def loss(rows: slice) -> Tensor:
            return (self.net(seen[rows]).float() - batch.action[rows]).square().mean()

        with learner_precision(self._device, self._autocast):
            mean_loss = descend(loss, slices_of(len(seen), self._device), self.net, self._optimiser)
        return {
            "inverse/loss": mean_loss,
            "inverse/weight_norm": get_total_norm(list(self.net.parameters())).detach(),
        }

    def state_dict(self) -> dict[str, Any]:
        """Return all that learning goes on from."""
        return {name: part.state_dict() for name, part in self._parts().items()}

    def load_state_dict(self, state: dict[str, Any]) -> None:
        """Go on from what `state_dict` returned."""
        for name, part in self._parts().items():
            part.load_state_dict(state[name])

    def _parts(self) -> dict[str, Any]:
        return {"normalizer": self.normalizer, "net": self.net, "optimiser": self._optimiser}
