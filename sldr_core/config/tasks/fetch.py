"""The tasks with one object on a table."""

from __future__ import annotations

from sldr_core.config.tasks.spec import FetchScene, Part, PositionGoals, TaskSpec

FETCH_PUSH = TaskSpec(
    name="FetchPush",
    goal_text="Push the block across the table to the red target; the gripper stays shut.",
    obs_size=25,
    goal_size=3,
    robot_action_size=4,
    object_action_size=7,
    object_state_size=12,
    episode_length=50,
    scene=FetchScene(
        model_file="fetch/push.xml",
        start_base=(0.405, 0.48, 0.0),
        start_object=(1.25, 0.53, 0.4),
        object_range=0.15,
        target_range=0.15,
        gripper_extra_height=0.0,
        gripper_blocked=True,
    ),
    goal=PositionGoals(distance=0.05),
    weld_torque_scale=10.0,
    paper_epochs=50,
    paper_locomotion_epochs=20,
    gamma=0.98,
    locomotion_gamma=0.98,
    parts=(Part("object0", "FetchPush", 0),),
)

FETCH_SLIDE = TaskSpec(
    name="FetchSlide",
    goal_text="Hit the puck so that it slides to the red target, out of reach; the gripper stays shut.",
    obs_size=25,
    goal_size=3,
    robot_action_size=4,
    object_action_size=7,
    object_state_size=12,
    episode_length=50,
    scene=FetchScene(
        model_file="fetch/slide.xml",
        start_base=(0.05, 0.48, 0.0),
        start_object=(1.7, 1.1, 0.41),
        object_range=0.1,
        target_range=0.3,
        target_offset=(0.4, 0.0, 0.0),
        gripper_extra_height=-0.02,
        gripper_blocked=True,
    ),
    goal=PositionGoals(distance=0.05),
    weld_torque_scale=10.0,
    paper_epochs=50,
    paper_locomotion_epochs=20,
    gamma=0.98,
    locomotion_gamma=0.98,
    parts=(Part("object0", "FetchSlide", 0),),
    original={"scene": {"object_range": 0.15}},
)

FETCH_PICK_AND_PLACE = TaskSpec(
    name="FetchPickAndPlace",
    goal_text="Grasp the block and bring it to the red target, on the table or in the air.",
    obs_size=25,
    goal_size=3,
    robot_action_size=4,
    object_action_size=7,
    object_state_size=12,
    episode_length=50,
    scene=FetchScene(
        model_file="fetch/pick_and_place.xml",
        start_base=(0.405, 0.48, 0.0),
        start_object=(1.25, 0.53, 0.4),
        object_range=0.15,
        target_range=0.15,
        target_in_the_air=True,
        gripper_extra_height=0.2,
        gripper_blocked=False,
    ),
    goal=PositionGoals(distance=0.05),
    weld_torque_scale=10.0,
    paper_epochs=50,
    paper_locomotion_epochs=20,
    gamma=0.98,
    locomotion_gamma=0.98,
    parts=(Part("object0", "FetchPickAndPlace", 0),),
)
