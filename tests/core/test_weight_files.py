"""Files of weights are read as data: damaged, foreign and hostile ones end in one sentence, and nothing runs."""

from __future__ import annotations

import io
import pickle
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from small_training import run, save_untrained_model, state_of, tiny_config

from sldr_core.errors import BadFile
from sldr_core.nets.locomotion_model import load_locomotion_model
from sldr_core.training import evaluate, load_policy

Load = Callable[[Path], Any]
every_reader = pytest.mark.parametrize("load", [load_locomotion_model, load_policy], ids=["model", "policy"])


class Intruder:
    """Touch a file when it is unpickled."""

    def __init__(self, trace: Path) -> None:
        self._trace = trace

    def __reduce__(self) -> tuple[Any, ...]:
        return (Path.touch, (self._trace,))


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return save_untrained_model(tmp_path / "model.pt")


def assert_one_sentence(err: pytest.ExceptionInfo[BadFile], path: Path) -> None:
    text = str(err.value)
    assert str(path) in text
    assert text.endswith(".")
    assert "\n" not in text


@every_reader
@pytest.mark.parametrize("share", [0.0, 0.01, 0.3, 0.7, 0.99, 0.9999])
def test_a_file_cut_short_is_refused(load: Load, share: float, model: Path) -> None:
    whole = model.read_bytes()
    model.write_bytes(whole[: int(share * len(whole))])

    with pytest.raises(BadFile) as err:
        load(model)
    assert_one_sentence(err, model)


@every_reader
def test_a_file_with_damaged_weights_is_refused(load: Load, model: Path) -> None:
    content = bytearray(model.read_bytes())
    weights = load_locomotion_model(model).nets.policy.weights[0].numpy().tobytes()
    content[content.index(weights) + 5] ^= 1
    model.write_bytes(content)

    with pytest.raises(BadFile) as err:
        load(model)
    assert_one_sentence(err, model)


@every_reader
def test_no_damage_at_all_escapes_as_another_error(load: Load, model: Path) -> None:
    whole, rng = model.read_bytes(), random.Random(0)
    refused = 0
    for _ in range(100):
        content = bytearray(whole)
        for _ in range(rng.choice([1, 3, 20])):
            content[rng.randrange(len(content))] = rng.randrange(256)
        model.write_bytes(content)
        try:
            load(model)
        except BadFile:
            refused += 1

    assert refused > 50


@every_reader
@pytest.mark.parametrize("content", [b"", b"hello", b"\n" * 100, b"PK\x03\x04", pickle.dumps({"kind": "policy"})])
def test_files_of_other_kinds_are_refused(load: Load, content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "foreign.pt"
    path.write_bytes(content)

    with pytest.raises(BadFile, match="is corrupt or no file of ours"):
        load(path)


@every_reader
@pytest.mark.parametrize("content", [[1], None, {}, {"kind": "recipe"}])
def test_archives_that_hold_something_else_are_refused(load: Load, content: Any, tmp_path: Path) -> None:
    path = tmp_path / "foreign.pt"
    torch.save(content, path)

    with pytest.raises(BadFile, match=r"holds a (foreign object|recipe), but a .* is needed"):
        load(path)


@every_reader
@pytest.mark.parametrize("archive", [True, False], ids=["archive", "pickle"])
def test_code_inside_a_file_is_never_run(load: Load, archive: bool, tmp_path: Path) -> None:
    path, trace = tmp_path / "hostile.pt", tmp_path / "trace"
    content = {"kind": "locomotion model", "config": Intruder(trace)}
    path.write_bytes(pickle.dumps(content)) if not archive else torch.save(content, path)

    with pytest.raises(BadFile) as err:
        load(path)
    assert_one_sentence(err, path)
    assert not trace.exists()
    pickle.loads(pickle.dumps(content))
    assert trace.exists(), "the intruder has to work where it may"


@every_reader
@pytest.mark.parametrize(
    "part",
    [
        {"config": None},
        {"config": {"task": "FetchFlip"}},
        {"nets": None},
        {"nets": {3: torch.zeros(1)}},
        {"nets": {"policy.weights.0": torch.zeros(2, 2)}},
    ],
)
def test_a_model_with_an_unfit_part_is_refused(load: Load, part: dict[str, Any], model: Path) -> None:
    content = torch.load(model, weights_only=True)
    torch.save({**content, **part}, model)

    with pytest.raises(BadFile, match="no usable"):
        load(model)


@pytest.mark.parametrize("name", ["policy-newest.pt", "policy-best.pt", "checkpoint.pt", "locomotion.pt"])
def test_every_file_of_a_run_holds_the_same_policy(name: str, tmp_path: Path) -> None:
    run(tiny_config(epochs=1), tmp_path)
    obs, goal = np.random.default_rng(0).normal(size=(5, 12)), np.zeros((5, 3))

    policy = load_policy(tmp_path / name)

    actions = policy.act(obs, goal)
    np.testing.assert_array_equal(actions, load_policy(tmp_path / "policy-newest.pt").act(obs, goal))
    assert policy.config == tiny_config(epochs=1)
    assert (actions.shape, actions.dtype) == ((5, 7), np.float32)
    assert np.abs(actions).max() <= 1.0


def test_a_saved_model_is_read_back_to_the_last_bit(model: Path) -> None:
    loaded, copy = load_locomotion_model(model), io.BytesIO()
    torch.save(loaded.nets.state_dict(), copy)

    assert loaded.measured.success_rate == 0.97
    assert not any(parameter.requires_grad for parameter in loaded.nets.parameters())
    loaded.save(model)
    again = load_locomotion_model(model)
    states = (loaded.nets.state_dict(), again.nets.state_dict())
    assert all(torch.equal(a, b) for a, b in zip(*(state.values() for state in states), strict=True))


def test_a_saved_policy_can_be_measured(tmp_path: Path) -> None:
    run(tiny_config(), tmp_path)

    result, again = (evaluate(tmp_path / "policy-best.pt", episodes=7, seed=5) for _ in range(2))

    assert result == again
    assert (result.task, result.phase, result.method, result.episodes) == ("ShortPush", "locomotion", "her", 7)
    assert result.success_rate == result.successes / 7
    assert 0.0 <= result.low <= result.success_rate <= result.high <= 1.0
    assert state_of(tmp_path)["counters"]["best_success_rate"] >= 0.0
