"""The time machine: every kept policy from one start toward one goal, each as if it were alone."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
import viser

from sldr_core.envs import make_envs
from sldr_core.training import load_policy
from sldr_core.training.files import KEPT_POLICIES, keeps_policy
from worker.viewer.commands import Command
from worker.viewer.page import open_page
from worker.viewer.reports import Job
from worker.viewer.simulated import Simulated
from worker.viewer.time_machine import act_each, distinct_epochs, one_start_for_all, open_time_machine, path_colours


@pytest.fixture(scope="module")
def server() -> Iterator[viser.ViserServer]:
    server = open_page()
    yield server
    server.stop()


@pytest.fixture(scope="module")
def policy_files(tmp_path_factory, write_policy_file):
    home = tmp_path_factory.mktemp("policies")
    for cycle in (2, 4, 8):
        write_policy_file(home / f"policy-epoch-{cycle // 2:04d}.pt", cycle=cycle)
    write_policy_file(home / "policy-newest.pt", cycle=8)
    return tuple(sorted(home.glob("policy-*.pt")))


def test_every_lane_begins_alike_and_goes_as_its_policy_would_alone(policy_files):
    policies = distinct_epochs([load_policy(path) for path in policy_files])
    lanes = make_envs("FetchPush", "locomotion", num_envs=len(policies), seed=7)
    source = make_envs("FetchPush", "locomotion", seed=7)
    together = Simulated(lanes, act_each(policies), one_start_for_all(source))
    alone = Simulated(
        make_envs("FetchPush", "locomotion", seed=7), policies[1].act, lambda envs: envs.restore(source.state())
    )
    for step in (0, 9):
        assert np.array_equal(together.moment(step, lane=1).qpos, alone.moment(step).qpos)
    assert np.array_equal(together.moment(0, lane=0).qpos, together.moment(0, lane=2).qpos)


def test_policies_are_in_the_order_of_training_and_each_epoch_once(policy_files):
    epochs = [policy.epoch for policy in distinct_epochs([load_policy(path) for path in policy_files])]
    assert epochs == [1, 2, 4]


def test_scrubbing_over_training_keeps_the_step_and_shows_another_policy(server, policy_files):
    show = open_time_machine(server, Job("session", {"kind": "time-machine"}, {"policies": policy_files}))
    show.transport.is_playing = False
    for _ in range(show.transport.steps):
        show.advance(0.0)
    show.transport.seek(8)
    state = show.state()
    assert (state["epochs"], state["at"]) == ([1, 2, 4], 2)
    assert None not in state["successes"]
    show.obey(Command("epoch", {"at": 0}))
    assert show.transport.step == 8
    assert show.state()["timeline"] != state["timeline"]
    assert show.report()["qpos"].shape == (7,)


def test_colours_go_from_bright_to_dark():
    brightness = [sum(colour) for colour in path_colours(5)]
    assert brightness == sorted(brightness, reverse=True)
    assert len(path_colours(1)) == 1


@pytest.mark.parametrize("epochs", [1, 2, 12, 13, 50, 1000])
def test_policies_are_kept_evenly_and_never_too_many(epochs):
    kept = [epoch for epoch in range(1, epochs + 1) if keeps_policy(epoch, epochs)]
    assert kept[0] == 1
    assert len(kept) <= KEPT_POLICIES + 1
    assert max(np.diff([*kept, epochs]), default=0) <= -(-epochs // KEPT_POLICIES)
