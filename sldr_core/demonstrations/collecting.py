"""Making demonstrations: a fan of many, one control step of one block after the other, or one to look at closely.

`N` demonstrations, `T` steps, `Z` object state, `G` goal, `A` object action.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sldr_core.demonstrations.starts import Drawn, StartSource
from sldr_core.envs import Envs, Observation, Start
from sldr_core.records import Floats

BLOCK = 24
"""Demonstrations side by side. One number for all: networks round otherwise in batches of other sizes."""

MOST = 1_920
"""Demonstrations of one fan at most."""

Act = Callable[[Floats, Floats], Floats]
"""Return actions `[N, A]` of object states `[N, Z]` and goals `[N, G]`."""


@dataclass(frozen=True)
class Fan:
    """Hold `N` demonstrations, enough of each to see where it led and to make it again."""

    seed: int
    start: Start
    """Where each began and what it was to reach, `[N, ...]`."""
    achieved: NDArray[np.float64]
    """Achieved goals, `[N, T+1, G]`."""
    action: Floats
    """`[N, T, A]`."""
    reached: NDArray[np.bool_]
    """Whether the goal was met at each moment, `[N, T+1]`."""

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.achieved)


@dataclass(frozen=True)
class Demonstration:
    """Hold what `N` objects, mostly one, did at every moment."""

    start: Start
    qpos: NDArray[np.float64]
    """Joint positions of the scene, `[N, T+1, nq]`."""
    state: Floats
    """What the object saw of itself, `[N, T+1, Z]`."""
    achieved: NDArray[np.float64]
    """Achieved goals, `[N, T+1, G]`."""
    action: Floats
    """`[N, T, A]`."""
    reached: NDArray[np.bool_]
    """Whether the goal was met at each moment, `[N, T+1]`."""

    @property
    def steps(self) -> int:
        """Control steps, `T`."""
        return self.action.shape[1]


class FanCollection:
    """Collect a fan by and by: between two control steps a viewer can do something else."""

    def __init__(self, envs: Envs, act: Act, source: StartSource, seed: int, count: int, first: int = 0) -> None:
        """Make ready.

        Args:
            envs: `BLOCK` simulations of the object alone.
            act: what the object does.
            source: where the starts come from.
            seed: seed of all starts.
            count: how many, a multiple of `BLOCK`.
            first: number of the first, a multiple of `BLOCK`.

        Raises:
            ValueError: a number that is no multiple, or too many.
        """
        if envs.num_envs != BLOCK or count % BLOCK or first % BLOCK or not 0 < count <= MOST:
            raise ValueError(f"a fan is made of blocks of {BLOCK}, up to {MOST}; got {count} from {first} on")
        self.count = count
        self.seed = seed
        self._envs, self._act, self._source = envs, act, source
        self._first = first
        self._blocks: list[Demonstration] = []
        self._current: _Recording | None = None

    @property
    def done(self) -> int:
        """How many are complete."""
        return BLOCK * len(self._blocks)

    def advance(self) -> bool:
        """Draw the next block's starts, or make one control step of it; tell whether there is more to do."""
        if self.done >= self.count:
            return False
        if self._current is None:
            first = self._first + self.done
            self._current = _Recording(self._envs, self._source.draw(self.seed, range(first, first + BLOCK)))
        elif not self._current.is_over:
            self._current.step(self._act)
        if self._current.is_over:
            self._blocks.append(self._current.close(keep_states=False))
            self._current = None
        return self.done < self.count

    def fan(self) -> Fan:
        """Return what is complete.

        Raises:
            ValueError: nothing is.
        """
        starts = [block.start for block in self._blocks]
        return Fan(
            self.seed,
            Start(
                qpos=_join([start.qpos for start in starts]),
                qvel=_join([start.qvel for start in starts]),
                goal=_join([start.goal for start in starts]),
            ),
            _join([block.achieved for block in self._blocks]),
            _join([block.action for block in self._blocks]),
            _join([block.reached for block in self._blocks]),
        )


def demonstrate(envs: Envs, drawn: Drawn, act: Act, given: Floats | None = None) -> Demonstration:
    """Make a demonstration in every simulation and keep every moment of it.

    Args:
        envs: as many simulations as `drawn` has starts.
        drawn: where they begin.
        act: what the object does.
        given: what it does instead, `[N, T, A]`: the actions of an earlier demonstration give that one again,
            to the last bit.
    """
    recording = _Recording(envs, drawn)
    while not recording.is_over:
        recording.step(act if given is None else _read_from(given, recording.taken))
    return recording.close(keep_states=True)


class _Recording:
    """Run one demonstration in every simulation and write down what is seen."""

    def __init__(self, envs: Envs, drawn: Drawn) -> None:
        count, length = envs.num_envs, envs.episode_length
        self._envs, self._start = envs, drawn.start
        self._qpos = np.empty((count, length + 1, envs.model.nq))
        self._state = np.empty((count, length + 1, envs.obs_size), dtype=np.float32)
        self._achieved = np.empty((count, length + 1, envs.goal_size))
        self._action = np.empty((count, length, envs.action_size), dtype=np.float32)
        self._goal = drawn.start.goal.astype(np.float32)
        self.taken = 0
        self._write(envs.begin(drawn.start, drawn.rngs))

    @property
    def is_over(self) -> bool:
        """Whether every step was taken."""
        return self.taken >= self._action.shape[1]

    def step(self, act: Act) -> None:
        """Take one control step."""
        action = act(self._state[:, self.taken], self._goal)
        self._action[:, self.taken] = action
        seen = self._envs.step(action)
        self.taken += 1
        self._write(seen)

    def close(self, keep_states: bool) -> Demonstration:
        """Return what was written down, with or without what only a close look needs."""
        kept = slice(None) if keep_states else slice(0)
        goal = self._start.goal[:, None]
        return Demonstration(
            self._start,
            self._qpos[:, kept],
            self._state[:, kept],
            self._achieved,
            self._action,
            self._envs.success(self._achieved, np.broadcast_to(goal, self._achieved.shape)),
        )

    def _write(self, seen: Observation) -> None:
        self._qpos[:, self.taken] = self._envs.qpos
        self._state[:, self.taken], self._achieved[:, self.taken] = seen.obs, seen.achieved


def _read_from(given: Floats, step: int) -> Act:
    return lambda state, goal: given[:, step]


def _join(parts: Sequence[NDArray]) -> NDArray:
    if not parts:
        raise ValueError("no demonstration is complete yet")
    return np.concatenate(parts)
