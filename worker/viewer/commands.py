"""What a page asks a 3D session to do: one JSON object a message, checked field by field."""

from __future__ import annotations

import json
import math
import reprlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sldr_core.errors import SldrError

FARTHEST = 1e6
"""No number of a vector is larger: what is simulated with it would overflow."""

SHORTEST_QUATERNION = 1e-6
"""One that is shorter has no direction that could be told."""


class BadCommand(SldrError):
    """Report a command that makes no sense; the text says which and why."""


@dataclass(frozen=True)
class Command:
    """Ask for one thing: `do` names it, the other values say how."""

    do: str
    values: Mapping[str, Any]

    @property
    def id(self) -> str | float | None:
        """What the answer is to be known by, if it is asked for.

        Raises:
            BadCommand: it could not be sent back.
        """
        value = self.values.get("id")
        if value is None or isinstance(value, str) or (isinstance(value, int | float) and abs(value) < math.inf):
            return value
        raise self._wrong("id", "a number or a text")

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
        """Return `[size]` numbers.

        Raises:
            BadCommand: it is missing or something else.
        """
        value = self._get(name)
        is_numbers = isinstance(value, list) and all(
            isinstance(part, int | float) and abs(part) <= FARTHEST for part in value
        )
        if not is_numbers or len(value) != size:
            raise self._wrong(name, f"a list of {size} numbers from {-FARTHEST:g} to {FARTHEST:g}")
        return np.asarray(value, dtype=np.float64)

    def quaternion(self, name: str) -> NDArray[np.float64]:
        """Return a quaternion, `[4]`, of any length.

        Raises:
            BadCommand: it is missing, something else, or has no direction.
        """
        value = self.vector(name, 4)
        if np.linalg.norm(value) < SHORTEST_QUATERNION:
            raise self._wrong(name, "a quaternion, which is not zero")
        return value

    def _get(self, name: str) -> Any:
        if name not in self.values:
            raise BadCommand(f'The command "{self.do}" needs "{name}".')
        return self.values[name]

    def _wrong(self, name: str, wanted: str) -> BadCommand:
        got = reprlib.repr(self.values[name])
        return BadCommand(f'"{name}" of the command "{self.do}" has to be {wanted}, got {got}.')


def read_command(text: str | bytes) -> Command:
    """Return the command that a message holds.

    Raises:
        BadCommand: it is not JSON, or names nothing to do.
    """
    try:
        values = json.loads(text)
    except (ValueError, RecursionError) as err:
        raise BadCommand(f"A command has to be JSON: {err}.") from err
    if not isinstance(values, dict) or not isinstance(values.get("do"), str):
        raise BadCommand('A command has to be an object whose "do" says what to do.')
    return Command(values["do"], values)


def unknown_command(command: Command, known: Sequence[str]) -> BadCommand:
    """Return the refusal of a command that a view does not have."""
    return BadCommand(f'This view has no command "{command.do}"; it has {", ".join(sorted(known))}.')
