"""The SLDR rewards against Eq. 8 and Eq. 7 written out in numpy, one transition at a time."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import torch
from small_training import collected_parts, save_untrained_model, tiny_config

from sldr_core.config import SldrConfig, find_task
from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets, Measured
from sldr_core.nets.transitions import Transitions
from sldr_core.nets.views import part_view
from sldr_core.streams import SldrStream

BATCH = 200
STORED = "sldr/object0/induced_action"
TASK = find_task("FetchPush")
OBJECT = part_view(TASK, TASK.parts[0])
CPU = torch.device("cpu")


@pytest.fixture
def nets() -> LocomotionNets:
    """Return networks with random weights, whose values spread over more than [-1, 0]."""
    generator = torch.Generator().manual_seed(0)
    nets = LocomotionNets(tiny_config(), generator)
    nets.normalizer.update(torch.randn(100, 18, generator=generator) * 2 + 1)
    nets.transition_normalizer.update(torch.randn(100, 24, generator=generator) * 2 - 1)
    nets.critic.weights[-1].data *= 300
    return nets.requires_grad_(False)


@pytest.fixture
def stream(nets: LocomotionNets) -> SldrStream:
    model = LocomotionModel(nets, tiny_config(), Measured(1.0, 1))
    return SldrStream("object0", SldrConfig(), model, OBJECT, CPU, autocast=False)


@pytest.fixture
def transitions(stream: SldrStream) -> Transitions:
    rng = np.random.default_rng(0)
    obs = rng.normal(size=(BATCH, 2, 25)).astype(np.float32)
    goal = torch.from_numpy(rng.normal(size=(BATCH, 3)).astype(np.float32))
    induced = torch.from_numpy(stream.annotate(obs)[STORED][:, 0])
    now, then = torch.from_numpy(obs[:, 0]), torch.from_numpy(obs[:, 1])
    return Transitions(now, then, goal, torch.zeros(BATCH, 4), torch.zeros(BATCH), {STORED: induced})


class PlainEquation:
    """Eq. 8 and Eq. 7 for one transition: the only code shared with the library is the weights."""

    def __init__(self, nets: LocomotionNets) -> None:
        self._part = {name: value.numpy().astype(np.float64) for name, value in nets.state_dict().items()}

    def reward(self, obs: np.ndarray, next_obs: np.ndarray, goal: np.ndarray) -> float:
        features = self._seen(obs, goal)
        actions = (self.induced(obs, next_obs), self._wanted(features))
        value = [self._forward("critic", np.concatenate([features, u]))[0] for u in actions]
        return float(min(max(value[0] - value[1], -1.0), 0.0))

    def distance_reward(self, obs: np.ndarray, next_obs: np.ndarray, goal: np.ndarray) -> float:
        induced, wanted = self.induced(obs, next_obs), self._wanted(self._seen(obs, goal))
        return max(-sum((w - u) ** 2 for w, u in zip(induced, wanted, strict=True)), -1.0)

    def induced(self, obs: np.ndarray, next_obs: np.ndarray) -> np.ndarray:
        z, next_z = self._object(obs), self._object(next_obs)
        return self._forward("inverse", self._normalised("transition_normalizer", np.concatenate([z, next_z - z])))

    def _seen(self, obs: np.ndarray, goal: np.ndarray) -> np.ndarray:
        z = self._object(obs)
        position, rotation, linear, angular = z[0:3], z[3:6], z[6:9], z[9:12]
        seen = np.concatenate([position, goal - position, rotation, -linear, angular, goal])
        return self._normalised("normalizer", seen)

    def _wanted(self, features: np.ndarray) -> np.ndarray:
        return np.tanh(self._forward("policy", features))

    @staticmethod
    def _object(obs: np.ndarray) -> np.ndarray:
        velocity = obs[14:17] + obs[20:23]  # relative to the grip, plus the grip's
        return np.concatenate([obs[3:6], obs[11:14], velocity, obs[17:20]])

    def _normalised(self, name: str, x: np.ndarray) -> np.ndarray:
        deviation = np.sqrt(self._part[f"{name}.m2"] / self._part[f"{name}.count"])
        return np.clip((x - self._part[f"{name}.mean"]) / (deviation + 0.01), -5, 5)

    def _forward(self, net: str, x: np.ndarray) -> np.ndarray:
        layers = sum(name.startswith(f"{net}.weights.") for name in self._part)
        for layer in range(layers):
            weight, bias = self._part[f"{net}.weights.{layer}"], self._part[f"{net}.biases.{layer}"]
            x = x @ weight[0] + bias[0, 0] if weight.ndim == 3 else weight @ x + bias
            x = np.maximum(x, 0.0) if layer < layers - 1 else x
        return x


def rows_of(batch: Transitions) -> Iterator[tuple[np.ndarray, ...]]:
    for parts in zip(batch.obs, batch.next_obs, batch.goal, strict=True):
        yield tuple(part.numpy().astype(np.float64) for part in parts)


def test_rewards_equal_the_equation_written_out(
    stream: SldrStream, nets: LocomotionNets, transitions: Transitions
) -> None:
    plain = PlainEquation(nets)

    rewards = stream.reward(transitions).numpy()

    expected = np.array([plain.reward(*row) for row in rows_of(transitions)])
    shares = [(expected == -1).mean(), (expected == 0).mean(), ((expected > -1) & (expected < 0)).mean()]
    assert min(shares) > 0.1, "the test has to meet both limits and what lies between"
    np.testing.assert_allclose(rewards, expected, atol=1e-3)


def test_the_distance_of_actions_equals_its_equation_written_out(
    nets: LocomotionNets, transitions: Transitions
) -> None:
    nets.policy.weights[-1].data *= 3  # so that actions lie nearer and further apart than 1
    plain, model = PlainEquation(nets), LocomotionModel(nets, tiny_config(), Measured(1.0, 1))
    stream = SldrStream("object0", SldrConfig(reward="action_distance"), model, OBJECT, CPU, autocast=False)

    rewards = stream.reward(transitions).numpy()

    expected = np.array([plain.distance_reward(*row) for row in rows_of(transitions)])
    assert min((expected == -1).mean(), (expected > -1).mean()) > 0.1, (
        "the test has to meet the limit and what is above"
    )
    np.testing.assert_allclose(rewards, expected, atol=1e-5)


def test_induced_actions_equal_the_inverse_model_written_out(
    stream: SldrStream, nets: LocomotionNets, transitions: Transitions
) -> None:
    plain = PlainEquation(nets)

    expected = [plain.induced(obs, next_obs) for obs, next_obs, _ in rows_of(transitions)]

    np.testing.assert_allclose(transitions.extra[STORED].numpy(), expected, atol=1e-5)


def test_induced_actions_are_computed_for_every_step_of_every_episode(stream: SldrStream) -> None:
    obs = np.random.default_rng(1).normal(size=(3, 6, 25)).astype(np.float32)

    annotated = stream.annotate(obs)

    assert stream.stored_sizes == {STORED: 7}
    assert annotated[STORED].shape == (3, 5, 7)
    alone = stream.annotate(obs[1:2, 2:4])[STORED][0, 0]
    np.testing.assert_allclose(annotated[STORED][1, 2], alone, atol=1e-6)


def test_an_object_that_does_what_it_wants_earns_the_most(
    stream: SldrStream, nets: LocomotionNets, transitions: Transitions
) -> None:
    wanted = nets.action(nets.features(OBJECT.object_state(transitions.obs), transitions.goal))
    transitions.extra[STORED][:] = wanted  # pyright: ignore[reportIndexIssue]

    assert stream.reward(transitions).abs().max() < 1e-4


def test_a_training_rewards_relabelled_goals_as_the_equation_does(tmp_path: Path) -> None:
    model = save_untrained_model(tmp_path / "model.pt")
    parts = collected_parts(tiny_config("manipulation", "her-sldr"), tmp_path, (model,))
    sample = parts.sampler.sample(100, 0)
    tensors = [torch.from_numpy(part) for part in (sample.obs, sample.next_obs, sample.goal, sample.action)]
    extra = {name: torch.from_numpy(values) for name, values in sample.extra.items()}
    batch = Transitions(*tensors, reward=torch.from_numpy(sample.reward), extra=extra)
    stream = parts.streams[1]
    assert isinstance(stream, SldrStream)
    plain = PlainEquation(stream._nets)

    rewards = stream.reward(batch).numpy()

    expected = [plain.reward(*row) for row in rows_of(batch)]
    np.testing.assert_allclose(rewards, expected, atol=1e-3)
    assert [stream.name for stream in parts.streams] == ["task", "sldr/object0"]
