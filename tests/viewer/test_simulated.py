"""Episodes are simulated on demand, and any moment of them can be gone back to, to the last bit."""

from __future__ import annotations

import numpy as np
import pytest

from sldr_core.envs import Envs, make_envs
from worker.viewer.simulated import Simulated


def push_right(obs, goal):
    return np.tile(np.array([0.3, -0.5, 0.1, 0.0], dtype=np.float32), (len(obs), 1))


@pytest.fixture
def envs() -> Envs:
    return make_envs("FetchPush", num_envs=2, seed=5)


def test_an_episode_is_that_of_the_same_environments_stepped_plainly(envs):
    episode = Simulated(envs, push_right)
    plain = make_envs("FetchPush", num_envs=2, seed=5)
    plain.reset()
    for _ in range(7):
        seen = plain.step(push_right(plain.qpos, None))
    assert episode.known == 0
    moment = episode.moment(7, lane=1)
    assert np.array_equal(moment.qpos, plain.qpos[1])
    assert np.array_equal(moment.obs, seen.obs[1])
    assert np.array_equal(episode.action(6, lane=1), push_right(plain.qpos, None)[1])
    assert episode.known == 7


def test_earlier_moments_are_kept_as_they_were(envs):
    episode = Simulated(envs, push_right)
    early = episode.moment(2).qpos.copy()
    episode.simulate_to(9)
    assert np.array_equal(episode.moment(2).qpos, early)


def test_a_branch_keeps_the_past_and_changes_what_follows(envs):
    episode = Simulated(envs, push_right)
    past, future = episode.moment(4).qpos, episode.moment(8).qpos
    episode.branch(4, lambda envs: envs.set_goal([1.3, 0.7, 0.42]))
    assert episode.known == 4
    assert np.array_equal(episode.moment(4).qpos, past)
    assert episode.moment(4).goal.tolist() == [1.3, 0.7, 0.42]
    assert np.array_equal(episode.moment(8).qpos, future)  # this policy does not look at the goal


def test_nothing_is_simulated_beyond_the_end(envs):
    episode = Simulated(envs, push_right)
    episode.simulate_to(10_000)
    assert episode.known == episode.steps == 50


def test_a_new_episode_has_another_goal_and_is_counted(envs):
    episode = Simulated(envs, push_right)
    before, version = episode.moment(0).goal, episode.version
    episode.restart()
    assert (episode.moment(0).goal != before).any()
    assert (episode.known, episode.version) == (0, version + 1)
