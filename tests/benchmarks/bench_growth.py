"""How the cost grows: simulations, objects, batches, stored runs and runs at once, each size beside the usual one."""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Iterator
from contextlib import closing
from functools import partial
from pathlib import Path

from bench_learner import BATCH, UPDATES, learn_cycle, learning_training
from bench_queries import QUESTIONS, fill_store
from bench_rows import REPETITIONS, Measured, Pairs, row, time_pairs
from bench_service import train_beside
from bench_simulation import SIMULATIONS, run_episode

from backend.store.database import Database, open_database
from backend.store.settings import Settings, sqlite_url
from sldr_core.envs import Envs, make_envs
from sldr_core.processor import count_cores
from sldr_core.zoo.index import SHIPPED

OTHER_SIMULATIONS = (1, 8, 152)
"""Beside those of a cycle of the paper."""

ONE_OBJECT = "FetchPickAndPlace"
MORE_OBJECTS = {2: "FetchStack2", 3: "FetchStack3"}
"""The same robot with more blocks, each of which is paid by the locomotion model of `ONE_OBJECT`."""

OTHER_BATCHES = (256, 512, 1216, 2432, 9728)
"""Beside the paper's."""

STORED_RUNS, OTHER_STORED_RUNS = 1_000, (100, 10_000)
LOGGED = 5
"""Metrics of each run in a store."""

RUNS_AT_ONCE = (2, 4)
"""Beside one alone."""


def measure_growth() -> Iterator[Measured]:
    """Time every size in turns with the usual one."""
    yield from _with_simulations()
    with tempfile.TemporaryDirectory() as name:
        yield from _with_objects(Path(name))
        yield from _with_batch(Path(name))
    with tempfile.TemporaryDirectory() as name:
        yield from _with_stored_runs(Path(name))
    yield from _with_runs_at_once()


def _with_simulations() -> Iterator[Measured]:
    usual = _envs("FetchPush", SIMULATIONS)
    for count in OTHER_SIMULATIONS:
        other = _envs("FetchPush", count)
        pairs = _time_steps(other, usual)
        rate = count / statistics.median(pairs.ours)
        what = f"FetchPush: a control step of {_counted(count, 'simulation')}, against {SIMULATIONS}"
        yield _growth(what, pairs, f"; {rate:,.0f} control steps/s")


def _with_objects(root: Path) -> Iterator[Measured]:
    model = SHIPPED / f"{ONE_OBJECT}.pt"
    one, learning_one = _envs(ONE_OBJECT, SIMULATIONS), learning_training(root, ONE_OBJECT, "her-sldr", model=model)
    for count, task in MORE_OBJECTS.items():
        beside = f"{count} objects, against {ONE_OBJECT} with 1"
        yield _growth(f"{task}: a control step with {beside}", _time_steps(_envs(task, SIMULATIONS), one))
        learning = learning_training(root, task, "her-sldr", model=model)
        pairs = time_pairs(partial(learn_cycle, learning), partial(learn_cycle, learning_one))
        yield _growth(f"{task}: a her-sldr update at {BATCH} with {beside}", _each(pairs, UPDATES, UPDATES))


def _with_batch(root: Path) -> Iterator[Measured]:
    usual = learning_training(root, "FetchPush", "her")
    for batch in OTHER_BATCHES:
        other = learning_training(root, "FetchPush", "her", batch=batch)
        pairs = time_pairs(partial(learn_cycle, other), partial(learn_cycle, usual))
        yield _growth(f"FetchPush: a her update at {batch}, against {BATCH}", _each(pairs, UPDATES, UPDATES))


def _with_stored_runs(root: Path) -> Iterator[Measured]:
    with closing(_filled(root, STORED_RUNS)) as usual:
        for count in OTHER_STORED_RUNS:
            with closing(_filled(root, count)) as other:
                for question in QUESTIONS:
                    pairs = time_pairs(partial(question.look_up, other), partial(question.look_up, usual))
                    yield _growth(f"{question.what}: {count:,} runs in the store, against {STORED_RUNS:,}", pairs)


def _with_runs_at_once() -> Iterator[Measured]:
    alone: list[float] = []
    beside: dict[int, list[float]] = {count: [] for count in RUNS_AT_ONCE}
    for _ in range(REPETITIONS):
        alone.append(train_beside(range(1), epochs=1))
        for count, seconds in beside.items():
            seconds.append(train_beside(range(count), epochs=1))
    for count, seconds in beside.items():
        yield row(
            f"{count} runs at once on {count_cores()} cores, each on one thread, against one alone",
            "x",
            Pairs(seconds, alone).costs,
            None,
            f"{statistics.median(seconds):.3g} against {statistics.median(alone):.3g} s until all have ended",
        )


def _growth(what: str, pairs: Pairs, further: str = "") -> Measured:
    """Return a row of how many times as long it takes as the usual size."""
    ours, theirs = (1e3 * statistics.median(seconds) for seconds in (pairs.ours, pairs.theirs))
    return row(what, "x", pairs.costs, None, f"{ours:.3g} against {theirs:.3g} ms{further}")


def _time_steps(other: Envs, usual: Envs) -> Pairs:
    """Time episodes; return the seconds of a control step."""
    pairs = time_pairs(partial(run_episode, other), partial(run_episode, usual))
    return _each(pairs, other.episode_length, usual.episode_length)


def _each(pairs: Pairs, times: int, usual_times: int) -> Pairs:
    """Return the seconds of one time, of pairs in which each was done so many times."""
    return Pairs([seconds / times for seconds in pairs.ours], [seconds / usual_times for seconds in pairs.theirs])


def _counted(count: int, thing: str) -> str:
    return f"{count} {thing}{'' if count == 1 else 's'}"


def _envs(task: str, count: int) -> Envs:
    return make_envs(task, num_envs=count, seed=0, threads=count_cores())


def _filled(root: Path, runs: int) -> Database:
    home = root / str(runs)
    settings = Settings(home=home, database_url=sqlite_url(home))
    fill_store(settings, runs, LOGGED)
    return open_database(settings)
