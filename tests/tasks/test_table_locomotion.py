"""Objects on a table can do what they are asked: how fast they turn, and that every locomotion task can be solved."""

from __future__ import annotations

import numpy as np
import pytest
from object_controllers import ChainFolder, place_blocks, pull_to_goal

from sldr_core.config import TupleScene, find_task
from sldr_core.envs import Envs, make_envs
from sldr_core.envs.rotations import angle_between

FEW, MANY = 20, 200
"""Episodes in the usual run and in the slow one."""

LIFTING_STEPS, TURNING_STEPS = 6, 6
SINGLE_TASKS = ["FetchPush", "FetchSlide", "FetchPickAndPlace"]
CHAIN_TASKS = ["FetchTuple3", "FetchTuple5"]
PITCH = 2  # the quaternion's component about y, the axis in which chains fold

counts = pytest.mark.parametrize("count", [FEW, pytest.param(MANY, marks=pytest.mark.slow)])


def success_rate(envs: Envs) -> float:
    now = envs.observe()
    return float(envs.success(now.achieved, now.goal).mean())


@counts
@pytest.mark.parametrize("task", SINGLE_TASKS)
def test_an_object_that_pulls_itself_to_its_goal_gets_there(task: str, count: int) -> None:
    envs = make_envs(task, "locomotion", num_envs=count, seed=1, threads=2, testing=True)

    for _ in range(envs.episode_length):
        envs.step(pull_to_goal(envs))

    print(f"{task}: {success_rate(envs):.1%} of {count} episodes")
    assert success_rate(envs) >= 0.99


@counts
@pytest.mark.parametrize("task", CHAIN_TASKS)
def test_a_chain_that_folds_itself_gets_its_shape(task: str, count: int) -> None:
    envs = make_envs(task, "locomotion", num_envs=count, seed=1, threads=2, testing=True)
    folder = ChainFolder(envs)

    for step in range(1, envs.episode_length + 1):
        envs.step(folder.actions(step))

    print(f"{task}: {success_rate(envs):.1%} of {count} episodes")
    assert success_rate(envs) >= 0.95


@pytest.mark.parametrize("task", CHAIN_TASKS)
def test_every_shape_can_be_reached_within_the_hinges_ranges(task: str) -> None:
    scene = find_task(task).scene
    assert isinstance(scene, TupleScene)

    for shape in scene.shapes:
        assert all(h.low <= angle <= h.high for h, angle in zip(scene.hinges, shape.hinge_angles, strict=True))
        positions, _ = place_blocks(scene, np.zeros(3), shape.pitch, np.array(shape.hinge_angles))
        offsets = np.array(shape.offsets)
        np.testing.assert_allclose((positions - positions[0])[:, [0, 2]], offsets - offsets[0], atol=1e-12)


@pytest.mark.parametrize("task", CHAIN_TASKS)
def test_the_scene_s_chain_lies_where_its_joint_angles_say(task: str) -> None:
    scene = find_task(task).scene
    assert isinstance(scene, TupleScene)
    envs = make_envs(task, "locomotion")
    for shape in scene.shapes:
        root = np.array([1.3, 0.75, 1.0])
        quat = (np.cos(shape.pitch / 2), 0.0, np.sin(shape.pitch / 2), 0.0)
        envs.qpos[0] = (*root, *quat, *shape.hinge_angles)
        envs.simulation.forward()

        positions, _ = place_blocks(scene, root, shape.pitch, np.array(shape.hinge_angles))

        np.testing.assert_allclose(envs.observe().achieved.reshape(-1, 3), positions, atol=1e-9)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
@pytest.mark.parametrize("component", [1, 2, 3])
@pytest.mark.parametrize("task", SINGLE_TASKS)
def test_full_action_on_one_component_turns_an_object_by_six_hundredths(task: str, component: int, sign: float) -> None:
    assert 0.055 < turning_rate(task, component, sign) < 0.07


@pytest.mark.parametrize("sign", [-1.0, 1.0])
@pytest.mark.parametrize("task", CHAIN_TASKS)
def test_full_action_turns_a_chain_s_end_by_six_hundredths_in_its_plane(task: str, sign: float) -> None:
    assert 0.055 < turning_rate(task, PITCH, sign) < 0.07


def turning_rate(task: str, component: int, sign: float) -> float:
    """Return how far the first block turns in a control step once all have lifted themselves [rad]."""
    envs = make_envs(task, "locomotion")
    body = envs.model.body("object0").id
    up, turn = np.zeros((2, 1, envs.action_size))
    up[:, 2::7] = 1.0
    turn[:, 3 + component] = sign
    for _ in range(LIFTING_STEPS):
        envs.step(up)
    turned = []
    for _ in range(TURNING_STEPS):
        envs.step(turn)
        turned.append(envs.simulation.body_quat[0, body].copy())
    angles = angle_between(np.stack(turned[1:]), np.stack(turned[:-1]))[1:]
    print(f"{task}, component {component}, {sign:+.0f}: {angles.mean():.4f} rad a step")
    return float(angles.mean())
