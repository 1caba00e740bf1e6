"""The tasks of folding a chain of hinged blocks into a shape."""

from __future__ import annotations

from math import pi

from sldr_core.config.tasks.spec import Hinge, Part, PositionGoals, Shape, TaskSpec, TupleScene

_TOP = Hinge(edge="top", low=-pi, high=0.0)
"""Folds the rest of the chain upwards."""

_BOTTOM = Hinge(edge="bottom", low=0.0, high=pi)
"""Folds the rest of the chain downwards."""

_HALF = pi / 2


def _tuple(
    hinges: tuple[Hinge, ...],
    shapes: tuple[Shape, ...],
    goal_text: str,
    paper_epochs: int,
    paper_locomotion_epochs: int,
) -> TaskSpec:
    blocks = len(hinges) + 1
    name = f"FetchTuple{blocks}"
    return TaskSpec(
        name=name,
        goal_text=goal_text,
        obs_size=10 + 15 * blocks,
        goal_size=3 * blocks,
        robot_action_size=4,
        object_action_size=14,
        object_state_size=12 * blocks,
        episode_length=50,
        scene=TupleScene(
            model_file="fetch/pick_and_place.xml",
            start_base=(0.405, 0.48, 0.0),
            start_object=(1.25, 0.53, 0.4),
            object_range=0.15,
            target_range=0.15,
            gripper_extra_height=0.2,
            gripper_blocked=False,
            hinges=hinges,
            shapes=shapes,
            start_shift=-0.1,
            stay_on_table=True,
        ),
        goal=PositionGoals(distance=0.02, objects=blocks),
        weld_torque_scale=10.0,
        paper_epochs=paper_epochs,
        paper_locomotion_epochs=paper_locomotion_epochs,
        gamma=0.98,
        locomotion_gamma=0.98,
        parts=(Part("chain", name, 0),),
        original={"goal": {"distance": 0.025, "joint_norm": True}, "scene": {"stay_on_table": False}},
    )


FETCH_TUPLE_3 = _tuple(
    hinges=(_TOP, _TOP),
    shapes=(
        Shape(
            name="L",
            offsets=((0.0, 0.05), (0.0, 0.0), (0.05, 0.0)),
            pitch=_HALF,
            hinge_angles=(0.0, -pi),
        ),
        Shape(
            name="L, a quarter turn to the left",
            offsets=((-0.05, 0.0), (0.0, 0.0), (0.0, 0.05)),
            pitch=0.0,
            hinge_angles=(0.0, -pi),
        ),
    ),
    goal_text="Fold the chain of three blocks into the marked shape, one of two; each ball has its block's colour.",
    paper_epochs=100,
    paper_locomotion_epochs=20,
)

FETCH_TUPLE_5 = _tuple(
    hinges=(_BOTTOM, _TOP, _TOP, _BOTTOM),
    shapes=(
        Shape(
            name="L",
            offsets=((0.0, 0.1), (0.0, 0.05), (0.0, 0.0), (0.05, 0.0), (0.1, 0.0)),
            pitch=0.0,
            hinge_angles=(pi, -pi, 0.0, 0.0),
        ),
        Shape(
            name="L, half a turn",
            offsets=((-0.1, 0.0), (-0.05, 0.0), (0.0, 0.0), (0.0, 0.05), (0.0, 0.1)),
            pitch=0.0,
            hinge_angles=(0.0, 0.0, -pi, pi),
        ),
        Shape(
            name="T",
            offsets=((0.0, 0.1), (0.0, 0.05), (-0.05, 0.0), (0.0, 0.0), (0.05, 0.0)),
            pitch=0.0,
            hinge_angles=(pi, -_HALF, -pi, pi),
        ),
        Shape(
            name="T, half a turn",
            offsets=((-0.05, 0.0), (0.0, 0.0), (0.05, 0.0), (0.0, 0.05), (0.0, 0.1)),
            pitch=-_HALF,
            hinge_angles=(pi, -pi, -_HALF, pi),
        ),
    ),
    goal_text="Fold the chain of five blocks into the marked shape, one of four; each ball has its block's colour.",
    paper_epochs=300,
    paper_locomotion_epochs=50,
)
