"""A number that is not finite ends a training at once, by its name, and leaves what it came from."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from small_training import CrashingRecorder, metrics_of, run, save_untrained_model, tiny_config

from sldr_core.agent import DdpgAgent, ddpg, inverse
from sldr_core.envs import Envs, Observation
from sldr_core.errors import DiskTooFull, TrainingDiverged
from sldr_core.nets.files import load_tensors
from sldr_core.nets.transitions import Transitions
from sldr_core.streams import TaskStream
from sldr_core.training import DirectoryRecorder, train

NAN = float("nan")


def third_call(healthy: Any, broken: Any) -> Any:
    """Return a function that is `healthy` twice and then `broken`."""
    calls = iter(range(10**6))
    return lambda *arguments, **named: (healthy if next(calls) < 2 else broken)(*arguments, **named)


def diverge(directory: Path) -> tuple[str, dict[str, Any]]:
    """Train until a number is not finite; return what is told, and what is left."""
    with pytest.raises(TrainingDiverged) as err:
        run(tiny_config(), directory)
    (path,) = directory.glob("dump-cycle-*.pt")
    assert str(err.value).endswith(f"What it came from is kept in {path}.")
    return str(err.value), load_tensors(path, "dump")


def test_a_reward(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def poisoned(_: TaskStream, batch: Transitions) -> torch.Tensor:
        return batch.reward.index_fill(0, torch.tensor([5]), NAN)

    monkeypatch.setattr(TaskStream, "reward", third_call(TaskStream.reward, poisoned))

    told, dump = diverge(tmp_path)

    # Two updates a cycle: the third is of the second one.
    assert told.startswith("the reward of stream 'task' became nan in cycle 2: training was stopped")
    assert (dump["culprit"], dump["cycle"]) == ("the reward of stream 'task'", 2)
    evidence = dump["evidence"]
    assert evidence["rewards"]["task"].isnan().nonzero().tolist() == [[5]]
    assert evidence["obs"].shape == evidence["next_obs"].shape == (16, 12)
    assert (evidence["goal"].shape, evidence["action"].shape) == ((16, 3), (16, 7))
    assert [line["cycle"] for line in metrics_of(tmp_path)] == [1]


class FullDisk(DirectoryRecorder):
    """Have no room for evidence."""

    def save_file(self, name: str, kind: str, write: Callable[[Path], None]) -> Path:
        if kind == "dump":
            raise DiskTooFull(f"{name} does not fit; free some space.")
        return super().save_file(name, kind, write)


def test_what_diverged_is_told_on_a_full_disk_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(TaskStream, "reward", lambda _, batch: batch.reward * NAN)
    with pytest.raises(TrainingDiverged, match=r"the reward of stream 'task' became nan .* as the disk is full"):
        train(tiny_config(), FullDisk(tmp_path))


def test_a_loss(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def infinite(q: torch.Tensor, target: torch.Tensor) -> torch.Tensor:
        return ((q - target) * float("inf")).square().mean(dim=1)

    monkeypatch.setattr(ddpg, "critic_losses", third_call(ddpg.critic_losses, infinite))

    told, dump = diverge(tmp_path)

    assert told.startswith("critic/task/loss became inf in cycle 2")
    assert dump["evidence"]["metrics"]["critic/task/loss"] == float("inf")
    assert np.isfinite(dump["evidence"]["metrics"]["critic/task/q_max"])


def test_a_value(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    healthy = DdpgAgent._critic_metrics

    def poisoned(agent: DdpgAgent, losses: torch.Tensor, q: torch.Tensor, target: torch.Tensor) -> Any:
        return healthy(agent, losses, q.index_fill(1, torch.tensor([0]), float("-inf")), target)

    monkeypatch.setattr(DdpgAgent, "_critic_metrics", third_call(healthy, poisoned))

    told, dump = diverge(tmp_path)

    assert told.startswith("critic/task/q_mean became -inf in cycle 2")
    assert dump["evidence"]["metrics"]["critic/task/q_min"] == float("-inf")


def test_a_weight_that_an_update_breaks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    healthy = inverse.InverseLearner.update

    def update(learner: inverse.InverseLearner, batch: Transitions) -> Any:
        healthy(learner, batch)
        learner.net.biases[1].data[3] = NAN
        norm = torch.nn.utils.get_total_norm(list(learner.net.parameters()))
        return {"inverse/loss": torch.tensor(0.1), "inverse/weight_norm": norm.detach()}

    monkeypatch.setattr(inverse.InverseLearner, "update", third_call(healthy, update))

    told, dump = diverge(tmp_path)

    assert told.startswith("inverse.net.biases.1 became nan in cycle 2")
    assert dump["evidence"]["obs"].shape == (16, 12)


@pytest.mark.parametrize("part", ["actor", "critics", "_target_critics"])
def test_a_weight_that_is_broken_between_cycles(part: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def break_weight(agent: DdpgAgent) -> None:
        getattr(agent, part).weights[1].data[..., 0] = float("inf")

    monkeypatch.setattr(DdpgAgent, "sync_targets", third_call(lambda _: None, break_weight))

    told, dump = diverge(tmp_path)

    # Targets are synced once a cycle: the third is the last thing that the third cycle does.
    name = f"agent.{part.strip('_')}.weights.1"
    assert told.startswith(f"{name} became inf in cycle 4")
    assert dump["evidence"][name].isinf().any()


@pytest.mark.parametrize(("entry", "number"), [("obs", NAN), ("achieved", float("inf"))])
def test_an_observation(entry: str, number: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    healthy, steps = Envs.step, iter(range(10**6))

    def step(envs: Envs, action: np.ndarray) -> Observation:
        now = healthy(envs, action)
        if next(steps) == 8 + 4:  # the fifth step after the eight of the warm-up
            getattr(now, entry)[1, 2] = number
        return now

    monkeypatch.setattr(Envs, "step", step)

    told, dump = diverge(tmp_path)

    assert told.startswith(f"'{entry}' of simulation 1 at step 5 became {number} in cycle 1")
    evidence = dump["evidence"]
    assert evidence["simulations"] == [1]
    assert (evidence["obs"].shape, evidence["action"].shape) == ((1, 9, 12), (1, 8, 7))
    assert not torch.isfinite(evidence[entry][0, 5, 2])


def test_an_observation_in_the_warm_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    healthy = Envs.reset

    def reset(envs: Envs, *ids: Any) -> Observation:
        now = healthy(envs, *ids)
        now.obs[0, 0] = NAN
        return now

    monkeypatch.setattr(Envs, "reset", reset)

    told, _ = diverge(tmp_path)

    assert told.startswith("'obs' of simulation 0 at step 0 became nan in cycle 0")


def test_weights_of_a_locomotion_model_are_found_out_by_what_is_made_of_them(tmp_path: Path) -> None:
    model = save_untrained_model(tmp_path / "model.pt", spoil=NAN)

    with pytest.raises(TrainingDiverged, match="the reward of stream 'sldr/object0' became nan in cycle 1"):
        run(tiny_config("manipulation", "her-sldr"), tmp_path / "run", (model,))


def test_no_checkpoint_is_written_of_a_training_that_went_wrong(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = tiny_config(epochs=1, cycles_per_epoch=12)
    with pytest.raises(ConnectionAbortedError):
        train(config, CrashingRecorder(tmp_path, 11))
    before = (tmp_path / "checkpoint.pt").read_bytes()
    monkeypatch.setattr(TaskStream, "reward", lambda _, batch: batch.reward * NAN)

    with pytest.raises(TrainingDiverged):
        train(config, DirectoryRecorder(tmp_path))

    assert (tmp_path / "checkpoint.pt").read_bytes() == before
