"""The ghost is the truth: it is one step of the locomotion policy in the locomotion scene, from the robot's moment.

The truth is made with MuJoCo alone: the object's joints are copied by hand, its weld is pulled by hand.
"""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest
from prepared import make_model, random_actions, save_model

from sldr_core.config import find_task
from sldr_core.envs import make_envs
from sldr_core.training import load_policy
from worker.viewer.demonstration import PartDemonstration
from worker.viewer.simulated import Moment

PHYSICS_STEPS = 20
"""Physics steps of a control step."""

SPEED = np.float32(0.05)
"""Change of the target at full action."""


def plain_step(task: str, joints: dict[str, str], moment: Moment, robot: mujoco.MjModel, model_file: Path):
    """Return `qpos` of the locomotion scene after one step from a moment, `joints` naming each joint's source."""
    envs = make_envs(task, "locomotion")
    model, data = envs.model, mujoco.MjData(envs.model)
    for joint, source in joints.items():
        to, came = model.joint(joint), robot.joint(source)
        size, speeds = (7, 6) if to.type[0] == mujoco.mjtJoint.mjJNT_FREE else (1, 1)
        data.qpos[to.qposadr[0] :][:size] = moment.qpos[came.qposadr[0] :][:size]
        data.qvel[to.dofadr[0] :][:speeds] = moment.qvel[came.dofadr[0] :][:speeds]
    envs.simulation.reset(np.array([0]), data.qpos[None].copy(), data.qvel[None].copy())
    goal = moment.goal if task.startswith("Hand") else moment.goal[:3]
    action = load_policy(model_file).act(envs.observe().obs, goal[None])[0]
    mujoco.mj_forward(model, data)
    lead = model.body("object" if task.startswith("Hand") else "object0").id
    data.mocap_pos[0] = data.xpos[lead] + SPEED * action[:3]
    data.mocap_quat[0] = data.xquat[lead] + SPEED * action[3:7]
    if model.nu:
        data.ctrl[:] = model.actuator_ctrlrange.mean(axis=1)
    mujoco.mj_step(model, data, PHYSICS_STEPS)
    return data.qpos.copy(), lead, model


@pytest.mark.parametrize(
    ("task", "locomotion", "part"),
    [("FetchPush", "FetchPush", 0), ("HandBlockFull", "HandBlockRotate", 0), ("FetchStack2", "FetchPickAndPlace", 1)],
)
def test_the_ghost_s_next_pose_is_one_step_of_the_locomotion_policy(tmp_path, task, locomotion, part):
    envs = make_envs(task, seed=1)
    spec = find_task(task).parts[part]
    ghost = PartDemonstration(find_task(task), spec, make_model(locomotion), envs.model)
    episode = random_actions(envs)
    moment = episode.moment(4)
    if task == "FetchStack2":
        goal = moment.goal[3 * spec.object_index :][:3]
        moment_of_part = Moment(moment.qpos, moment.qvel, moment.obs, moment.achieved, goal)
    else:
        moment_of_part = moment
    names = [ghost.model.joint(joint).name for joint in range(ghost.model.njnt)]
    joints = {name: name.replace("object0", f"object{spec.object_index}") for name in names}
    model_file = save_model(locomotion, tmp_path / "locomotion.pt")
    qpos, lead, model = plain_step(locomotion, joints, moment_of_part, envs.model, model_file)
    place = model.jnt_qposadr[model.body_jntadr[lead]]
    shown = ghost.one_step(moment)
    assert np.abs(shown[place : place + 7] - qpos[place : place + 7]).max() <= 1e-6
    assert np.abs(shown[place : place + 7] - moment_pose(envs.model, moment, spec.object_index)).max() > 1e-5


def moment_pose(model: mujoco.MjModel, moment: Moment, index: int) -> np.ndarray:
    numbered = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, f"object{index}:joint")
    first = model.jnt_qposadr[numbered if numbered >= 0 else model.joint("object:joint").id]
    return moment.qpos[first : first + 7]


def test_a_whole_demonstration_begins_at_the_moment_and_goes_on_step_by_step():
    envs = make_envs("FetchPush", seed=1)
    ghost = PartDemonstration(
        find_task("FetchPush"), find_task("FetchPush").parts[0], make_model("FetchPush"), envs.model
    )
    moment = random_actions(envs).moment(3)
    path = ghost.run(moment, 6)
    assert len(path) == 7
    assert np.array_equal(path[0], moment_pose(envs.model, moment, 0))
    assert np.array_equal(path[1], ghost.one_step(moment))
    assert np.array_equal(ghost.run(moment, 6), path)
