"""The panel in the 3D page: what is shown, how it goes, and the few things one can press."""

from __future__ import annotations

import threading

import viser

from worker.viewer.playback import SPEEDS, Playback
from worker.viewer.rollout import Rollout

_SPEED_LABELS = {f"{speed:g}x": speed for speed in SPEEDS}


class Panel:
    """Show the state of a rollout and take a person's wishes, which the session's loop then reads."""

    def __init__(self, server: viser.ViserServer, playback: Playback, title: str) -> None:
        self._playback = playback
        self._new_goal = threading.Event()
        self._shown = ""
        server.gui.set_panel_label(title)
        self._text = server.gui.add_markdown("")
        self._pause = server.gui.add_button("Pause", icon=viser.Icon.PLAYER_PAUSE)
        button = server.gui.add_button("New goal", icon=viser.Icon.TARGET)
        self._speed = server.gui.add_dropdown("Speed", tuple(_SPEED_LABELS), initial_value="1x")
        self._pause.on_click(lambda _: self._toggle_pause())
        button.on_click(lambda _: self._new_goal.set())
        self._speed.on_update(lambda _: self._set_speed())

    def take_new_goal(self) -> bool:
        """Tell whether a new goal was asked for since the last call."""
        asked = self._new_goal.is_set()
        self._new_goal.clear()
        return asked

    def show(self, rollout: Rollout) -> None:
        """Write what the rollout is at, if that has changed."""
        text = describe(rollout)
        if text != self._shown:
            self._text.content = self._shown = text

    def _toggle_pause(self) -> None:
        self._playback.is_paused = not self._playback.is_paused
        self._pause.label = "Play" if self._playback.is_paused else "Pause"
        self._pause.icon = viser.Icon.PLAYER_PLAY if self._playback.is_paused else viser.Icon.PLAYER_PAUSE

    def _set_speed(self) -> None:
        self._playback.speed = _SPEED_LABELS[self._speed.value]


def describe(rollout: Rollout) -> str:
    """Say in a few lines what is shown and how it went so far, in Markdown."""
    policy = rollout.policy_file.policy
    actor = "the object moves itself" if policy.config.phase == "locomotion" else policy.config.method
    lines = [f"**{policy.config.task}**, {actor}, seed {policy.config.seed}"]
    if policy.epoch is not None:
        is_tested = policy.success_rate is not None and policy.success_rate >= 0.0
        tested = f", test success {policy.success_rate:.0%}" if is_tested else ""
        lines.append(f"Policy of epoch {policy.epoch}{tested}")
    lines.append(f"Episode {rollout.episode}, {100 * rollout.distance:.0f} cm to the goal")
    if rollout.finished:
        lines.append(f"Reached in {rollout.successes} of {rollout.finished} episodes here")
    if rollout.policy_file.problem:
        lines.append(f"A newer policy could not be read: {rollout.policy_file.problem}")
    return "  \n".join(lines)
