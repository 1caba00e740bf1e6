"""The view of a live policy: one episode after another, under the newest policy or a chosen one."""

from __future__ import annotations

import os
from typing import Any

import viser

from sldr_core.envs import Envs, make_envs
from sldr_core.training import Policy
from worker.viewer.camera import find_camera
from worker.viewer.commands import Command, unknown_command
from worker.viewer.page import look_through
from worker.viewer.policy_file import PolicyFile
from worker.viewer.reports import Job
from worker.viewer.scene import Kinematics, SceneView
from worker.viewer.simulated import Simulated
from worker.viewer.transport import Transport


def open_live(server: viser.ViserServer, job: Job) -> LiveShow:
    """Open the view of a job's policy.

    Raises:
        BadFile: the policy cannot be used.
    """
    # Every session starts elsewhere: two people who watch one run do not see the same goals.
    seed = int.from_bytes(os.urandom(4), "little")
    return LiveShow(server, PolicyFile(job.file("policy")), seed)


class LiveShow:
    """Show episodes of a policy that follows its file, at the pace of the transport."""

    def __init__(self, server: viser.ViserServer, policy_file: PolicyFile, seed: int) -> None:
        config = policy_file.policy.config
        self._policy_file = policy_file
        self._server = server
        self._episode = Simulated(
            make_show_envs(policy_file.policy, 1, seed), lambda o, g: policy_file.policy.act(o, g)
        )
        self._kinematics = Kinematics(self._episode.envs.model)
        self._scene = SceneView(server, self._episode.envs.model)
        self.transport = Transport(self._episode.steps)
        look_through(server, find_camera(config.task_spec, config.phase))

    @property
    def message(self) -> str:
        """What is shown, in one sentence."""
        config = self._policy_file.policy.config
        actor = (
            "the object moving itself" if config.phase == "locomotion" else f"the robot trained with {config.method}"
        )
        return f"Live: {actor} on {config.task}, always with the newest policy of the run."

    def advance(self, wall_s: float) -> None:
        """Let time pass, simulate what is due, and draw it."""
        self.transport.advance(wall_s)
        if self.transport.has_ended:
            self._begin_anew()
        step, episode = self.transport.step, self._episode
        now, later = episode.moment(step), episode.moment(min(step + 1, episode.steps))
        poses = self._kinematics.poses(now.qpos).towards(self._kinematics.poses(later.qpos), self.transport.share)
        with self._server.atomic():
            self._scene.show(poses)
            self._scene.show_goal(now.goal[:3], episode.is_reached(step))

    def obey(self, command: Command) -> dict[str, Any] | None:
        """Begin a new episode, or refuse."""
        if command.do != "new":
            raise unknown_command(command, ["new"])
        self._begin_anew()
        return None

    def state(self) -> dict[str, Any]:
        """Return which episode is shown."""
        return {
            "timeline": self._episode.version,
            "known": self._episode.known,
            "epoch": self._policy_file.policy.epoch,
        }

    def report(self) -> dict[str, Any]:
        """Return the moment that is drawn."""
        moment = self._episode.moment(self.transport.step)
        return {"qpos": moment.qpos, "qvel": moment.qvel, "goal": moment.goal}

    def _begin_anew(self) -> None:
        self._policy_file.refresh()
        self._episode.restart()
        self.transport.seek(0)


def make_show_envs(policy: Policy, lanes: int, seed: int) -> Envs:
    """Build the simulations that a policy was trained in, `lanes` of them."""
    config = policy.config
    return make_envs(
        config.task,
        phase=config.phase,
        num_envs=lanes,
        seed=seed,
        robot=config.scene.locomotion_robot,
        variant=config.scene.variant,
    )
