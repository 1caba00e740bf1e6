"""Every task is an environment that other libraries can train on."""

from __future__ import annotations

import gc
import warnings

import gymnasium
import numpy as np
import psutil
import pytest
from gymnasium.utils.env_checker import check_env

from sldr_core.config import LOCOMOTION_TASKS, TASKS, Phase
from sldr_core.envs import make_envs
from sldr_core.errors import InvalidConfig
from sldr_core.registration import Registered, register_envs, registered_envs

ALL = list(registered_envs())
every_env = pytest.mark.parametrize("registered", ALL, ids=[env.id for env in ALL])

SB3_STEPS = 300
MAX_GROWTH = 4e6  # [bytes]
WARM_UP = 300  # resets after which the allocator has what it needs


@pytest.fixture(scope="module", autouse=True)
def registered_once() -> None:
    register_envs()
    register_envs()  # what is known already stays


def test_the_ids_are_the_tasks_and_their_locomotion() -> None:
    ids = [env.id for env in ALL]

    assert len(ids) == len(set(ids))
    assert {f"sldr/{task}-v0" for task in TASKS} <= set(ids)
    learnt = {env.task for env in ALL if env.phase == "locomotion"}
    assert learnt == {task for spec in TASKS.values() for task in spec.locomotion_tasks}
    assert set(LOCOMOTION_TASKS) <= learnt


@every_env
def test_gymnasium_s_own_check_passes(registered: Registered) -> None:
    env = gymnasium.make(registered.id, disable_env_checker=True)

    with warnings.catch_warnings():
        # Observations have no bounds, as in the reference.
        warnings.filterwarnings("ignore", message=".*infinity")
        check_env(env.unwrapped, skip_render_check=True)

    assert env.spec is not None
    assert env.spec.max_episode_steps == TASKS.get(registered.task, env.unwrapped.envs.spec).episode_length  # type: ignore[attr-defined]


@pytest.mark.parametrize("env_id", ["sldr/FetchStack2-v0", "sldr/HandBlockRotate-Locomotion-v0"])
def test_an_episode_ends_by_its_time_limit_and_its_rewards_can_be_computed_again(env_id: str) -> None:
    env = gymnasium.make(env_id, disable_env_checker=True)
    env.action_space.seed(0)
    seen, _ = env.reset(seed=0)
    achieved, desired, rewards, ended = [], [], [], False
    while not ended:
        seen, reward, terminated, ended, info = env.step(env.action_space.sample())
        assert not terminated
        assert info["is_success"] in (0.0, 1.0)
        achieved.append(seen["achieved_goal"])
        desired.append(seen["desired_goal"])
        rewards.append(reward)

    again = env.unwrapped.compute_reward(np.stack(achieved), np.stack(desired), {})  # type: ignore[attr-defined]

    assert env.spec is not None
    assert len(rewards) == env.spec.max_episode_steps
    np.testing.assert_array_equal(again, rewards)


def test_who_asks_for_pictures_is_told_where_they_are() -> None:
    with (
        pytest.warns(UserWarning, match="rgb_array"),
        pytest.raises(InvalidConfig, match="render_mode: these environments draw nothing"),
    ):
        gymnasium.make("sldr/FetchPush-v0", render_mode="rgb_array")


def test_a_gymnasium_episode_is_that_of_the_batch_with_the_same_seed() -> None:
    env, envs = gymnasium.make("sldr/FetchTuple3-v0", disable_env_checker=True), make_envs("FetchTuple3", seed=4)
    seen, _ = env.reset(seed=4)

    np.testing.assert_array_equal(seen["observation"], envs.observe().obs[0])
    np.testing.assert_array_equal(seen["desired_goal"], envs.observe().goal[0])


def test_stable_baselines3_trains_on_a_task_without_a_wrapper() -> None:
    from stable_baselines3 import SAC, HerReplayBuffer

    env = gymnasium.make("sldr/FetchStack2-v0", disable_env_checker=True)
    model = SAC(
        "MultiInputPolicy",
        env,
        replay_buffer_class=HerReplayBuffer,
        learning_starts=100,
        batch_size=32,
        train_freq=5,
        policy_kwargs={"net_arch": [32, 32]},
        seed=0,
        device="cpu",
    )

    model.learn(SB3_STEPS)

    assert model.num_timesteps == SB3_STEPS
    assert model.replay_buffer is not None
    rewards = model.replay_buffer.sample(64).rewards
    assert set(rewards.flatten().tolist()) <= {-1.0, 0.0}


@pytest.mark.slow
@pytest.mark.parametrize("task", TASKS | LOCOMOTION_TASKS)
def test_a_thousand_resets_leave_memory_flat(task: str) -> None:
    phase: Phase = "manipulation" if task in TASKS else "locomotion"
    envs = make_envs(task, phase)
    process = psutil.Process()
    for _ in range(WARM_UP):
        envs.reset()
    gc.collect()
    before = process.memory_info().rss

    for _ in range(1000):
        envs.reset()

    gc.collect()
    grown = process.memory_info().rss - before
    print(f"{task}: {grown / 1e3:.0f} kB more after 1,000 resets")
    assert grown < MAX_GROWTH
