"""What every batch of environments keeps to, whoever acts in it."""

from __future__ import annotations

from typing import Any, cast

import mujoco
import numpy as np
import pytest

from sldr_core.config import FetchScene, find_task
from sldr_core.envs import Envs, Observation, make_envs
from sldr_core.envs.scenes.fetch import settle_fetch
from sldr_core.envs.scenes.welds import SUBSTEPS

TASK = find_task("FetchPush")
SCENE = cast(FetchScene, TASK.scene)
ACTORS: list[dict[str, Any]] = [
    {"phase": "manipulation"},
    {"phase": "locomotion", "robot": "absent"},
    {"phase": "locomotion", "robot": "still"},
    {"phase": "locomotion", "robot": "random"},
]
ids_of = "-".join
every_actor = pytest.mark.parametrize("actor", ACTORS, ids=lambda actor: ids_of(actor.values()))


def actions_of(envs: Envs, steps: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-1, 1, (steps, envs.num_envs, envs.action_size)).astype(np.float32)


def play(envs: Envs, actions: np.ndarray) -> np.ndarray:
    """Return the full physics state and the observation after each step, `[T, N, ...]`."""
    seen = []
    for action in actions:
        now = envs.step(action)
        seen.append(np.concatenate([envs.simulation.state, now.obs, now.achieved, now.goal], axis=1))
    return np.stack(seen)


def one_of(state: dict[str, Any], index: int) -> dict[str, Any]:
    keep = slice(index, index + 1)
    return {name: part[keep] for name, part in state.items()}


@every_actor
def test_shapes_and_types_are_those_of_the_task(actor: dict[str, Any]) -> None:
    envs = make_envs("FetchPush", num_envs=3, **actor)
    moves_robot = actor["phase"] == "manipulation"

    now = envs.step(actions_of(envs, 1)[0])

    obs_size = TASK.obs_size if moves_robot else TASK.object_state_size
    assert envs.action_size == (TASK.robot_action_size if moves_robot else TASK.object_action_size)
    assert (envs.obs_size, envs.goal_size, envs.episode_length) == (obs_size, TASK.goal_size, TASK.episode_length)
    assert now.obs.shape == (3, obs_size)
    assert now.achieved.shape == now.goal.shape == (3, TASK.goal_size)
    assert now.obs.dtype == now.achieved.dtype == now.goal.dtype == np.float64


def test_whoever_changes_a_scene_changes_it_for_nobody_else() -> None:
    changed = make_envs("FetchPush").simulation.model
    before = changed.site_pos.copy()
    changed.site_pos[:] = 7.0

    np.testing.assert_array_equal(make_envs("FetchPush").simulation.model.site_pos, before)


@every_actor
def test_a_whole_episode_of_random_actions_stays_finite(actor: dict[str, Any]) -> None:
    envs = make_envs("FetchPush", num_envs=2, **actor)

    assert np.isfinite(play(envs, actions_of(envs, envs.episode_length))).all()


@every_actor
def test_the_same_seed_gives_the_same_episode_and_another_seed_another(actor: dict[str, Any]) -> None:
    first, again, other = (make_envs("FetchPush", num_envs=2, seed=seed, **actor) for seed in (5, 5, 6))
    actions = actions_of(first, 5)

    played = [play(envs, actions) for envs in (first, again, other)]

    np.testing.assert_array_equal(played[0], played[1])
    goal_xy = slice(-3, -1)
    assert (played[0][..., goal_xy] != played[2][..., goal_xy]).all()


@every_actor
@pytest.mark.parametrize("threads", [1, 2, 3])
def test_a_batch_equals_its_simulations_run_alone(actor: dict[str, Any], threads: int) -> None:
    batch = make_envs("FetchPush", num_envs=3, seed=1, threads=threads, **actor)
    single = make_envs("FetchPush", num_envs=1, **actor)
    before, actions = batch.state(), actions_of(batch, 10)

    together = play(batch, actions)

    for index in range(batch.num_envs):
        single.restore(one_of(before, index))
        alone = play(single, actions[:, index : index + 1])
        np.testing.assert_array_equal(together[:, index], alone[:, 0])


