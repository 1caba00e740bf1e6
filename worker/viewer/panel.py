"""A few buttons in the 3D page itself, for a view that is open without our own page around it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import viser

from worker.viewer.playback import SPEEDS

_SPEED_LABELS = {f"{speed:g}x": speed for speed in SPEEDS}


def add_panel(server: viser.ViserServer, ask: Callable[[Mapping[str, Any]], None]) -> None:
    """Add what one needs to watch a live policy; each button asks for a command."""
    server.gui.set_panel_label("Live policy")
    server.gui.main_panel.expand()
    pause = server.gui.add_button("Pause or play", icon=viser.Icon.PLAYER_PAUSE)
    new = server.gui.add_button("New goal", icon=viser.Icon.TARGET)
    speed = server.gui.add_dropdown("Speed", tuple(_SPEED_LABELS), initial_value="1x")
    pause.on_click(lambda _: ask({"do": "toggle"}))
    new.on_click(lambda _: ask({"do": "new"}))
    speed.on_update(lambda _: ask({"do": "speed", "speed": _SPEED_LABELS[speed.value]}))
