"""Several processes empty one long queue as fast as they can; each run must be claimed once.

`python chaos_claims.py WORKER` is one of those processes: it waits for a line, then claims until nothing is left.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from chaos_table import Finding

from backend.store.database import open_database
from backend.store.launches import LaunchOrder, launch
from backend.store.queue import claim
from backend.store.runs import RunFilter, list_runs
from backend.store.settings import Settings, load_settings

ROOT = Path(__file__).parents[2]
PATIENCE_S = 3600.0


def measure_claims(settings: Settings, queued: int, claimers: int, say: Callable[[str], None]) -> Finding:
    """Fill the queue, let the claimers at it, and count."""
    db = open_database(settings)
    if list_runs(db, RunFilter(), 1).total:
        raise SystemExit(f"The store {settings.database_url} holds runs; name an empty one.")
    say(f"queueing {queued} runs")
    launched = launch(db, LaunchOrder("FetchPush", "manipulation", "her", range(queued), "smoke"))
    db.close()
    say(f"{claimers} processes claim them")
    environment = {**os.environ, **settings.as_environment(), "PYTHONPATH": str(ROOT)}
    processes = [_start(f"claimer-{number}", environment) for number in range(claimers)]
    started = time.monotonic()
    for process in processes:
        assert process.stdin is not None
        process.stdin.write("go\n")
        process.stdin.flush()
    claimed = [process.communicate(timeout=PATIENCE_S)[0].split() for process in processes]
    took_s = time.monotonic() - started
    return Finding(
        name="A long queue",
        rows=[
            ("store", settings.database_url.partition(":")[0]),
            ("queued runs", str(queued)),
            ("claimers", str(claimers)),
            ("claims of each", ", ".join(str(len(ids)) for ids in claimed)),
            ("claims per second", f"{queued / took_s:.0f}"),
            ("time", f"{took_s:.1f} s"),
        ],
        complaints=_compare(launched, [run_id for ids in claimed for run_id in ids]),
    )


def _start(worker: str, environment: dict[str, str]) -> subprocess.Popen[str]:
    """Start a claimer and wait until it is ready."""
    process = subprocess.Popen(
        [sys.executable, __file__, worker], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment
    )
    assert process.stdout is not None
    if process.stdout.readline() != "ready\n":
        raise SystemExit(f"The claimer {worker} did not start.")
    return process


def _compare(launched: list[str], claimed: list[str]) -> list[str]:
    counts = Counter(claimed)
    found = [f"Run {run_id} was claimed {count} times." for run_id, count in counts.items() if count > 1]
    found += [f"Run {run_id} was never claimed." for run_id in launched if run_id not in counts]
    return found


def claim_all(worker: str) -> None:
    """Claim until nothing is left, then print what was claimed."""
    db = open_database(load_settings())
    print("ready", flush=True)
    sys.stdin.readline()
    ids: list[str] = []
    while (taken := claim(db, worker)) is not None:
        ids.append(taken.run_id)
    print("\n".join(ids))
    db.close()


if __name__ == "__main__":
    claim_all(sys.argv[1])
