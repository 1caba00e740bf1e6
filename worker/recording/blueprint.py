"""How a Rerun file of a run is laid out: curves, curves by stream, each episode, the log."""

from __future__ import annotations

from collections.abc import Sequence

import rerun as rr
import rerun.blueprint as rrb

from worker.recording.content import EpisodeScene, Recording

TIMELINE = "env_steps"
"""The timeline that the charts open with."""
LOG = "log"
"""Where the log stands."""

BACKGROUND_RGB = (226, 232, 238)
"""The air around episodes, as in our pictures."""

_STREAM_GROUPS = ("critic", "stream")
"""Metrics `critic/<stream>/name` and `stream/<stream>/name` are about one stream."""


def make_blueprint(recording: Recording) -> rrb.Blueprint:
    """Lay out everything at rest, showing the whole training: else only the beginning would show."""
    groups = chart_groups(list(recording.curves))
    streams = {name: group for name, group in groups.items() if name.startswith("stream ")}
    others = {name: group for name, group in groups.items() if name not in streams}
    axis = rrb.archetypes.TimeAxis(view_range=_whole_training(recording))
    tabs: list[rrb.Container | rrb.View] = [rrb.Grid(*_charts(others, axis), name="Curves")]
    if streams:
        tabs.append(rrb.Grid(*_charts(streams, axis), name="Streams"))
    tabs += [_episode_view(scene) for scene in recording.episodes]
    if recording.log:
        tabs.append(rrb.TextLogView(origin=LOG, name="Log"))
    return rrb.Blueprint(
        rrb.Tabs(*tabs, name=recording.title, active_tab=0),
        rrb.TimePanel(state="collapsed", timeline=TIMELINE, play_state="paused"),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        auto_views=False,
        auto_layout=False,
    )


def chart_groups(names: Sequence[str]) -> dict[str, list[str]]:
    """Return the metrics of each chart: one for all that is about a stream, else one per group; tests first."""
    groups: dict[str, list[str]] = {}
    for name in sorted(names):
        groups.setdefault(_group(name), []).append(name)
    return dict(sorted(groups.items(), key=lambda item: (item[0] != "test", item[0])))


def _group(name: str) -> str:
    group = name.rpartition("/")[0] or name
    kind, _, stream = group.partition("/")
    return f"stream {stream}" if kind in _STREAM_GROUPS and stream else group


def _charts(groups: dict[str, list[str]], axis: rrb.archetypes.TimeAxis) -> list[rrb.View]:
    return [
        rrb.TimeSeriesView(origin="/", contents=[f"+ /{name}" for name in names], name=group, axis_x=axis)
        for group, names in groups.items()
    ]


def _whole_training(recording: Recording) -> rr.TimeRange:
    steps = recording.steps
    first, last = (steps[0].env_steps, steps[-1].env_steps) if steps else (0, 0)
    return rr.TimeRange(
        start=rr.TimeRangeBoundary.absolute(seq=first), end=rr.TimeRangeBoundary.absolute(seq=max(last, first + 1))
    )


def _episode_view(scene: EpisodeScene) -> rrb.Container:
    """Show an episode in 3D above the rewards that it earned; on the timeline of its steps it plays."""
    eye = rrb.EyeControls3D(position=scene.eye.position, look_target=scene.eye.look_at, eye_up=(0.0, 0.0, 1.0))
    in_space = [f"+ /{scene.path}/**", f"- /{scene.path}/series/**"]
    last = max(len(next(iter(scene.series.values()), [])) - 1, 1)
    whole = rr.TimeRange(start=rr.TimeRangeBoundary.absolute(seq=0), end=rr.TimeRangeBoundary.absolute(seq=last))
    return rrb.Vertical(
        rrb.Spatial3DView(origin="/", contents=in_space, name=scene.title, eye_controls=eye, background=BACKGROUND_RGB),
        rrb.TimeSeriesView(
            origin=f"/{scene.path}/series",
            name="Rewards and Q on the timeline episode_step",
            axis_x=rrb.archetypes.TimeAxis(view_range=whole),
        ),
        row_shares=[3, 1],
        name=scene.title,
    )
