"""Named budgets: how a task, phase, method and seed become a whole config.

`make_config` is the one place where task, method and preset meet; overrides come last.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any, Literal, cast

from pydantic import ConfigDict
from pydantic.dataclasses import dataclass

from sldr_core.config import (
    LOCOMOTION_METHOD,
    PHASES,
    Phase,
    TaskSpec,
    TrainConfig,
    Variant,
    config_from_dict,
    find_method,
    find_task,
)
from sldr_core.errors import InvalidConfig, UnknownName

Settings = dict[str, Any]
"""Settings of a config as nested plain values; only those that differ from the defaults."""

NAMED_BESIDE = ("task", "phase", "method", "seed")
"""What no override replaces: task, phase and method bring numbers of their own."""

_FROZEN = ConfigDict(extra="forbid", use_attribute_docstrings=True)


@dataclass(frozen=True, config=_FROZEN)
class Preset:
    """Name a budget and the settings it stands for."""

    name: str
    """The preset's name."""
    summary: str
    """What it is for, in one sentence for a person."""
    manipulation: Settings
    """Settings of manipulation runs."""
    locomotion: Settings
    """Settings of locomotion runs."""
    numbers: Literal["paper", "quick"] = "paper"
    """Which of a task's epochs and discounts it begins with."""


QUICK_AGENT: Settings = {
    "hidden_sizes": [128, 128, 128],
    "lowest_return": 0.0,
    "lowest_auxiliary_return": 0.0,
}
"""Small nets that two cores can train."""

QUICK_GAMMA = 0.95
"""A horizon that values spread over within minutes."""

SMOKE_CURRICULUM: Settings = {"group_size": 32, "candidates": 16, "kept": 8}
"""Groups that a small batch has room for, in the usual proportions."""

PRESETS: dict[str, Preset] = {
    preset.name: preset
    for preset in (
        Preset(
            name="quick",
            summary="Reach a learnt policy while you watch: small nets, and updates where something moved.",
            manipulation={
                "loop": {
                    "cycles_per_epoch": 15,
                    "collecting": "beside",
                    "warmup_cycles": 45,
                    "updates_per_cycle": 80,
                    "updates_per_sync": 1,
                    "batch_size": 512,
                    "test_episodes": 114,
                    "stop_at_success": 0.95,
                    "stop_after_tests": 3,
                },
                "agent": {**QUICK_AGENT, "learning_rate": 2e-3, "average_rate": 0.0025},
                "replay": {"still_weight": 0.1, "met_weight": 0.05},
            },
            locomotion={
                "loop": {
                    "cycles_per_epoch": 10,
                    "collecting": "beside",
                    "updates_per_sync": 4,
                    "batch_size": 1024,
                    "test_episodes": 114,
                    "stop_at_success": 0.98,
                    "stop_after_tests": 2,
                },
                "agent": QUICK_AGENT,
            },
            numbers="quick",
        ),
        Preset(
            name="paper",
            summary="The paper's budget and settings: hours on a laptop, made for a GPU box or a cluster.",
            manipulation={},
            locomotion={},
        ),
        Preset(
            name="smoke",
            summary="See everything work within a minute; nothing is learnt.",
            manipulation={
                "loop": {
                    "epochs": 2,
                    "cycles_per_epoch": 2,
                    "episodes_per_cycle": 4,
                    "updates_per_cycle": 4,
                    "updates_per_sync": 4,
                    "batch_size": 64,
                    "test_episodes": 4,
                },
                "agent": {"hidden_sizes": [32, 32, 32]},
                "replay": {"capacity": 2000},
                "compute": {"threads": 1},
                "sldr": {"gate": 0.0},
                "rnd": {"outputs": 32},
                "curriculum": SMOKE_CURRICULUM,
            },
            locomotion={
                "loop": {
                    "epochs": 2,
                    "cycles_per_epoch": 2,
                    "episodes_per_cycle": 4,
                    "updates_per_cycle": 4,
                    "updates_per_sync": 4,
                    "batch_size": 64,
                    "test_episodes": 4,
                },
                "agent": {"hidden_sizes": [32, 32, 32]},
                "replay": {"capacity": 2000},
                "compute": {"threads": 1},
                "curriculum": SMOKE_CURRICULUM,
            },
        ),
    )
}


def find_preset(name: str) -> Preset:
    """Return a preset.

    Raises:
        UnknownName: no preset is called `name`.
    """
    if name not in PRESETS:
        raise UnknownName("preset", name, PRESETS)
    return PRESETS[name]


