"""The parts that an environment is made of, whatever its family.

`N` simulations, `D` observation, `G` goal, `A` action.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from sldr_core.envs.simulation import Array, Ids, Mocap, Simulation

OBJECT_SPEED = np.float32(0.05)
"""Change of an object's target per control step at full action [m, and raw quaternion units]."""

POSE_CHANGE = 7
"""Entries of an action for each mocap body: position 3, quaternion 4."""


class Actuation(Protocol):
    """Turn actions into targets of the physics."""

    def apply(self, action: NDArray[np.float32]) -> None:
        """Set the targets for the next control step from actions `[N, A]` in [-1, 1]."""
        ...


class Observer(Protocol):
    """Read observations and achieved goals off the scene."""

    def observe(self) -> Array:
        """Return observations `[N, D]`."""
        ...

    def achieved(self) -> Array:
        """Return achieved goals `[N, G]`."""
        ...


class Hold(Protocol):
    """Keep something in its place after each control step."""

    def apply(self) -> None:
        """Write it."""
        ...


class Marker(Protocol):
    """Show goals in the scene."""

    def show(self, ids: Ids, goal: Array) -> None:
        """Put the marks of simulations `ids` to goals `[len(ids), G]`."""
        ...


@dataclass(frozen=True)
class Start:
    """Where episodes start and what they are to reach: of one, or of `N` with a leading axis."""

    qpos: Array
    """`[nq]`."""
    qvel: Array
    """`[nv]`."""
    goal: Array
    """`[G]`."""


class Starts(Protocol):
    """Draw starts and goals."""

    def draw(self, rngs: Sequence[np.random.Generator]) -> Start:
        """Draw the starts of `N` episodes, `[N, ...]`; each depends on nothing but its own generator."""
        ...


def stack_starts(starts: Sequence[Start]) -> Start:
    """Return the starts of single episodes as those of `N`."""
    return Start(
        qpos=np.stack([start.qpos for start in starts]),
        qvel=np.stack([start.qvel for start in starts]),
        goal=np.stack([start.goal for start in starts]),
    )


@dataclass(frozen=True)
class EnvParts:
    """What a family's builder puts together for one task and phase."""

    simulation: Simulation
    actor: Actuation
    """The one who acts."""
    bystander: Actuation | None
    """The robot in locomotion, where it is in the scene."""
    observer: Observer
    """What the one who acts sees."""
    starts: Starts
    hold: Hold | None
    marker: Marker | None = None
    """What shows goals that are set by hand, where goals are bodies of the scene."""


class ObjectActuation:
    """Move bodies by their mocap welds: position change and raw quaternion change of each (paper §5)."""

    def __init__(self, mocaps: Sequence[Mocap]) -> None:
        self._mocaps = tuple(mocaps)

    def apply(self, action: NDArray[np.float32]) -> None:
        """Set the targets of every mocap from `[N, 7 for each]`."""
        for mocap, change in zip(self._mocaps, np.split(action, len(self._mocaps), axis=1), strict=True):
            mocap.pull(OBJECT_SPEED * change[:, :3], OBJECT_SPEED * change[:, 3:POSE_CHANGE])
