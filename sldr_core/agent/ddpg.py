"""DDPG with one critic per reward stream (paper §3.2 and §4.3).

`B` batch, `S` streams, `F` features, `A` action.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from copy import deepcopy
from typing import Any

import torch
from torch import Tensor, nn
from torch.nn.utils import get_total_norm

from sldr_core.agent.losses import actor_loss, critic_losses, lowest_return, td_target
from sldr_core.config import AgentConfig
from sldr_core.nets.adam import Adam
from sldr_core.nets.descent import descend, held, slices_of
from sldr_core.nets.mlp import Mlp, MlpStack
from sldr_core.nets.normalizer import Drift, Normalizer
from sldr_core.nets.precision import learner_precision
from sldr_core.nets.transitions import Transitions
from sldr_core.nets.views import View

SATURATED = 0.99
"""An action entry beyond this counts as saturated."""


class DdpgAgent:
    """Act, and learn from batches.

    Attributes:
        normalizer: running statistics of the visited features.
        actor, critics: the online networks; `critics` is a stack of `S`.
        averaged_actor: the running average of the actor's weights, by which tests judge (Polyak and Juditsky 1992);
            the actor itself if `average_rate` is 1.
    """

    def __init__(
        self,
        view: View,
        action_size: int,
        stream_names: Sequence[str],
        stream_weights: Sequence[float],
        config: AgentConfig,
        generator: torch.Generator,
        device: torch.device,
        autocast: bool,
    ) -> None:
        self._config = config
        self._view = view
        self._streams = tuple(stream_names)
        self._device = device
        self._autocast = autocast
        hidden = config.hidden_sizes
        self.normalizer = Normalizer(view.size).to(device)
        self.actor = Mlp((view.size, *hidden, action_size), generator, squash=True).to(device)
        self.critics = MlpStack(len(self._streams), (view.size + action_size, *hidden, 1), generator).to(device)
        averages = config.average_rate < 1.0
        self.averaged_actor = deepcopy(self.actor).requires_grad_(False) if averages else self.actor
        self._target_actor = deepcopy(self.actor).requires_grad_(False)
        self._target_critics = deepcopy(self.critics).requires_grad_(False)
        self._weights = torch.tensor(stream_weights, device=device)
        self._lowest = torch.tensor(_lowest_targets(config, len(self._streams)), device=device)
        self._actor_optimiser = Adam(self.actor.parameters(), lr=config.learning_rate, fused=True)
        self._critic_optimiser = Adam(self.critics.parameters(), lr=config.learning_rate, fused=True)

    def features(self, obs: Tensor, goal: Tensor) -> Tensor:
        """Return normalised features `[..., F]`."""
        return self.normalizer(self._view.features(obs, goal))

    @torch.no_grad()
    def act(self, obs: Tensor, goal: Tensor) -> Tensor:
        """Return the deterministic actions `[..., A]` of the online actor, around which episodes are explored."""
        return self._act(self.actor, obs, goal)

    @torch.no_grad()
    def act_averaged(self, obs: Tensor, goal: Tensor) -> Tensor:
        """Return the deterministic actions `[..., A]` of the averaged actor, which is what a training is tested by."""
        return self._act(self.averaged_actor, obs, goal)

    def frozen_policy(self) -> Callable[[Tensor, Tensor], Tensor]:
        """Return what `act` does now; it goes on doing that while this agent learns.

        It acts on the processor: on a GPU each step would wait for the updates that are made meanwhile.
        """
        normalizer, actor = deepcopy(self.normalizer).cpu(), deepcopy(self.actor).cpu().requires_grad_(False)

        def act(obs: Tensor, goal: Tensor) -> Tensor:
            return actor(normalizer(self._view.features(obs, goal)))

        return act

    @torch.no_grad()
    def values(self, obs: Tensor, goal: Tensor, action: Tensor) -> Tensor:
        """Return what each stream's online critic says of `B` observations, goals and actions, `[S, B]`."""
        with self._precision():
            return self._judge(self.features(obs, goal), action)

    def observe(self, obs: Tensor, goal: Tensor) -> Drift:
        """Take visited observations and their original goals into the running statistics; return how they moved."""
        return self.normalizer.update(self._view.features(obs.to(self._device), goal.to(self._device)))

    def update(self, batch: Transitions, rewards: Tensor) -> dict[str, Tensor]:
        """Learn from one batch.

        Args:
            batch: the transitions.
            rewards: reward of each stream, `[S, B]`.

        Returns:
            Scalars by metric name, detached and still on the device.
        """
        with self._precision():
            features = self.features(batch.obs, batch.goal)
            next_features = self.features(batch.next_obs, batch.goal)
            metrics = self._update_critics(features, batch.action, rewards, next_features)
        # Anew, as a context keeps the weights that it has rounded: the actor would learn from the critics as they were.
        with self._precision():
            metrics |= self._update_actor(features)
        if self.averaged_actor is not self.actor:
            _move(self.averaged_actor, self.actor, self._config.average_rate)
        return metrics

    def sync_targets(self) -> None:
        """Move the target networks towards the online ones by the target rate."""
        _move(self._target_actor, self.actor, self._config.target_rate)
        _move(self._target_critics, self.critics, self._config.target_rate)

    def state_dict(self) -> dict[str, Any]:
        """Return all that learning goes on from."""
        return {name: part.state_dict() for name, part in self._parts().items()}

    def load_state_dict(self, state: dict[str, Any]) -> None:
        """Go on from what `state_dict` returned."""
        for name, part in self._parts().items():
            part.load_state_dict(state[name])

    def _act(self, actor: Mlp, obs: Tensor, goal: Tensor) -> Tensor:
        return actor(self.features(obs.to(self._device), goal.to(self._device))).cpu()

    def _parts(self) -> dict[str, Any]:
        averaged = {} if self.averaged_actor is self.actor else {"averaged_actor": self.averaged_actor}
        return {
            "normalizer": self.normalizer,
            "actor": self.actor,
            **averaged,
            "critics": self.critics,
            "target_actor": self._target_actor,
            "target_critics": self._target_critics,
            "actor_optimiser": self._actor_optimiser,
            "critic_optimiser": self._critic_optimiser,
        }

    def _update_critics(
        self, features: Tensor, action: Tensor, rewards: Tensor, next_features: Tensor
    ) -> dict[str, Tensor]:
        judged: list[Tensor] = []
        targets: list[Tensor] = []

        def loss(rows: slice) -> Tensor:
            target = self._targets(rewards[:, rows], next_features[rows])
            q = self._judge(features[rows], action[rows])
            judged.append(q.detach())
            targets.append(target)
            return critic_losses(q, target)

        losses = descend(loss, slices_of(len(features), self._device), self.critics, self._critic_optimiser)
        return {
            **self._critic_metrics(losses, torch.cat(judged, dim=1), torch.cat(targets, dim=1)),
            "critic/weight_norm": get_total_norm(list(self.critics.parameters())).detach(),
        }

    @torch.no_grad()
    def _targets(self, rewards: Tensor, next_features: Tensor) -> Tensor:
        """Return what the critics should say `[S, B]`, by the target networks."""
        next_action = self._target_actor(next_features)
        next_q = self._target_critics(torch.cat([next_features, next_action], dim=-1))[..., 0]
        return td_target(rewards, next_q.float(), self._config.gamma, self._lowest)

    def _judge(self, features: Tensor, action: Tensor) -> Tensor:
        """Return what the online critics say of features `[B, F]` and actions `[B, A]`, `[S, B]`."""
        return self.critics(torch.cat([features, action], dim=-1))[..., 0].float()

    def _critic_metrics(self, losses: Tensor, q: Tensor, target: Tensor) -> dict[str, Tensor]:
        """Return scalars by metric name, of losses `[S]`, values and targets `[S, B]`."""
        rows = {
            "loss": losses,
            "q_mean": q.mean(dim=1),
            "q_min": q.amin(dim=1),
            "q_max": q.amax(dim=1),
            "target_clip_low_share": (target <= self._lowest[:, None]).float().mean(dim=1),
            "target_clip_high_share": (target >= 0.0).float().mean(dim=1),
        }
        return {
            f"critic/{stream}/{name}": row[index]
            for index, stream in enumerate(self._streams)
            for name, row in rows.items()
        }

    def _update_actor(self, features: Tensor) -> dict[str, Tensor]:
        chosen: list[Tensor] = []

        def loss(rows: slice) -> Tensor:
            action = self.actor(features[rows])
            q = self._judge(features[rows], action)
            chosen.append(action.detach())
            return actor_loss(q, self._weights, action.float(), self._config.action_l2)

        with held(self.critics):
            mean_loss = descend(loss, slices_of(len(features), self._device), self.actor, self._actor_optimiser)
        return {
            "actor/loss": mean_loss,
            "actor/weight_norm": get_total_norm(list(self.actor.parameters())).detach(),
            "actor/saturated_share": (torch.cat(chosen).abs() > SATURATED).float().mean(),
        }

    def _precision(self) -> AbstractContextManager[None]:
        return learner_precision(self._device, self._autocast)


@torch.no_grad()
def _move(behind: nn.Module, ahead: nn.Module, rate: float) -> None:
    """Move the weights of one network towards those of another by a share of the way."""
    for weight, wanted in zip(behind.parameters(), ahead.parameters(), strict=True):
        weight.lerp_(wanted, rate)


def _lowest_targets(config: AgentConfig, streams: int) -> list[float]:
    """Return the lowest target of the task's critic, which is the first, and of the others."""
    task = config.lowest_return or lowest_return(config.gamma)
    return [task] + [config.lowest_auxiliary_return or task] * (streams - 1)
