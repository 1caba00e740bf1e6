"""`make chaos`: attack a service in three ways, print what was found, and keep it in the documentation.

The store is SQLite in a directory of its own; with SLDR_DATABASE_URL set, the long queue is measured there as well.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import sys
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from chaos_claims import measure_claims
from chaos_crowd import Crowd, press
from chaos_kills import Attack, attack
from chaos_table import Finding, as_markdown, as_text
from measured_page import write_results

from backend.store.settings import DATABASE_VARIABLE, Settings, sqlite_url

COMMAND = "make chaos"
"""What writes the results."""

PARTS = ("kills", "crowd", "claims")


def main() -> int:
    """Run the parts asked for; return 1 if anything was wrong."""
    options = _parse()
    findings: list[Finding] = []
    for name, measure in _parts(options).items():
        home = Path(tempfile.mkdtemp(prefix=f"sldr-chaos-{name}-"))
        finding = measure(Settings(home=home, database_url=sqlite_url(home)))
        print(as_text(finding), flush=True)
        findings.append(finding)
        if not finding.complaints:
            shutil.rmtree(home)
    if options.write is not None:
        write_results(options.write, COMMAND, [as_markdown(finding) for finding in findings])
    return 1 if any(finding.complaints for finding in findings) else 0


def _parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="make chaos", description=__doc__)
    parser.add_argument("--only", choices=PARTS, action="append", help="run this part; may be given again")
    parser.add_argument("--write", type=Path, metavar="PAGE", help="put the results into this page")
    parser.add_argument("--seed", type=int, default=random.randrange(10**6), help="of the moments and the victims")
    parser.add_argument("--runs", type=int, default=50, help="runs that are disturbed")
    parser.add_argument("--kills", type=int, default=100, help="processes that are killed")
    parser.add_argument("--workers", type=int, default=3, help="workers that are disturbed")
    parser.add_argument("--gap", type=float, default=4.0, help="mean time between two kills [s]")
    parser.add_argument("--sums", action="store_true", help="disturb sums in place of real trainings")
    parser.add_argument("--minutes", type=float, default=10.0, help="how long the crowd presses")
    parser.add_argument("--queued", type=int, default=10_000, help="length of the long queue")
    parser.add_argument("--claimers", type=int, default=8, help="processes that empty it")
    return parser.parse_args()


def _parts(options: argparse.Namespace) -> dict[str, Callable[[Settings], Finding]]:
    """Return what to do, by name."""
    disturbed = Attack(options.runs, options.kills, options.workers, options.gap, not options.sums, options.seed)
    crowd = Crowd(60.0 * options.minutes, apis=2, workers=4, clients=4, seed=options.seed)
    parts: dict[str, Callable[[Settings], Finding]] = {
        "kills": lambda settings: attack(settings, disturbed, _say),
        "crowd": lambda settings: press(settings, crowd, _say),
        "claims": lambda settings: measure_claims(settings, options.queued, options.claimers, _say),
    }
    parts = {name: part for name, part in parts.items() if options.only is None or name in options.only}
    url = os.environ.get(DATABASE_VARIABLE)
    if url and "claims" in parts:
        parts["claims-there"] = lambda settings: measure_claims(
            replace(settings, database_url=url), options.queued, options.claimers, _say
        )
    return parts


def _say(sentence: str) -> None:
    print(sentence, file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
