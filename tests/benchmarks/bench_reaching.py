"""Answers: how long a person waits until something has been learnt."""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from bench_rows import Measured, Target, row
from kept_seeds import Reached, reach_each
from sac_peer import PeerCurve, train_peer

from sldr_core.config import TrainConfig
from sldr_core.presets import make_config, make_locomotion_config
from sldr_core.records import Step
from sldr_core.training import DirectoryRecorder, train

SEEDS = (0, 1, 2)
TESTED = 380
"""Episodes of each test of the object."""

LEARNT = 0.9
"""Test success that counts."""

TIMES = 10.0
"""How many times as long a peer should take, if it is given the time."""

PEER_CAP_S = 2 * 3600.0
"""A peer that has not learnt by then is stopped [s]."""


def measure_locomotion() -> Iterator[Measured]:
    """Train the object of FetchPush from nothing until every test episode ends at its goal."""
    seconds, told = [], []
    for seed in SEEDS:
        config = make_config(
            "FetchPush", "locomotion", "her", seed, "quick", {"loop": {"test_episodes": TESTED, "stop_at_success": 1.0}}
        )
        reached = _train_until(config, 1.0)
        seconds.append(reached.seconds)
        told.append(f"seed {seed}: {reached.best:.1%}")
    yield row(
        "FetchPush locomotion, from nothing to 100 % of 380 test episodes",
        "s",
        seconds,
        Target("at most", 30.0),
        ", ".join(told),
    )


def measure_manipulation(
    task: str, env_id: str, minutes: float, cap_s: float = PEER_CAP_S, take_kept: bool = False
) -> Iterator[Measured]:
    """Train a peer, then object and robot, until nine of ten test episodes end at the goal, three seeds (hours).

    The peer comes first. It is kept, and so is each seed: whoever is interrupted need not wait for them again.

    Args:
        task: what is to be learnt.
        env_id: the same task of gymnasium-robotics.
        minutes: how long it may take [min].
        cap_s: how long the peer may take [s].
        take_kept: whether what was trained on this machine before, peer or seed, need not be trained again.
    """
    peer = train_peer(task, env_id, LEARNT, cap_s, take_kept)
    reached = reach_each(task, SEEDS, _reach, take_kept)
    waits = [one.seconds / 60.0 for one in reached]
    told = ", ".join(f"seed {seed}: best {one.best:.1%}" for seed, one in zip(SEEDS, reached, strict=True))
    yield row(
        f"{task}: minutes to 90 % test success, preset `quick`, her-sldr with its locomotion run",
        "min",
        waits,
        Target("at most", minutes),
        f"median {statistics.median(waits):.1f} min; {told}",
    )
    yield against_peer(task, reached, peer, times_wanted(minutes))


def times_wanted(minutes: float) -> float:
    """Return how many times as long the peer should take: no more than one that is stopped can show."""
    return min(TIMES, PEER_CAP_S / (60.0 * minutes))


def against_peer(task: str, reached: Sequence[Reached], peer: PeerCurve, times: float) -> Measured:
    """Compare how long each seed took with the peer, which is taken to have learnt when its time was over."""
    peer_s = min(peer.seconds_to(LEARNT), peer.cap_s)
    return row(
        f"{task}: time to 90 % test success, against Stable-Baselines3's SAC with HER",
        "x",
        [peer_s / one.seconds for one in reached],
        Target("at least", times),
        peer.told(LEARNT),
        {"steps": peer.steps, "seconds": peer.seconds, "success": peer.success},
    )


class _StopAt(DirectoryRecorder):
    """End a training once a test has reached a success rate."""

    def __init__(self, directory: Path, rate: float) -> None:
        super().__init__(directory)
        self._rate = rate
        self._begun = time.perf_counter()
        self.seconds = float("inf")
        self.best = 0.0

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        super().log(step, metrics)
        rate = metrics.get("test/success_rate", 0.0)
        self.best = max(self.best, rate)
        if rate >= self._rate and self.seconds == float("inf"):
            self.seconds = time.perf_counter() - self._begun
            self.request_stop("cancel")


def _train_until(config: TrainConfig, rate: float, models: tuple[Path, ...] = ()) -> Reached:
    with tempfile.TemporaryDirectory() as name:
        recorder = _StopAt(Path(name) / "run", rate)
        train(config, recorder, models)
        return Reached(recorder.seconds, recorder.best)


def _reach(task: str, seed: int) -> Reached:
    """Train the object to its end, then the robot until it has learnt; count both."""
    config = make_config(task, "manipulation", "her-sldr", seed, "quick")
    with tempfile.TemporaryDirectory() as name:
        begun = time.perf_counter()
        train(make_locomotion_config(config, "quick"), DirectoryRecorder(Path(name)))
        object_s = time.perf_counter() - begun
        reached = _train_until(config, LEARNT, (Path(name) / "locomotion.pt",))
    return Reached(object_s + reached.seconds, reached.best)
