"""Where episodes on a table start and what they ask for, drawn many times.

Ours differ on purpose from the authors' code in one point: a chain never starts, and never is to lie, beyond the
table's edge (the variant `original` has such draws).
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import pytest

from sldr_core.config import TASKS, StackScene, TaskSpec, TupleScene, find_task
from sldr_core.envs import Envs, make_envs
from sldr_core.envs.scenes.fetch import FetchStart, settle_fetch
from sldr_core.envs.scenes.stack import settle_stack
from sldr_core.envs.scenes.tuple import settle_tuple

FEW, MANY = 300, 10_000
"""Resets in the usual run and in the slow one."""

AT_ONCE = 100
MIN_GRIPPER_DISTANCE = 0.1  # [m]
AIR = 0.45  # highest goal above the table [m]
SAME_HEIGHT = 1e-3  # [m]
DEEPEST_CONTACT = -1e-3  # [m], of a block that rests on the table
SPREAD = 0.97
"""A uniform draw fills at least this share of its range."""

SETTLE: dict[str, Any] = {"fetch": settle_fetch, "stack": settle_stack, "tuple": settle_tuple}
TABLE_TASKS = [name for name, spec in TASKS.items() if spec.family in SETTLE]

counts = pytest.mark.parametrize("count", [FEW, pytest.param(MANY, marks=pytest.mark.slow)])
every_task = pytest.mark.parametrize("task", TABLE_TASKS)


def drawn(spec: TaskSpec, count: int, testing: bool = False) -> tuple[np.ndarray, np.ndarray, FetchStart]:
    """Return starts and goals `[count, n, 3]`, and what they are drawn around; print their means and ranges."""
    envs = make_envs(spec.name, num_envs=AT_ONCE, seed=1, testing=testing)
    seen = [envs.observe(), *(envs.reset() for _ in range(count // AT_ONCE - 1))]
    starts = np.concatenate([now.achieved for now in seen]).reshape(count, -1, 3)
    goals = np.concatenate([now.goal for now in seen]).reshape(count, -1, 3)
    for name, places in (("starts", starts), ("goals", goals)):
        low, mean, high = (np.round(values, 3) for values in (places.min(0), places.mean(0), places.max(0)))
        print(f"{spec.name} {count} {name}: least {low.tolist()}, mean {mean.tolist()}, greatest {high.tolist()}")
    return starts, goals, SETTLE[spec.family](spec.scene)


def deepest_contact(envs: Envs) -> float:
    """Return the depth of the deepest contact of an object in any simulation [m], negative inside."""
    data = mujoco.MjData(envs.model)
    depths = [0.0]
    for qpos in envs.qpos:
        data.qpos[:] = qpos
        mujoco.mj_forward(envs.model, data)
        for contact in data.contact:
            bodies = [envs.model.body(envs.model.geom_bodyid[geom]).name for geom in contact.geom]
            if any(name.startswith("object") for name in bodies):
                depths.append(float(contact.dist))
    return min(depths)


@counts
@every_task
def test_objects_start_on_the_table_near_the_gripper_and_not_under_it(task: str, count: int) -> None:
    spec = find_task(task)
    starts, _, settled = drawn(spec, count)
    scene: Any = spec.scene
    shift = scene.start_shift if isinstance(scene, TupleScene) else 0.0
    free = starts[:, :1] if isinstance(scene, TupleScene) else starts

    away = free[..., :2] - settled.gripper_pos[:2]

    assert np.abs(starts[..., 2] - settled.object_height).max() < SAME_HEIGHT
    assert np.hypot(away[..., 0], away[..., 1]).min() >= MIN_GRIPPER_DISTANCE
    assert np.abs(away - (shift, 0.0)).max() <= scene.object_range + SAME_HEIGHT
    assert np.ptp(away[..., 1]) > SPREAD * 2 * scene.object_range
    if isinstance(scene, TupleScene):
        np.testing.assert_allclose(
            np.diff(starts, axis=1), np.full((count, scene.objects - 1, 3), (0.05, 0, 0)), atol=SAME_HEIGHT
        )
        assert (starts[..., 0] >= 1.05 + 0.025).all()
        assert (starts[..., 0] <= 1.55 - 0.025).all(), "a block starts beyond the table's edge"


@counts
@pytest.mark.parametrize("task", ["FetchStack2", "FetchStack3"])
def test_blocks_start_apart(task: str, count: int) -> None:
    starts, _, _ = drawn(find_task(task), count)
    pairs = [(i, j) for i in range(starts.shape[1]) for j in range(i)]

    distances = [np.linalg.norm(starts[:, i, :2] - starts[:, j, :2], axis=1).min() for i, j in pairs]

    assert min(distances) >= 0.07


@counts
@pytest.mark.parametrize("task", ["FetchPush", "FetchSlide", "FetchPickAndPlace"])
def test_single_goals_lie_around_the_gripper(task: str, count: int) -> None:
    spec = find_task(task)
    _, goals, settled = drawn(spec, count)
    scene: Any = spec.scene
    away = goals[:, 0] - settled.gripper_pos - scene.target_offset
    above = goals[:, 0, 2] - settled.object_height

    assert np.abs(away[:, :2]).max() <= scene.target_range
    assert np.ptp(away[:, :2], axis=0).min() > SPREAD * 2 * scene.target_range
    assert above.min() == 0.0
    if scene.target_in_the_air:
        assert 0.9 * AIR < above.max() <= AIR
        assert abs((above > 0).mean() - 0.5) < 2.0 / np.sqrt(count)
    else:
        assert above.max() == 0.0


@counts
@pytest.mark.parametrize("task", ["FetchStack2", "FetchStack3"])
def test_half_of_the_training_goals_are_towers_where_the_first_block_starts(task: str, count: int) -> None:
    spec = find_task(task)
    starts, goals, settled = drawn(spec, count)
    scene = spec.scene
    assert isinstance(scene, StackScene)

    is_tower = goals[:, -1, 2] > settled.object_height + SAME_HEIGHT
    others = goals[~is_tower, 1:]

    assert abs(is_tower.mean() - scene.stack_probability) < 2.0 / np.sqrt(count)
    np.testing.assert_allclose(goals[:, 0], starts[:, 0], atol=SAME_HEIGHT)
    assert np.abs(others[..., :2] - settled.gripper_pos[:2]).max() <= scene.target_range
    assert (others[..., 2] == settled.object_height).all()


@counts
@pytest.mark.parametrize("task", ["FetchStack2", "FetchStack3"])
def test_every_test_goal_is_a_tower(task: str, count: int) -> None:
    starts, goals, _ = drawn(find_task(task), count, testing=True)

    np.testing.assert_allclose(goals[..., :2], np.repeat(starts[:, :1, :2], goals.shape[1], axis=1), atol=SAME_HEIGHT)
    np.testing.assert_allclose(np.diff(goals[..., 2], axis=1), 0.05)


@counts
@pytest.mark.parametrize("task", ["FetchTuple3", "FetchTuple5"])
def test_each_shape_is_asked_for_as_often_as_the_others_and_on_the_table(task: str, count: int) -> None:
    spec = find_task(task)
    _, goals, settled = drawn(spec, count)
    scene = spec.scene
    assert isinstance(scene, TupleScene)
    shapes = np.array([shape.offsets for shape in scene.shapes])

    offsets = (goals - goals[:, :1])[..., [0, 2]]
    apart = np.abs(offsets[:, None] - (shapes - shapes[:, :1])).max(axis=(2, 3))

    assert apart.min(axis=1).max() < 1e-9
    shares = np.bincount(apart.argmin(axis=1), minlength=len(shapes)) / count
    assert np.abs(shares - 1 / len(shapes)).max() < 2.0 / np.sqrt(count)
    assert (goals[..., 1] == goals[:, :1, 1]).all()
    assert goals[..., 2].min() == settled.object_height
    assert goals[..., 0].min() >= 1.05 + 0.025
    assert goals[..., 0].max() <= 1.55 - 0.025


@every_task
def test_no_start_has_objects_inside_one_another_and_none_falls(task: str) -> None:
    envs = make_envs(task, num_envs=50, seed=2)
    before = envs.observe().achieved

    assert deepest_contact(envs) > DEEPEST_CONTACT
    for _ in range(3):
        after = envs.step(np.zeros((envs.num_envs, envs.action_size))).achieved
    assert np.abs(after - before).max() < 2e-3  # [m]
