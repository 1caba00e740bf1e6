"""What a Rerun file of a run shows, as plain numbers: curves, episodes and lines of the log.

`T` steps of an episode, `S` reward streams.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from sldr_core.records import Step

Curves = Mapping[str, Sequence[float | None]]
"""Values per metric `group/name`, as long as the steps; None or NaN where a metric was not logged."""

Solid = Literal["box", "ellipsoid", "capsule", "cylinder"]
"""The forms of which scenes are made; what is a mesh in the model is left out."""


@dataclass(frozen=True)
class Form:
    """One solid of a body."""

    solid: Solid
    half_size: tuple[float, float, float]
    """Box and ellipsoid: half the length of each axis. Others: radius, half the length, nothing [m]."""
    position: tuple[float, float, float]
    """In the body's frame [m]."""
    quaternion: tuple[float, float, float, float]
    """In the body's frame, w first."""
    rgba: tuple[float, float, float, float]


@dataclass(frozen=True)
class Body:
    """One body of a scene, and where it is at each moment."""

    name: str
    forms: tuple[Form, ...]
    position: NDArray[np.float64]
    """`[T+1, 3]` [m]; one row if it never moves."""
    quaternion: NDArray[np.float64]
    """`[T+1, 4]`, w first; one row if it never moves."""


@dataclass(frozen=True)
class Arrow:
    """A direction at each step, drawn where it applies."""

    name: str
    origin: NDArray[np.float64]
    """`[T, 3]` [m]."""
    vector: NDArray[np.float64]
    """`[T, 3]` [m]."""
    rgb: tuple[int, int, int]


@dataclass(frozen=True)
class Eye:
    """Where the scene is looked at from."""

    position: tuple[float, float, float]
    look_at: tuple[float, float, float]


@dataclass(frozen=True)
class EpisodeScene:
    """One recorded episode in 3D, with the rewards that it earned."""

    path: str
    """Below which its entities stand, as in `scenes/epoch-0012/0`."""
    title: str
    env_steps: int
    """Control steps of training when it was recorded."""
    bodies: tuple[Body, ...]
    bones: NDArray[np.float64]
    """The robot as lines between its joints, `[T+1, bones, 2, 3]` [m]."""
    goals: NDArray[np.float64]
    """Where objects are to go, `[goals, 3]` [m]; none where the goal is a body of the scene."""
    paths: Mapping[str, NDArray[np.float64]]
    """The way of each object, `[T+1, 3]` [m]."""
    demonstrations: Mapping[str, NDArray[np.float64]]
    """The way that each object would have taken by itself from the same start, `[*, 3]` [m]; empty where unknown."""
    arrows: tuple[Arrow, ...]
    """What objects wanted, and what the robot made them do."""
    series: Mapping[str, NDArray[np.float32]]
    """Reward and Q of each stream, each `[T]`."""
    eye: Eye


@dataclass(frozen=True)
class LogLine:
    """One line that the run's processes have said."""

    env_steps: int
    """Control steps of training by then, as far as the log tells."""
    text: str


@dataclass(frozen=True)
class Recording:
    """All that a Rerun file of a run shows."""

    title: str
    steps: Sequence[Step]
    """How far the training was at each point."""
    curves: Curves
    episodes: Sequence[EpisodeScene] = ()
    log: Sequence[LogLine] = ()
