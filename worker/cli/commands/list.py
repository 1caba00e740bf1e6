"""`sldr list`: what can be trained."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from typing import Any, Literal

import tyro

from sldr_core.config import METHODS, TASKS
from sldr_core.presets import PRESETS

Kind = Literal["tasks", "methods", "presets"]

KINDS: dict[Kind, tuple[dict[str, Any], str]] = {
    "tasks": (TASKS, "goal_text"),
    "methods": (METHODS, "summary"),
    "presets": (PRESETS, "summary"),
}
"""The registry of each kind, and the field that tells a person what an entry is."""


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(show, prog="sldr list", args=list(arguments))


def show(kind: tyro.conf.Positional[Kind], json: bool = False) -> int:
    """List tasks, methods or presets.

    Args:
        kind: What to list.
        json: Print everything known about each, for programs.
    """
    registry, summary = KINDS[kind]
    print(_as_json(registry) if json else _as_lines(registry, summary))
    return 0


def _as_json(registry: dict[str, Any]) -> str:
    return json.dumps([dataclasses.asdict(entry) for entry in registry.values()], indent=2)


def _as_lines(registry: dict[str, Any], summary: str) -> str:
    width = max(map(len, registry))
    return "\n".join(f"{name:{width}}  {getattr(entry, summary)}" for name, entry in registry.items())
