"""The tasks: every number that tells one from another, as data.

Lengths in [m], angles in [rad], times in control steps of 0.04 s.
A new task is one `TaskSpec` in `TASKS` and, if its scene is new, one file in `sldr_core/envs/scenes`.
"""

from __future__ import annotations

from typing import Literal

from pydantic import ConfigDict
from pydantic.dataclasses import dataclass

from sldr_core.errors import UnknownName

Phase = Literal["locomotion", "manipulation"]
"""Who acts: the object on its own, or the robot."""

PHASES: tuple[Phase, ...] = ("locomotion", "manipulation")

_FROZEN = ConfigDict(extra="forbid", use_attribute_docstrings=True)


@dataclass(frozen=True, config=_FROZEN)
class TaskSpec:
    """Say what one task is: its sizes, its distributions, what counts as success."""

    name: str
    """The task's name, as in the paper."""
    family: Literal["fetch"]
    """Which scene builder, observation and action layout it uses."""
    model_file: str
    """The MJCF file of gymnasium-robotics that the scene starts from, below its assets folder."""
    goal_text: str
    """What the robot has to do, in one sentence for a person."""
    obs_size: int
    """Entries of the robot's observation s."""
    goal_size: int
    """Entries of a goal and of an achieved goal."""
    robot_action_size: int
    """Entries of a robot action, each in [-1, 1]."""
    object_action_size: int
    """Entries of an object action, each in [-1, 1]: position and quaternion change."""
    episode_length: int
    """Control steps of one episode."""
    success_distance: float
    """An episode succeeds if its last achieved goal is nearer to the goal than this [m]."""
    start_base: tuple[float, float, float]
    """Where the robot's base stands before the gripper is brought to its start: x, y, z slide [m]."""
    start_object: tuple[float, float, float]
    """Where the object lies before each episode draws its own x and y [m]."""
    object_range: float
    """Half side of the square around the gripper in which the object starts [m]."""
    target_range: float
    """Half side of the square around the gripper in which goals are drawn [m]."""
    target_offset: tuple[float, float, float]
    """Added to every goal [m]."""
    target_in_the_air: bool
    """Whether half of the goals float above the table, up to 0.45 m."""
    gripper_extra_height: float
    """How far above its lowest start the gripper begins [m]."""
    gripper_blocked: bool
    """Whether the fingers are held shut."""
    weld_torque_scale: float
    """Torque scale of the weld that moves the object, set so that it turns about 0.06 rad per step."""
    paper_epochs: int
    """Epochs of a manipulation run in the paper's protocol."""
    paper_locomotion_epochs: int
    """Epochs of a locomotion run in the paper's protocol."""
    gamma: float
    """Discount of the manipulation phase."""
    locomotion_gamma: float
    """Discount of the locomotion phase."""


FETCH_PUSH = TaskSpec(
    name="FetchPush",
    family="fetch",
    model_file="fetch/push.xml",
    goal_text="Push the block across the table to the red target; the gripper stays shut.",
    obs_size=25,
    goal_size=3,
    robot_action_size=4,
    object_action_size=7,
    episode_length=50,
    success_distance=0.05,
    start_base=(0.405, 0.48, 0.0),
    start_object=(1.25, 0.53, 0.4),
    object_range=0.15,
    target_range=0.15,
    target_offset=(0.0, 0.0, 0.0),
    target_in_the_air=False,
    gripper_extra_height=0.0,
    gripper_blocked=True,
    weld_torque_scale=10.0,
    paper_epochs=50,
    paper_locomotion_epochs=20,
    gamma=0.98,
    locomotion_gamma=0.98,
)

TASKS: dict[str, TaskSpec] = {spec.name: spec for spec in (FETCH_PUSH,)}


def find_task(name: str) -> TaskSpec:
    """Return the spec of a task.

    Raises:
        UnknownName: no task is called `name`.
    """
    if name not in TASKS:
        raise UnknownName("task", name, TASKS)
    return TASKS[name]