def test_object_steps_equal_a_plain_mujoco_loop() -> None:
    envs = make_envs("FetchPush", "locomotion", num_envs=2, threads=2)
    model, kind = envs.model, mujoco.mjtState.mjSTATE_INTEGRATION
    body, mocap = model.body("object0").id, model.body("object0:mocap").mocapid[0]
    datas = [mujoco.MjData(model) for _ in range(envs.num_envs)]
    for data, state in zip(datas, envs.simulation.state, strict=True):
        mujoco.mj_setState(model, data, state, kind)
        mujoco.mj_forward(model, data)
        mujoco.mj_setState(model, data, state, kind)

    for action in actions_of(envs, 20):
        envs.step(action)
        for index, data in enumerate(datas):
            change = np.float32(0.05) * action[index]
            data.mocap_pos[mocap] = data.xpos[body] + change[:3]
            data.mocap_quat[mocap] = data.xquat[body] + change[3:]
            mujoco.mj_step(model, data, nstep=SUBSTEPS)
            mujoco.mj_forward(model, data)
            state = np.empty(envs.simulation.state.shape[1])
            mujoco.mj_getState(model, data, state, kind)
            np.testing.assert_array_equal(envs.simulation.state[index], state)


@every_actor
def test_leaving_contacts_out_changes_nothing_that_is_read_or_stepped_on(actor: dict[str, Any]) -> None:
    ours, whole = (make_envs("FetchPush", num_envs=3, seed=4, **actor) for _ in range(2))
    whole.simulation.forward_motion = whole.simulation.forward
    actions = actions_of(ours, 30)

    np.testing.assert_array_equal(play(ours, actions), play(whole, actions))

    np.testing.assert_array_equal(ours.simulation.snapshot(), whole.simulation.snapshot())


@every_actor
def test_resetting_some_simulations_leaves_the_others_as_they_were(actor: dict[str, Any]) -> None:
    envs = make_envs("FetchPush", num_envs=4, **actor)
    play(envs, actions_of(envs, 3))
    before, seen = envs.state(), envs.observe()

    after = envs.reset([2, 0])

    kept, fresh = [1, 3], [0, 2]
    np.testing.assert_array_equal(envs.state()["simulation"][kept], before["simulation"][kept])
    np.testing.assert_array_equal(after.obs[kept], seen.obs[kept])
    np.testing.assert_array_equal(after.goal[kept], seen.goal[kept])
    assert (after.goal[fresh] != seen.goal[fresh])[:, :2].all()
    assert [envs.state()["rngs"][i] == before["rngs"][i] for i in range(4)] == [False, True, False, True]


@every_actor
def test_a_restored_state_continues_to_the_last_bit(actor: dict[str, Any]) -> None:
    envs = make_envs("FetchPush", num_envs=2, seed=1, **actor)
    elsewhere = make_envs("FetchPush", num_envs=2, seed=9, **actor)
    actions = actions_of(envs, 12)
    play(envs, actions[:4])
    state = envs.state()
    expected = play(envs, actions[4:]), envs.reset().obs

    elsewhere.restore(state)

    np.testing.assert_array_equal(play(elsewhere, actions[4:]), expected[0])
    np.testing.assert_array_equal(elsewhere.reset().obs, expected[1])


@every_actor
def test_observations_share_no_memory_with_each_other_or_the_simulation(actor: dict[str, Any]) -> None:
    envs = make_envs("FetchPush", num_envs=2, **actor)
    parts: list[np.ndarray] = [envs.qpos, envs.qvel, envs.mocap_pos]
    for action in actions_of(envs, 2):
        now: Observation = envs.step(action)
        parts += [now.obs, now.achieved, now.goal]

    for index, part in enumerate(parts):
        assert not any(np.shares_memory(part, other) for other in parts[:index])


