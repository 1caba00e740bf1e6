"""DDPG with stacked critics learns exactly what a plain one with separate networks learns."""

from __future__ import annotations

from copy import deepcopy

import pytest
import torch
from torch import Tensor, nn

from sldr_core.agent import DdpgAgent
from sldr_core.config import AgentConfig, find_task
from sldr_core.nets import descent
from sldr_core.nets.mlp import Mlp
from sldr_core.nets.transitions import Transitions
from sldr_core.nets.views import view_of

CONFIG = AgentConfig(hidden_sizes=(16, 16), learning_rate=1e-3, gamma=0.9, target_rate=0.1, action_l2=0.5)
VIEW = view_of(find_task("FetchPush"), "manipulation")
STREAMS = ("task", "sldr/object0")
WEIGHTS = (1.0, 0.5)
BATCH = 32


def make_agent(config: AgentConfig = CONFIG) -> DdpgAgent:
    generator = torch.Generator().manual_seed(0)
    agent = DdpgAgent(VIEW, 4, STREAMS, WEIGHTS, config, generator, torch.device("cpu"), autocast=False)
    obs, goal = torch.randn(200, 25, generator=generator), torch.randn(200, 3, generator=generator)
    agent.observe(obs, goal)
    return agent


def draw_batch(seed: int) -> tuple[Transitions, Tensor]:
    generator = torch.Generator().manual_seed(seed)
    obs, next_obs = (torch.randn(BATCH, 25, generator=generator) for _ in range(2))
    goal, action = torch.randn(BATCH, 3, generator=generator), torch.rand(BATCH, 4, generator=generator) * 2 - 1
    rewards = -torch.rand(2, BATCH, generator=generator)
    return Transitions(obs, next_obs, goal, action, rewards[0], extra={}), rewards


def weights_of(net: nn.Module) -> list[Tensor]:
    return [parameter.detach().clone() for parameter in net.parameters()]


def linear_net(weights: list[Tensor], biases: list[Tensor], squash: bool) -> nn.Sequential:
    """Build an ordinary network; weights are `[outputs, inputs]`."""
    layers: list[nn.Module] = []
    for weight, bias in zip(weights, biases, strict=True):
        layer = nn.Linear(weight.shape[1], weight.shape[0])
        layer.weight.data.copy_(weight)
        layer.bias.data.copy_(bias)
        layers += [layer, nn.ReLU()]
    return nn.Sequential(*layers[:-1], *([nn.Tanh()] if squash else []))


class PlainDdpg:
    """DDPG as in a textbook: one network, one optimiser and one loop turn for each critic."""

    def __init__(self, agent: DdpgAgent) -> None:
        self.features = agent.features
        self.actor, self.target_actor = self._actor_of(agent.actor), self._actor_of(agent.actor)
        self.critics, self.target_critics = self._critics_of(agent), self._critics_of(agent)
        self.actor_optimiser = torch.optim.Adam(self.actor.parameters(), lr=CONFIG.learning_rate)
        self.critic_optimisers = [torch.optim.Adam(net.parameters(), lr=CONFIG.learning_rate) for net in self.critics]

    def update(self, batch: Transitions, rewards: Tensor) -> None:
        now, then = self.features(batch.obs, batch.goal), self.features(batch.next_obs, batch.goal)
        for index, critic in enumerate(self.critics):
            with torch.no_grad():
                next_q = self.target_critics[index](torch.cat([then, self.target_actor(then)], 1))[:, 0]
                target = (rewards[index] + CONFIG.gamma * next_q).clamp(-1 / (1 - CONFIG.gamma), 0)
            loss = nn.functional.mse_loss(critic(torch.cat([now, batch.action], 1))[:, 0], target)
            self.critic_optimisers[index].zero_grad()
            loss.backward()
            self.critic_optimisers[index].step()
        action = self.actor(now)
        loss = CONFIG.action_l2 * (action**2).mean()
        for weight, critic in zip(WEIGHTS, self.critics, strict=True):
            loss = loss - weight * critic(torch.cat([now, action], 1)).mean()
        self.actor_optimiser.zero_grad()
        loss.backward()
        self.actor_optimiser.step()

    def sync(self) -> None:
        pairs = [(self.actor, self.target_actor), *zip(self.critics, self.target_critics, strict=True)]
        with torch.no_grad():
            for online, target in pairs:
                for new, old in zip(online.parameters(), target.parameters(), strict=True):
                    old.copy_((1 - CONFIG.target_rate) * old + CONFIG.target_rate * new)

    @staticmethod
    def _actor_of(actor: Mlp) -> nn.Sequential:
        return linear_net(list(actor.weights), list(actor.biases), squash=True)

    @staticmethod
    def _critics_of(agent: DdpgAgent) -> list[nn.Sequential]:
        stack = agent.critics
        return [
            linear_net([w[index].T for w in stack.weights], [b[index, 0] for b in stack.biases], squash=False)
            for index in range(stack.count)
        ]


