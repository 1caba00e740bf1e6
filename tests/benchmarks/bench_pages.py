"""A client that watches a 3D page as a browser does, and counts what comes."""

from __future__ import annotations

import time
from dataclasses import dataclass

import msgspec
import viser
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

STILL_S = 0.25
"""After so long without a message the scene stands still, as it does at the end of an episode [s]."""


@dataclass(frozen=True)
class Watched:
    """What came in a while."""

    updates: int
    """Messages; one holds all that moved in a frame."""
    seconds: float
    still_s: float
    """Part of the seconds in which nothing moved [s]."""

    @property
    def rate(self) -> float:
        """Updates a second while something moved."""
        return self.updates / (self.seconds - self.still_s)


def watch(port: int | None) -> ClientConnection:
    """Connect with a 3D page's server and say where the camera is, as the page does."""
    protocol = Subprotocol(f"viser-v{viser.__version__}")
    page = connect(f"ws://127.0.0.1:{port}", subprotocols=[protocol], compression=None, max_size=None, proxy=None)
    pose = {"wxyz": (1, 0, 0, 0), "position": (3, 0, 1), "look_at": (0, 0, 0), "up_direction": (0, 0, 1)}
    lens = {"fov": 0.6, "near": 0.01, "far": 100.0, "image_height": 480, "image_width": 640}
    page.send(msgspec.msgpack.encode({"type": "ViewerCameraMessage", **pose, **lens}))
    return page


def drain(page: ClientConnection, seconds: float) -> Watched:
    """Read what comes for a while."""
    began = last = time.monotonic()
    count, still_s = 0, 0.0
    while (left := began + seconds - time.monotonic()) > 0:
        try:
            page.recv(timeout=left)
        except TimeoutError:
            break
        now = time.monotonic()
        count += 1
        still_s += now - last if now - last > STILL_S else 0.0
        last = now
    ended = time.monotonic()
    return Watched(count, ended - began, still_s + (ended - last if ended - last > STILL_S else 0.0))
