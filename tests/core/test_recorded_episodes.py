"""What a test records of its first episodes is what happened and what the training itself would compute of it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch
from small_training import (
    SHORT_PUSH,
    StoppingRecorder,
    collected_parts,
    metrics_of,
    run,
    save_untrained_model,
    state_of,
    tiny_config,
)

from sldr_core.config import TrainConfig, config_from_dict, config_hash
from sldr_core.envs import make_envs
from sldr_core.episodes import RecordedTest, read_episodes, tag_shares
from sldr_core.nets.files import load_tensors, save_tensors
from sldr_core.nets.locomotion_model import load_locomotion_model
from sldr_core.nets.views import table_state
from sldr_core.presets import make_config
from sldr_core.records import Episodes
from sldr_core.replay.sampling import Draw, read_sample
from sldr_core.training import train
from sldr_core.training.build import Parts
from sldr_core.training.checkpoint import KIND as CHECKPOINT_KIND
from sldr_core.training.cycle import learn
from sldr_core.training.files import CHECKPOINT_FILE
from sldr_core.training.recording import EpisodeRecording
from sldr_core.training.resimulation import first_differences, make_resimulation
from sldr_core.training.rollout import numpy_policy
from sldr_core.training.testing import run_test
from sldr_core.training.updates import on_device
from sldr_core.training.witness import Witness

KEPT = 3


def nothing() -> None:
    """Check nothing between steps."""


def record(parts: Parts, episodes: int = 5) -> tuple[RecordedTest, Witness, int]:
    """Hold a test and record it; return the number of its successes as well."""
    witness = Witness(parts.test_envs, KEPT)
    result = run_test(parts.test_envs, numpy_policy(parts.agent.act_averaged), episodes, nothing, witness)
    return EpisodeRecording(parts).record(witness.courses, 7, 700), witness, result.successes


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return save_untrained_model(tmp_path_factory.mktemp("model") / "model.pt")


@pytest.fixture(scope="module")
def parts(tmp_path_factory: pytest.TempPathFactory, model: Path) -> Parts:
    """Return a training that has learnt a little, so that critics and normalisers are not as they began."""
    parts = collected_parts(tiny_config("manipulation", "her-sldr"), tmp_path_factory.mktemp("parts"), (model,))
    learn(parts, 0, nothing)
    return parts


@pytest.fixture(scope="module")
def recorded(parts: Parts) -> RecordedTest:
    return record(parts)[0]


def test_the_first_episodes_of_a_test_are_recorded_whole(parts: Parts, recorded: RecordedTest) -> None:
    assert [episode.index for episode in recorded.episodes] == [0, 1, 2]
    assert recorded.origin.streams == ("task", "sldr/object0")
    assert recorded.origin.parts == ("object0",)
    assert recorded.origin.objects == ("object0",)
    assert (recorded.origin.epoch, recorded.origin.env_steps) == (7, 700)
    assert config_from_dict(dict(recorded.origin.config)) == parts.config
    assert recorded.origin.config_hash == config_hash(parts.config)
    for episode in recorded.episodes:
        assert episode.length == SHORT_PUSH.episode_length
        assert episode.wanted.shape == episode.induced.shape == (8, 1, 7)
        twin = make_envs("ShortPush", num_envs=1, testing=True)
        twin.qpos[0], twin.qvel[0] = episode.qpos[0], episode.qvel[0]
        twin.simulation.forward()
        twin.set_goal(episode.goal)
        seen = twin.observe()
        np.testing.assert_array_equal(episode.obs[0], seen.obs[0].astype(np.float32))
        np.testing.assert_array_equal(episode.achieved[0], seen.achieved[0].astype(np.float32))
        np.testing.assert_allclose(episode.distance, np.linalg.norm(episode.achieved - episode.goal, axis=1), atol=1e-6)
        np.testing.assert_array_equal(episode.success, episode.distance < 0.05)
        acted = parts.agent.act_averaged(
            torch.from_numpy(episode.obs[:-1]), torch.from_numpy(episode.goal).float().expand(8, 3)
        )
        np.testing.assert_allclose(episode.action, acted.numpy(), atol=1e-5)


def test_rewards_are_those_that_the_training_draws_from_its_memory(parts: Parts, recorded: RecordedTest) -> None:
    extra = {}
    obs = np.stack([episode.obs for episode in recorded.episodes])
    for stream in parts.streams:
        extra.update(stream.annotate(obs))
    first = parts.buffer.written
    parts.buffer.store(
        Episodes(
            obs=obs,
            achieved=np.stack([episode.achieved for episode in recorded.episodes]),
            goal=np.stack([episode.goal.astype(np.float32) for episode in recorded.episodes]),
            action=np.stack([episode.action for episode in recorded.episodes]),
            extra=extra,
        )
    )
    for at, episode in enumerate(recorded.episodes):
        for step in range(episode.length):
            slot = (first + at) % parts.buffer.slots
            draw = Draw(np.array([slot]), np.array([step]), np.array([0]))
            batch = on_device(read_sample(parts.buffer, draw, parts.envs.reward), torch.device("cpu"))
            for column, stream in enumerate(parts.streams):
                assert episode.reward[step, column] == pytest.approx(float(stream.reward(batch)), abs=1e-5)


@torch.no_grad()
def test_q_is_the_object_s_own_value_of_what_was_done_less_that_of_what_it_wanted(
    recorded: RecordedTest, model: Path
) -> None:
    nets = load_locomotion_model(model).nets
    for episode in recorded.episodes:
        state = table_state(torch.from_numpy(episode.obs), 1, range(1))
        goal = torch.from_numpy(episode.goal).float()
        for step in range(episode.length):
            features = nets.features(state[step : step + 1], goal[None])
            wanted = nets.action(features)
            induced = nets.inferred_action(state[step : step + 1], state[step + 1 : step + 2])
            q = float(nets.value(features, induced) - nets.value(features, wanted))
            np.testing.assert_allclose(episode.wanted[step, 0], wanted[0].numpy(), atol=1e-5)
            np.testing.assert_allclose(episode.induced[step, 0], induced[0].numpy(), atol=1e-5)
            assert episode.reward[step, 1] == pytest.approx(min(max(q, -1.0), 0.0), abs=1e-5)


@torch.no_grad()
def test_values_are_those_of_the_online_critics(parts: Parts, recorded: RecordedTest) -> None:
    for episode in recorded.episodes:
        for step in range(episode.length):
            goal = torch.from_numpy(episode.goal).float()
            seen = parts.agent.normalizer(torch.cat([torch.from_numpy(episode.obs[step]), goal]))
            value = parts.agent.critics(torch.cat([seen, torch.from_numpy(episode.action[step])])[None])[:, 0, 0]
            np.testing.assert_allclose(episode.value[step], value.numpy(), atol=1e-5)


def test_a_recorded_episode_simulates_again_to_the_same_bits(parts: Parts, recorded: RecordedTest) -> None:
    assert all(episode.resimulates for episode in recorded.episodes)
    one = recorded.episodes[1]
    alone = make_resimulation(parts.config, 1)
    spoilt = one.action.copy()
    spoilt[4, 0] += 0.25

    assert first_differences(alone, [one]) == [None]
    assert first_differences(alone, [replace(one, action=spoilt)]) == [5]
    assert first_differences(alone, [replace(one, qpos=one.qpos + 1e-12)]) == [0]


def test_an_episode_beside_a_robot_that_acts_at_random_simulates_again(tmp_path: Path) -> None:
    config = make_config(SHORT_PUSH.name, "locomotion", "her", 0, "smoke", {"scene": {"locomotion_robot": "random"}})
    recorded, witness, _ = record(collected_parts(config, tmp_path))

    assert all(episode.resimulates for episode in recorded.episodes)
    assert recorded.origin.parts == ()
    assert recorded.episodes[0].wanted.shape == (8, 0, 0)
    assert not {"never_touched", "dropped"} & set(witness.tags)


def test_shares_are_of_every_episode_of_the_test(parts: Parts) -> None:
    recorded, witness, successes = record(parts, episodes=5)

    assert len(witness.tags) == 5
    assert tag_shares(witness.tags)["success"] == successes / 5
    assert [episode.tag for episode in recorded.episodes] == witness.tags[:KEPT]


def test_a_robot_that_pushes_has_touched_and_one_that_waits_has_not() -> None:
    envs = make_envs("FetchPush", num_envs=4, seed=5, testing=True)

    def go_through_the_object(obs: np.ndarray, goal: np.ndarray) -> np.ndarray:
        action = np.zeros((len(obs), 4), dtype=np.float32)
        action[:2, :3] = 10.0 * (obs[:2, 3:6] - obs[:2, :3])
        return action

    witness = Witness(envs, kept=1)
    run_test(envs, go_through_the_object, 4, nothing, witness)

    untouched = [tag == "never_touched" for tag in witness.tags]
    assert untouched == [False, False, True, True]
    assert witness.courses[0].contact.any()


def as_if_unrecorded(config: TrainConfig) -> TrainConfig:
    return replace(config, loop=replace(config.loop, recorded_episodes=0))


@pytest.mark.parametrize("method", ["her-dense", "her-rnd", "her-sldr"])
def test_recording_changes_neither_metrics_nor_weights(method: str, model: Path, tmp_path: Path) -> None:
    config = tiny_config("manipulation", method)
    run(config, tmp_path / "with", (model,))
    run(as_if_unrecorded(config), tmp_path / "without", (model,))

    assert len(list((tmp_path / "with").glob("episodes-*"))) == 2
    assert not list((tmp_path / "without").glob("episodes-*"))
    assert metrics_of(tmp_path / "with") == metrics_of(tmp_path / "without")
    ours, theirs = state_of(tmp_path / "with"), state_of(tmp_path / "without")
    assert {name for name in ours if ours[name] != theirs[name]} == {"config", "config_hash"}


def test_a_resumed_training_records_the_same_bytes(model: Path, tmp_path: Path) -> None:
    config = tiny_config("manipulation", "her-sldr", epochs=3)
    run(config, tmp_path / "whole", (model,))
    train(config, StoppingRecorder(tmp_path / "parts", 3, "shutdown"), (model,))
    run(config, tmp_path / "parts", (model,))

    for epoch in (1, 2, 3):
        name = f"episodes-epoch-{epoch:04d}.npz"
        assert (tmp_path / "parts" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()
        shares = metrics_of(tmp_path / "whole")[2 * epoch - 1]["metrics"]
        kept = read_episodes(tmp_path / "whole" / name)
        assert [kept.origin.epoch, len(kept.episodes)] == [epoch, 3]
        assert shares["episodes/success_share"] == shares["test/success_rate"]
        assert shares["episodes/never_touched_share"] == pytest.approx(
            [episode.tag for episode in kept.episodes].count("never_touched") / 3
        )


def test_a_checkpoint_of_before_episodes_were_recorded_is_gone_on_from(tmp_path: Path) -> None:
    config = tiny_config(epochs=3)
    train(config, StoppingRecorder(tmp_path, 3, "shutdown"))
    content = load_tensors(tmp_path / CHECKPOINT_FILE, CHECKPOINT_KIND)
    del content["counters"]["best_epoch"], content["config"]["loop"]["recorded_episodes"]
    save_tensors(tmp_path / CHECKPOINT_FILE, content)

    assert run(config, tmp_path).finished
    assert (tmp_path / "episodes-epoch-0003.npz").exists()
