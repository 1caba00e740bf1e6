"""What the object's critic Q_nu thinks of a slice of positions, goals, rotations or actions, all else as it is now.

`M` points of a slice, `Z` object state, `G` goal, `A` object action.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import torch
from numpy.typing import NDArray

from sldr_core.config import PoseGoal, TaskSpec
from sldr_core.envs.rotations import multiply_quaternions, quaternion_from_vector
from sldr_core.nets.locomotion_model import LocomotionNets
from sldr_core.records import Floats

SliceKind = Literal["position", "goal", "turn", "action"]
"""What is varied: where the object is, where its goal is, how it is turned, or what it does."""

POINTS = 25
"""Points along one side of a slice."""

ROTATION_ACTION = 4
"""Where the three turning entries of an object action begin: position 3, then the quaternion's w, x, y, z."""

MOCAP_ACTION = 7
"""Entries of an action for each body that is pulled."""

_HAND_POSITION = slice(6, 9)
_HAND_QUATERNION = slice(9, 13)

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Slice:
    """Say which plane of what is looked at."""

    kind: SliceKind
    axes: tuple[int, int]
    """Across and up: 0, 1, 2 for x, y, z; of actions 3, 4, 5 are the turns about them."""
    across: tuple[float, float]
    """Least and greatest value across [m], [rad], or of the action."""
    up: tuple[float, float]
    """Least and greatest value up."""
    body: int = 0
    """Which of the bodies that are pulled acts, where there are several."""
    points: int = POINTS

    def grid(self) -> tuple[Array, Array]:
        """Return the values across and up, `[points]` each."""
        return np.linspace(*self.across, self.points), np.linspace(*self.up, self.points)

    def vectors(self, here: Array) -> Array:
        """Return all points of the plane through `here` `[3]`, row by row, `[M, 3]`."""
        across, up = np.meshgrid(*self.grid())
        vectors = np.tile(here, (across.size, 1))
        vectors[:, self.axes[0]], vectors[:, self.axes[1]] = across.ravel(), up.ravel()
        return vectors


@dataclass(frozen=True)
class Landscape:
    """Hold what the critic says of a slice."""

    slice: Slice
    value: Floats
    """`[points up, points across]`."""
    here: tuple[float, float]
    """What is the case now, across and up."""
    now: float
    """The value of that."""


def evaluate_slice(nets: LocomotionNets, task: TaskSpec, plane: Slice, state: Array, goal: Array) -> Landscape:
    """Return Q_nu over a slice through the present moment.

    Of a state or goal it is Q(z, nu(z, g), g), how good it is to be there; of an action it is Q(z, a, g).

    Args:
        nets: the object's networks.
        task: the task in which it learnt.
        plane: the slice.
        state: what the object sees of itself now, `[Z]`.
        goal: `[G]`.
    """
    wanted = wanted_action(nets, state[None], goal[None])
    now = float(values_of(nets, state[None], goal[None], wanted)[0])
    here = _here(task, plane, state, goal, wanted[0])
    vectors = plane.vectors(here[:3]) if plane.kind != "action" else np.empty((0, 3))
    if plane.kind == "action":
        value = values_of(nets, state[None], goal[None], _varied_actions(plane, wanted[0]))
    elif plane.kind == "goal":
        value = values_of(nets, state[None], moved_goals(task, goal, vectors))
    elif plane.kind == "turn":
        value = values_of(nets, turned_states(state, quaternion_from_vector(vectors)), goal[None])
    else:
        value = values_of(nets, moved_states(task, state, vectors), goal[None])
    centre = (float(here[plane.axes[0]]), float(here[plane.axes[1]]))
    return Landscape(plane, value.reshape(plane.points, plane.points), centre, now)


