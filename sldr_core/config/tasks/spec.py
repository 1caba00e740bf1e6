"""What one task is made of: the records that the tasks' constants fill in.

Lengths in [m], angles in [rad], times in control steps of 0.04 s.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

Phase = Literal["locomotion", "manipulation"]
"""Who acts: the object on its own, or the robot."""

PHASES: tuple[Phase, ...] = ("locomotion", "manipulation")

Variant = Literal["ours", "original"]
"""Whose numbers a task has: the paper's, as we read it, or those of the authors' code."""

Vector = tuple[float, float, float]

_FROZEN = ConfigDict(extra="forbid", use_attribute_docstrings=True)


@dataclass(frozen=True, kw_only=True, config=_FROZEN)
class PositionGoals:
    """Score the positions of one or more objects, given as x, y, z after x, y, z."""

    distance: float
    """Success: every object is nearer to its goal than this [m]."""
    objects: int = 1
    """Positions in a goal."""
    joint_norm: bool = False
    """Whether one norm over the whole goal has to be below `distance` instead."""


@dataclass(frozen=True, kw_only=True, config=_FROZEN)
class PoseGoal:
    """Score one object's position and quaternion (w first), or only one of the two; `None` is not scored."""

    distance: float | None
    """Success: the object is nearer to its goal than this [m]."""
    angle: float | None
    """Success: the object is turned less than this from its goal [rad]; a quaternion's sign means nothing."""
    ignore_z: bool = False
    """Whether the third Euler angle is not scored: a pen may turn about its own axis."""
    seen_nearest: bool = True
    """Whether networks see, of all poses that count as the goal, the one that is nearest to the object.

    Goals of hindsight have the sign of the object's quaternion and are near in what does not count; others would hardly
    be learnt.
    """


@dataclass(frozen=True, kw_only=True, config=_FROZEN)
class TableScene:
    """Say what the scenes around the Fetch robot share."""

    model_file: str
    """The MJCF file of gymnasium-robotics that the scene starts from, below its assets folder."""
    start_base: Vector
    """Where the robot's base stands before the gripper is brought to its start: x, y, z slide [m]."""
    start_object: Vector
    """Where the object lies before each episode draws its own x and y [m]."""
    object_range: float
    """Half side of the square around the gripper in which objects start [m]."""
    target_range: float
    """Half side of the square around the gripper in which goals are drawn [m]."""
    gripper_extra_height: float
    """How far above its lowest start the gripper begins [m]."""
    gripper_blocked: bool
    """Whether the fingers are held shut."""


@dataclass(frozen=True, kw_only=True, config=_FROZEN)
class FetchScene(TableScene):
    """One object on a table."""

    family: Literal["fetch"] = "fetch"
    """Which builder and which parts the scene uses."""
    target_offset: Vector = (0.0, 0.0, 0.0)
    """Added to every goal [m]."""
    target_in_the_air: bool = False
    """Whether half of the goals float above the table, up to 0.45 m."""


@dataclass(frozen=True, kw_only=True, config=_FROZEN)
class StackScene(TableScene):
    """Several blocks on a table with a low wall around it."""

    family: Literal["stack"] = "stack"
    """Which builder and which parts the scene uses."""
    objects: int
    """Blocks."""
    wall_half_height: float
    """Half the height of the wall [m]."""
    object_spacing: float
    """Blocks start at least this far from each other, in the plane [m]."""
    level_height: float
    """From one block of a tower to the next [m]."""
    stack_probability: float
    """Share of training goals that are towers; the others lie on the table. Tests are towers only."""


@dataclass(frozen=True, kw_only=True, config=_FROZEN)
class Hinge:
    """Say how a block of a chain turns against the one before it, about the edge they share."""

    edge: Literal["top", "bottom"]
    """On which edge the axis lies; it points along y."""
    low: float
    """Least angle [rad]."""
    high: float
    """Greatest angle [rad]."""


@dataclass(frozen=True, kw_only=True, config=_FROZEN)
class Shape:
    """Say where the blocks of a chain have to be, relative to the goal's base point."""

    name: str
    """What the shape looks like."""
    offsets: tuple[tuple[float, float], ...]
    """x and z of each block, from the first [m]."""
    pitch: float
    """One way to reach it: the angle of the first block about y [rad]."""
    hinge_angles: tuple[float, ...]
    """One way to reach it: the angle of each hinge [rad]."""


@dataclass(frozen=True, kw_only=True, config=_FROZEN)
class TupleScene(TableScene):
    """A chain of hinged blocks on a table, lying flat along x at the start."""

    family: Literal["tuple"] = "tuple"
    """Which builder and which parts the scene uses."""
    hinges: tuple[Hinge, ...]
    """Hinges between the blocks, from the first."""
    shapes: tuple[Shape, ...]
    """Shapes that goals are drawn from, each as often as the others."""
    start_shift: float
    """Added to x of the first block's start [m]: it brings the chain's middle towards the gripper."""
    stay_on_table: bool
    """Whether starts and goals with a block beyond the table's edge are drawn again."""

    @property
    def objects(self) -> int:
        """Blocks of the chain."""
        return len(self.hinges) + 1


