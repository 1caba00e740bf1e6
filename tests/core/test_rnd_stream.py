"""Random network distillation: the target stays, the predictor learns, and what was seen loses its reward."""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch
from small_training import collected_parts, tiny_config
from torch import Tensor

from sldr_core.config import AgentConfig, RndConfig
from sldr_core.nets.transitions import Transitions
from sldr_core.nets.views import View, joined_features
from sldr_core.streams import RndStream
from sldr_core.training.cycle import learn

OBS, GOAL, OUTPUTS = 4, 2, 5
VIEW = View(OBS + GOAL, joined_features)
AGENT = replace(AgentConfig(), hidden_sizes=(16, 16), learning_rate=1e-2)
CPU = torch.device("cpu")


@pytest.fixture(autouse=True)
def one_thread() -> Iterator[None]:
    """Keep threads from waiting for each other over networks this small."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def make_stream(seed: int = 0) -> RndStream:
    generator = torch.Generator().manual_seed(seed)
    return RndStream(RndConfig(outputs=OUTPUTS), AGENT, VIEW, generator, CPU, autocast=False)


def episodes(seed: int, shift: float = 0.0) -> tuple[Tensor, Tensor]:
    generator = torch.Generator().manual_seed(seed)
    goal = torch.randn((6, 1, GOAL), generator=generator).expand(6, 9, GOAL)
    return torch.randn((6, 9, OBS), generator=generator) + shift, goal


def batch_of(obs: Tensor, goal: Tensor) -> Transitions:
    """Return all transitions of episodes; what only other streams use is no number."""
    now, then, goals = (part.reshape(-1, part.shape[-1]) for part in (obs[:, :-1], obs[:, 1:], goal[:, 1:]))
    unused = torch.full((len(now), 1), float("nan"))
    return Transitions(now * float("nan"), then, goals, unused, unused[:, 0], {})


def forward(weights: list[np.ndarray], biases: list[np.ndarray], x: np.ndarray) -> np.ndarray:
    for layer, (weight, bias) in enumerate(zip(weights, biases, strict=True)):
        x = weight @ x + bias
        x = np.maximum(x, 0.0) if layer < len(weights) - 1 else x
    return x


def plain_errors(stream: RndStream, next_obs: Tensor, goal: Tensor, seen: np.ndarray) -> np.ndarray:
    """Return the summed squared errors, one state at a time, normalised by the rows `seen` before."""
    mean, deviation = seen.mean(axis=0), seen.std(axis=0)
    errors = []
    for state, wanted in zip(next_obs.double().numpy(), goal.double().numpy(), strict=True):
        x = np.clip((np.concatenate([state, wanted]) - mean) / (deviation + 0.01), -5, 5)
        outputs = [
            forward(
                [w.detach().double().numpy() for w in net.weights], [b.detach().double().numpy() for b in net.biases], x
            )
            for net in (stream.nets.predictor, stream.nets.target)
        ]
        errors.append(float(np.square(outputs[0] - outputs[1]).sum()))
    return np.array(errors)


def test_rewards_are_the_errors_at_next_states_in_deviations_from_those_that_were_visited() -> None:
    stream = make_stream()
    obs, goal = episodes(0)
    stream.observe(obs, goal)
    batch = batch_of(*episodes(1, shift=0.5))

    rewards = stream.reward(batch).numpy()

    seen = torch.cat([obs, goal], dim=-1).reshape(-1, OBS + GOAL).double().numpy()
    visited = batch_of(obs, goal)
    errors = plain_errors(stream, visited.next_obs, visited.goal, seen)
    expected = plain_errors(stream, batch.next_obs, batch.goal, seen)
    expected = np.clip((expected - errors.mean()) / (errors.std() + 0.01), -5, 5)
    np.testing.assert_allclose(rewards, expected, atol=1e-4)
    assert rewards.std() > 0.1


def test_the_target_stays_and_the_predictor_moves() -> None:
    stream = make_stream()
    stream.observe(*episodes(0))
    before = deepcopy(stream.nets.state_dict())

    for _ in range(5):
        stream.learn(batch_of(*episodes(0)))

    moved = {name for name, value in stream.nets.state_dict().items() if not torch.equal(value, before[name])}
    assert moved == {name for name in before if name.startswith("predictor.")}


def test_what_was_learnt_is_rewarded_less_than_what_is_new() -> None:
    stream = make_stream()
    stream.observe(*episodes(0))
    known, new = batch_of(*episodes(0)), batch_of(*episodes(1, shift=3.0))
    before = stream.reward(known).mean()

    losses = [float(stream.learn(known)["rnd/loss"]) for _ in range(60)]

    assert losses[-1] < 0.1 * losses[0]
    assert stream.reward(known).mean() < before
    assert stream.reward(new).mean() > stream.reward(known).max()


def test_asking_for_rewards_changes_nothing() -> None:
    stream = make_stream()
    stream.observe(*episodes(0))
    before = deepcopy(stream.state_dict())

    first, again = (stream.reward(batch_of(*episodes(1))) for _ in range(2))

    assert torch.equal(first, again)
    assert not first.requires_grad
    after = stream.state_dict()
    assert all(torch.equal(value, before["nets"][name]) for name, value in after["nets"].items())


def test_rewards_are_limited() -> None:
    stream = make_stream()
    stream.observe(*episodes(0))
    for weight in stream.nets.target.parameters():
        weight.data *= 10

    assert stream.reward(batch_of(*episodes(1))).max() == 5.0


def test_a_restored_stream_goes_on_to_the_last_bit() -> None:
    stream, other = make_stream(seed=0), make_stream(seed=1)
    stream.observe(*episodes(0))
    stream.learn(batch_of(*episodes(0)))

    other.load_state_dict(deepcopy(stream.state_dict()))

    for one in (stream, other):
        one.observe(*episodes(1))
        one.learn(batch_of(*episodes(1)))
    batch = batch_of(*episodes(2))
    assert torch.equal(stream.reward(batch), other.reward(batch))


def test_a_training_learns_to_predict_on_the_very_batches_of_its_agent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    parts = collected_parts(tiny_config("manipulation", "her-rnd", updates_per_cycle=3), tmp_path)
    stream, seen = parts.streams[1], []
    assert isinstance(stream, RndStream)
    update, learnt = parts.agent.update, stream.learn
    monkeypatch.setattr(parts.agent, "update", lambda batch, rewards: (seen.append(batch), update(batch, rewards))[1])
    monkeypatch.setattr(stream, "learn", lambda batch: (seen.append(batch), learnt(batch))[1])

    metrics = learn(parts, 0, lambda: None)

    assert len(seen) == 6
    assert all(first is second for first, second in zip(seen[::2], seen[1::2], strict=True))
    assert metrics["rnd/loss"] > 0.0
    assert {"critic/rnd/loss", "stream/rnd/mean"} <= set(metrics)
    assert float(stream.nets.scale.count) == 2 * 8, "every step of both episodes was visited once"


def test_the_other_networks_start_as_without_the_stream(tmp_path: Path) -> None:
    starts = []
    for method in ("her", "her-rnd"):
        (tmp_path / method).mkdir()
        starts.append(collected_parts(tiny_config("manipulation", method), tmp_path / method).agent.actor.state_dict())

    assert all(torch.equal(value, starts[1][name]) for name, value in starts[0].items())
