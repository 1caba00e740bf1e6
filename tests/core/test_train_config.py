"""A config is checked where it enters, explains itself, and is the same everywhere."""

from __future__ import annotations

import json
import subprocess
import sys
from copy import deepcopy
from typing import Any

import pytest

from sldr_core.config import (
    METHODS,
    PHASES,
    TrainConfig,
    config_from_dict,
    config_hash,
    config_schema,
    config_to_dict,
    find_method,
    find_task,
)
from sldr_core.errors import InvalidConfig, UnknownName
from sldr_core.presets import PRESETS, find_preset, make_config, make_locomotion_config

TIMEOUT_S = 60


def leaves(values: dict[str, Any], path: tuple[str, ...] = ()) -> dict[tuple[str, ...], Any]:
    """Return every setting by its path."""
    found: dict[tuple[str, ...], Any] = {}
    for name, value in values.items():
        found.update(leaves(value, (*path, name)) if isinstance(value, dict) else {(*path, name): value})
    return found


def changed(path: tuple[str, ...], value: Any) -> dict[str, Any]:
    """Return the default config as plain values with one setting replaced."""
    values = config_to_dict(TrainConfig())
    group = values
    for name in path[:-1]:
        group = group[name]
    group[path[-1]] = value
    return values


OTHER_WORDS = {
    "phase": ("locomotion", {"method": "her"}),
    "method": ("her", {}),
    "variant": ("original", {}),
    "locomotion_robot": ("still", {}),
    "device": ("cpu", {}),
    "precision": ("bfloat16", {}),
    "collecting": ("beside", {}),
    "reward": ("action_distance", {}),
}
ONLY_ONE_VALUE = {("task",)}
SETTINGS = {path: value for path, value in leaves(config_to_dict(TrainConfig())).items() if path not in ONLY_ONE_VALUE}


def other_value(path: tuple[str, ...], value: Any) -> Any:
    if isinstance(value, str):
        return OTHER_WORDS[path[-1]][0]
    if isinstance(value, list):
        return value[:-1]
    if path[-1].startswith("lowest_"):
        return value - 100.0
    return value + 1 if isinstance(value, int) else value * 0.9 + 0.001


@pytest.mark.parametrize("path", SETTINGS, ids=".".join)
def test_every_setting_changes_the_hash(path: tuple[str, ...]) -> None:
    values = changed(path, other_value(path, SETTINGS[path]))
    values.update(OTHER_WORDS.get(path[-1], (None, {}))[1])

    assert config_hash(config_from_dict(values)) != config_hash(TrainConfig())


def test_the_hash_is_the_same_in_every_process() -> None:
    code = "from sldr_core.config import *; print(config_hash(TrainConfig(seed=7)))"
    arguments = [sys.executable, "-c", code]

    printed = subprocess.run(arguments, capture_output=True, text=True, timeout=TIMEOUT_S, check=True).stdout

    assert printed.strip() == config_hash(TrainConfig(seed=7))


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("phase", PHASES)
def test_a_config_survives_json(preset: str, phase: Any) -> None:
    config = make_config("FetchPush", phase, "her", 3, preset)

    again = config_from_dict(json.loads(json.dumps(config_to_dict(config))))

    assert again == config
    assert config_hash(again) == config_hash(config)


def test_every_setting_says_what_it_is_and_what_it_is_by_default() -> None:
    schema = config_schema()
    groups = {"TrainConfig": schema, **schema["$defs"]}
    settings = {
        f"{group}.{name}": setting
        for group, part in groups.items()
        for name, setting in part["properties"].items()
        if "$ref" not in setting
    }

    assert len(settings) == len(leaves(config_to_dict(TrainConfig())))
    assert [name for name, setting in settings.items() if not setting.get("description")] == []
    assert [name for name, setting in settings.items() if "default" not in setting] == []
    assert [group for group, part in groups.items() if not part.get("description")] == []


