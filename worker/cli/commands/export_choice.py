"""What every export is asked for: which runs, and how they are shown."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import tyro

from backend.comparison.curves import CurveView
from backend.comparison.records import Axis, Statistic
from backend.figures.styles import Width
from backend.store.compared_runs import RunChoice
from sldr_core.config import Phase, find_method, find_task
from sldr_core.errors import InvalidConfig
from sldr_core.presets import find_preset
from worker.cli.commands.export_from_server import find_named_server
from worker.cli.service import Server

Many = tyro.conf.UseAppendAction[tuple[str, ...]]


@dataclass(frozen=True)
class Chosen:
    """Which runs: all that pass every option that is given."""

    task: Many = ()
    """Only runs of this task; may be given again, as the next ones."""
    method: Many = ()
    """Only runs of this method."""
    preset: Many = ()
    """Only runs of this preset."""
    run: Many = ()
    """Only the run with this id."""
    study: str | None = None
    """Only runs of the study with this id."""
    phase: Phase = "manipulation"
    """Which training."""
    study_file: Annotated[Path | None, tyro.conf.arg(metavar="FILE", help_behavior_hint="")] = None
    """Take the runs of this study file instead; "sample" stands for those that come with the product."""
    server: Server = None
    """The service that has them, as http://127.0.0.1:8000 (default: SLDR_URL, else the store of this machine)."""

    def named_server(self) -> str | None:
        """Return the service to ask; None if the runs are in a study file, or in the store of this machine.

        Raises:
            InvalidConfig: both a service and a study file are given.
        """
        if self.study_file is None:
            return find_named_server(self.server)
        if self.server is not None:
            raise InvalidConfig({"server": "a study file has the runs already; leave one of the two out"})
        return None

    def choice(self) -> RunChoice:
        """Return the choice as the store takes it.

        Raises:
            UnknownName: there is no such task, method or preset.
        """
        self._check_names()
        return RunChoice(self.phase, self.task, self.method, self.preset, self.run, self.study)

    def question(self) -> dict[str, Any]:
        """Return the choice as a service takes it.

        Raises:
            UnknownName: there is no such task, method or preset.
        """
        self._check_names()
        names = {"task": self.task, "method": self.method, "preset": self.preset, "run": self.run}
        return {"phase": self.phase, "study": self.study, **{name: list(given) for name, given in names.items()}}

    def _check_names(self) -> None:
        for task in self.task:
            find_task(task)
        for method in self.method:
            find_method(method)
        for preset in self.preset:
            find_preset(preset)


@dataclass(frozen=True)
class Shown:
    """How they are shown."""

    metric: str = CurveView.metric
    """What curves show."""
    x: Axis = CurveView.x
    """What curves are drawn over."""
    statistic: Statistic = CurveView.statistic
    """What several seeds say together; seeds draws each."""
    level: float = CurveView.level
    """Of confidence intervals."""
    seeds: bool = CurveView.with_seeds
    """Whether each seed is drawn as well."""
    drop_ended: bool = CurveView.drop_ended
    """Whether a run that is done counts no more behind its end; else its last value does."""
    width: Width = "double"
    """One column of a paper, both, or a slide."""

    def view(self) -> CurveView:
        """Return the view as comparisons take it."""
        if not 0.5 <= self.level <= 0.999:
            raise InvalidConfig({"level": f"it must lie between 0.5 and 0.999, got {self.level}"})
        return CurveView(self.metric, self.x, self.statistic, self.level, self.seeds, self.drop_ended)

    def question(self) -> dict[str, Any]:
        """Return the view as a service takes it."""
        view = self.view()
        of_curves = {"metric": view.metric, "x": view.x, "seeds": view.with_seeds, "drop_ended": view.drop_ended}
        return {"statistic": view.statistic, "level": view.level, "width": self.width, **of_curves}


Runs = tyro.conf.OmitArgPrefixes[Chosen]
View = tyro.conf.OmitArgPrefixes[Shown]
