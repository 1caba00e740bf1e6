"""What would fail again is told in one sentence, and costs nobody their files."""

from __future__ import annotations

from pathlib import Path

import pytest
import torch
from small_training import TINY, StoppingRecorder, contents_of, run, save_untrained_model, tiny_config

from sldr_core.errors import BadFile, DiskTooFull, InvalidConfig, LocomotionMissing, TrainingDiverged
from sldr_core.nets.transitions import Transitions
from sldr_core.presets import make_config
from sldr_core.streams import TaskStream
from sldr_core.training import train
from sldr_core.training.checkpoint import PARTS


@pytest.fixture
def trained(tmp_path: Path) -> Path:
    directory = tmp_path / "run"
    run(tiny_config(), directory)
    return directory


@pytest.fixture
def stopped(tmp_path: Path) -> Path:
    directory = tmp_path / "run"
    train(tiny_config(), StoppingRecorder(directory, 1, "pause"))
    return directory


def test_a_checkpoint_of_another_config_is_refused_and_nothing_is_touched(trained: Path) -> None:
    before = contents_of(trained)
    other = tiny_config(seed=1, episodes_per_cycle=3)

    with pytest.raises(BadFile, match="was made by another config than this run's; use another directory"):
        run(other, trained)

    assert contents_of(trained) == before


@pytest.mark.parametrize("length", [0, 1, 1000, -1])
def test_a_checkpoint_cut_short_is_refused(trained: Path, length: int) -> None:
    checkpoint = trained / "checkpoint.pt"
    checkpoint.write_bytes(checkpoint.read_bytes()[:length])

    with pytest.raises(BadFile, match=r"checkpoint\.pt is corrupt or no file of ours"):
        run(tiny_config(), trained)


@pytest.mark.parametrize("part", sorted(PARTS))
def test_a_checkpoint_that_lacks_a_part_is_refused(stopped: Path, part: str) -> None:
    content = torch.load(stopped / "checkpoint.pt", weights_only=True)
    del content[part]
    torch.save(content, stopped / "checkpoint.pt")

    with pytest.raises(BadFile, match=rf"checkpoint\.pt is no whole checkpoint: it lacks {part}; remove"):
        run(tiny_config(), stopped)


@pytest.mark.parametrize("length", [None, 1000])
def test_a_checkpoint_without_its_replay_file_is_refused_again_and_again(stopped: Path, length: int | None) -> None:
    replay = stopped / "replay.bin"
    kept = replay.read_bytes()[:length]
    replay.unlink()
    if length:
        replay.write_bytes(kept)

    for _ in range(2):
        with pytest.raises(BadFile, match=r"needs .*replay\.bin, which is gone or was cut short"):
            run(tiny_config(), stopped)


def test_a_finished_training_needs_its_replay_file_no_longer(trained: Path) -> None:
    (trained / "replay.bin").unlink()
    before = contents_of(trained)

    again = run(tiny_config(), trained)

    assert again.finished
    assert again.test_success_rate == torch.load(trained / "checkpoint.pt")["counters"]["test_success_rate"]
    assert contents_of(trained) == before


def test_a_run_begun_anew_leaves_nothing_of_the_one_before(trained: Path) -> None:
    (trained / "notes.txt").write_text("kept")
    for checkpoint in trained.glob("checkpoint*.pt"):
        checkpoint.unlink()

    run(tiny_config(epochs=1, seed=1), trained)

    policies = [path.name for path in trained.glob("policy-epoch-*.pt")]
    assert policies == ["policy-epoch-0001.pt"]
    assert [path.name for path in trained.glob("episodes-epoch-*")] == ["episodes-epoch-0001.npz"]
    assert (trained / "notes.txt").read_text() == "kept"