@pytest.mark.parametrize("shape", [(2,), (3, 4), (2, 5), (1, 2, 4)])
def test_actions_of_another_shape_are_refused_by_name(shape: tuple[int, ...]) -> None:
    envs = make_envs("FetchPush", num_envs=2)

    with pytest.raises(ValueError, match=r"expected actions of shape \(2, 4\), got"):
        envs.step(np.zeros(shape))


@pytest.mark.parametrize("shape", [(3,), (1, 3), (2, 3), (7, 3), (2, 5, 3)])
def test_rewards_of_arrays_equal_those_worked_out_one_by_one(shape: tuple[int, ...]) -> None:
    envs = make_envs("FetchPush")
    rng = np.random.default_rng(0)
    achieved, goal = rng.uniform(0, 0.06, shape), rng.uniform(0, 0.06, shape)

    reward, success = envs.reward(achieved, goal), envs.success(achieved, goal)

    pairs = zip(achieved.reshape(-1, 3), goal.reshape(-1, 3), strict=True)
    distances = np.array([sum((a - g) ** 2 for a, g in zip(*pair, strict=True)) ** 0.5 for pair in pairs])
    np.testing.assert_array_equal(np.ravel(reward), np.where(distances > 0.05, -1.0, 0.0))
    np.testing.assert_array_equal(np.ravel(success), distances < 0.05)
    assert np.shape(reward) == np.shape(success) == shape[:-1]


def test_goals_go_to_the_simulations_in_the_order_they_are_named() -> None:
    envs = make_envs("FetchPush", num_envs=4)

    envs.set_goal([[3.0] * 3, [1.0] * 3], ids=[3, 1])

    np.testing.assert_array_equal(envs.observe().goal[[1, 3]], [[1.0] * 3, [3.0] * 3])


@pytest.mark.parametrize("ids", [[1, 1], [-1], [2], [True, False, True]])
def test_ids_that_name_no_simulation_are_refused_in_a_sentence(ids: list[int]) -> None:
    with pytest.raises(ValueError, match="ids have to be different numbers from 0 to 1"):
        make_envs("FetchPush", num_envs=2).reset(ids)


@pytest.mark.parametrize("actor", ACTORS[:2], ids=["robot", "object"])
def test_two_thousand_starts_and_goals_lie_where_the_task_says(actor: dict[str, Any]) -> None:
    envs = make_envs("FetchPush", num_envs=250, threads=2, **actor)
    settled = settle_fetch(SCENE)
    centre, height = settled.gripper_pos, settled.object_height

    seen = [envs.reset() for _ in range(8)]
    starts = np.concatenate([now.achieved for now in seen])
    goals = np.concatenate([now.goal for now in seen])

    away = starts[:, :2] - centre[:2]
    assert np.abs(away).max() <= SCENE.object_range
    assert np.hypot(*away.T).min() >= 0.1
    assert np.abs(starts[:, 2] - height).max() < 1e-6
    assert np.abs(goals[:, :2] - centre[:2]).max() <= SCENE.target_range
    np.testing.assert_array_equal(goals[:, 2], height)
    assert np.ptp(starts[:, :2], axis=0).min() > 1.9 * SCENE.object_range
    assert np.ptp(goals[:, :2], axis=0).min() > 1.9 * SCENE.target_range


@pytest.mark.parametrize("actor", ACTORS[:2], ids=["robot", "object"])
def test_no_object_falls_or_slides_before_anyone_acts(actor: dict[str, Any]) -> None:
    envs = make_envs("FetchPush", num_envs=100, threads=2, **actor)
    before = envs.observe().achieved

    for _ in range(3):
        after = envs.step(np.zeros((envs.num_envs, envs.action_size))).achieved

    assert np.abs(after - before).max() < 2e-3  # [m]
