"""What every task keeps to, in both phases: one contract over the whole registry."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pytest

from sldr_core.config import LOCOMOTION_TASKS, TASKS, Phase, find_task
from sldr_core.envs import Envs, make_envs
from sldr_core.errors import InvalidConfig

STEPS = 6
PAPER_ORDER = [
    *("FetchPush", "FetchSlide", "FetchPickAndPlace", "FetchStack2", "FetchStack3", "FetchTuple3", "FetchTuple5"),
    *("HandEggRotate", "HandBlockRotate", "HandPenRotate", "HandEggFull", "HandBlockFull", "HandPenFull"),
]

SCENES: list[tuple[str, Phase]] = [
    *((task, "manipulation") for task in TASKS),
    *((spec.name, "locomotion") for spec in (TASKS | LOCOMOTION_TASKS).values() if spec.name in spec.locomotion_tasks),
]
every_scene = pytest.mark.parametrize(("task", "phase"), SCENES, ids=[f"{task}-{phase}" for task, phase in SCENES])

STILL_ENTRIES = {
    # The fingers are held shut, as in the reference.
    ("FetchPush", "manipulation"): {9, 10},
    ("FetchSlide", "manipulation"): {9, 10},
}
"""Entries of observations that are the same in every episode."""


def actions_of(envs: Envs, steps: int = STEPS, seed: int = 0) -> np.ndarray:
    shape = (steps, envs.num_envs, envs.action_size)
    return np.random.default_rng(seed).uniform(-1.0, 1.0, shape).astype(np.float32)


def play(envs: Envs, actions: np.ndarray) -> np.ndarray:
    """Return the physics' state and all that was seen after each step, `[T, N, ...]`."""
    seen = []
    for action in actions:
        now = envs.step(action)
        seen.append(np.concatenate([envs.simulation.state, now.obs, now.achieved, now.goal], axis=1))
    return np.stack(seen)


def test_the_thirteen_tasks_are_there_in_the_paper_s_order() -> None:
    assert list(TASKS) == PAPER_ORDER


@pytest.mark.parametrize("task", TASKS)
def test_every_part_learns_in_a_task_whose_object_sees_what_the_part_s_model_is_given(task: str) -> None:
    for part in TASKS[task].parts:
        trained_in = find_task(part.locomotion_task)
        assert trained_in.name in trained_in.locomotion_tasks
        assert trained_in.object_state_size == TASKS[task].object_state_size


@pytest.mark.parametrize("task", TASKS | LOCOMOTION_TASKS)
def test_a_spec_is_plain_json(task: str) -> None:
    assert json.loads(json.dumps(dataclasses.asdict(find_task(task))))["name"] == task


@pytest.mark.parametrize("task", TASKS | LOCOMOTION_TASKS)
def test_the_original_variant_differs_in_what_the_spec_says_and_is_simulated(task: str) -> None:
    ours, original = find_task(task), find_task(task, "original")

    assert ours == original or ours.original
    if task in TASKS:
        assert make_envs(task, variant="original").spec == original


@pytest.mark.parametrize("task", [spec.name for spec in TASKS.values() if spec.name not in spec.locomotion_tasks])
def test_a_task_whose_objects_learn_elsewhere_has_no_locomotion_of_its_own(task: str) -> None:
    with pytest.raises(InvalidConfig, match="learn in"):
        make_envs(task, "locomotion")


@every_scene
def test_sizes_and_types_are_the_spec_s_and_values_stay_finite(task: str, phase: Phase) -> None:
    spec, envs = find_task(task), make_envs(task, phase, num_envs=3)
    robot_acts = phase == "manipulation"

    for action in actions_of(envs):
        now = envs.step(action)

    assert envs.obs_size == (spec.obs_size if robot_acts else spec.object_state_size)
    assert envs.action_size == (spec.robot_action_size if robot_acts else spec.object_action_size)
    assert (envs.goal_size, envs.episode_length) == (spec.goal_size, spec.episode_length)
    assert now.obs.shape == (3, envs.obs_size)
    assert now.achieved.shape == now.goal.shape == (3, spec.goal_size)
    for values in (now.obs, now.achieved, now.goal):
        assert values.dtype == np.float64
        assert np.isfinite(values).all()