def test_a_run_does_not_go_on_with_another_locomotion_model(tmp_path: Path) -> None:
    config = tiny_config("manipulation", "her-sldr")
    first = save_untrained_model(tmp_path / "first.pt")
    train(config, StoppingRecorder(tmp_path / "run", 1, "pause"), (first,))
    before = contents_of(tmp_path / "run")

    with pytest.raises(BadFile, match="began with another locomotion model of ShortPush"):
        run(config, tmp_path / "run", (save_untrained_model(tmp_path / "other.pt", spoil=0.5),))

    assert contents_of(tmp_path / "run").keys() == before.keys()
    assert run(config, tmp_path / "run", (first,)).finished


def test_a_method_that_needs_a_locomotion_model_says_how_to_get_one(tmp_path: Path) -> None:
    config = make_config("FetchPush", "manipulation", "her-sldr", 0, "smoke")

    with pytest.raises(LocomotionMissing, match="needs a locomotion model of FetchPush: train with `sldr train"):
        run(config, tmp_path)


def test_a_locomotion_model_that_is_not_there_is_named(tmp_path: Path) -> None:
    missing = tmp_path / "gone" / "locomotion.pt"

    with pytest.raises(BadFile, match=rf"There is no file {missing}; give the path of a locomotion model"):
        run(tiny_config("manipulation", "her-sldr"), tmp_path, (missing,))


def test_a_locomotion_model_of_another_task_is_refused(tmp_path: Path) -> None:
    model = save_untrained_model(tmp_path / "model.pt", task="FetchPush")

    named = "is a locomotion model of FetchPush; ShortPush needs a locomotion model of ShortPush"
    with pytest.raises(BadFile, match=named):
        run(tiny_config("manipulation", "her-sldr"), tmp_path, (model,))


def test_a_locomotion_model_below_the_gate_is_refused(tmp_path: Path) -> None:
    model = save_untrained_model(tmp_path / "model.pt")
    config = make_config("ShortPush", "manipulation", "her-sldr", 0, "smoke", {**TINY, "sldr": {"gate": 0.98}})

    with pytest.raises(LocomotionMissing, match=r"reached 97.0% test success, below the gate of 98.0%; train"):
        run(config, tmp_path, (model,))


def test_a_policy_is_no_locomotion_model(trained: Path, tmp_path: Path) -> None:
    with pytest.raises(BadFile, match=r"holds a policy, but a locomotion model is needed"):
        run(tiny_config("manipulation", "her-sldr"), tmp_path, (trained / "policy-best.pt",))


def test_a_reward_that_is_no_number_ends_the_training_by_the_name_of_its_metric(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def poisoned(_: TaskStream, batch: Transitions) -> torch.Tensor:
        return batch.reward.index_fill(0, torch.tensor([0]), float("nan"))

    monkeypatch.setattr(TaskStream, "reward", poisoned)

    with pytest.raises(TrainingDiverged, match="the reward of stream 'task' became nan in cycle 1: training was"):
        run(tiny_config(), tmp_path)
    assert not (tmp_path / "checkpoint.pt").exists()


def test_a_locomotion_model_with_broken_weights_ends_the_training(tmp_path: Path) -> None:
    model = save_untrained_model(tmp_path / "model.pt", spoil=float("nan"))

    with pytest.raises(TrainingDiverged, match="became nan"):
        run(tiny_config("manipulation", "her-sldr"), tmp_path, (model,))


def test_a_gpu_that_is_not_there_is_named_with_what_to_choose(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    config = make_config("FetchPush", "locomotion", "her", 0, "smoke", {"compute": {"device": "cuda"}})

    with pytest.raises(InvalidConfig, match=r"compute\.device: there is no GPU .* choose 'auto' or 'cpu'"):
        run(config, tmp_path)


def test_a_replay_that_no_disk_can_hold_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    config = make_config("FetchPush", "locomotion", "her", 0, "smoke", {"replay": {"capacity": 10**12}})

    with pytest.raises(
        DiskTooFull, match=r"for replay\.bin\) and the disk has .* free; lower replay\.capacity or free"
    ):
        run(config, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == [".training.lock"]
