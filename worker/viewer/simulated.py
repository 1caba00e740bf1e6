"""Episodes that are simulated as far as they are looked at; any moment can be gone back to, and changed.

`N` simulations side by side ("lanes") under one policy. `D` observation, `G` goal, `A` action.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sldr_core.envs import Envs, Observation

Array = NDArray[np.float64]
Act = Callable[[Array, Array], NDArray[np.float32]]
"""Return actions `[N, A]` of observations `[N, D]` and goals `[N, G]`."""


@dataclass(frozen=True)
class Moment:
    """One episode at one control step; the arrays are copies."""

    qpos: Array
    """`[nq]`."""
    qvel: Array
    """`[nv]`."""
    obs: Array
    """`[D]`."""
    achieved: Array
    """`[G]`."""
    goal: Array
    """`[G]`."""


@dataclass(frozen=True)
class _Known:
    """All lanes at one control step, and all that decides what comes next."""

    moments: tuple[Moment, ...]
    reached: NDArray[np.bool_]
    """Whether each lane meets its goal, `[N]`."""
    state: dict[str, Any]


class Simulated:
    """Simulate one episode in every lane, on demand.

    Attributes:
        envs: the simulations; they stand at the last known step.
        steps: control steps of an episode.
        version: counts the changes of what was known: new episodes and branches.
    """

    def __init__(self, envs: Envs, act: Act, begin: Callable[[Envs], object] = Envs.reset) -> None:
        """Begin the first episode.

        Args:
            envs: the simulations, which belong to this object from now on.
            act: what is done in them.
            begin: puts every simulation to a new start.
        """
        self.envs = envs
        self.steps = envs.episode_length
        self.version = 0
        self._act, self._begin = act, begin
        self._known: list[_Known] = []
        self._actions: list[NDArray[np.float32]] = []
        self.restart()

    @property
    def lanes(self) -> int:
        """Episodes side by side, `N`."""
        return self.envs.num_envs

    @property
    def known(self) -> int:
        """The last step that has been simulated."""
        return len(self._known) - 1

    def restart(self) -> None:
        """Begin a new episode in every lane, from new starts and toward new goals."""
        self._begin(self.envs)
        self._known, self._actions = [self._see(self.envs.observe())], []
        self.version += 1

    def moment(self, step: int, lane: int = 0) -> Moment:
        """Return a lane at a step, which is simulated if it was not."""
        self.simulate_to(step)
        return self._known[step].moments[lane]

    def action(self, step: int, lane: int = 0) -> NDArray[np.float32]:
        """Return the action that led from a step to the next, `[A]`."""
        self.simulate_to(step + 1)
        return self._actions[step][lane]

    def is_reached(self, step: int, lane: int = 0) -> bool:
        """Tell whether the goal is met at a step."""
        self.simulate_to(step)
        return bool(self._known[step].reached[lane])

    def simulate_to(self, step: int) -> None:
        """Simulate up to a step, at most to the episode's end."""
        while self.known < min(step, self.steps):
            now = self._known[-1].moments
            obs, goal = (np.stack([getattr(lane, name) for lane in now]) for name in ("obs", "goal"))
            action = self._act(obs, goal)
            seen = self.envs.step(action)
            self._actions.append(np.asarray(action, dtype=np.float32).copy())
            self._known.append(self._see(seen))

    def branch(self, step: int, change: Callable[[Envs], None]) -> None:
        """Go back to a known step, change something there, and forget what came after."""
        self.simulate_to(step)
        del self._known[step + 1 :], self._actions[step:]
        self.envs.restore(self._known[step].state)
        change(self.envs)
        self._known[step] = self._see(self.envs.observe())
        self.version += 1

    def _see(self, seen: Observation) -> _Known:
        envs = self.envs
        moments = tuple(
            Moment(envs.qpos[lane].copy(), envs.qvel[lane].copy(), seen.obs[lane], seen.achieved[lane], seen.goal[lane])
            for lane in range(envs.num_envs)
        )
        return _Known(moments, envs.success(seen.achieved, seen.goal), envs.state())
