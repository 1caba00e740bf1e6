"""The view of a recorded episode: every state is the file's, and the demonstration stands beside it."""

from __future__ import annotations

from typing import Any

import viser

from sldr_core.envs import Envs
from sldr_core.episodes import read_episodes
from sldr_core.errors import BadFile, InvalidConfig
from sldr_core.training.resimulation import first_differences, make_resimulation
from worker.viewer import against
from worker.viewer.commands import Command, unknown_command
from worker.viewer.display import Display, show_lanes
from worker.viewer.judging import load_models
from worker.viewer.overlay import build_against
from worker.viewer.reports import Job
from worker.viewer.timeline import timeline, worst_q
from worker.viewer.tracks import RecordedTrack, title
from worker.viewer.transport import Transport

VERBS = ("timeline", "worst", "resimulate")


def open_episode(server: viser.ViserServer, job: Job) -> EpisodeShow:
    """Open the view of an episode of a job's file.

    Raises:
        BadFile: the file cannot be used, or has no such episode.
    """
    path, index = job.file("episodes"), int(job.request["index"])
    test = read_episodes(path)
    episode = next((episode for episode in test.episodes if episode.index == index), None)
    if episode is None:
        known = ", ".join(str(episode.index) for episode in test.episodes)
        raise BadFile(f"{path} has no episode {index}; it has {known}.")
    try:
        track = RecordedTrack(test, episode)
    except InvalidConfig as err:
        raise BadFile(f"{path} was recorded by another version ({err}); show it with that one.") from err
    config = track.config
    envs = make_resimulation(config, 1)
    if episode.qpos.shape[1] != envs.model.nq:
        raise BadFile(f"{path} holds states of another scene than {config.task} has here; record it again.")
    models = load_models(config, job.files.get("locomotion", ())) if config.phase == "manipulation" else {}
    ghosts = build_against(server, config, envs.model, models)
    display = show_lanes(server, config, envs.model, [track], ghosts)
    message = f"Recorded: {title(config)}, episode {index} of the test after epoch {test.origin.epoch}."
    return EpisodeShow(track, envs, display, message)


class EpisodeShow:
    """Play an episode; nothing of it is simulated."""

    def __init__(self, track: RecordedTrack, envs: Envs, display: Display, message: str) -> None:
        self._track, self._envs, self._display = track, envs, display
        self._timeline: dict[str, Any] | None = None
        self.message = message
        self.transport = Transport(track.steps, stops_at_end=True)
        self.transport.is_playing = False

    def advance(self, wall_s: float) -> None:
        """Let time pass, and draw the moment."""
        self.transport.advance(wall_s)
        self._display.draw(self.transport.step, self.transport.share)

    def obey(self, command: Command) -> dict[str, Any] | None:
        """Tell the curves, go to the worst q_t, simulate again, or change the demonstration.

        Raises:
            BadCommand: there is no such command, or a value of it makes no sense.
        """
        match command.do:
            case "timeline":
                return self._curves()
            case "worst":
                step = worst_q(self._curves()["columns"])
                if step is not None:
                    self.transport.is_playing = False
                    self.transport.seek(step)
                return {"step": step}
            case "resimulate":
                [different] = first_differences(self._envs, [self._track.episode])
                return {"equal": different is None, "step": different}
            case _ if self._display.against is not None and command.do in against.VERBS:
                self._display.against.obey(command)
                return None
        raise unknown_command(command, [*VERBS, *self._display.verbs])

    def state(self) -> dict[str, Any]:
        """Return what is drawn besides the transport."""
        return {
            "timeline": 0,
            "known": self._track.known,
            "reached": [self._track.is_reached(self.transport.step)],
            **self._display.state(),
        }

    def report(self) -> dict[str, Any]:
        """Return the moment that is drawn."""
        return self._display.report(self.transport.step)

    def _curves(self) -> dict[str, Any]:
        if self._timeline is None:
            self._timeline = timeline(self._track, self._envs, self._display.against)
        return self._timeline
