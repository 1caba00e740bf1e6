"""N simulations of one task and phase behind four verbs: reset, step, reward, success."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from sldr_core.config import Phase, RewardKind, TaskSpec
from sldr_core.envs.parts import EnvParts, Start
from sldr_core.envs.rewards import (
    REWARDS,
    Offsets,
    goal_gaps,
    goal_offsets,
    is_success,
    object_positions,
    remaining_distance,
)
from sldr_core.envs.scenes.welds import SUBSTEPS
from sldr_core.envs.simulation import Array, Ids


@dataclass(frozen=True)
class Observation:
    """What is seen after a reset or a step; the arrays are copies."""

    obs: Array
    """`[N, D]`."""
    achieved: Array
    """`[N, G]`."""
    goal: Array
    """`[N, G]`."""


class Envs:
    """Hold N simulations. An episode is `episode_length` steps; it never resets by itself.

    Attributes:
        qpos, qvel, mocap_pos, mocap_quat: live views `[N, ...]` of the simulations.
    """

    def __init__(
        self,
        *,
        spec: TaskSpec,
        phase: Phase,
        parts: EnvParts,
        bystander_moves: bool,
        reward: RewardKind,
        seed: int,
    ) -> None:
        self.spec = spec
        self.phase = phase
        self.simulation = simulation = parts.simulation
        self.num_envs = simulation.num_envs
        self.obs_size = spec.obs_size if phase == "manipulation" else spec.object_state_size
        self.goal_size = spec.goal_size
        self.action_size = spec.robot_action_size if phase == "manipulation" else spec.object_action_size
        self.episode_length = spec.episode_length
        self.qpos, self.qvel = simulation.qpos, simulation.qvel
        self.mocap_pos, self.mocap_quat = simulation.mocap_pos, simulation.mocap_quat
        self._actor, self._bystander, self._observer = parts.actor, parts.bystander, parts.observer
        self._starts, self._hold, self._marker = parts.starts, parts.hold, parts.marker
        self._bystander_moves = bystander_moves
        self._reward = REWARDS[reward]
        self._goal = np.zeros((self.num_envs, spec.goal_size))
        self.reseed(seed)
        self.reset()

    @property
    def model(self) -> mujoco.MjModel:
        """The scene's MuJoCo model."""
        return self.simulation.model

    def reseed(self, seed: int) -> None:
        """Let simulation `i` draw from a new generator of (`seed`, `i`) at its next reset."""
        self._rngs = [np.random.default_rng((seed, index)) for index in range(self.num_envs)]

    def reset(self, ids: ArrayLike | None = None) -> Observation:
        """Start new episodes in simulations `ids` (all if None); the others are left as they are."""
        chosen = np.sort(self._ids(ids))
        start = self.draw_starts([self._rngs[index] for index in chosen])
        self._goal[chosen] = start.goal
        self.simulation.reset(chosen, start.qpos, start.qvel)
        return self.observe()

    def draw_starts(self, rngs: Sequence[np.random.Generator]) -> Start:
        """Draw starts and goals of at most `N` episodes, one from each generator, and start none of them."""
        return self._starts.draw(rngs)

    def begin(self, start: Start, rngs: Sequence[np.random.Generator]) -> Observation:
        """Start episodes in all simulations from chosen starts `[N, ...]`; simulation `i` draws on from `rngs[i]`."""
        self._rngs = list(rngs)
        self.simulation.reset(self._ids(None), start.qpos, start.qvel)
        self.set_goal(start.goal)
        return self.observe()

    def step(self, action: ArrayLike) -> Observation:
        """Advance every simulation by one control step of 0.04 s.

        Args:
            action: `[N, A]`; values beyond [-1, 1] are clipped. Taken as float32, as the reference does.
        """
        clipped = np.clip(np.asarray(action, dtype=np.float32), -1.0, 1.0)
        if clipped.shape != (self.num_envs, self.action_size):
            raise ValueError(f"expected actions of shape {(self.num_envs, self.action_size)}, got {clipped.shape}")
        if self._bystander is not None:
            self._bystander.apply(self._bystander_action())
        self._actor.apply(clipped)
        self.simulation.step(SUBSTEPS)
        if self._hold is not None:
            self._hold.apply()
        return self.observe()

    def observe(self) -> Observation:
        """Return what is seen now."""
        return Observation(self._observer.observe(), self._observer.achieved(), self._goal.copy())

    def unstable(self) -> NDArray[np.bool_]:
        """Tell whose physics came apart since the last reset, `[N]`: what was seen of them since is not to be used."""
        return self.simulation.unstable()

    def reward(self, achieved: NDArray[np.floating], goal: NDArray[np.floating]) -> NDArray[np.float32]:
        """Return the reward, sparse or dense as ordered, of achieved and desired goals `[..., G]`, as `[...]`."""
        return self._reward(self.spec.goal, achieved, goal)

    def success(self, achieved: NDArray[np.floating], goal: NDArray[np.floating]) -> NDArray[np.bool_]:
        """Tell which achieved goals `[..., G]` count as success, as `[...]`."""
        return is_success(self.spec.goal, achieved, goal)

    def offsets(self, achieved: NDArray[np.floating], goal: NDArray[np.floating]) -> Offsets:
        """Return how far achieved goals `[..., G]` are from desired ones, as `[...]`."""
        return goal_offsets(self.spec.goal, achieved, goal)

    def remaining_distance(self, achieved: NDArray[np.floating], goal: NDArray[np.floating]) -> NDArray[np.floating]:
        """Return how far achieved goals `[..., G]` are from desired ones in one number each, as `[...]`."""
        return remaining_distance(self.spec.goal, achieved, goal)

    def object_positions(self, achieved: NDArray[np.floating]) -> NDArray[np.floating]:
        """Return the positions of the objects [m], `[..., O, 3]`, in achieved goals `[..., G]`."""
        return object_positions(self.spec.goal, achieved)

    def gaps(self, goals: NDArray[np.floating], others: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return distances `[..., M, N]` of goals `[..., M, G]` from others `[..., N, G]`, by what the task scores."""
        return goal_gaps(self.spec.goal, goals, others)

    def set_goal(self, goal: ArrayLike, ids: ArrayLike | None = None) -> None:
        """Replace the goals of simulations `ids` by `[len(ids), G]`, in the order of `ids`, or by one `[G]`."""
        chosen = self._ids(ids)
        self._goal[chosen] = goal
        if self._marker is not None:
            self._marker.show(chosen, self._goal[chosen])

    def state(self) -> dict[str, Any]:
        """Return everything that decides what comes next, at any moment: simulations, goals and generators."""
        return {
            "simulation": self.simulation.snapshot(),
            "goal": self._goal.copy(),
            "rngs": [rng.bit_generator.state for rng in self._rngs],
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from what `state` returned, to the last bit."""
        self.simulation.restore(state["simulation"])
        self._goal[:] = state["goal"]
        for rng, rng_state in zip(self._rngs, state["rngs"], strict=True):
            rng.bit_generator.state = rng_state

    def _ids(self, ids: ArrayLike | None) -> Ids:
        chosen = np.arange(self.num_envs) if ids is None else np.atleast_1d(np.asarray(ids, dtype=np.int64))
        if np.unique(chosen).size < chosen.size or not set(chosen) <= set(range(self.num_envs)):
            raise ValueError(f"ids have to be different numbers from 0 to {self.num_envs - 1}, got {chosen.tolist()}")
        return chosen

    def _bystander_action(self) -> NDArray[np.float32]:
        size = self.spec.robot_action_size
        if not self._bystander_moves:
            return np.zeros((self.num_envs, size), dtype=np.float32)
        return np.stack([rng.uniform(-1.0, 1.0, size) for rng in self._rngs]).astype(np.float32)
