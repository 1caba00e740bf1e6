"""The service: how soon it answers, what it weighs, and what two trainings at once gain."""

from __future__ import annotations

import gzip
import os
import re
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import httpx
import psutil
from bench_rows import REPETITIONS, Measured, Target, row

from backend.api.pages import BUILT_PAGE

PATIENCE_S = 60.0
MB, KB = 1e6, 1e3

FIRST_PAGE = "assets/runs-page-*.*"
"""What the build calls the files of the page of runs, which is fetched once the frame around it is there."""

GZIP_LEVEL = 6
"""As servers compress by default."""

COMPILING = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
"""The environment, in which Python keeps what it has compiled, as it does unless told otherwise."""

TRAINING = "--task FetchPush --phase locomotion --method her --preset quick --set compute.threads=1"
"""A training that fits a core, twice of which fit two."""

EPOCHS = 2
"""Of each of the two."""


def measure_service() -> Iterator[Measured]:
    """Start the service again and again, and weigh it."""
    seconds, megabytes = [], []
    with tempfile.TemporaryDirectory() as name:
        _start_once(Path(name) / "uncounted")
        for repetition in range(REPETITIONS):
            second, megabyte = _start_once(Path(name) / str(repetition))
            seconds.append(second)
            megabytes.append(megabyte)
    yield row("`sldr serve` to its first answer", "s", seconds, Target("at most", 3.0), "an empty data directory")
    yield row("memory of the API process", "MB", megabytes, Target("at most", 180.0), "resident, after answering")
    weight = _page_weight() / KB
    yield row("first page", "kB", [weight], Target("at most", 300.0), "all it loads before it shows runs, gzipped")


def measure_two_at_once() -> Iterator[Measured]:
    """Train two runs beside each other, and one after the other."""
    gains, told = [], []
    for _ in range(REPETITIONS):
        alone_s = train_beside([0]) + train_beside([1])
        together_s = train_beside([0, 1])
        gains.append(alone_s / together_s)
        told.append(f"{together_s:.0f} s against {alone_s:.0f} s")
    yield row(
        "two runs at once on two cores, against one after the other",
        "x",
        gains,
        Target("at least", 1.0),
        f"each on one thread: {told[-1]}",
    )


def _start_once(home: Path) -> tuple[float, float]:
    """Return after how long the service answers [s], and what its API process weighs then [MB]."""
    port = free_port()
    begun = time.perf_counter()
    process = subprocess.Popen(
        [sys.executable, "-m", "worker.cli", "serve", "--port", str(port)],
        env={**COMPILING, "SLDR_HOME": str(home)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        _wait_for_answer(f"http://127.0.0.1:{port}/healthz")
        seconds = time.perf_counter() - begun
        return seconds, _api_memory(process.pid) / MB
    finally:
        process.terminate()
        process.wait(PATIENCE_S)


def _wait_for_answer(url: str) -> None:
    give_up_at = time.monotonic() + PATIENCE_S
    while True:
        try:
            httpx.get(url).raise_for_status()
        except httpx.HTTPError:
            if time.monotonic() > give_up_at:
                raise
            time.sleep(0.01)
        else:
            return


def _api_memory(parent: int) -> int:
    family = [psutil.Process(parent), *psutil.Process(parent).children(recursive=True)]
    return max(process.memory_info().rss for process in family if "backend.api" in " ".join(process.cmdline()))


def _page_weight() -> int:
    """Return the gzipped size of the page, of what it names, and of the runs page, with their imports [bytes]."""
    page = BUILT_PAGE / "index.html"
    named = re.findall(r'(?:src|href)="/([^"]+\.(?:js|css))"', page.read_text())
    first = [page, *(BUILT_PAGE / name for name in named), *BUILT_PAGE.glob(FIRST_PAGE)]
    return sum(len(gzip.compress(file.read_bytes(), GZIP_LEVEL)) for file in with_imports(first))


def with_imports(files: Iterable[Path]) -> set[Path]:
    """Return files with all that they import at once, and what that imports; not what is fetched when it is needed."""
    found: set[Path] = set()
    ahead = list(files)
    while ahead:
        file = ahead.pop()
        if file not in found:
            found.add(file)
            text = file.read_text() if file.suffix == ".js" else ""
            ahead += [file.parent / name for name in re.findall(r'(?:from|import)\s*["\']\./([^"\']+\.js)["\']', text)]
    return found


def train_beside(seeds: Sequence[int], epochs: int = EPOCHS) -> float:
    """Train runs beside each other; return how long that takes [s]."""
    with tempfile.TemporaryDirectory() as name:
        begun = time.perf_counter()
        command = [sys.executable, "-m", "worker.cli", "train", *TRAINING.split(), "--set", f"loop.epochs={epochs}"]
        processes = [
            subprocess.Popen(
                [*command, "--seed", str(seed), "--out", str(Path(name) / str(seed))],
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            for seed in seeds
        ]
        codes = [process.wait() for process in processes]
        if any(codes):
            raise SystemExit(f"A training ended with {codes}.")
        return time.perf_counter() - begun


def free_port() -> int:
    """Return a port that nobody listens on."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]