@pytest.mark.parametrize(
    ("values", "setting", "problem"),
    [
        ({"sead": 1}, "sead", "Unexpected keyword argument"),
        ({"loop": {"batch_sise": 1}}, "loop.batch_sise", "Unexpected keyword argument"),
        ({"loop": {"batch_size": -1}}, "loop.batch_size", "greater than 0 (got -1)"),
        ({"loop": {"batch_size": 1.5}}, "loop.batch_size", "(got 1.5)"),
        ({"loop": {"epochs": 10**15}}, "loop.epochs", "less than or equal to 1000000000000 (got 1000000000000000)"),
        ({"loop": {"warmup_cycles": 10**400}}, "loop.warmup_cycles", "less than or equal to 1000000000000"),
        ({"agent": {"gamma": 1.0}}, "agent.gamma", "less than 1 (got 1.0)"),
        ({"agent": {"learning_rate": float("nan")}}, "agent.learning_rate", "(got nan)"),
        ({"agent": {"action_l2": float("inf")}}, "agent.action_l2", "finite number (got inf)"),
        ({"agent": {"hidden_sizes": []}}, "agent.hidden_sizes", "at least 1 item"),
        ({"agent": {"hidden_sizes": [32, 0]}}, "agent.hidden_sizes.1", "greater than 0 (got 0)"),
        ({"exploration": {"noise_std": "much"}}, "exploration.noise_std", "(got 'much')"),
        ({"replay": {"relabel_probability": 1.01}}, "replay.relabel_probability", "(got 1.01)"),
        ({"compute": {"device": "tpu"}}, "compute.device", "'auto', 'cpu' or 'cuda' (got 'tpu')"),
        ({"phase": "sleep"}, "phase", "'locomotion' or 'manipulation' (got 'sleep')"),
        ({"seed": -1}, "seed", "(got -1)"),
        ({"seed": 2**31}, "seed", "less than 2147483648"),
        ({"task": "FetchPus"}, "task", "Did you mean 'FetchPush'?"),
        ({"method": "her-sldrr"}, "method", "Did you mean 'her-sldr'?"),
        ({"phase": "locomotion"}, "method", "a locomotion run learns from the sparse reward alone; use 'her'."),
        ({"phase": "locomotion", "method": "her-dense"}, "method", "learns from the sparse reward alone"),
        ({"phase": "locomotion", "method": "her-rnd"}, "method", "learns from the sparse reward alone"),
        ({"sldr": {"reward": "distance"}}, "sldr.reward", "'advantage' or 'action_distance' (got 'distance')"),
        ({"rnd": {"outputs": 0}}, "rnd.outputs", "greater than 0 (got 0)"),
        ({"curriculum": {"candidates": 1}}, "curriculum.candidates", "(got 1)"),
        ({"curriculum": {"candidates": 10**15}}, "curriculum.candidates", "less than or equal to 1000000000000"),
        (
            {"method": "cher", "loop": {"batch_size": 4865}},
            "loop.batch_size",
            "4865 is no whole number of groups of 256",
        ),
        (
            {"method": "cher", "curriculum": {"kept": 127}},
            "curriculum.kept",
            "the last of 127 picks could not compare 3",
        ),
        ({"replay": {"capacity": 3799}}, "replay.capacity", "3799 transitions cannot hold two cycles of 1900"),
    ],
    ids=lambda value: ".".join(value) if isinstance(value, dict) else None,
)
def test_a_setting_that_cannot_work_is_named(values: dict[str, Any], setting: str, problem: str) -> None:
    with pytest.raises(InvalidConfig) as err:
        config_from_dict(values)

    assert list(err.value.problems) == [setting]
    assert problem in err.value.problems[setting]
    assert str(err.value).startswith(f"{setting}: ")


def test_all_that_cannot_work_is_named_at_once() -> None:
    with pytest.raises(InvalidConfig) as err:
        config_from_dict({"seed": -1, "loop": {"epochs": 0}, "agent": {"gamma": 2}})

    assert set(err.value.problems) == {"seed", "loop.epochs", "agent.gamma"}


def test_a_replay_of_exactly_two_cycles_is_enough() -> None:
    assert config_from_dict({"replay": {"capacity": 3800}}).replay.capacity == 3800


@pytest.mark.parametrize(
    ("find", "name", "near"),
    [
        (find_task, "fetchpush", "FetchPush"),
        (find_method, "hersldr", "her-sldr"),
        (find_preset, "smoky", "smoke"),
        (lambda name: make_config("FetchPush", name, "her", 0, "smoke"), "locomote", "locomotion"),
    ],
)
def test_an_unknown_name_gets_the_nearest_and_the_whole_list(find: Any, name: str, near: str) -> None:
    with pytest.raises(UnknownName, match=rf"is called '{name}'\. Did you mean '{near}'\? There are: .*{near}"):
        find(name)


