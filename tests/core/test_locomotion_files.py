"""A locomotion model says what it is, and is refused where it does not fit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import torch
from small_training import run, save_untrained_model, tiny_config

from sldr_core.config import config_from_dict, config_hash
from sldr_core.errors import BadFile
from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets, Measured, load_locomotion_model
from sldr_core.presets import Settings, make_config
from sldr_core.training.build import build_training

TINY: Settings = {"agent": {"hidden_sizes": [8, 8]}}


def save_model(path: Path, task: str, variant: str = "ours") -> Path:
    """Write a model of a task that has learnt nothing."""
    config = make_config(task, "locomotion", "her", 0, "smoke", {**TINY, "scene": {"variant": variant}})
    nets = LocomotionNets(config, torch.Generator().manual_seed(0))
    LocomotionModel(nets, config, Measured(0.5, 4)).save(path)
    return path


def change(path: Path, **parts: Any) -> Path:
    """Replace parts of a file."""
    torch.save({**torch.load(path, weights_only=True), **parts}, path)
    return path


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return save_untrained_model(tmp_path / "model.pt")


def test_a_trained_model_says_task_phase_config_and_measured_success(tmp_path: Path) -> None:
    config = tiny_config()
    run(config, tmp_path)

    content = torch.load(tmp_path / "locomotion.pt", weights_only=True)

    assert (content["task"], content["phase"]) == ("ShortPush", "locomotion")
    assert content["config_hash"] == config_hash(config)
    assert config_from_dict(content["config"]) == config
    assert 0.0 <= content["success_rate"] <= 1.0
    assert content["test_episodes"] == config.loop.test_episodes


@pytest.mark.parametrize("part", [{"task": "FetchSlide"}, {"phase": "manipulation"}])
def test_a_file_that_contradicts_itself_is_refused(part: dict[str, Any], model: Path) -> None:
    with pytest.raises(BadFile, match=r"says it is of .*, but its config is of ShortPush \(locomotion\)"):
        load_locomotion_model(change(model, **part))


def test_networks_of_another_size_than_the_task_s_are_refused_in_one_sentence(model: Path, tmp_path: Path) -> None:
    chain = torch.load(save_model(tmp_path / "chain.pt", "FetchTuple3"), weights_only=True)

    with pytest.raises(BadFile, match=r"no usable locomotion model .*size mismatch") as err:
        load_locomotion_model(change(model, nets=chain["nets"]))
    assert "\n" not in str(err.value)


@pytest.mark.parametrize(("ours", "theirs"), [("ours", "original"), ("original", "ours")])
def test_a_model_of_another_variant_is_refused(ours: str, theirs: str, tmp_path: Path) -> None:
    model = save_model(tmp_path / "slide.pt", "FetchSlide", theirs)
    config = make_config("FetchSlide", "manipulation", "her-sldr", 0, "smoke", {**TINY, "scene": {"variant": ours}})

    told = rf"is a locomotion model of FetchSlide in variant '{theirs}', whose numbers differ from .* '{ours}'"
    with pytest.raises(BadFile, match=told):
        build_training(config, tmp_path, [model])


def test_a_model_whose_numbers_are_the_same_in_both_variants_serves_both(tmp_path: Path) -> None:
    model = save_model(tmp_path / "push.pt", "FetchPush")
    settings: Settings = {**TINY, "scene": {"variant": "original"}}

    parts = build_training(
        make_config("FetchPush", "manipulation", "her-sldr", 0, "smoke", settings), tmp_path, [model]
    )

    assert [stream.name for stream in parts.streams] == ["task", "sldr/object0"]


def test_a_model_of_another_task_is_refused(tmp_path: Path) -> None:
    model = save_model(tmp_path / "egg.pt", "HandEggRotate")
    config = make_config("HandBlockRotate", "manipulation", "her-sldr", 0, "smoke", TINY)

    told = "is a locomotion model of HandEggRotate; HandBlockRotate needs a locomotion model of HandBlockRotate"
    with pytest.raises(BadFile, match=told):
        build_training(config, tmp_path, [model])
