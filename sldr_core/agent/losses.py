"""The maths of DDPG as pure functions (paper Eq. 3, 4, 10 and 11).

`B` batch, `S` streams, `A` action.
"""

from __future__ import annotations

from torch import Tensor


def lowest_return(gamma: float) -> float:
    """Return the worst possible return of rewards in [-1, 0]."""
    return -1.0 / (1.0 - gamma)


def td_target(reward: Tensor, next_q: Tensor, gamma: float) -> Tensor:
    """Return r + gamma Q', clipped to what rewards in [-1, 0] allow. All `[S, B]`.

    Every transition bootstraps: episodes end by time alone.
    """
    return (reward + gamma * next_q).clamp(lowest_return(gamma), 0.0)


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
