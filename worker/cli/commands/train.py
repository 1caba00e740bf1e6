"""`sldr train`: one training in this process, into a directory."""

from __future__ import annotations

import shlex
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import FrameType
from typing import Annotated

import tyro
from rich.console import Console

from sldr_core.config import LOCOMOTION_METHOD, Phase, TrainConfig, find_task
from sldr_core.errors import BadFile, InvalidConfig, LocomotionMissing
from sldr_core.presets import locomotion_tasks, make_config
from worker.cli.settings import parse_settings

INTERRUPTED = 130
"""Exit code of a training that was stopped before its end, so that scripts do not go on."""


@dataclass(frozen=True)
class Arguments:
    """Train here and now, without page and queue. The same command again resumes."""

    task: str
    """The task to learn, as `sldr list tasks` names it."""
    phase: Phase = "manipulation"
    """Who acts: the object on its own, or the robot."""
    method: Annotated[str | None, tyro.conf.arg(metavar="STR", help_behavior_hint="")] = None
    """The method, as `sldr list methods` names it (default: her-sldr, for locomotion her)."""
    seed: int = 0
    """Seed of every random number."""
    preset: str = "quick"
    """The budget, as `sldr list presets` names it."""
    out: Annotated[Path | None, tyro.conf.arg(metavar="DIR", help_behavior_hint="")] = None
    """Directory for checkpoints, policies and metrics (default: one below runs/, named after the training)."""
    locomotion_model: Annotated[tyro.conf.UseAppendAction[tuple[Path, ...]], tyro.conf.arg(metavar="FILE")] = ()
    """The locomotion.pt of a locomotion training, where the method takes its reward from one; repeat it for several."""
    settings: Annotated[
        tyro.conf.UseAppendAction[tuple[str, ...]], tyro.conf.arg(name="set", metavar="GROUP.NAME=VALUE")
    ] = ()
    """A setting laid over the preset, as in loop.batch_size=256; may be given again."""


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    given = tyro.cli(Arguments, prog="sldr train", args=list(arguments))
    config = _make_config(given)
    _check_locomotion(config, given.locomotion_model)
    directory = given.out or Path("runs") / f"{config.task}-{config.phase}-{config.method}-{config.seed}-{given.preset}"
    return _train(config, directory, given.locomotion_model, shlex.join(["sldr", "train", *arguments]))


def _train(config: TrainConfig, directory: Path, models: Sequence[Path], command: str) -> int:
    from sldr_core.training import DirectoryRecorder, train
    from worker.cli.progress import ShownProgress, ShownRecorder

    console = Console(stderr=True)
    recorder = DirectoryRecorder(directory)
    say = partial(console.print, highlight=False, soft_wrap=True)
    say(f"Training {config.task} ({config.phase}, {config.method}, seed {config.seed}) into {directory}")

    def stop() -> None:
        recorder.request_stop("pause")
        say("Stopping: writing a checkpoint first. Once more ends at once, without one.")

    with ShownProgress(config, console) as progress, _stopping(stop):
        result = train(config, ShownRecorder(recorder, progress), models)
    if not result.finished:
        print(f"Stopped with a checkpoint. To go on from there: {command}", file=sys.stderr)
        return INTERRUPTED
    success = "never tested" if result.test_success_rate is None else f"{result.test_success_rate:.1%} test success"
    print(f"Finished: {success}. Policies and metrics are in {directory}")
    return 0


@contextmanager
def _stopping(stop: Callable[[], None]) -> Iterator[None]:
    """Call `stop` at the first Ctrl-C or SIGTERM; let the second one end the process."""

    def on_signal(number: int, frame: FrameType | None) -> None:
        for signal_number in earlier:
            signal.signal(signal_number, signal.default_int_handler)
        stop()

    earlier = {number: signal.signal(number, on_signal) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in earlier.items():
            signal.signal(number, handler)


def _make_config(given: Arguments) -> TrainConfig:
    find_task(given.task)
    method = given.method or (LOCOMOTION_METHOD if given.phase == "locomotion" else TrainConfig().method)
    return make_config(given.task, given.phase, method, given.seed, given.preset, parse_settings(given.settings))


def _check_locomotion(config: TrainConfig, models: Sequence[Path]) -> None:
    """Find out before the slow imports."""
    if config.needs_locomotion and not models:
        raise LocomotionMissing(
            f"Method {config.method} takes its reward from a locomotion model of "
            f"{' and one of '.join(locomotion_tasks(config))}: train it with "
            f"'sldr train --task {locomotion_tasks(config)[0]} --phase locomotion --out DIR', "
            "then pass --locomotion-model DIR/locomotion.pt."
        )
    if models and not config.needs_locomotion:
        raise InvalidConfig({"locomotion-model": f"method {config.method} takes no reward from one; leave it out."})
    for model in models:
        if not model.is_file():
            raise BadFile(f"There is no locomotion model {model}; give the locomotion.pt of a locomotion training.")