def test_task_then_method_then_preset_then_overrides_decide() -> None:
    task = find_task("FetchPush")
    config = make_config("FetchPush", "locomotion", "ddpg", 5, "quick", {"loop": {"epochs": 3}})

    assert (config.task, config.phase, config.method, config.seed) == ("FetchPush", "locomotion", "ddpg", 5)
    assert config.agent.gamma == task.quick_locomotion_gamma == 0.95
    assert config.agent.hidden_sizes == (128, 128, 128)
    assert config.exploration.noise_std == 0.05
    assert config.replay.relabel_probability == METHODS["ddpg"].relabel_probability == 0.0
    assert config.loop.batch_size == PRESETS["quick"].locomotion["loop"]["batch_size"]
    assert config.loop.epochs == 3
    assert make_config("FetchPush", "locomotion", "her", 0, "quick").loop.epochs == task.quick_locomotion_epochs == 10
    assert make_config("FetchPush", "manipulation", "her", 0, "quick").loop.epochs == task.quick_epochs == 15
    assert make_config("FetchSlide", "manipulation", "her", 0, "quick").loop.epochs == 40
    assert make_config("HandPenRotateXYZ", "locomotion", "her", 0, "quick").agent.gamma == 0.98
    assert make_config("HandPenRotate", "manipulation", "her", 0, "quick").agent.gamma == 0.95
    paper = make_config("FetchPush", "locomotion", "her", 0, "paper")
    assert (paper.loop.epochs, paper.agent.gamma) == (task.paper_locomotion_epochs, task.locomotion_gamma)


def test_the_paper_preset_is_the_papers_protocol() -> None:
    config = make_config("FetchPush", "manipulation", "her-sldr", 0, "paper")

    loop = config.loop
    assert (loop.epochs, loop.cycles_per_epoch, loop.episodes_per_cycle) == (50, 50, 38)
    assert (loop.updates_per_cycle, loop.updates_per_sync, loop.batch_size) == (40, 40, 4864)
    assert (loop.test_episodes, loop.stop_after_tests) == (380, 0)
    assert (config.agent.gamma, config.agent.hidden_sizes) == (0.98, (256, 256, 256))
    assert (config.agent.learning_rate, config.agent.target_rate, config.agent.action_l2) == (1e-3, 0.05, 1.0)
    assert (config.replay.capacity, config.replay.relabel_probability) == (1_000_000, 0.8)


def test_making_configs_changes_no_preset_and_no_override() -> None:
    presets, overrides = deepcopy(PRESETS), {"loop": {"epochs": 3}, "agent": {"hidden_sizes": [4]}}
    given = deepcopy(overrides)

    for preset in PRESETS:
        for phase in PHASES:
            make_config("FetchPush", phase, "her", 0, preset, overrides)

    assert presets == PRESETS
    assert overrides == given


@pytest.mark.parametrize(
    ("overrides", "setting"),
    [({"loop": 3}, "loop"), ({"loop": {"batch": 3}}, "loop.batch"), ({"lop": {"epochs": 3}}, "lop")],
)
def test_an_override_that_fits_nothing_is_named(overrides: dict[str, Any], setting: str) -> None:
    with pytest.raises(InvalidConfig) as err:
        make_config("FetchPush", "manipulation", "her", 0, "quick", overrides)

    assert list(err.value.problems) == [setting]


def test_every_seed_shares_one_locomotion_run() -> None:
    manipulation = [make_config("FetchPush", "manipulation", "her-sldr", seed, "quick") for seed in range(3)]

    locomotion = {config_hash(make_locomotion_config(config, "quick")) for config in manipulation}

    assert len(locomotion) == 1
    config = make_locomotion_config(manipulation[2], "quick")
    assert (config.phase, config.method, config.seed, config.needs_locomotion) == ("locomotion", "her", 0, False)


def test_a_config_cannot_be_changed() -> None:
    with pytest.raises(AttributeError):
        TrainConfig().seed = 3  # pyright: ignore[reportAttributeAccessIssue]


@pytest.mark.parametrize("name", ["task", "phase", "method", "seed"])
def test_no_override_replaces_what_other_settings_follow_from(name: str) -> None:
    values = {"task": "HandPenFull", "phase": "locomotion", "method": "her", "seed": 1}
    with pytest.raises(InvalidConfig, match=f"{name}: is named by the launch itself"):
        make_config("FetchPush", "manipulation", "ddpg", 0, "quick", {name: values[name]})
