"""A training on a GPU is the same code; without one, at least no tensor of an update is left on the processor."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import pytest
import torch
from small_training import StoppingRecorder, assert_same_training, run, save_untrained_model, tiny_config

from sldr_core.agent import DdpgAgent, InverseLearner
from sldr_core.config import METHODS, Phase, TrainConfig
from sldr_core.nets.adam import Adam
from sldr_core.nets.locomotion_model import load_locomotion_model
from sldr_core.nets.transitions import Transitions
from sldr_core.nets.views import view_of
from sldr_core.streams import Stream, StreamOrder, TaskStream, build_rnd, build_sldr
from sldr_core.training import evaluate, load_policy, train
from sldr_core.training.build import build_training
from sldr_core.training.cycle import collect_random, learn
from sldr_core.training.graphs import EAGER_UPDATES
from sldr_core.training.updates import update_on

needs_gpu = pytest.mark.skipif(not torch.cuda.is_available(), reason="torch finds no GPU on this machine")

TRAININGS: list[tuple[Phase, str]] = [("locomotion", "her"), *(("manipulation", method) for method in METHODS)]
every_training = pytest.mark.parametrize(("phase", "method"), TRAININGS, ids=["-".join(names) for names in TRAININGS])


def config_on(device: str, phase: Phase, method: str) -> TrainConfig:
    config = tiny_config(phase, method)
    return replace(config, compute=replace(config.compute, device=device))  # pyright: ignore[reportArgumentType]


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return save_untrained_model(tmp_path / "model.pt")


@needs_gpu
@every_training
def test_a_training_on_a_gpu_is_stopped_resumed_and_measured(
    phase: Phase, method: str, tmp_path: Path, model: Path
) -> None:
    config = config_on("cuda", phase, method)

    run(config, tmp_path / "whole", (model,))
    train(config, StoppingRecorder(tmp_path / "parts", 2, "shutdown"), (model,))
    run(config, tmp_path / "parts", (model,))

    assert_same_training(tmp_path / "parts", tmp_path / "whole")
    for path in (tmp_path / "whole").glob("*.pt"):
        assert load_policy(path).normalizer.shift.device.type == "cpu"
        assert evaluate(path, episodes=2, seed=0).episodes == 2


@needs_gpu
@every_training
def test_a_gpu_learns_what_a_processor_learns(phase: Phase, method: str, tmp_path: Path, model: Path) -> None:
    learnt: list[dict[str, float]] = []
    for device in ("cpu", "cuda"):
        (tmp_path / device).mkdir()
        parts = build_training(config_on(device, phase, method), tmp_path / device, (model,))
        collect_random(parts, lambda: None)
        metrics = learn(parts, 0, lambda: None)
        learnt.append({name: value for name, value in metrics.items() if not name.startswith("speed/")})
        assert next(parts.agent.actor.parameters()).device.type == device

    assert learnt[1] == pytest.approx(learnt[0], rel=1e-3, abs=1e-4)


@needs_gpu
@every_training
def test_a_replayed_update_is_the_one_made_operation_by_operation(
    phase: Phase, method: str, tmp_path: Path, model: Path
) -> None:
    config = config_on("cuda", phase, method)
    told: list[dict[str, float]] = []
    states: list[dict[str, Any]] = []
    for name in ("replayed", "by operation"):
        (tmp_path / name).mkdir()
        parts = build_training(config, tmp_path / name, (model,))
        make = parts.make_update
        if name == "by operation":
            make = partial(update_on, parts.learners, parts.compute.device)
        collect_random(parts, lambda: None)
        # Both kinds of updates, those that move the targets and those that do not, are captured and replayed.
        updates = [make(parts.sampler.sample(16, number), number % 2 == 0) for number in range(4 * EAGER_UPDATES)]
        told.append({metric: float(value) for metric, value in updates[-1].metrics.items()})
        states.append(parts.learner_states())

    assert told[0] == told[1]
    torch.testing.assert_close(states[0], states[1], rtol=0.0, atol=0.0)


@needs_gpu
def test_auto_takes_the_gpu(tmp_path: Path) -> None:
    parts = build_training(tiny_config(), tmp_path, [])

    assert parts.compute.device.type == "cuda"


def test_a_file_from_a_machine_with_a_gpu_is_measured_on_one_without(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    run(tiny_config(), tmp_path)
    content = torch.load(tmp_path / "policy-best.pt", weights_only=True)
    content["config"]["compute"]["device"] = "cuda"
    torch.save(content, tmp_path / "policy-best.pt")

    assert evaluate(tmp_path / "policy-best.pt", episodes=2, seed=0).episodes == 2


@pytest.fixture
def elsewhere(monkeypatch: pytest.MonkeyPatch) -> torch.device:
    """Return a device whose tensors have no numbers, but which, like a GPU, refuses tensors that lie elsewhere."""
    for module in ("agent.ddpg", "agent.inverse", "streams.rnd"):
        monkeypatch.setattr(f"sldr_core.{module}.Adam", lambda parameters, lr, fused: Adam(parameters, lr=lr))
    monkeypatch.setattr(torch, "autocast", lambda *_, **__: nullcontext())
    return torch.device("meta")


def zeros(device: torch.device, **sizes: int) -> dict[str, torch.Tensor]:
    return {name: torch.zeros(4, size, device=device) for name, size in sizes.items()}


@pytest.mark.parametrize(("method", "build"), [("her-sldr", build_sldr), ("her-rnd", build_rnd)])
def test_no_tensor_of_a_robot_s_update_is_left_on_the_processor(
    method: str, build: Callable[[StreamOrder], Sequence[Stream]], model: Path, elsewhere: torch.device
) -> None:
    config, generator = tiny_config("manipulation", method), torch.Generator()
    models = {"ShortPush": load_locomotion_model(model)}
    streams = [TaskStream(), *build(StreamOrder(config, models, generator, elsewhere, autocast=False))]
    view, names = view_of(config.task_spec, "manipulation"), [stream.name for stream in streams]
    agent = DdpgAgent(view, 4, names, [1.0, 1.0], config.agent, generator, elsewhere, autocast=False)
    stored = {name: size for stream in streams for name, size in stream.stored_sizes.items()}
    tensors = zeros(elsewhere, obs=25, next_obs=25, goal=3, action=4)
    batch = Transitions(**tensors, reward=torch.zeros(4, device=elsewhere), extra=zeros(elsewhere, **stored))
    seen = zeros(torch.device("cpu"), obs=25, goal=3)

    agent.observe(**seen)
    metrics = agent.update(batch, torch.stack([stream.reward(batch) for stream in streams]))
    for stream in streams:
        stream.observe(seen["obs"][None], seen["goal"][None])
        metrics.update(stream.learn(batch))
    agent.sync_targets()

    assert {value.device.type for value in metrics.values()} == {"meta"}


def test_no_tensor_of_the_inverse_model_is_left_on_the_processor(elsewhere: torch.device) -> None:
    learner = InverseLearner(12, 7, tiny_config().agent, torch.Generator(), elsewhere, autocast=False)
    tensors = zeros(elsewhere, obs=12, next_obs=12, goal=3, action=7)
    seen = zeros(torch.device("cpu"), state=12, next_state=12, action=7)

    error = learner.error(**seen)
    learner.observe(seen["state"], seen["next_state"])
    metrics = learner.update(Transitions(**tensors, reward=torch.zeros(4, device=elsewhere), extra={}))

    assert {value.device.type for value in (error, *metrics.values())} == {"meta"}
