"""Collecting whole episodes, with or without exploration noise.

`N` simulations, `T` steps, `A` action.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray

from sldr_core.config import ExplorationConfig
from sldr_core.envs import Envs, Observation
from sldr_core.errors import TrainingDiverged
from sldr_core.records import Episodes, Floats
from sldr_core.training.finite import check_episodes

Act = Callable[[Floats, Floats], Floats]
"""Return actions `[N, A]` of observations `[N, D]` and goals `[N, G]`."""

Check = Callable[[], None]
"""Called between steps; raises to abandon what is being done."""

ACTING_THREADS = 1
"""Of torch while episodes run: a few dozen observations gain nothing from more, and threads that have nothing to do
wait for the next product by keeping a core busy, which simulations and a learner beside need."""

log = logging.getLogger(__name__)

Watch = Callable[[int, Observation], None]
"""Shown every moment of the episodes, from 0 to T, right after it has come; it changes nothing."""


class Exploration:
    """Add noise to a policy: now and then a uniform action, else Gaussian noise, then the limits (paper §6.1)."""

    def __init__(self, config: ExplorationConfig, rng: np.random.Generator) -> None:
        self.rng = rng
        self._config = config

    def around(self, act: Act) -> Act:
        """Return the policy `act` with noise."""
        return lambda obs, goal: self.perturb(act(obs, goal))

    def perturb(self, action: Floats) -> Floats:
        """Return noisy actions `[N, A]` in [-1, 1]."""
        noisy = action + self.rng.normal(0.0, self._config.noise_std, action.shape).astype(np.float32)
        uniform = self.random(action.shape)
        chosen = self.rng.random((action.shape[0], 1)) < self._config.random_action_probability
        return np.where(chosen, uniform, noisy).clip(-1.0, 1.0)

    def random(self, shape: tuple[int, ...]) -> Floats:
        """Return uniform actions."""
        return self.rng.uniform(-1.0, 1.0, shape).astype(np.float32)


@dataclass(frozen=True)
class Collected:
    """N episodes and how they ended."""

    episodes: Episodes
    success: NDArray[np.bool_]
    """Whether the last step met the goal, `[N]`."""
    final_distance: Floats
    """How far the last achieved goal was from the goal, as `Envs.remaining_distance` has it, `[N]`."""
    unstable: NDArray[np.bool_]
    """Whose physics came apart on the way, `[N]`; such an episode has failed."""

    def usable_episodes(self) -> Episodes:
        """Return N episodes to learn from: a stable one stands in for each unstable one, so that N stays what it is.

        Raises:
            TrainingDiverged: there is no stable one.
        """
        if not self.unstable.any():
            return self.episodes
        stable, unstable = np.flatnonzero(~self.unstable), np.flatnonzero(self.unstable)
        if not stable.size:
            raise TrainingDiverged(
                f"All {len(unstable)} simulations became unstable in one episode, so that there is nothing to learn "
                f"from; check the masses, gains and time step of the task's scene."
            )
        rows = np.arange(len(self.unstable))
        rows[unstable] = np.resize(stable, unstable.size)
        episodes = self.episodes
        return Episodes(episodes.obs[rows], episodes.achieved[rows], episodes.goal[rows], episodes.action[rows])


def collect_episodes(envs: Envs, act: Act, check: Check, watch: Watch | None = None) -> Collected:
    """Reset every simulation and run one episode in each.

    Raises:
        NonFinite: a number that was seen or done is not finite.
    """
    now = envs.reset()
    length, count = envs.episode_length, envs.num_envs
    obs = np.empty((count, length + 1, envs.obs_size), dtype=np.float32)
    achieved = np.empty((count, length + 1, envs.goal_size), dtype=np.float32)
    action = np.empty((count, length, envs.action_size), dtype=np.float32)
    goal = now.goal.astype(np.float32)
    show = watch or (lambda t, now: None)
    with _acting_threads():
        for t in range(length):
            show(t, now)
            obs[:, t], achieved[:, t] = now.obs, now.achieved
            action[:, t] = act(obs[:, t], goal)
            now = envs.step(action[:, t])
            check()
    show(length, now)
    obs[:, length], achieved[:, length] = now.obs, now.achieved
    episodes = Episodes(obs, achieved, goal, action)
    check_episodes(episodes)
    unstable = envs.unstable()
    if unstable.any():
        log.warning(
            "MuJoCo found simulations unstable (%s) and set them back in the middle of their episodes: these count as "
            "failed and are not learnt from.",
            ", ".join(str(index) for index in np.flatnonzero(unstable)),
        )
    return Collected(
        episodes,
        envs.success(now.achieved, now.goal) & ~unstable,
        envs.remaining_distance(now.achieved, now.goal).astype(np.float32),
        unstable,
    )


@contextmanager
def _acting_threads() -> Iterator[None]:
    """Give torch the threads of acting: a learner in another thread keeps those that `resolve_compute` gave it."""
    before = torch.get_num_threads()
    torch.set_num_threads(ACTING_THREADS)
    try:
        yield
    finally:
        torch.set_num_threads(before)


def numpy_policy(act: Callable[[torch.Tensor, torch.Tensor], torch.Tensor]) -> Act:
    """Wrap a policy on tensors as one on arrays."""
    return lambda obs, goal: act(torch.from_numpy(np.ascontiguousarray(obs)), torch.from_numpy(goal)).numpy()
