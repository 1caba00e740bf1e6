"""`sldr list`: what can be trained, and the locomotion models that come with the product."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal

import tyro

from sldr_core.config import METHODS, TASKS
from sldr_core.presets import PRESETS
from sldr_core.zoo.index import ZooModel, model_to_dict, read_zoo, zoo_directory

Kind = Literal["tasks", "methods", "presets", "models"]

KINDS: dict[str, tuple[dict[str, Any], str]] = {
    "tasks": (TASKS, "goal_text"),
    "methods": (METHODS, "summary"),
    "presets": (PRESETS, "summary"),
}
"""The registry of each kind, and the field that tells a person what an entry is."""


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(show, prog="sldr list", args=list(arguments))


def show(kind: tyro.conf.Positional[Kind], json: bool = False) -> int:
    """List tasks, methods, presets, or the locomotion models of the zoo.

    Args:
        kind: What to list.
        json: Print everything known about each, for programs.
    """
    if kind == "models":
        print(_models_as_json(read_zoo()) if json else "\n".join(_model_lines(read_zoo())))
        return 0
    registry, summary = KINDS[kind]
    print(_as_json(registry) if json else _as_lines(registry, summary))
    return 0


def _models_as_json(models: Mapping[str, ZooModel]) -> str:
    return json.dumps([model_to_dict(model) for model in models.values()], indent=2)


def _model_lines(models: Mapping[str, ZooModel]) -> Iterable[str]:
    if not models:
        yield f"The zoo ({zoo_directory()}) is empty: every locomotion model is trained here."
        return
    width = max(map(len, models))
    for name, model in models.items():
        measured = model.measured
        yield (
            f"{name:{width}}  {model.goal_kind:11}  {measured.success_rate:6.1%} of {measured.episodes} episodes "
            f"({measured.low:.1%} to {measured.high:.1%}), {model.size / 1e3:.0f} kB"
        )


def _as_json(registry: dict[str, Any]) -> str:
    return json.dumps([dataclasses.asdict(entry) for entry in registry.values()], indent=2)


def _as_lines(registry: dict[str, Any], summary: str) -> str:
    width = max(map(len, registry))
    return "\n".join(f"{name:{width}}  {getattr(entry, summary)}" for name, entry in registry.items())
