"""A live policy in 3D: episodes go on, goals are moved, objects pushed, and one can go back to any moment."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import viser
from prepared import make_model, random_actions, save_model

from sldr_core.config import find_task
from sldr_core.envs import make_envs
from sldr_core.errors import BadFile
from sldr_core.presets import make_config
from worker.viewer.commands import BadCommand, Command
from worker.viewer.crowd import grid_offsets
from worker.viewer.gizmos import GoalGizmos
from worker.viewer.judging import StreamJudge
from worker.viewer.live import LiveShow, object_joints, open_live, push
from worker.viewer.page import open_page
from worker.viewer.reports import Job
from worker.viewer.timeline import worst_q
from worker.viewer.tracks import SimulatedTrack


@pytest.fixture(scope="module")
def server() -> Iterator[viser.ViserServer]:
    server = open_page()
    yield server
    server.stop()


@pytest.fixture
def show(server, policy_path) -> LiveShow:
    return open_live(server, Job("session", {"kind": "live"}, {"policy": (policy_path,)}))


def seek(show: LiveShow, step: int) -> None:
    show.transport.is_playing = False
    show.transport.seek(step)
    show.advance(0.0)


def test_a_moment_gone_back_to_is_the_same_to_the_last_bit(show):
    seek(show, 4)
    early = show.report()["qpos"]
    seek(show, 20)
    seek(show, 4)
    assert np.array_equal(show.report()["qpos"], early)


def test_a_goal_that_is_moved_leaves_the_past_and_changes_the_future(show):
    seek(show, 12)
    before, version = show.report()["qpos"], show.state()["timeline"]
    seek(show, 6)
    show.obey(Command("goal", {"goal": [1.2, 0.6, 0.42]}))
    assert show.state()["known"] == 6
    seek(show, 12)
    assert show.report()["goal"].tolist() == [1.2, 0.6, 0.42]
    assert (show.report()["qpos"] != before).any()
    assert show.state()["timeline"] > version


def test_a_push_changes_the_speed_and_no_position(show):
    seek(show, 3)
    before = show.report()
    show.obey(Command("push", {"velocity": [0.5, 0.0, -0.25]}))
    after = show.report()
    assert np.array_equal(after["qpos"], before["qpos"])
    joint = make_envs("FetchPush", "locomotion").model.joint("object0:joint")
    change = (after["qvel"] - before["qvel"])[joint.dofadr[0] :][:6]
    assert change == pytest.approx([0.5, 0.0, -0.25, 0, 0, 0])


@pytest.mark.parametrize("odd", [1, -1, "first", [0], None])
def test_an_object_that_there_is_not_is_not_pushed(show, odd):
    with pytest.raises(BadCommand, match='"object" of the command "push" has to be a whole number from 0 to 0'):
        show.obey(Command("push", {"velocity": [0.5, 0.0, 0.0], "object": odd}))


@pytest.mark.parametrize(("task", "movable"), [("HandBlockRotate", 1), ("FetchStack2", 2), ("FetchTuple3", 1)])
def test_every_object_of_a_task_can_be_pushed(task, movable):
    envs = make_envs(task)
    joints = object_joints(envs.model)
    assert len(joints) == movable
    before = envs.qvel.copy()
    push(envs, [0.5, 0.0, 0.0], joints[-1])
    assert np.count_nonzero(envs.qvel != before) == 1


def test_the_end_of_an_episode_is_followed_by_another(show):
    seek(show, 50)
    version = show.state()["timeline"]
    show.transport.is_playing = True
    for _ in range(3):
        show.advance(0.4)
    assert show.state()["timeline"] == version + 1
    assert show.transport.step < 50


def test_two_policies_start_from_the_same_start(server, policy_path, tmp_path, write_policy_file):
    write_policy_file(tmp_path / "other.pt", cycle=4)
    files = {"policy": (policy_path,), "beside": (tmp_path / "other.pt",)}
    show = open_live(server, Job("session", {"kind": "live"}, files))
    show.obey(Command("new", {}))
    seek(show, 0)
    one, other = show.report()["lanes"]
    assert np.array_equal(one["qpos"], other["qpos"])


def test_nine_episodes_go_side_by_side(server, policy_path):
    show = open_live(server, Job("session", {"kind": "live", "episodes": 9}, {"policy": (policy_path,)}))
    seek(show, 2)
    lanes = show.report()["lanes"]
    assert len(lanes) == len(show.state()["reached"]) == 9
    assert (lanes[0]["qpos"] != lanes[1]["qpos"]).any()


def test_a_policy_of_another_phase_cannot_start_from_the_same_start(server, policy_path, tmp_path, write_policy_file):
    write_policy_file(tmp_path / "robot.pt", phase="manipulation")
    files = {"policy": (policy_path,), "beside": (tmp_path / "robot.pt",)}
    with pytest.raises(BadFile, match=r"robot\.pt is a policy of FetchPush \(manipulation\); only one of FetchPush"):
        open_live(server, Job("session", {"kind": "live"}, files))


def test_a_simulated_transition_is_judged_as_the_training_s_stream_does():
    """Compare with q = Q(z, w) - Q(z, u) from the networks themselves, in numbers of their own."""
    import torch

    config, model = make_config("FetchPush", "manipulation", "her-sldr", 0, "smoke"), make_model("FetchPush")
    envs = make_envs("FetchPush", seed=2)
    episode = random_actions(envs)
    track = SimulatedTrack(episode, StreamJudge(config, {"FetchPush": model}, envs))
    judged = track.judged(5)
    state, later = (_object_state(episode.moment(step).obs) for step in (5, 6))
    goal = torch.tensor(episode.moment(5).goal, dtype=torch.float32)[None]
    features = model.nets.features(state, goal)
    induced, wanted = model.nets.inferred_action(state, later), model.nets.action(features)
    q = model.nets.value(features, induced) - model.nets.value(features, wanted)
    assert judged.reward["sldr/object0"] == pytest.approx(float(q.clamp(-1, 0)), abs=1e-5)
    assert judged.wanted[0] == pytest.approx(wanted[0].numpy(), abs=1e-6)
    assert judged.induced[0] == pytest.approx(induced[0].numpy(), abs=1e-6)
    assert judged.reward["task"] in (-1.0, 0.0)


def _object_state(obs):
    """Return position, Euler angles, velocity and spin of the block out of FetchPush's observation, `[1, 12]`."""
    import torch

    seen = np.concatenate([obs[3:6], obs[11:14], obs[14:17] + obs[20:23], obs[17:20]])
    return torch.tensor(seen, dtype=torch.float32)[None]