@pytest.mark.parametrize("slice_rows", [BATCH, 12])
def test_learning_equals_a_plain_implementation_with_separate_networks(
    slice_rows: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(descent, "SLICE_ROWS", slice_rows)
    agent = make_agent()
    plain = PlainDdpg(agent)

    for seed in range(6):
        batch, rewards = draw_batch(seed)
        agent.update(batch, rewards)
        plain.update(batch, rewards)
        if seed % 2:
            agent.sync_targets()
            plain.sync()

    obs, goal = draw_batch(99)[0].obs, draw_batch(99)[0].goal
    torch.testing.assert_close(agent.act(obs, goal), plain.actor(plain.features(obs, goal)), atol=1e-5, rtol=1e-4)
    for index, critic in enumerate(plain.critics):
        layers = [layer for layer in critic if isinstance(layer, nn.Linear)]
        for ours, theirs in zip(agent.critics.weights, layers, strict=True):
            torch.testing.assert_close(ours[index].T, theirs.weight, atol=1e-5, rtol=1e-4)


def test_targets_move_by_the_target_rate_and_only_when_synced() -> None:
    agent = make_agent()
    before = weights_of(agent._target_critics) + weights_of(agent._target_actor)
    agent.update(*draw_batch(0))
    unsynced = weights_of(agent._target_critics) + weights_of(agent._target_actor)

    agent.sync_targets()

    online = weights_of(agent.critics) + weights_of(agent.actor)
    synced = weights_of(agent._target_critics) + weights_of(agent._target_actor)
    for old, still, new, moved in zip(before, unsynced, online, synced, strict=True):
        assert torch.equal(old, still)
        torch.testing.assert_close(moved, 0.9 * old + 0.1 * new)


def test_an_update_leaves_the_normaliser_alone() -> None:
    agent = make_agent()
    before = {name: value.clone() for name, value in agent.normalizer.state_dict().items()}

    agent.update(*draw_batch(0))

    assert all(torch.equal(value, before[name]) for name, value in agent.normalizer.state_dict().items())


def test_a_stream_without_weight_does_not_move_the_actor() -> None:
    def actor_after(second_rewards: float) -> list[Tensor]:
        agent = DdpgAgent(
            VIEW, 4, STREAMS, (1.0, 0.0), CONFIG, torch.Generator().manual_seed(0), torch.device("cpu"), autocast=False
        )
        for seed in range(3):
            batch, rewards = draw_batch(seed)
            rewards[1] = second_rewards
            agent.update(batch, rewards)
        return weights_of(agent.actor)

    assert all(torch.equal(a, b) for a, b in zip(actor_after(-1.0), actor_after(0.0), strict=True))


def test_metrics_name_every_stream() -> None:
    metrics = make_agent().update(*draw_batch(0))

    parts = ("loss", "q_mean", "q_min", "q_max", "target_clip_low_share", "target_clip_high_share")
    assert set(metrics) == {f"critic/{stream}/{part}" for stream in STREAMS for part in parts} | {
        "critic/weight_norm",
        "actor/loss",
        "actor/saturated_share",
        "actor/weight_norm",
    }


def test_metrics_of_a_critic_are_those_of_its_values_and_targets() -> None:
    agent = make_agent()
    batch, _ = draw_batch(0)
    # gamma is 0.9, so targets are clipped to [-10, 0]: a quarter of them each lies below and above.
    quarters = torch.tensor([[-100.0, 100.0, -5.0, -5.0], [-1.0, -1.0, -1.0, 100.0]])
    rewards = quarters.repeat_interleave(BATCH // 4, dim=1)
    inputs = torch.cat([agent.features(batch.obs, batch.goal), batch.action], dim=-1)
    values = agent.critics(inputs)[1, :, 0].detach()

    metrics = {name: value.item() for name, value in agent.update(batch, rewards).items()}

    assert metrics["critic/task/target_clip_low_share"] == 0.25
    assert metrics["critic/task/target_clip_high_share"] == 0.25
    assert metrics["critic/sldr/object0/target_clip_low_share"] == 0.0
    assert metrics["critic/sldr/object0/target_clip_high_share"] == 0.25
    assert metrics["critic/sldr/object0/q_mean"] == pytest.approx(values.mean().item(), rel=1e-5)
    assert metrics["critic/sldr/object0/q_min"] == pytest.approx(values.min().item(), rel=1e-5)
    assert metrics["critic/sldr/object0/q_max"] == pytest.approx(values.max().item(), rel=1e-5)
    squares = sum(weight.square().sum().item() for weight in weights_of(agent.actor))
    assert metrics["actor/weight_norm"] == pytest.approx(squares**0.5, rel=1e-5)


def test_actions_stay_within_their_limits() -> None:
    obs, goal = 1e3 * torch.randn(50, 25), 1e3 * torch.randn(50, 3)

    assert make_agent().act(obs, goal).abs().max() <= 1.0


def test_a_restored_agent_learns_on_to_the_last_bit() -> None:
    agent, other = make_agent(), make_agent()
    agent.update(*draw_batch(0))
    other.load_state_dict(deepcopy(agent.state_dict()))

    for one in (agent, other):
        one.update(*draw_batch(1))
        one.sync_targets()

    for ours, theirs in zip(
        weights_of(agent.actor) + weights_of(agent._target_critics),
        weights_of(other.actor) + weights_of(other._target_critics),
        strict=True,
    ):
        assert torch.equal(ours, theirs)
