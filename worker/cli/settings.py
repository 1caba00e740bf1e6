"""Settings given on the command line as `group.name=value`."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from sldr_core.errors import InvalidConfig


def parse_settings(words: Sequence[str]) -> dict[str, Any]:
    """Return `["loop.batch_size=256"]` as `{"loop": {"batch_size": 256}}`.

    A value is read as JSON where it is JSON, else as text.

    Raises:
        InvalidConfig: a word is not of that form, or two contradict each other.
    """
    settings: dict[str, Any] = {}
    for word in words:
        name, equals, value = word.partition("=")
        if not name or not equals:
            raise InvalidConfig({"set": f"'{word}' is not of the form group.name=value, as in loop.batch_size=256"})
        _put(settings, name, _read(value))
    return settings


def _put(settings: dict[str, Any], name: str, value: Any) -> None:
    *groups, last = name.split(".")
    for group in groups:
        settings = settings.setdefault(group, {})
        if not isinstance(settings, dict):
            raise InvalidConfig({name: f"'{group}' is already set to a value"})
    settings[last] = value


def _read(value: str) -> Any:
    try:
        return json.loads(value)
    except json.JSONDecodeError:
        return value
