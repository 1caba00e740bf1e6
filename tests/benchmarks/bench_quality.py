"""Quality: whether `quick` and bfloat16 end as well as the float32 `paper` settings, read from finished runs."""

from __future__ import annotations

import statistics
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from bench_rows import Measured, Target, row

from backend.store.database import Database, open_database
from backend.store.run_filter import RunFilter
from backend.store.runs import RunRow, list_runs
from backend.store.settings import Settings, load_settings, sqlite_url
from backend.store.states import RunState
from sldr_core.config import config_from_dict
from sldr_core.presets import make_config

SEEDS_AT_LEAST = 3
"""Fewer runs say nothing of a spread."""

RUNS_AT_MOST = 10_000
REFERENCE = ("paper", "float32")
COMPARED = (("paper", "bfloat16"), ("quick", "float32"), ("quick", "bfloat16"))

ENDINGS = ("epochs", "stop_at_success", "stop_after_tests")
"""Settings that change nothing before the end: `paper` goes on for hours after a task has been learnt."""

TaskAndMethod = tuple[str, str]

Settled = tuple[str, str]
"""Preset and precision."""


@dataclass(frozen=True)
class Finished:
    """Say how a run ended."""

    success: float
    """Of its last test."""
    epochs: int


def measure_quality(home: Path | None = None) -> Iterator[Measured]:
    """Compare the finished runs of a store; say which are missing.

    Args:
        home: the data directory; that of `SLDR_HOME` if None.
    """
    settings = load_settings() if home is None else Settings(home.absolute(), sqlite_url(home.absolute()))
    if settings.database_url == sqlite_url(settings.home) and not (settings.home / "sldr.db").exists():
        print(f"missing: there is no store in {settings.home}; name a data directory with --home")
        return
    with closing(open_database(settings)) as db:
        success = _read_success(db)
    if not success:
        print("missing: no manipulation run with the settings of `paper` or `quick` has finished")
    yield from compare_quality(success)


def compare_quality(success: Mapping[TaskAndMethod, Mapping[Settled, Sequence[Finished]]]) -> Iterator[Measured]:
    """Return a row for each task, method and way of training that has enough runs.

    Args:
        success: how runs ended, by task and method, then by preset and precision.
    """
    for (task, method), by_settings in success.items():
        reference = by_settings.get(REFERENCE, ())
        for settings in COMPARED:
            name, found = f"{task}, {method}, {_words(settings)}", by_settings.get(settings, ())
            if min(len(reference), len(found)) < SEEDS_AT_LEAST:
                print(f"missing: {name} has {len(found)} runs, {_words(REFERENCE)} has {len(reference)}")
            else:
                yield _compare(name, found, reference)


def _compare(name: str, found: Sequence[Finished], reference: Sequence[Finished]) -> Measured:
    """Compare the median with the lower quartile of the reference: above the upper one is as good."""
    low, middle, high = statistics.quantiles([100.0 * run.success for run in reference], n=4, method="inclusive")
    told = (
        f"{_words(REFERENCE)}: {middle:.1f} % ({low:.1f} to {high:.1f}), {len(reference)} and {len(found)} seeds "
        f"of at most {max(run.epochs for run in reference)} and {max(run.epochs for run in found)} epochs"
    )
    return row(f"{name}: test success", "%", [100.0 * run.success for run in found], Target("at least", low), told)


def _read_success(db: Database) -> dict[TaskAndMethod, dict[Settled, list[Finished]]]:
    wanted = RunFilter(states=[RunState.SUCCEEDED], phases=["manipulation"], presets=["paper", "quick"])
    success: dict[TaskAndMethod, dict[Settled, list[Finished]]] = {}
    for run in list_runs(db, wanted, RUNS_AT_MOST).rows:
        if run.success_rate is not None and run.progress is not None and is_as_its_preset(run):
            by_settings = success.setdefault((run.task, run.method), {})
            settled = (run.preset, run.config["compute"]["precision"])
            by_settings.setdefault(settled, []).append(Finished(run.success_rate, run.progress.epoch))
    return success


def is_as_its_preset(run: RunRow) -> bool:
    """Tell whether nothing was changed but where and how precisely it is computed, and when it ends at last."""
    settings = run.config
    free = {"compute": settings["compute"], "loop": {name: settings["loop"][name] for name in ENDINGS}}
    return config_from_dict(settings) == make_config(run.task, "manipulation", run.method, run.seed, run.preset, free)


def _words(settings: Settled) -> str:
    return f"`{settings[0]}` in {settings[1]}"
