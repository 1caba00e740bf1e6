"""The clock of a 3D view: which step is shown, and how it goes on. Every kind of view has one."""

from __future__ import annotations

from typing import Any

from worker.viewer.commands import Command
from worker.viewer.playback import SPEEDS, Playback

END_S = 0.6
"""How long the end of an episode stands still before what follows [s]."""

VERBS = ("play", "pause", "toggle", "seek", "step", "speed", "loop")
"""The commands that drive it."""


class Transport:
    """Hold the cursor of an episode and move it as time passes, or as a person says.

    Attributes:
        step: the control step that is shown, 0 to `steps`.
        steps: the last step there is.
        is_playing: whether time moves it.
        is_looping: whether the same episode begins again at its end.
        has_ended: whether it stands at the end, has been there for a moment, and does not loop.
    """

    def __init__(self, steps: int, stops_at_end: bool = False) -> None:
        """Start at step 0, playing; `stops_at_end` says whether playing ends with the episode."""
        self.step = 0
        self.steps = steps
        self.is_playing = True
        self.is_looping = False
        self._stops_at_end = stops_at_end
        self._playback = Playback()
        self._end_left_s = END_S

    @property
    def speed(self) -> float:
        """Simulated seconds per second."""
        return self._playback.speed

    @property
    def share(self) -> float:
        """How far the moment shown is from the step to the next, 0 to 1; 0 while it stands still."""
        return self._playback.share if self.is_playing and self.step < self.steps else 0.0

    @property
    def has_ended(self) -> bool:
        """Whether the end was shown for a while and something else may follow."""
        return self.is_playing and not self.is_looping and self.step >= self.steps and self._end_left_s <= 0.0

    def advance(self, wall_s: float) -> None:
        """Let time pass on the wall."""
        if not self.is_playing:
            return
        if self.step < self.steps:
            self.step = min(self.step + self._playback.advance(wall_s), self.steps)
            self._end_left_s = END_S
            return
        self._end_left_s -= wall_s * max(self.speed, 1.0)
        if self._end_left_s > 0.0:
            return
        if self.is_looping:
            self.seek(0)
        elif self._stops_at_end:
            self.is_playing = False

    def seek(self, step: int) -> None:
        """Show a step, exactly; beyond the ends the nearest."""
        self.step = min(max(step, 0), self.steps)
        self._playback.rewind()
        self._end_left_s = END_S

    def obey(self, command: Command) -> None:
        """Do what one of `VERBS` says.

        Raises:
            BadCommand: a value of it makes no sense.
        """
        match command.do:
            case "play":
                self._play()
            case "pause":
                self.is_playing = False
            case "toggle" if self.is_playing:
                self.is_playing = False
            case "toggle":
                self._play()
            case "seek":
                self.seek(command.integer("step", 0, self.steps))
            case "step":
                self.is_playing = False
                self.seek(self.step + command.integer("by", -self.steps, self.steps))
            case "speed":
                self._playback.speed = command.number("speed", SPEEDS[0], SPEEDS[-1])
            case "loop":
                self.is_looping = command.flag("on")

    def state(self) -> dict[str, Any]:
        """Return what a transport bar shows."""
        return {
            "step": self.step,
            "steps": self.steps,
            "playing": self.is_playing,
            "speed": self.speed,
            "loop": self.is_looping,
        }

    def _play(self) -> None:
        if self.step >= self.steps:
            self.seek(0)
        self.is_playing = True