@dataclass(frozen=True, kw_only=True, config=_FROZEN)
class HandScene:
    """One object on the palm of the Shadow hand."""

    family: Literal["hand"] = "hand"
    """Which builder and which parts the scene uses."""
    model_file: str
    """The MJCF file of gymnasium-robotics that the scene starts from, below its assets folder."""
    target_position: Literal["ignore", "random"]
    """`random`: the goal's position is the start plus a draw from `target_range`; `ignore`: it is the start."""
    target_rotation: Literal["ignore", "xyz"]
    """`xyz`: the goal's rotation is drawn about any axis; `ignore`: it is the start's."""
    target_range: tuple[tuple[float, float], tuple[float, float], tuple[float, float]]
    """Least and greatest change of x, y, z [m]."""
    start_position_std: float
    """Deviation of the start's position from the model's own [m]."""
    start_rotation_random: bool
    """Whether the object starts turned by any angle about any axis, or as the model has it."""
    min_height: float
    """Starts whose object has fallen below this are drawn again [m]."""


Scene = Annotated[FetchScene | StackScene | TupleScene | HandScene, Field(discriminator="family")]


@dataclass(frozen=True, config=_FROZEN)
class Part:
    """Name a part of a task and whose locomotion model rewards it."""

    name: str
    """The part's name; its stream is `sldr/<name>`."""
    locomotion_task: str
    """The task in which the part's locomotion model is trained."""
    object_index: int
    """Which of the scene's objects it is."""


@dataclass(frozen=True, kw_only=True, config=_FROZEN)
class TaskSpec:
    """Say what one task is: its sizes, its scene and distributions, what counts as success."""

    name: str
    """The task's name, as in the paper."""
    goal_text: str
    """What the robot has to do, in one sentence for a person."""
    obs_size: int
    """Entries of the robot's observation s."""
    goal_size: int
    """Entries of a goal and of an achieved goal."""
    robot_action_size: int
    """Entries of a robot action, each in [-1, 1]."""
    object_action_size: int
    """Entries of an object action, each in [-1, 1]: change of position and quaternion, 7 for each mocap body."""
    object_state_size: int
    """Entries of what the object that acts sees of itself."""
    episode_length: int
    """Control steps of one episode."""
    scene: Scene
    """What is simulated, and how starts and goals are distributed."""
    goal: Annotated[PositionGoals | PoseGoal, Field(union_mode="left_to_right")]
    """What counts as success."""
    weld_torque_scale: float
    """Torque scale of the weld that moves the object, set so that it turns about 0.06 rad per step."""
    paper_epochs: int
    """Epochs of a manipulation run in the paper's protocol."""
    paper_locomotion_epochs: int
    """Epochs of a locomotion run in the paper's protocol."""
    quick_epochs: int = 40
    """Epochs of a manipulation run of the preset `quick`, at most: it ends once the robot has learnt."""
    quick_locomotion_epochs: int = 40
    """Epochs of a locomotion run of the preset `quick`, at most."""
    quick_locomotion_gamma: float = 0.95
    """Discount of a locomotion run of the preset `quick`: a short horizon is soon learnt, if it reaches the goals."""
    gamma: float
    """Discount of the manipulation phase."""
    locomotion_gamma: float
    """Discount of the locomotion phase."""
    lowest_return: float = 0.0
    """Lowest target of the task's critic in the manipulation phase; 0 where it is what the discount allows."""
    lowest_auxiliary_return: float = 0.0
    """Lowest target of the critics of all other rewards; 0 where it is that of the task's."""
    parts: tuple[Part, ...]
    """The parts that a locomotion model can reward, one critic for each."""
    original: Mapping[str, Any] = field(default_factory=dict[str, Any], hash=False)
    """What the authors' code has instead: values of this record, nested; `variant="original"` lays them over it."""

    @property
    def family(self) -> Literal["fetch", "stack", "tuple", "hand"]:
        """Which builder and which parts the task uses."""
        return self.scene.family

    @property
    def locomotion_tasks(self) -> tuple[str, ...]:
        """The tasks in which the locomotion models of its parts are trained, each once."""
        return tuple(dict.fromkeys(part.locomotion_task for part in self.parts))

    @property
    def success_distance(self) -> float | None:
        """How near every object has to be to its goal [m]; None where the position does not count."""
        return self.goal.distance

    @property
    def success_angle(self) -> float | None:
        """How near the object's rotation has to be to its goal [rad]; None where it does not count."""
        return self.goal.angle if isinstance(self.goal, PoseGoal) else None