def make_config(
    task: str,
    phase: Phase,
    method: str,
    seed: int,
    preset: str,
    overrides: Settings | None = None,
) -> TrainConfig:
    """Return the whole config of one run: task's numbers, then method, then preset, then overrides.

    Raises:
        UnknownName: task, phase, method or preset does not exist.
        InvalidConfig: a setting is unknown or cannot work, or an override names what is an argument.
    """
    if phase not in PHASES:
        raise UnknownName("phase", phase, PHASES)
    check_overrides(overrides or {})
    settings: Settings = {"task": task, "phase": phase, "method": method, "seed": seed}
    spec, budget = find_task(task, _variant_in(overrides)), find_preset(preset)
    _merge(settings, _task_settings(spec, phase))
    epochs, gamma = _epochs_and_gamma(spec, phase, budget)
    _merge(settings, {"loop": {"epochs": epochs}, "agent": {"gamma": gamma}})
    _merge(settings, {"replay": {"relabel_probability": find_method(method).relabel_probability}})
    _merge(settings, getattr(budget, phase))
    _merge(settings, overrides or {})
    return config_from_dict(settings)


def check_overrides(overrides: Mapping[str, Any]) -> None:
    """Refuse overrides of what other settings follow from.

    Raises:
        InvalidConfig: there is one.
    """
    misplaced = [name for name in NAMED_BESIDE if name in overrides]
    if misplaced:
        raise InvalidConfig(
            {name: "is named by the launch itself; leave it out of the settings." for name in misplaced}
        )


def lay_over(settings: Mapping[str, Any], changes: Mapping[str, Any]) -> Settings:
    """Return settings with nested `changes` laid over them; neither is changed.

    Raises:
        InvalidConfig: a value stands where the other has a group of settings.
    """
    laid = copy.deepcopy(dict(settings))
    _merge(laid, dict(changes))
    return laid


def locomotion_tasks(config: TrainConfig) -> tuple[str, ...]:
    """Return the tasks whose locomotion models a training takes its reward from, each once; often none."""
    return config.task_spec.locomotion_tasks if config.needs_locomotion else ()


def make_locomotion_config(config: TrainConfig, preset: str, task: str | None = None) -> TrainConfig:
    """Return the config of a locomotion run that a manipulation run takes its reward from.

    One object serves every seed, so the locomotion run always has seed 0.

    Args:
        config: the manipulation run.
        preset: the locomotion run's budget.
        task: one of `locomotion_tasks(config)`; the first if None.
    """
    compute = {
        "device": config.compute.device,
        "precision": config.compute.precision,
        "threads": config.compute.threads,
    }
    scene = {"locomotion_robot": config.scene.locomotion_robot, "variant": config.scene.variant}
    trained_in = task or config.task_spec.locomotion_tasks[0]
    return make_config(trained_in, "locomotion", LOCOMOTION_METHOD, 0, preset, {"compute": compute, "scene": scene})


def _variant_in(overrides: Settings | None) -> Variant:
    """Return the variant that overrides ask for; what is no variant is told of when the config is built."""
    scene = (overrides or {}).get("scene")
    return "original" if isinstance(scene, dict) and cast(Settings, scene).get("variant") == "original" else "ours"


def _task_settings(task: TaskSpec, phase: Phase) -> Settings:
    if phase == "locomotion":
        return {"exploration": {"random_action_probability": 0.2, "noise_std": 0.05}}
    return {"agent": {"lowest_return": task.lowest_return, "lowest_auxiliary_return": task.lowest_auxiliary_return}}


def _epochs_and_gamma(task: TaskSpec, phase: Phase, preset: Preset) -> tuple[int, float]:
    match preset.numbers, phase:
        case "paper", "manipulation":
            return task.paper_epochs, task.gamma
        case "paper", "locomotion":
            return task.paper_locomotion_epochs, task.locomotion_gamma
        case "quick", "manipulation":
            return task.quick_epochs, QUICK_GAMMA
        case "quick", "locomotion":
            return task.quick_locomotion_epochs, task.quick_locomotion_gamma


def _merge(settings: Settings, changes: Settings, path: str = "") -> None:
    """Lay nested `changes` over `settings`, in place."""
    for key, value in changes.items():
        if isinstance(settings.get(key), dict):
            if not isinstance(value, dict):
                raise InvalidConfig({f"{path}{key}": f"expected a group of settings, got {value!r}"})
            _merge(settings[key], cast(Settings, value), f"{path}{key}.")
        else:
            settings[key] = copy.deepcopy(value)
