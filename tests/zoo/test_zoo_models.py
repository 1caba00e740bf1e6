"""The shipped file is half as large, does what was measured, and is refused once it is another."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
import torch
from zoo_cases import TASK, save_model

from sldr_core.config import config_hash
from sldr_core.errors import BadFile
from sldr_core.nets.locomotion_model import load_locomotion_model
from sldr_core.presets import make_config
from sldr_core.training import evaluate, load_policy
from sldr_core.training.evaluation import EvaluationResult
from sldr_core.zoo import adding
from sldr_core.zoo.adding import TEST_SEED, add_to_zoo, origin_here
from sldr_core.zoo.index import INDEX_FILE, SHIPPED, ZooModel, find_in_zoo, read_zoo

LARGEST_ZOO = 25_000_000
"""What all shipped models may take together [bytes]."""


def test_weights_are_those_of_the_training_rounded_to_half_precision(source: Path, shipped: ZooModel) -> None:
    ours, trained = load_locomotion_model(shipped.path).nets, load_locomotion_model(source).nets

    for name, value in trained.state_dict().items():
        is_net = name.startswith(("policy.", "critic.", "inverse."))
        expected = value.half().float() if is_net else value
        assert torch.equal(ours.state_dict()[name], expected), name
        assert ours.state_dict()[name].dtype == value.dtype
    assert shipped.size < 0.75 * source.stat().st_size


def test_the_shipped_file_is_what_was_measured(shipped: ZooModel) -> None:
    again = evaluate(shipped.path, episodes=2, seed=TEST_SEED)

    assert (again.successes, again.low, again.high) == (
        shipped.measured.successes,
        shipped.measured.low,
        shipped.measured.high,
    )
    measured = load_locomotion_model(shipped.path).measured
    assert (measured.success_rate, measured.episodes) == (again.success_rate, 2)
    assert load_policy(shipped.path).config == shipped.config


def test_the_index_holds_all_that_is_known(shipped: ZooModel) -> None:
    assert read_zoo(shipped.path.parent) == {TASK: shipped}
    [entry] = json.loads((shipped.path.parent / INDEX_FILE).read_text())["models"]
    assert entry["config_hash"] == config_hash(shipped.config)
    assert (entry["goal_kind"], entry["file"]) == ("position", "FetchPush.pt")
    assert entry["origin"]["machine"] == "a laptop"
    assert entry["origin"]["wall_s"] == 12.5
    assert {"torch", "mujoco"} <= entry["origin"]["versions"].keys()


def test_a_model_serves_its_task_in_its_scene_whatever_the_budget(shipped: ZooModel) -> None:
    models = {shipped.name: shipped}
    original = {"scene": {"variant": "original"}}

    assert find_in_zoo(models, make_config(TASK, "locomotion", "her", 0, "paper")) is shipped
    assert find_in_zoo(models, make_config(TASK, "locomotion", "her", 0, "paper", original)) is None
    assert find_in_zoo(models, make_config("FetchSlide", "locomotion", "her", 0, "paper")) is None


def test_a_weight_too_large_for_half_precision_is_refused_and_nothing_is_left(tmp_path: Path) -> None:
    source = save_model(tmp_path / "locomotion.pt", largest=1e6)

    with pytest.raises(BadFile, match=r"half precision: inverse\."):
        add_to_zoo(source, tmp_path / "zoo", origin_here("smoke"), episodes=1)

    assert not list((tmp_path / "zoo").iterdir())


def test_a_model_that_is_added_while_another_is_measured_stays(
    source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    other = save_model(tmp_path / "other.pt", task="FetchSlide")

    def evaluate_slowly(path: Path, episodes: int, seed: int) -> EvaluationResult:
        monkeypatch.setattr(adding, "evaluate", evaluate)
        add_to_zoo(other, tmp_path / "zoo", origin_here("smoke"), episodes=1)
        return evaluate(path, episodes, seed)

    monkeypatch.setattr(adding, "evaluate", evaluate_slowly)
    add_to_zoo(source, tmp_path / "zoo", origin_here("smoke"), episodes=1)

    models = read_zoo(tmp_path / "zoo")
    assert sorted(models) == ["FetchPush", "FetchSlide"]
    for model in models.values():
        model.check()


def test_a_changed_file_is_refused(shipped: ZooModel, tmp_path: Path) -> None:
    shutil.copytree(shipped.path.parent, tmp_path / "zoo")
    [model] = read_zoo(tmp_path / "zoo").values()
    model.check()
    content = bytearray(model.path.read_bytes())
    content[len(content) // 2] ^= 1
    model.path.write_bytes(content)

    with pytest.raises(BadFile, match="not the one that was measured"):
        model.check()
    model.path.unlink()
    with pytest.raises(BadFile, match="is gone"):
        model.check()


@pytest.mark.parametrize(
    "change",
    [
        lambda entry: entry.update(file="../outside.pt"),
        lambda entry: entry.update(size=10**12),
        lambda entry: entry.pop("config"),
        lambda entry: entry["config"].update(task="Nothing"),
        lambda entry: entry["measured"].update(more=1),
    ],
    ids=["path", "size", "no-config", "task", "unknown"],
)
def test_an_index_that_cannot_be_is_refused_in_a_sentence(shipped: ZooModel, tmp_path: Path, change) -> None:
    content = json.loads((shipped.path.parent / INDEX_FILE).read_text())
    change(content["models"][0])
    (tmp_path / INDEX_FILE).write_text(json.dumps(content))

    with pytest.raises(BadFile, match="cannot be read"):
        read_zoo(tmp_path)


def test_an_empty_zoo_is_no_error(tmp_path: Path) -> None:
    assert read_zoo(tmp_path) == {}


def test_what_is_shipped_is_whole_and_small() -> None:
    models = read_zoo(SHIPPED)

    for model in models.values():
        model.check()
    assert {path.name for path in SHIPPED.glob("*.pt")} == {model.path.name for model in models.values()}
    assert sum(model.size for model in models.values()) <= LARGEST_ZOO


@pytest.mark.slow
@pytest.mark.parametrize("name", read_zoo(SHIPPED))
def test_a_shipped_model_does_what_the_index_says(name: str) -> None:
    model = read_zoo(SHIPPED)[name]

    again = evaluate(model.path, model.measured.episodes, seed=1)

    assert again.high >= model.measured.low
    assert again.low <= model.measured.high
