"""The Viser page around a scene: bound to this machine, camera framed, soft light, nothing that calls outside."""

from __future__ import annotations

import contextlib
import io

import numpy as np
import viser

from worker.viewer.camera import Camera
from worker.viewer.dress import LAMP_DIRECTION
from worker.viewer.origins import refusing_other_pages

HOST = "127.0.0.1"

ROOM_LIGHT = 0.12
"""Brightness of the surroundings."""

SKY_LIGHT = 1.0
"""Brightness of the light from above and below."""

LAMP_LIGHT = 1.4
"""Brightness of the lamp that casts shadows."""

_LAMP_POSITION = (-4.0 * LAMP_DIRECTION[0], -4.0 * LAMP_DIRECTION[1], -4.0 * LAMP_DIRECTION[2])


def open_page(port: int = 0, is_alone: bool = False) -> viser.ViserServer:
    """Start a Viser server on this machine alone, lit and empty; port 0 takes a free one.

    The page is dark where its address says `?darkMode`.

    Args:
        port: where it listens.
        is_alone: whether browsers open the page here, and not through the proxy.
    """
    banner = contextlib.redirect_stdout(io.StringIO())  # Viser prints one that nobody asked for.
    with banner, refusing_other_pages(allow_own=is_alone):
        server = viser.ViserServer(host=HOST, port=port, verbose=False)
    _refuse_sharing(server)
    server.gui.configure_theme(show_logo=False, show_share_button=False, control_width="small")
    # Our own page has the controls; what is left here is Viser's own, folded away.
    server.gui.set_panel_label("View")
    server.gui.main_panel.minimize()
    server.scene.set_up_direction("+z")
    _add_lights(server)
    return server


def look_through(server: viser.ViserServer, camera: Camera) -> None:
    """Let those who open the page look through a camera, until they turn the view themselves."""
    server.initial_camera.position = camera.position
    server.initial_camera.look_at = np.asarray(camera.look_at)
    server.initial_camera.up = (0.0, 0.0, 1.0)
    server.initial_camera.fov = float(np.radians(camera.field_of_view))


def _add_lights(server: viser.ViserServer) -> None:
    """Light from all sides, and one lamp that casts soft shadows; weak enough that white keeps its shades."""
    server.scene.configure_default_lights(enabled=False)
    server.scene.configure_environment_map("studio", environment_intensity=ROOM_LIGHT)
    server.scene.add_light_hemisphere(
        "/lights/sky", intensity=SKY_LIGHT, sky_color=(255, 255, 255), ground_color=(150, 150, 160)
    )
    server.scene.add_light_directional("/lights/lamp", intensity=LAMP_LIGHT, cast_shadow=True, position=_LAMP_POSITION)


def _refuse_sharing(server: viser.ViserServer) -> None:
    """Keep a page from opening Viser's tunnel through an outside host, which any client may ask for."""
    server.request_share_url = lambda verbose=True: None
