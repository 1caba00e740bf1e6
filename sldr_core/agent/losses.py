"""The maths of DDPG as pure functions (paper Eq. 3, 4, 10 and 11).

`B` batch, `S` streams, `A` action.
"""

from __future__ import annotations

from torch import Tensor


def lowest_return(gamma: float) -> float:
    """Return the worst possible return of rewards in [-1, 0]."""
    return -1.0 / (1.0 - gamma)


def td_target(reward: Tensor, next_q: Tensor, gamma: float, lowest: Tensor) -> Tensor:
    """Return r + gamma Q', clipped to 0 and the lowest target of each stream.

    Every transition bootstraps: episodes end by time alone.

    Args:
        reward: `[S, B]`.
        next_q: values of the next states, `[S, B]`.
        gamma: the discount.
        lowest: lowest target of each stream, `[S]`.
    """
    return (reward + gamma * next_q).clamp(max=0.0).maximum(lowest[:, None])


def critic_losses(q: Tensor, target: Tensor) -> Tensor:
    """Return each stream's mean squared error `[S]` of values and targets `[S, B]`."""
    return (q - target).square().mean(dim=1)


def actor_loss(q: Tensor, weights: Tensor, action: Tensor, action_l2: float) -> Tensor:
    """Return the loss of the actor: minus the weighted sum of all critics, plus the squared action.

    Args:
        q: values of the actor's own actions, `[S, B]`.
        weights: weight of each stream, `[S]`.
        action: the actor's actions, `[B, A]`.
        action_l2: weight of the mean squared action.
    """
    return -(weights @ q).mean() + action_l2 * action.square().mean()