@every_scene
def test_the_same_seed_gives_the_same_episode_and_another_seed_another(task: str, phase: Phase) -> None:
    first, again, other = (make_envs(task, phase, num_envs=2, seed=seed) for seed in (5, 5, 6))
    actions = actions_of(first)

    played = [play(envs, actions) for envs in (first, again, other)]

    np.testing.assert_array_equal(played[0], played[1])
    assert (played[0] != played[2]).any(axis=2).all()


@every_scene
def test_simulations_side_by_side_equal_single_ones_on_any_number_of_threads(task: str, phase: Phase) -> None:
    batches = [make_envs(task, phase, num_envs=3, threads=threads) for threads in (1, 2, 3)]
    start, actions = batches[0].state(), actions_of(batches[0], steps=3)

    played = [play(together, actions) for together in batches]

    for index in range(3):
        alone = make_envs(task, phase)
        keep = slice(index, index + 1)
        alone.restore({name: part[keep] for name, part in start.items()})
        expected = play(alone, actions[:, keep])[:, 0]
        for together in played:
            np.testing.assert_array_equal(together[:, index], expected)


@every_scene
def test_a_reset_leaves_the_others_untouched(task: str, phase: Phase) -> None:
    envs, undisturbed = (make_envs(task, phase, num_envs=3) for _ in range(2))
    before, after = actions_of(envs), actions_of(envs, seed=1)
    play(envs, before)
    play(undisturbed, before)

    envs.reset([1])

    played, expected = play(envs, after), play(undisturbed, after)
    np.testing.assert_array_equal(played[:, [0, 2]], expected[:, [0, 2]])
    assert (played[:, 1] != expected[:, 1]).any()


@every_scene
def test_rewards_are_the_same_alone_in_pairs_and_in_batches(task: str, phase: Phase) -> None:
    envs = make_envs(task, phase)
    rng = np.random.default_rng(0)
    goal = np.repeat(envs.observe().goal, 60, axis=0)
    scale = rng.choice([0.0, 0.003, 0.03], size=(60, 1))
    achieved = goal + scale * rng.normal(size=goal.shape)
    if goal.shape[1] == 7:
        achieved[:, 3:] /= np.linalg.norm(achieved[:, 3:], axis=1, keepdims=True)

    together = envs.reward(achieved, goal)

    assert together.dtype == np.float32
    assert set(together) == {-1.0, 0.0}, "a test of one value would prove little"
    np.testing.assert_array_equal(together == 0, envs.success(achieved, goal))
    for size in (1, 2):
        few = [envs.reward(achieved[i : i + size], goal[i : i + size]) for i in range(0, 60, size)]
        np.testing.assert_array_equal(np.concatenate(few), together)
    np.testing.assert_array_equal([envs.reward(*pair) for pair in zip(achieved, goal, strict=True)], together)
    np.testing.assert_array_equal(envs.reward(achieved.reshape(6, 10, -1), goal.reshape(6, 10, -1)).ravel(), together)


@every_scene
def test_no_entry_of_the_observation_stands_still(task: str, phase: Phase) -> None:
    envs = make_envs(task, phase, num_envs=4)

    seen = [envs.observe().obs, *(envs.step(action).obs for action in actions_of(envs, steps=10))]

    moved = np.ptp(np.concatenate(seen), axis=0) > 0.0
    assert set(np.flatnonzero(~moved)) <= STILL_ENTRIES.get((task, phase), set())


@every_scene
def test_what_two_steps_return_shares_no_memory(task: str, phase: Phase) -> None:
    envs = make_envs(task, phase, num_envs=2)
    actions = actions_of(envs)

    first, second = envs.step(actions[0]), envs.step(actions[1])

    arrays = [getattr(now, name) for now in (first, second) for name in ("obs", "achieved", "goal")]
    live = [envs.qpos, envs.simulation.state, envs.simulation.site_pos, envs.simulation.body_pos]
    for i, array in enumerate(arrays):
        assert not any(np.shares_memory(array, other) for other in [*arrays[i + 1 :], *live])
