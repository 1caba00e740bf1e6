"""One simulation of a task and phase behind gymnasium's interface of goal environments."""

from __future__ import annotations

from typing import Any, ClassVar

import gymnasium
import numpy as np
from numpy.typing import NDArray

from sldr_core.config import Phase, Robot, Variant
from sldr_core.envs import Observation, make_envs
from sldr_core.errors import InvalidConfig

CONTROL_RATE = 25
"""Control steps per second."""

Seen = dict[str, Any]
"""What is seen, by name; arrays of float64."""


class SingleEnv(gymnasium.Env[Any, NDArray[np.float32]]):
    """Act with `[A]` and see `observation` `[D]`, `achieved_goal` and `desired_goal` `[G]`.

    It never terminates; gymnasium's time limit truncates it after the task's episode.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": [], "render_fps": CONTROL_RATE}

    def __init__(
        self,
        task: str,
        phase: Phase = "manipulation",
        robot: Robot = "auto",
        testing: bool = False,
        variant: Variant = "ours",
        render_mode: str | None = None,
    ) -> None:
        """Build the simulation; the arguments are those of `make_envs`.

        Raises:
            InvalidConfig: it is asked to render.
        """
        if render_mode is not None:
            raise InvalidConfig(
                {"render_mode": "these environments draw nothing; leave it out (`sldr viewer` shows policies in 3D)."}
            )
        seed = int(np.random.SeedSequence().generate_state(1)[0])
        self.envs = make_envs(task, phase, seed=seed, robot=robot, testing=testing, variant=variant)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (self.envs.action_size,), np.float32)
        self.observation_space = gymnasium.spaces.Dict(
            {
                "observation": _unbounded(self.envs.obs_size),
                "achieved_goal": _unbounded(self.envs.goal_size),
                "desired_goal": _unbounded(self.envs.goal_size),
            }
        )

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Seen, dict[str, Any]]:
        """Start a new episode; with a seed, the one that this seed stands for."""
        super().reset(seed=seed, options=options)
        if seed is not None:
            self.envs.reseed(seed)
        now = self.envs.reset()
        return _seen(now), self._info(now)

    def step(self, action: NDArray[np.float32]) -> tuple[Seen, float, bool, bool, dict[str, Any]]:
        """Advance by one control step."""
        now = self.envs.step(np.asarray(action)[None])
        reward = float(self.envs.reward(now.achieved, now.goal)[0])
        return _seen(now), reward, False, False, self._info(now)

    def compute_reward(
        self, achieved_goal: NDArray[np.floating], desired_goal: NDArray[np.floating], info: Any
    ) -> NDArray[np.float32]:
        """Return the reward of goals `[..., G]`, as `[...]`; `info` is not used."""
        return self.envs.reward(achieved_goal, desired_goal)

    def _info(self, now: Observation) -> dict[str, Any]:
        return {"is_success": float(self.envs.success(now.achieved, now.goal)[0])}


def _unbounded(size: int) -> gymnasium.spaces.Box:
    return gymnasium.spaces.Box(-np.inf, np.inf, (size,), np.float64)


def _seen(now: Observation) -> Seen:
    return {"observation": now.obs[0], "achieved_goal": now.achieved[0], "desired_goal": now.goal[0]}
