"""How fast an object moves itself: what its actions are worth in metres and radians."""

from __future__ import annotations

import numpy as np
import pytest

from sldr_core.envs import Envs, make_envs

LIFTING_STEPS = 5
MEASURED_STEPS = 6


def floating_object() -> Envs:
    """Return an object that has lifted itself clear of the table."""
    envs = make_envs("FetchPush", "locomotion")
    up = np.zeros((1, 7))
    up[0, 2] = 1.0
    for _ in range(LIFTING_STEPS):
        envs.step(up)
    return envs


def poses_during(envs: Envs, action: np.ndarray) -> np.ndarray:
    """Return the object's poses after each step of a constant action, `[T, 7]`."""
    start = int(envs.model.joint("object0:joint").qposadr[0])
    poses = []
    for _ in range(MEASURED_STEPS):
        envs.step(action)
        poses.append(envs.qpos[0, start : start + 7].copy())
    return np.stack(poses)[1:]


def angles_between(quaternions: np.ndarray) -> np.ndarray:
    """Return the angle [rad] from each quaternion to the next."""
    cosines = np.abs((quaternions[1:] * quaternions[:-1]).sum(axis=1))
    return 2 * np.arccos(np.minimum(cosines, 1.0))


@pytest.mark.parametrize("component", [1, 2, 3])
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_full_action_on_one_quaternion_component_turns_the_object_by_six_hundredths(
    component: int, sign: float
) -> None:
    action = np.zeros((1, 7))
    action[0, 3 + component] = sign

    angles = angles_between(poses_during(floating_object(), action)[:, 3:])

    assert 0.05 < angles.mean() < 0.07


def test_an_object_on_the_table_can_turn_about_the_vertical() -> None:
    action = np.zeros((1, 7))
    action[0, 6] = 1.0

    angles = angles_between(poses_during(make_envs("FetchPush", "locomotion"), action)[:, 3:])

    assert 0.05 < angles.mean() < 0.07


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_full_action_on_one_axis_moves_the_object_by_three_centimetres(axis: int, sign: float) -> None:
    action = np.zeros((1, 7))
    action[0, axis] = sign
    envs = floating_object()
    if axis == 2 and sign < 0:
        poses_during(envs, -action)  # room to sink

    positions = poses_during(envs, action)[:, :3]

    np.testing.assert_allclose(sign * np.diff(positions[:, axis]), 0.032, atol=0.002)  # [m]


def test_an_object_that_does_nothing_in_the_air_nearly_hangs_there() -> None:
    positions = poses_during(floating_object(), np.zeros((1, 7)))[:, 2]

    assert np.abs(np.diff(positions)).max() < 0.01  # [m], the weld is soft


def test_a_still_robot_keeps_away_from_the_object() -> None:
    envs = make_envs("FetchPush", "locomotion", robot="still")
    grip = envs.model.site("robot0:grip").id
    before = envs.simulation.site_pos[0, grip].copy()

    for _ in range(20):
        envs.step(np.zeros((1, 7)))

    assert np.linalg.norm(envs.simulation.site_pos[0, grip] - before) < 0.01  # [m]


def test_a_random_robot_moves() -> None:
    envs = make_envs("FetchPush", "locomotion", robot="random")
    grip = envs.model.site("robot0:grip").id
    before = envs.simulation.site_pos[0, grip].copy()

    for _ in range(20):
        envs.step(np.zeros((1, 7)))

    assert np.linalg.norm(envs.simulation.site_pos[0, grip] - before) > 0.01  # [m]
