"""One 3D session in its own process: a simulation, a policy that follows the training, and a Viser page."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path

import torch

from worker.viewer.camera import find_camera
from worker.viewer.page import open_page
from worker.viewer.panel import Panel
from worker.viewer.playback import Playback
from worker.viewer.policy_file import PolicyFile
from worker.viewer.reports import Ready, Watched
from worker.viewer.rollout import Rollout, make_rollout_envs
from worker.viewer.scene import SceneView

FRAME_S = 1.0 / 30.0
"""Time between two frames [s]."""

UNWATCHED_S = 0.2
"""Time between two looks for a client while nobody watches; nothing is simulated then [s]."""

RESULT_S = 0.6
"""How long the end of an episode stands still [s]."""


class Session:
    """Show rollouts of one policy file on one page, at the pace of the wall clock."""

    def __init__(self, policy_path: Path, port: int = 0) -> None:
        policy_file = PolicyFile(policy_path)
        config = policy_file.policy.config
        # Every session starts elsewhere: two people who watch one run do not see the same goals.
        seed = int.from_bytes(os.urandom(4), "little")
        self.rollout = Rollout(make_rollout_envs(policy_file.policy, seed), policy_file)
        self.server = open_page(find_camera(config.task_spec, config.phase), port)
        self._playback = Playback()
        self._panel = Panel(self.server, self._playback, "Live rollout")
        self._scene = SceneView(self.server, self.rollout.envs.model)
        self._result_left_s = 0.0
        self._draw()

    @property
    def port(self) -> int:
        """Where the page is served on 127.0.0.1."""
        return self.server.get_port()

    @property
    def message(self) -> str:
        """What the page shows, in one sentence."""
        config = self.rollout.policy_file.policy.config
        actor = (
            "the object moving itself" if config.phase == "locomotion" else f"the robot trained with {config.method}"
        )
        return f"Live: {actor} on {config.task}, always with the newest policy of the run."

    @property
    def clients(self) -> int:
        """People who look at it now."""
        return len(self.server.get_clients())

    def advance(self, wall_s: float) -> None:
        """Let time pass on the wall, simulate what is due, and show it."""
        if self._panel.take_new_goal():
            self._result_left_s = 0.0
            self.rollout.restart()
        elif self.rollout.is_over:
            self._wait_after_the_end(wall_s)
        else:
            self._simulate(self._playback.advance(wall_s))
        self._draw()

    def _simulate(self, steps: int) -> None:
        for _ in range(steps):
            self.rollout.advance()
            if self.rollout.is_over:
                self._result_left_s = RESULT_S
                return

    def _wait_after_the_end(self, wall_s: float) -> None:
        if self._playback.is_paused:
            return
        self._result_left_s -= wall_s * max(self._playback.speed, 1.0)
        if self._result_left_s <= 0.0:
            self.rollout.restart()

    def _draw(self) -> None:
        rollout = self.rollout
        share = 1.0 if rollout.is_over else self._playback.share
        with self.server.atomic():
            self._scene.show(rollout.before.towards(rollout.now, share))
            self._scene.show_goal(rollout.goal, rollout.is_reached)
        self._panel.show(rollout)


def serve(policy_path: Path, host: Connection) -> None:
    """Open a session, tell the host, and run it for ever.

    Raises:
        BadFile: the policy cannot be used.
        BrokenPipeError: the host is gone.
    """
    torch.set_num_threads(1)
    session = Session(policy_path)
    host.send(Ready(session.port, session.message))
    watch(session, lambda clients: host.send(Watched(clients)))


def watch(session: Session, tell: Callable[[int], None] = lambda clients: None) -> None:
    """Run a session for ever; tell each time the number of people who watch has changed."""
    clients, last = -1, time.monotonic()
    while True:
        time.sleep(FRAME_S if clients > 0 else UNWATCHED_S)
        now = time.monotonic()
        if session.clients != clients:
            clients = session.clients
            tell(clients)
        if clients > 0:
            session.advance(now - last)
        last = now
