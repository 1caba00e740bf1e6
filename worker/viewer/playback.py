"""From seconds on the wall to control steps: one clock for every speed."""

from __future__ import annotations

CONTROL_S = 0.04
"""Simulated time of one control step [s]."""

SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)
"""Simulated seconds per second that a person can choose."""

MAX_STEPS = 8
"""Control steps due at once; after a longer stall the rest is left out, not hurried through."""


class Playback:
    """Count how much simulated time is due."""

    def __init__(self) -> None:
        self.speed = 1.0
        self._due_s = 0.0

    @property
    def share(self) -> float:
        """How far the present moment is from the last step to the next, 0 to 1."""
        return min(self._due_s / CONTROL_S, 1.0)

    def advance(self, wall_s: float) -> int:
        """Let time pass on the wall and return how many control steps it makes."""
        self._due_s += wall_s * self.speed
        steps = int(self._due_s / CONTROL_S)
        self._due_s -= steps * CONTROL_S
        return min(steps, MAX_STEPS)

    def rewind(self) -> None:
        """Forget what was due."""
        self._due_s = 0.0
