"""What a person sees of a training in the terminal: a recorder that shows what it passes on."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn
from rich.table import Column

from sldr_core.config import TrainConfig
from sldr_core.episodes import RecordedTest
from sldr_core.records import Step
from sldr_core.training.recorder import Recorder, StopReason

BAR_WIDTH = 12
"""Narrow, so that the line beside it fits in a terminal [characters]."""


class ShownProgress:
    """Draw a training's progress: a bar in a terminal, elsewhere one line per test."""

    def __init__(self, config: TrainConfig, console: Console) -> None:
        self._epochs = config.loop.epochs
        self._console = console
        self._newest: dict[str, float] = {}
        line = TextColumn("{task.description}", table_column=Column(ratio=1, no_wrap=False))
        self._bar = Progress(BarColumn(BAR_WIDTH), TaskProgressColumn(), line, console=console, expand=True)
        self._row = self._bar.add_task("starting", total=1.0)

    def __enter__(self) -> ShownProgress:
        """Begin to draw."""
        if self._console.is_terminal:
            self._bar.start()
        return self

    def __exit__(self, *error: object) -> None:
        """Leave the last state on the screen."""
        if self._console.is_terminal:
            self._bar.stop()

    def show(self, step: Step, metrics: Mapping[str, float]) -> None:
        """Draw the newest numbers."""
        self._newest.update(metrics)
        line = describe(step, self._epochs, self._newest)
        if self._console.is_terminal:
            self._bar.update(self._row, description=line, completed=self._newest.get("progress/fraction", 0.0))
        elif "test/success_rate" in metrics:
            self._console.print(line, highlight=False, soft_wrap=True)


class ShownRecorder:
    """Pass everything on to another recorder and show the numbers on the way."""

    def __init__(self, recorder: Recorder, progress: ShownProgress) -> None:
        self._recorder = recorder
        self._progress = progress

    @property
    def directory(self) -> Path:
        """The run's own directory."""
        return self._recorder.directory

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        """Keep and show the numbers."""
        self._recorder.log(step, metrics)
        self._progress.show(step, metrics)

    def save_file(self, name: str, kind: str, write: Callable[[Path], None]) -> Path:
        """Keep a file."""
        return self._recorder.save_file(name, kind, write)

    def record_episodes(self, test: RecordedTest, kept_epochs: Collection[int]) -> None:
        """Keep the first episodes of a test."""
        self._recorder.record_episodes(test, kept_epochs)

    def stop_requested(self) -> StopReason | None:
        """Tell whether the training should end now."""
        return self._recorder.stop_requested()


def describe(step: Step, epochs: int, metrics: Mapping[str, float]) -> str:
    """Return epoch, success, speed and time left as one line; what is not known yet is left out."""
    parts = [f"epoch {step.epoch}/{epochs}"]
    if "test/success_rate" in metrics:
        best = f" (best {metrics['test/best_success_rate']:.0%})" if "test/best_success_rate" in metrics else ""
        parts.append(f"success {metrics['test/success_rate']:.0%}{best}")
    if "speed/env_steps_per_s" in metrics:
        parts.append(f"{metrics['speed/env_steps_per_s']:,.0f} steps/s")
    if "speed/updates_per_s" in metrics:
        parts.append(f"{metrics['speed/updates_per_s']:,.0f} updates/s")
    if "progress/seconds_left" in metrics:
        parts.append(f"{duration(metrics['progress/seconds_left'])} left")
    return ", ".join(parts)


def duration(seconds: float) -> str:
    """Return a time span as a person says it, as precisely as it can be foreseen."""
    minutes, rest = divmod(max(0, round(seconds)), 60)
    if minutes >= 60:
        return f"{minutes // 60} h {minutes % 60} min"
    if minutes >= 10:
        return f"{minutes} min"
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"
