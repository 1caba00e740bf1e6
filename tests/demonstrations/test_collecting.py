"""A fan is the same whoever asks, and each of its demonstrations can be made again to the last bit."""

from __future__ import annotations

import numpy as np
import pytest

from sldr_core.demonstrations import BLOCK, FanCollection, demonstrate
from sldr_core.demonstrations.starts import SEED_OFFSET
from sldr_core.envs import make_envs


def test_a_block_alone_equals_the_same_block_of_a_larger_fan(push, push_fan):
    envs = push.make_envs(BLOCK)
    alone = FanCollection(envs, push.act, push.starts("FetchPush", envs), seed=3, count=BLOCK, first=BLOCK)
    while alone.advance():
        pass
    fan = alone.fan()
    assert np.array_equal(fan.achieved, push_fan.achieved[BLOCK:])
    assert np.array_equal(fan.action, push_fan.action[BLOCK:])


def test_a_demonstration_is_made_again_from_seed_index_and_actions(push, push_fan):
    envs = push.make_envs(1)
    index = BLOCK + 5
    drawn = push.starts("FetchPush", envs).draw(3, [index])
    again = demonstrate(envs, drawn, push.act, given=push_fan.action[index : index + 1])
    assert np.array_equal(again.achieved[0], push_fan.achieved[index])
    assert np.array_equal(again.reached[0], push_fan.reached[index])


def test_a_fan_is_what_a_plain_loop_does(push, push_fan):
    envs = make_envs("FetchPush", "locomotion", num_envs=BLOCK, testing=True)
    rngs = [np.random.default_rng((3 + SEED_OFFSET, index)) for index in range(BLOCK)]
    now = envs.begin(envs.draw_starts(rngs), rngs)
    for step in range(envs.episode_length):
        assert np.array_equal(now.achieved, push_fan.achieved[:BLOCK, step])
        assert np.array_equal(envs.success(now.achieved, now.goal), push_fan.reached[:BLOCK, step])
        action = push.act(now.obs.astype(np.float32), now.goal.astype(np.float32))
        assert np.array_equal(action, push_fan.action[:BLOCK, step])
        now = envs.step(action)


def test_a_close_look_keeps_every_moment(push):
    envs = push.make_envs(1)
    seen = demonstrate(envs, push.starts("FetchPush", envs).draw(0, [7]), push.act)
    assert seen.qpos.shape == (1, seen.steps + 1, envs.model.nq)
    assert np.array_equal(seen.qpos[0, -1], envs.qpos[0])
    assert np.array_equal(seen.state[0, :, :3], seen.achieved[0].astype(np.float32))


def test_other_seeds_and_other_numbers_give_other_starts(push):
    envs = push.make_envs(2)
    source = push.starts("FetchPush", envs)
    goals = np.concatenate([source.draw(seed, [0, 1]).start.goal for seed in (0, 1)])
    assert len(np.unique(goals, axis=0)) == 4


@pytest.mark.parametrize(("count", "first"), [(BLOCK + 1, 0), (0, 0), (10**6 * BLOCK, 0), (BLOCK, 1)])
def test_a_fan_is_made_of_whole_blocks_and_not_too_many(push, count, first):
    envs = push.make_envs(BLOCK)
    with pytest.raises(ValueError, match="blocks of"):
        FanCollection(envs, push.act, push.starts("FetchPush", envs), seed=0, count=count, first=first)


def test_a_stack_s_objects_get_their_own_starts_and_goals(inspect):
    inspected = inspect("FetchPickAndPlace")
    assert inspected.start_tasks == ("FetchPickAndPlace", "FetchStack2", "FetchStack3")
    drawn = inspected.starts("FetchStack2", inspected.make_envs(1)).draw(5, [6, 7])
    stacks = make_envs("FetchStack2", testing=True)
    stack = stacks.draw_starts([np.random.default_rng((5 + SEED_OFFSET, 3))])
    for part in (0, 1):
        pose = stacks.model.joint(f"object{part}:joint").qposadr[0]
        assert np.array_equal(drawn.start.qpos[part, :7], stack.qpos[0, pose : pose + 7])
        assert np.array_equal(drawn.start.goal[part], stack.goal[0, 3 * part : 3 * part + 3])
