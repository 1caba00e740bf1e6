"""`make bench`: measure each row beside its peer, print the table, and keep it with the machine it was measured on."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from bench_clients import measure_clients
from bench_epoch import measure_epoch
from bench_gpu import measure_gpu
from bench_growth import measure_growth
from bench_learner import measure_learner
from bench_metrics import measure_metrics
from bench_quality import measure_quality
from bench_queries import measure_queries
from bench_reaching import PEER_CAP_S, measure_locomotion, measure_manipulation
from bench_rows import Measured
from bench_service import measure_service, measure_two_at_once
from bench_simulation import measure_collecting, measure_locomotion_scenes
from kept_results import as_line, as_tables, keep_each, read_results
from measured_page import write_parts

GROUPS: dict[str, Callable[[], Iterator[Measured]]] = {
    "collecting": measure_collecting,
    "locomotion-scenes": measure_locomotion_scenes,
    "learner": measure_learner,
    "epoch": measure_epoch,
    "gpu": measure_gpu,
    "metrics": measure_metrics,
    "queries": measure_queries,
    "service": measure_service,
    "two-at-once": measure_two_at_once,
    "clients": measure_clients,
    "growth": measure_growth,
    "locomotion": measure_locomotion,
    "push": partial(measure_manipulation, "FetchPush", "FetchPush-v4", 5.0),
    "pick-and-place": partial(measure_manipulation, "FetchPickAndPlace", "FetchPickAndPlace-v4", 25.0),
    "quality": measure_quality,
}
AGAINST_PEERS = ("push", "pick-and-place")
"""Groups in which a peer is trained for hours."""

NUMBERS = Path("docs/performance.json")
"""Beside the page that is made of it, so that a group measured on another day or machine stays in the page."""

LONG = (*AGAINST_PEERS, "quality")
"""Groups of hours, and of runs that took hours: measured only when they are named."""


def main() -> int:
    """Measure the groups asked for; return 1 if a target is missed."""
    options = _parse()
    named = options.only or [name for name in GROUPS if name not in LONG]
    peer = {"cap_s": 3600.0 * options.peer_hours, "take_kept": options.go_on}
    groups = GROUPS | {name: partial(GROUPS[name], **peer) for name in AGAINST_PEERS}
    groups["quality"] = partial(measure_quality, options.home)
    measured: list[Measured] = []
    for name in named:
        # A group that measures nothing on this machine leaves what is known of it from another one.
        for one in keep_each(options.json, name, groups[name]()):
            print(as_line(one), flush=True)
            measured.append(one)
            if options.write is not None:
                write_parts(options.write, "make bench", as_tables(read_results(options.json), list(GROUPS)))
    missed = [one for one in measured if not one.is_met]
    print(f"{len(missed)} of {len(measured)} rows fall short.")
    return 1 if missed else 0


def _parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="make bench", description=__doc__)
    parser.add_argument("--only", choices=list(GROUPS), action="append", help="measure this group; may be given again")
    parser.add_argument("--write", type=Path, metavar="PAGE", help="put the table into this page")
    parser.add_argument("--json", type=Path, default=NUMBERS, help="where the numbers go")
    hours = PEER_CAP_S / 3600.0
    parser.add_argument("--peer-hours", type=float, default=hours, help="how long a robot's peer may train")
    parser.add_argument("--go-on", action="store_true", help="take what peer and seeds came to here before")
    parser.add_argument("--home", type=Path, help="data directory whose finished runs `quality` reads")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
