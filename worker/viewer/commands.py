"""What a page asks a 3D session to do: one JSON object a message, checked field by field."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sldr_core.errors import SldrError


class BadCommand(SldrError):
    """Report a command that makes no sense; the text says which and why."""


@dataclass(frozen=True)
class Command:
    """Ask for one thing: `do` names it, the other values say how."""

    do: str
    values: Mapping[str, Any]

    def number(self, name: str, low: float = -math.inf, high: float = math.inf) -> float:
        """Return a number between two limits.

        Raises:
            BadCommand: it is missing, no number, or beyond the limits.
        """
        value = self._get(name)
        if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
            raise self._wrong(name, f"a number from {low:g} to {high:g}")
        return float(value)

    def integer(self, name: str, low: int, high: int) -> int:
        """Return a whole number between two limits.

        Raises:
            BadCommand: it is missing, not whole, or beyond the limits.
        """
        value = self._get(name)
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            raise self._wrong(name, f"a whole number from {low} to {high}")
        return value

    def flag(self, name: str) -> bool:
        """Return true or false.

        Raises:
            BadCommand: it is missing or neither.
        """
        value = self._get(name)
        if not isinstance(value, bool):
            raise self._wrong(name, "true or false")
        return value

    def choice(self, name: str, choices: Sequence[str]) -> str:
        """Return one of some words.

        Raises:
            BadCommand: it is missing or none of them.
        """
        value = self._get(name)
        if value not in choices:
            raise self._wrong(name, " or ".join(f'"{word}"' for word in choices))
        return value

    def vector(self, name: str, size: int) -> NDArray[np.float64]:
        """Return `[size]` finite numbers.

        Raises:
            BadCommand: it is missing or something else.
        """
        value = self._get(name)
        is_numbers = isinstance(value, list) and all(
            isinstance(part, int | float) and math.isfinite(part) for part in value
        )
        if not is_numbers or len(value) != size:
            raise self._wrong(name, f"a list of {size} numbers")
        return np.asarray(value, dtype=np.float64)

    def _get(self, name: str) -> Any:
        if name not in self.values:
            raise BadCommand(f'The command "{self.do}" needs "{name}".')
        return self.values[name]

    def _wrong(self, name: str, wanted: str) -> BadCommand:
        return BadCommand(f'"{name}" of the command "{self.do}" has to be {wanted}, got {self.values[name]!r}.')


def read_command(text: str | bytes) -> Command:
    """Return the command that a message holds.

    Raises:
        BadCommand: it is not JSON, or names nothing to do.
    """
    try:
        values = json.loads(text)
    except ValueError as err:
        raise BadCommand(f"A command has to be JSON: {err}.") from err
    if not isinstance(values, dict) or not isinstance(values.get("do"), str):
        raise BadCommand('A command has to be an object whose "do" says what to do.')
    return Command(values["do"], values)


def unknown_command(command: Command, known: Sequence[str]) -> BadCommand:
    """Return the refusal of a command that a view does not have."""
    return BadCommand(f'This view has no command "{command.do}"; it has {", ".join(sorted(known))}.')
