"""The maths of DDPG, worked out by hand and by finite differences."""

from __future__ import annotations

import pytest
import torch
from torch import Tensor

from sldr_core.agent.losses import actor_loss, critic_losses, lowest_return, td_target
from sldr_core.nets.mlp import Mlp, MlpStack


def test_the_worst_return_is_that_of_minus_one_for_ever() -> None:
    assert lowest_return(0.98) == pytest.approx(-sum(0.98**t for t in range(5000)))


def test_targets_are_reward_plus_discounted_value_within_what_is_possible() -> None:
    reward = torch.tensor([[-1.0, 0.0, -1.0, 0.0], [-0.5, -0.5, -0.25, 0.0]])
    next_q = torch.tensor([[-4.0, -2.0, -10.0, 3.0], [0.0, -1.0, 1.0, 0.0]])

    target = td_target(reward, next_q, gamma=0.9, lowest=torch.tensor([-10.0, -10.0]))

    # -1 - 9 is exactly the lowest return of -10; 2.7 and 0.65 lie above 0.
    by_hand = torch.tensor([[-4.6, -1.8, -10.0, 0.0], [-0.5, -1.4, 0.0, 0.0]])
    torch.testing.assert_close(target, by_hand)


def test_each_stream_has_a_lowest_target_of_its_own() -> None:
    reward, next_q = torch.full((2, 3), -1.0), torch.tensor([[-20.0, -5.0, -200.0]] * 2)

    target = td_target(reward, next_q, gamma=0.9, lowest=torch.tensor([-10.0, -100.0]))

    torch.testing.assert_close(target, torch.tensor([[-10.0, -5.5, -10.0], [-19.0, -5.5, -100.0]]))


def test_each_stream_has_its_own_mean_squared_error() -> None:
    q = torch.tensor([[-1.0, -2.0], [0.0, -3.0]])
    target = torch.tensor([[-1.0, -4.0], [-1.0, -3.0]])

    assert critic_losses(q, target).tolist() == [2.0, 0.5]


def test_the_actor_loss_weighs_streams_and_squared_actions() -> None:
    q = torch.tensor([[-1.0, -3.0], [-2.0, -4.0]])
    action = torch.tensor([[1.0, 0.0], [0.5, -0.5]])

    loss = actor_loss(q, torch.tensor([1.0, 0.5]), action, action_l2=2.0)

    # Weighted sums -2 and -5, so 3.5; squares 1, 0, .25, .25, so 2 * 0.375.
    assert loss.item() == pytest.approx(3.5 + 0.75)


@pytest.fixture
def critics() -> MlpStack:
    return MlpStack(2, (3, 4, 1), torch.Generator().manual_seed(0))


def gradient_of_critics(critics: MlpStack, rewards: Tensor) -> list[Tensor]:
    """Return the gradient of the summed loss by each parameter, `[S, ...]`."""
    x = torch.randn((6, 3), generator=torch.Generator().manual_seed(1))
    q = critics(x)[..., 0]
    target = td_target(rewards, torch.full_like(rewards, -1.0), 0.9, torch.full((len(rewards),), -10.0))
    return list(torch.autograd.grad(critic_losses(q, target).sum(), list(critics.parameters())))


def test_the_reward_of_one_stream_moves_no_other_critic(critics: MlpStack) -> None:
    rewards = -torch.rand((2, 6), generator=torch.Generator().manual_seed(2))
    changed = torch.stack([rewards[0], 0.5 * rewards[1]])

    before, after = gradient_of_critics(critics, rewards), gradient_of_critics(critics, changed)

    assert all(torch.equal(a[0], b[0]) for a, b in zip(before, after, strict=True))
    assert all(not torch.equal(a[1], b[1]) for a, b in zip(before, after, strict=True))


def test_the_actor_gradient_equals_finite_differences(critics: MlpStack) -> None:
    actor = Mlp((2, 4, 1), torch.Generator().manual_seed(3), squash=True).double()
    critics = critics.double()
    features = torch.randn((5, 2), generator=torch.Generator().manual_seed(4), dtype=torch.float64)
    weights = torch.tensor([1.0, 0.7], dtype=torch.float64)

    def loss() -> Tensor:
        action = actor(features)
        return actor_loss(critics(torch.cat([features, action], dim=-1))[..., 0], weights, action, action_l2=0.3)

    exact = torch.autograd.grad(loss(), list(actor.parameters()))

    step = 1e-6
    for parameter, gradient in zip(actor.parameters(), exact, strict=True):
        entries = parameter.data.view(-1)
        for index in range(entries.numel()):
            kept = entries[index].item()
            entries[index] = kept + step
            above = loss().item()
            entries[index] = kept - step
            below = loss().item()
            entries[index] = kept
            assert gradient.view(-1)[index].item() == pytest.approx((above - below) / (2 * step), abs=1e-8)
