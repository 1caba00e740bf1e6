"""Kill what trains, what supervises and what serves, at random moments; every run must end as if nobody had.

The trainings are either sums that anybody can work out, or real ones under the preset `smoke`.
"""

from __future__ import annotations

import json
import random
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from chaos_evidence import Curves, Witness, complaints
from chaos_service import HERE, ROOT, Service, kill, make_service, running
from chaos_table import Finding
from chaos_training import METRIC, expected_curve

from backend.store.attempts import list_attempts
from backend.store.database import Database, open_database
from backend.store.launches import LaunchOrder, launch
from backend.store.runs import get_run, get_runs
from backend.store.settings import Settings
from backend.store.states import ENDED

LOOK_S = 0.2
"""Between two looks at store and processes [s]."""
FAKE_CYCLES = 20
RUNS_LEFT = 2
"""The last kill should land before fewer runs than this are left."""
KINDS = ("child", "supervisor", "API")


@dataclass(frozen=True)
class Attack:
    """Say how many runs are disturbed how often."""

    runs: int
    kills: int
    workers: int
    gap_s: float
    """Mean time between two kills [s]."""
    real: bool
    """Whether the trainings are real ones."""
    seed: int
    """Of the moments and the victims."""
    lease_s: float = 5.0
    cycle_s: float = 0.1
    """Length of a cycle of a training that is not real [s]."""
    patience_s: float = 3600.0
    """How long all of it may take [s]."""


def attack(settings: Settings, order: Attack, say: Callable[[str], None]) -> Finding:
    """Run the trainings, disturb them, and look for what must not be."""
    db = open_database(settings)
    run_ids = _launch(db, order)
    say(f"{len(run_ids)} runs, {order.kills} kills, random seed {order.seed}, data in {settings.home}")
    undisturbed = _undisturbed(db, run_ids, order, settings.home / "undisturbed")
    child = (
        [] if order.real else [sys.executable, str(HERE / "chaos_training.py"), str(FAKE_CYCLES), str(order.cycle_s)]
    )
    service = make_service(settings, order.workers, 1, order.lease_s, child)
    witness = Witness(db, run_ids)
    started = time.monotonic()
    with running(service):
        kills = _disturb(service, db, witness, order, say)
    witness.look()
    took_s = time.monotonic() - started
    found = complaints(witness, undisturbed)
    if (landed := sum(kills.values())) < order.kills:
        found.append(f"Only {landed} of {order.kills} kills landed before all runs had ended; take a shorter gap.")
    attempts = sum(len(list_attempts(db, run_id)) for run_id in run_ids)
    db.close()
    return Finding(
        name="Killed at random",
        rows=[
            ("trainings", "smoke runs" if order.real else "sums"),
            ("runs", str(len(run_ids))),
            ("workers", str(order.workers)),
            *((f"kills of the {kind}", str(kills[kind])) for kind in KINDS),
            ("attempts", str(attempts)),
            ("numbers seen in the store", str(witness.count())),
            ("time", f"{took_s:.0f} s"),
            ("random seed", str(order.seed)),
        ],
        complaints=found,
    )


def _disturb(
    service: Service, db: Database, witness: Witness, order: Attack, say: Callable[[str], None]
) -> dict[str, int]:
    """Kill until enough have been killed, and wait until every run has ended."""
    drawn = random.Random(order.seed)
    kills: dict[str, int] = dict.fromkeys(KINDS, 0)
    deck: list[str] = []
    give_up_at = time.monotonic() + order.patience_s
    kill_at = time.monotonic() + order.gap_s
    while time.monotonic() < give_up_at:
        service.keep_alive()
        witness.look()
        ended = sum(run.state in ENDED for run in get_runs(db, witness.run_ids))
        if ended == len(witness.run_ids):
            break
        landed = sum(kills.values())
        # Whatever the gap, the last kill has to land before the last runs are through.
        is_late = landed * max(1, len(witness.run_ids) - RUNS_LEFT) < ended * order.kills
        if landed < order.kills and (is_late or time.monotonic() >= kill_at):
            deck = deck or drawn.sample(KINDS, len(KINDS))
            if kill(_victims(service, deck[-1]), drawn.choice):
                say(f"kill {landed + 1}: {deck[-1]}")
                kills[deck.pop()] += 1
                kill_at = time.monotonic() + drawn.uniform(0.0, 2.0 * order.gap_s)
        time.sleep(LOOK_S)
    return kills


def _victims(service: Service, kind: str) -> list[int]:
    match kind:
        case "child":
            return service.living_children()
        case "supervisor":
            return service.living_workers()
        case _:
            return service.living_apis()


def _launch(db: Database, order: Attack) -> list[str]:
    """Queue so many runs; of the real ones, half take their reward from a locomotion run."""
    if not order.real:
        return launch(db, LaunchOrder("FetchPush", "manipulation", "her", range(order.runs), "smoke"))
    with_reward = (order.runs - 1) // 2
    ids: list[str] = []
    if with_reward:
        ids += launch(db, LaunchOrder("FetchPush", "manipulation", "her-sldr", range(with_reward), "smoke"))
    rest = order.runs - len(ids)
    return ids + launch(db, LaunchOrder("FetchPush", "manipulation", "her", range(rest), "smoke"))


def _undisturbed(db: Database, run_ids: Sequence[str], order: Attack, directory: Path) -> Mapping[str, Curves]:
    runs = [get_run(db, run_id) for run_id in run_ids]
    if not order.real:
        return {run.id: {METRIC: expected_curve(run.seed, FAKE_CYCLES)} for run in runs}
    directory.mkdir()
    orders = [{"id": run.id, "config": run.config, "needs": run.needs} for run in runs]
    (directory / "runs.json").write_text(json.dumps(orders))
    command = [sys.executable, str(HERE / "chaos_reference.py"), str(directory)]
    subprocess.run(command, check=True, cwd=ROOT, timeout=order.patience_s)
    return json.loads((directory / "curves.json").read_text())
