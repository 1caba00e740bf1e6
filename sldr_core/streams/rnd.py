"""Random network distillation (Burda et al., 2018): a reward for states that were seldom seen.

A network learns what a fixed random one says of the next state and its goal; where it errs, the state is new.
`B` batch, `N` episodes, `T` steps, `D` observation, `G` goal, `F` features.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager
from typing import Any

import torch
from torch import Tensor, nn

from sldr_core.config import AgentConfig, RndConfig
from sldr_core.nets.adam import Adam
from sldr_core.nets.descent import descend, slices_of
from sldr_core.nets.mlp import Mlp
from sldr_core.nets.normalizer import Normalizer
from sldr_core.nets.precision import learner_precision
from sldr_core.nets.transitions import Transitions
from sldr_core.nets.views import View, view_of
from sldr_core.records import Floats
from sldr_core.streams.stream import ObjectActions, StreamOrder


class RndNets(nn.Module):
    """The fixed network, the one that learns, and the statistics of what goes in and what comes out."""

    def __init__(self, inputs: int, outputs: int, config: AgentConfig, generator: torch.Generator) -> None:
        super().__init__()
        sizes = (inputs, *config.hidden_sizes, outputs)
        self.normalizer = Normalizer(inputs)
        self.target = Mlp(sizes, generator).requires_grad_(False)
        self.predictor = Mlp(sizes, generator)
        self.scale = Normalizer(1)

    def squared_errors(self, features: Tensor) -> Tensor:
        """Return how far the prediction is off, by output, `[..., outputs]`, of normalised features `[..., F]`."""
        return (self.predictor(features) - self.target(features)).float().square()


class RndStream:
    """Reward a transition by the error at its next state, in deviations from the mean of all that was visited.

    So rewards lie about 0, within the normaliser's limits, and not in [-1, 0] as others do; the targets of the
    stream's critic are clipped as all others are.

    Attributes:
        nets: the networks and their statistics.
    """

    name = "rnd"
    stored_sizes: Mapping[str, int] = {}

    def __init__(
        self,
        config: RndConfig,
        agent: AgentConfig,
        view: View,
        generator: torch.Generator,
        device: torch.device,
        autocast: bool,
    ) -> None:
        self.weight = config.weight
        self.nets = RndNets(view.size, config.outputs, agent, generator).to(device)
        self._optimiser = Adam(self.nets.predictor.parameters(), lr=agent.learning_rate, fused=True)
        self._view = view
        self._device = device
        self._autocast = autocast

    def annotate(self, obs: Floats) -> Mapping[str, Floats]:
        """Store nothing: what is new changes with every update."""
        return {}

    @torch.no_grad()
    def observe(self, obs: Tensor, goal: Tensor) -> None:
        """Take visited states, then the errors at those that a step led to, into the running statistics."""
        features = self._view.features(obs.to(self._device), goal.to(self._device))
        self.nets.normalizer.update(features)
        with self._precision():
            errors = self.nets.squared_errors(self.nets.normalizer(features[:, 1:]))
        self.nets.scale.update(errors.sum(dim=-1, keepdim=True))

    @torch.no_grad()
    def reward(self, batch: Transitions) -> Tensor:
        """Return the standardised summed error `[B]` at the next states, under the sampled goals."""
        features = self._next_features(batch)
        with self._precision():
            errors = [
                self.nets.squared_errors(features[rows]).sum(dim=-1, keepdim=True)
                for rows in slices_of(len(features), self._device)
            ]
        return self.nets.scale(torch.cat(errors))[:, 0]

    def object_actions(self, batch: Transitions) -> ObjectActions | None:
        """Return nothing: the rewards come from no actions of an object."""
        return None

    def learn(self, batch: Transitions) -> dict[str, Tensor]:
        """Learn to predict at the next states of the batch."""
        features = self._next_features(batch)

        def loss(rows: slice) -> Tensor:
            return self.nets.squared_errors(features[rows]).mean()

        with self._precision():
            mean_loss = descend(loss, slices_of(len(features), self._device), self.nets.predictor, self._optimiser)
        return {"rnd/loss": mean_loss}

    def state_dict(self) -> dict[str, Any]:
        """Return networks, statistics and optimiser."""
        return {"nets": self.nets.state_dict(), "optimiser": self._optimiser.state_dict()}

    def load_state_dict(self, state: dict[str, Any]) -> None:
        """Go on from what `state_dict` returned."""
        self.nets.load_state_dict(state["nets"])
        self._optimiser.load_state_dict(state["optimiser"])

    def _next_features(self, batch: Transitions) -> Tensor:
        return self.nets.normalizer(self._view.features(batch.next_obs, batch.goal))

    def _precision(self) -> AbstractContextManager[None]:
        return learner_precision(self._device, self._autocast)


def build_rnd(order: StreamOrder) -> list[RndStream]:
    """Build the one stream."""
    config = order.config
    view = view_of(config.task_spec, config.phase)
    return [RndStream(config.rnd, config.agent, view, order.generator, order.device, order.autocast)]
