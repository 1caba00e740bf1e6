"""One 3D session in its own process: a simulation, a policy that follows the training, and a Viser page."""

from __future__ import annotations

import ctypes
import logging
import os
import signal
import sys
import time
from multiprocessing.connection import Connection
from pathlib import Path

import torch

from sldr_core.errors import SldrError
from worker.viewer.camera import find_camera
from worker.viewer.page import open_page
from worker.viewer.panel import Panel
from worker.viewer.playback import Playback
from worker.viewer.policy_file import PolicyFile
from worker.viewer.reports import Broken, Job, Ready, Report, Watched
from worker.viewer.rollout import Rollout, make_rollout_envs
from worker.viewer.scene import SceneView

FRAME_S = 1.0 / 30.0
"""Time between two frames [s]."""

UNWATCHED_S = 0.2
"""Time between two looks for a client while nobody watches; nothing is simulated then [s]."""

RESULT_S = 0.6
"""How long the end of an episode stands still [s]."""

NICENESS = 5
"""Watching gives way to training."""

PR_SET_PDEATHSIG = 1

log = logging.getLogger("sldr.viewer")


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


def serve_session(job: Job, host: Connection) -> None:
    """Serve one session until the host ends this process; the entry point of the process."""
    end_with_host(job.host_pid)
    logging.basicConfig(stream=sys.stderr, level=logging.INFO, format="%(asctime)s %(name)s %(message)s")
    torch.set_num_threads(1)
    try:
        session = Session(job.policy_path)
        _tell(host, Ready(session.port, session.message))
        watch(session, host)
    except SldrError as err:
        _tell(host, Broken(str(err)))
    except Exception as err:
        log.exception("session %s broke down", job.session_id)
        _tell(host, Broken(f"The 3D view broke down ({type(err).__name__}: {err})."))


def watch(session: Session, host: Connection | None = None) -> None:
    """Run a session for ever; tell the host how many people watch."""
    clients, last = -1, time.monotonic()
    while True:
        time.sleep(FRAME_S if clients > 0 else UNWATCHED_S)
        now = time.monotonic()
        if session.clients != clients:
            clients = session.clients
            if host is not None:
                _tell(host, Watched(clients))
        if clients > 0:
            session.advance(now - last)
        last = now


def end_with_host(host_pid: int) -> None:
    """Make this process gentle, deaf to Ctrl-C (the host ends it in order), and mortal with its host."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(NICENESS)
    if sys.platform == "linux":
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != host_pid:
        raise SystemExit(1)


def _tell(host: Connection, report: Report) -> None:
    try:
        host.send(report)
    except BrokenPipeError:
        raise SystemExit(1) from None
