"""What is kept of a test's episodes: every state, what was seen and done, and what each stream and critic said.

`T` steps, `K` simulation state, `D` observation, `G` goal, `A` action, `S` streams, `P` parts that a locomotion model
rewards, `U` object action, `O` objects.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sldr_core.episodes.tags import Tag
from sldr_core.records import Floats

Doubles = NDArray[np.float64]
Flags = NDArray[np.bool_]

SLDR_PREFIX = "sldr/"
"""Streams of this name hold q_t, how the robot's move compares with what the object wanted."""


@dataclass(frozen=True)
class Origin:
    """Say which policy made the episodes, and what the columns of their arrays are."""

    config: Mapping[str, Any]
    """The training's config as plain values; `sldr_core.config.config_from_dict` reads it."""
    config_hash: str
    epoch: int
    """Epochs trained when the test was held."""
    env_steps: int
    """Control steps of training episodes by then."""
    streams: tuple[str, ...]
    """Names of the reward streams, the columns of rewards and values."""
    parts: tuple[str, ...]
    """Parts that a locomotion model rewards, the columns of wanted and induced actions; none without SLDR."""
    objects: tuple[str, ...]
    """Bodies of the objects, the columns of contacts."""


@dataclass(frozen=True)
class Course:
    """The course of one whole episode. Transition `t` leads from moment `t` to moment `t + 1`."""

    index: int
    """Number of the episode in its test, from 0."""
    tag: Tag
    """What went wrong, or `success`."""
    start_state: Doubles
    """Everything to simulate on from, `[K]`: a row of `Simulation.snapshot()` before the first step."""
    rng_state: Mapping[str, Any]
    """State of the simulation's generator before the first step; only a robot that acts at random draws from it."""
    qpos: Doubles
    """Joint positions, `[T+1, nq]`."""
    qvel: Doubles
    """Joint velocities, `[T+1, nv]`."""
    obs: Floats
    """Observations, `[T+1, D]`."""
    goal: Doubles
    """The goal, `[G]`; the policy and the streams saw it as float32."""
    achieved: Floats
    """Achieved goals, `[T+1, G]`."""
    action: Floats
    """Actions of the one who acts, `[T, A]`."""
    contact: Flags
    """Whether the robot touches each object, `[T+1, O]`."""
    distance: Doubles
    """Largest distance of an object from its goal [m], `[T+1]`."""
    angle: Doubles
    """Angle between the object's rotation and its goal's [rad], `[T+1]`; NaN where the goal has no rotation."""
    success: Flags
    """Whether the goal is reached, `[T+1]`; the last one decides."""

    @property
    def length(self) -> int:
        """Steps of the episode, `T`."""
        return len(self.action)


@dataclass(frozen=True)
class RecordedEpisode(Course):
    """The course of an episode of the deterministic policy, with what the training's streams and critics say of it."""

    resimulates: bool
    """Whether start and actions alone gave the same states again, to the last bit, right after it was recorded."""
    reward: Floats
    """Reward of each stream under the original goal, `[T, S]`."""
    value: Floats
    """Q of each stream's critic for the observation, the goal and the action, `[T, S]`."""
    wanted: Floats
    """u = nu(z, g), what each part wanted to do, `[T, P, U]`."""
    induced: Floats
    """w = I(z, z'), what the robot made it do, `[T, P, U]`."""


@dataclass(frozen=True)
class EpisodeSummary:
    """Describe one recorded episode in a row of a table."""

    epoch: int
    index: int
    success: bool
    tag: Tag
    task_return: float
    """Sum of the task's rewards."""
    worst_q: float | None
    """Least reward of any SLDR stream; None without one."""
    worst_q_step: int | None
    """The transition it was given for."""
    length: int
    """Steps."""
    resimulates: bool


@dataclass(frozen=True)
class RecordedTest:
    """The first episodes of one test, all of the same shapes: what one file holds."""

    origin: Origin
    episodes: tuple[RecordedEpisode, ...]

    def summaries(self) -> tuple[EpisodeSummary, ...]:
        """Return a row for each episode."""
        return tuple(self._summary(episode) for episode in self.episodes)

    def _summary(self, episode: RecordedEpisode) -> EpisodeSummary:
        worst_q, worst_q_step = worst_q_of(self.origin.streams, episode.reward)
        return EpisodeSummary(
            epoch=self.origin.epoch,
            index=episode.index,
            success=bool(episode.success[-1]),
            tag=episode.tag,
            task_return=float(episode.reward[:, self.origin.streams.index("task")].sum(dtype=np.float64)),
            worst_q=worst_q,
            worst_q_step=worst_q_step,
            length=episode.length,
            resimulates=episode.resimulates,
        )


def worst_q_of(streams: tuple[str, ...], reward: Floats) -> tuple[float | None, int | None]:
    """Return the least q of rewards `[T, S]` and its first step; None without an SLDR stream."""
    columns = [column for column, name in enumerate(streams) if name.startswith(SLDR_PREFIX)]
    if not columns:
        return None, None
    q = reward[:, columns].min(axis=1)
    step = int(q.argmin())
    return float(q[step]), step
