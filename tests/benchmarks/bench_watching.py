"""What a training loses while 3D sessions beside it are watched: its cycles alone and watched take turns."""

from __future__ import annotations

import itertools
import multiprocessing
import statistics
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path

from bench_pages import drain, watch

from sldr_core.presets import make_config
from sldr_core.records import Step
from sldr_core.training import DirectoryRecorder, train

BLOCK_CYCLES = 5
"""Cycles of a turn; the first, which begins before it, is left out."""

PAIRS = 8
"""Turns alone, each with the watched one after it."""

SETTINGS = {"loop": {"cycles_per_epoch": 10_000, "epochs": 1}}
"""No tests: every cycle is the same work."""


@dataclass(frozen=True)
class Cost:
    """What a cycle of the training took."""

    wall_s: float
    cpu_s: float


class CycleClock(DirectoryRecorder):
    """Tell wall and CPU time after every cycle."""

    def __init__(self, directory: Path, told: Connection) -> None:
        super().__init__(directory)
        self._told = told

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        """Tell the time; a cycle logs once."""
        super().log(step, metrics)
        self._told.send((time.monotonic(), time.process_time()))


def measure_slowing(directory: Path, ports: Sequence[int]) -> str:
    """Train beside sessions that listen on `ports`, in turns watched and not, and say what watching costs."""
    with training(directory) as clock:
        read_block(clock)  # imports, first episodes
        pairs = []
        for _ in range(PAIRS):
            alone = read_block(clock)
            with watching(ports):
                pairs.append((alone, read_block(clock)))
    wall = [100.0 * (watched.wall_s / alone.wall_s - 1.0) for alone, watched in pairs]
    cpu = [100.0 * (watched.cpu_s / alone.cpu_s - 1.0) for alone, watched in pairs]
    slower = f"{_in_words('wall', wall)}, {_in_words('CPU', cpu)} a cycle"
    return f"a training beside {len(ports)} watched sessions: {slower}"


@contextmanager
def training(directory: Path) -> Iterator[Connection]:
    """Train FetchPush with `quick` in a process of its own; hand out what its clock tells."""
    context = multiprocessing.get_context("spawn")
    clock, told = context.Pipe(duplex=False)
    process = context.Process(target=run_training, args=(directory, told), daemon=True)
    process.start()
    try:
        yield clock
    finally:
        process.kill()
        process.join()


def run_training(directory: Path, told: Connection) -> None:
    """Train until this process is ended."""
    config = make_config("FetchPush", "manipulation", "her", 0, "quick", SETTINGS)
    train(config, CycleClock(directory, told))


def read_block(clock: Connection) -> Cost:
    """Wait for a turn's cycles and return the median cost of one."""
    while clock.poll():
        clock.recv()
    times = [clock.recv() for _ in range(BLOCK_CYCLES)]
    steps = list(itertools.pairwise(times))
    return Cost(
        statistics.median(after[0] - before[0] for before, after in steps),
        statistics.median(after[1] - before[1] for before, after in steps),
    )


@contextmanager
def watching(ports: Sequence[int]) -> Iterator[None]:
    """Watch sessions, each from a thread that reads what comes."""
    done = threading.Event()

    def read(port: int) -> None:
        with closing(watch(port)) as page:
            while not done.is_set():
                drain(page, 0.5)

    threads = [threading.Thread(target=read, args=(port,)) for port in ports]
    with ExitStack() as stack:
        for thread in threads:
            thread.start()
            stack.callback(thread.join)
        stack.callback(done.set)
        yield


def _in_words(what: str, percents: Sequence[float]) -> str:
    return f"{what} {statistics.median(percents):+.1f} % ({min(percents):+.1f} to {max(percents):+.1f})"
