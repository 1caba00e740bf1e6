"""By what runs of the same method differ: settings that their preset does not have, named as shortly as is clear."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Any

from backend.store.runs import RunRow
from sldr_core.config import Phase, config_to_dict, flatten
from sldr_core.errors import SldrError
from sldr_core.presets import make_config

IDENTITY = ("task", "phase", "method", "seed")
"""Settings that say which run it is."""

PLACES = ("compute.device", "compute.threads")
"""Settings that say where a run is computed; runs that differ in nothing else belong together."""

PRESET = "preset"

_ELSEWHERE = frozenset((*IDENTITY, *PLACES))
"""Settings that are no variant."""

Variant = tuple[tuple[str, str], ...]
"""Settings and their values as text, sorted by name."""


def as_text(value: Any) -> str:
    """Return a setting's value as it is typed in an override."""
    return value if isinstance(value, str) else json.dumps(value)


def deviations(config: Mapping[str, Any], preset: str) -> Variant:
    """Return the settings in which a run's config is not what its preset gives for its task and method."""
    flat = flatten(config)
    usual = _usual(flat["task"], flat["phase"], flat["method"], preset)
    return tuple(
        sorted(
            (name, as_text(value))
            for name, value in flat.items()
            if name not in _ELSEWHERE and usual.get(name, value) != value
        )
    )


def changes(run: RunRow) -> list[str]:
    """Return the settings in which a run's config is not what its preset gives, as overrides: `loop.epochs=12`."""
    return list(_changes(run.config_json, run.preset))


def distinguishing(variants: Iterable[Variant]) -> set[str]:
    """Return the settings that not all variants share; what all share tells nothing apart."""
    sets = [set(variant) for variant in variants]
    if not sets:
        return set()
    shared = set[tuple[str, str]].intersection(*sets)
    return {name for variant in sets for name, _ in variant - shared}


def label(variant: Variant, names: Sequence[str]) -> str:
    """Return a variant as words: `learning_rate 0.0003, quick`; groups are named only where `names` needs them."""
    lasts = Counter(name.rpartition(".")[2] for name in names)
    return ", ".join(
        value if name == PRESET else f"{_short(name, lasts)} {value}" for name, value in variant if name in names
    )


def _short(name: str, lasts: Counter[str]) -> str:
    last = name.rpartition(".")[2]
    return last if lasts[last] == 1 else name


@lru_cache(maxsize=2048)
def _changes(config: str, preset: str) -> tuple[str, ...]:
    """Look through a config, as JSON, once however often tables show it: even reading it takes long for a table."""
    return tuple(f"{name}={value}" for name, value in deviations(json.loads(config), preset))


@lru_cache(maxsize=1024)
def _usual(task: str, phase: Phase, method: str, preset: str) -> dict[str, Any]:
    """Return the flat config of a preset; nothing if this version does not know one of the names any more."""
    try:
        return flatten(config_to_dict(make_config(task, phase, method, 0, preset)))
    except SldrError:
        return {}