def evaluate_turns(nets: LocomotionNets, state: Array, goal: Array, directions: Array, angle: float) -> Floats:
    """Return Q_nu of the object in the hand turned by `angle` [rad] about each of the axes `[M, 3]`, `[M]`."""
    return values_of(nets, turned_states(state, quaternion_from_vector(angle * directions)), goal[None])


@torch.no_grad()
def wanted_action(nets: LocomotionNets, state: NDArray[np.floating], goal: NDArray[np.floating]) -> Floats:
    """Return u = nu(z, g) `[N, A]` of states `[N, Z]` and goals `[N, G]`."""
    return nets.action(nets.features(_tensor(state), _tensor(goal))).numpy()


@torch.no_grad()
def values_of(
    nets: LocomotionNets,
    state: NDArray[np.floating],
    goal: NDArray[np.floating],
    action: NDArray[np.floating] | None = None,
) -> Floats:
    """Return Q_nu(z, a, g), `[M]`; `a` is what the object would do if it is not given.

    Args:
        nets: the object's networks.
        state: `[M, Z]`, or one for all.
        goal: `[M, G]`, or one for all.
        action: `[M, A]`, or one for all.
    """
    count = max(len(part) for part in (state, goal, action) if part is not None)
    features = nets.features(_tensor(state).expand(count, -1), _tensor(goal).expand(count, -1))
    chosen = nets.action(features) if action is None else _tensor(action).expand(count, -1)
    return nets.value(features, chosen).numpy()


def moved_states(task: TaskSpec, state: Array, places: Array) -> Array:
    """Return `state` `[Z]` with the object, of a chain its first block, at each of `places` `[M, 3]`; `[M, Z]`."""
    moved = np.tile(state, (len(places), 1))
    if task.family == "hand":
        moved[:, _HAND_POSITION] = places
        return moved
    positions = moved[:, : len(state) // 4].reshape(len(places), -1, 3)
    positions += (places - state[:3])[:, None]
    return moved


def turned_states(state: Array, turns: Array) -> Array:
    """Return the state `[13]` of an object in the hand turned, about the world's axes, by quaternions `[M, 4]`."""
    turned = np.tile(state, (len(turns), 1))
    turned[:, _HAND_QUATERNION] = multiply_quaternions(turns, state[_HAND_QUATERNION])
    return turned


def moved_goals(task: TaskSpec, goal: Array, places: Array) -> Array:
    """Return `goal` `[G]` moved so that its (first) position is at each of `places` `[M, 3]`; `[M, G]`."""
    moved = np.tile(goal, (len(places), 1))
    if isinstance(task.goal, PoseGoal):
        moved[:, :3] = places
        return moved
    positions = moved.reshape(len(places), -1, 3)
    positions += (places - goal[:3])[:, None]
    return moved


def action_entry(axis: int, body: int) -> int:
    """Return the entry of an action that moves along axis 0 to 2, or turns about axis 3 to 5, one of the bodies."""
    return MOCAP_ACTION * body + (axis if axis < 3 else ROTATION_ACTION + axis - 3)


def _varied_actions(plane: Slice, wanted: Floats) -> Floats:
    across, up = np.meshgrid(*plane.grid())
    actions = np.tile(wanted, (across.size, 1))
    for axis, values in zip(plane.axes, (across, up), strict=True):
        actions[:, action_entry(axis, plane.body)] = values.ravel()
    return actions


def _here(task: TaskSpec, plane: Slice, state: Array, goal: Array, wanted: Floats) -> Array:
    """Return what is the case now, by the numbers of the axes."""
    if plane.kind == "action":
        return np.array([wanted[action_entry(axis, plane.body)] for axis in range(6)], dtype=np.float64)
    if plane.kind == "turn":
        return np.zeros(3)
    if plane.kind == "goal":
        return goal[:3]
    return state[_HAND_POSITION] if task.family == "hand" else state[:3]


def _tensor(values: NDArray[np.floating]) -> torch.Tensor:
    return torch.from_numpy(np.ascontiguousarray(values, dtype=np.float32))