def test_a_dragged_chain_moves_as_a_whole_and_a_block_of_a_stack_alone(server):
    for task, moved in (("FetchTuple3", (0, 1, 2)), ("FetchStack2", (1,))):
        spec = find_task(task)
        gizmos = GoalGizmos(server, spec)
        goal = np.arange(spec.goal_size) / 10.0
        gizmos.show(goal)
        last = len(gizmos._nodes) - 1
        gizmos._nodes[last].position = goal[3 * last :][:3] + np.array([0.0, 0.2, 0.0])
        gizmos._dragged(last)
        wished = gizmos.take()
        assert wished is not None
        expected = goal.copy()
        expected[[3 * block + 1 for block in moved]] += 0.2
        assert wished == pytest.approx(expected)
        assert gizmos.take() is None


def test_copies_stand_apart_around_the_middle():
    offsets = grid_offsets(4, (2.0, 1.0))
    assert offsets.mean(axis=0) == pytest.approx([0, 0, 0])
    assert {tuple(place) for place in offsets} == {(-1, -0.5, 0), (-1, 0.5, 0), (1, -0.5, 0), (1, 0.5, 0)}


def test_the_worst_q_is_the_first_of_the_least_of_any_part():
    assert worst_q({"q/a": [0.0, -0.5, -0.9], "q/b": [-0.1, -0.9, 0.0], "reward/task": [-9.0, 0, 0]}) == 1
    assert worst_q({"reward/task": [-1.0]}) is None


def test_a_model_file_is_a_policy_as_well(server, tmp_path: Path):
    path = save_model("FetchPush", tmp_path / "locomotion.pt")
    show = open_live(server, Job("session", {"kind": "live", "policy": "locomotion.pt"}, {"policy": (path,)}))
    assert show.message == "Live: the object moving itself on FetchPush, locomotion.pt."
