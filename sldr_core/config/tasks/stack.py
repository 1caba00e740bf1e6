"""The tasks of stacking blocks; each block is rewarded by the locomotion model of FetchPickAndPlace."""

from __future__ import annotations

from sldr_core.config.tasks.spec import Part, PositionGoals, StackScene, TaskSpec


def _stack(objects: int, goal_text: str, episode_length: int, paper_epochs: int) -> TaskSpec:
    return TaskSpec(
        name=f"FetchStack{objects}",
        goal_text=goal_text,
        obs_size=10 + 15 * objects,
        goal_size=3 * objects,
        robot_action_size=4,
        object_action_size=7,
        object_state_size=12,
        episode_length=episode_length,
        scene=StackScene(
            model_file="fetch/pick_and_place.xml",
            start_base=(0.405, 0.48, 0.0),
            start_object=(1.25, 0.53, 0.4),
            object_range=0.15,
            target_range=0.15,
            gripper_extra_height=0.2,
            gripper_blocked=False,
            objects=objects,
            wall_half_height=0.05,
            object_spacing=0.07,
            level_height=0.05,
            stack_probability=0.5,
        ),
        goal=PositionGoals(distance=0.05, objects=objects),
        weld_torque_scale=10.0,
        paper_epochs=paper_epochs,
        paper_locomotion_epochs=20,
        gamma=0.98,
        locomotion_gamma=0.98,
        parts=tuple(Part(f"object{index}", "FetchPickAndPlace", index) for index in range(objects)),
        original={"goal": {"joint_norm": True}},
    )


FETCH_STACK_2 = _stack(
    objects=2,
    goal_text="Put the second block on the first, which stays where it is; each ball has its block's colour.",
    episode_length=50,
    paper_epochs=100,
)

FETCH_STACK_3 = _stack(
    objects=3,
    goal_text="Put the second block on the first and the third on the second, in this order.",
    episode_length=100,
    paper_epochs=200,
)
