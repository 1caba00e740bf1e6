"""`sldr retention`: make room by letting go what ended runs no longer need."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from typing import Annotated

import tyro

from backend.store.database import open_database
from backend.store.retention.plan import RetentionPlan, plan_retention
from backend.store.retention.removal import apply_retention
from backend.store.retention.rule import KIND_WORDS, LONGEST_DAYS, Removable, Rule
from backend.store.settings import load_settings
from sldr_core.errors import InvalidConfig, UnknownName

SHOWN_RUNS = 20
"""Runs that are listed, those with the largest share first."""


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(retention, prog="sldr retention", args=list(arguments))


def retention(
    kind: Annotated[tyro.conf.UseAppendAction[tuple[str, ...]], tyro.conf.arg(metavar="KIND")] = (),
    older_than: Annotated[int, tyro.conf.arg(metavar="DAYS")] = 30,
    preview: bool = False,
    apply: bool = False,
) -> int:
    """Show what would be removed of ended runs, or remove it. Results stay: metrics, logs, newest and best policies.

    Runs tagged keep or starred lose nothing, nor do runs that others learn from.

    Args:
        kind: What may go: replay, policies, episodes, videos or recordings; may be given again (default: replay).
        older_than: Only of runs that ended at least so many days ago.
        preview: Show what would be removed, and remove nothing.
        apply: Remove it.
    """
    if preview == apply:
        raise InvalidConfig({"retention": "say one of --preview, which shows what would go, and --apply."})
    if not 0 <= older_than <= LONGEST_DAYS:
        raise InvalidConfig({"older-than": f"it must be between 0 and {LONGEST_DAYS} days, got {older_than}."})
    settings = load_settings()
    with closing(open_database(settings)) as db:
        plan = plan_retention(db, settings, Rule(_kinds(kind), older_than))
        print("\n".join(_lines(plan)))
        if apply:
            removed = apply_retention(db, settings, plan)
            print(f"Removed {removed.files} files of {removed.runs} runs: {_in_words(removed.size)}.")
            if removed.left:
                print(f"{removed.left} files could not be reached; the next --apply takes them.")
    return 0


def _kinds(names: Sequence[str]) -> frozenset[Removable]:
    known = [kind.value for kind in Removable]
    for name in names:
        if name not in known:
            raise UnknownName("kind of file", name, known)
    return frozenset(Removable(name) for name in names or (Removable.REPLAY.value,))


def _lines(plan: RetentionPlan) -> list[str]:
    """Return what a person reads of a plan."""
    totals = plan.totals()
    lines = [f"{_in_words(size):>10}  {count:6} files: {KIND_WORDS[kind]}" for kind, (count, size) in totals.items()]
    for share in plan.runs[:SHOWN_RUNS]:
        told = f"{share.task} {share.phase} {share.method} seed {share.seed}, {share.state} {share.ended_at:%Y-%m-%d}"
        lines.append(f"{_in_words(share.size):>10}  run {share.run_id}  {told}")
    if len(plan.runs) > SHOWN_RUNS:
        lines.append(f"and {len(plan.runs) - SHOWN_RUNS} more runs")
    spared = plan.spared
    lines.append(
        f"Spared: {spared['young']} that ended less than {plan.rule.older_than_days} days ago, "
        f"{spared['kept']} tagged to be kept, {spared['needed']} that others learn from."
    )
    return lines


def _in_words(size: int) -> str:
    return f"{size / 1e9:,.1f} GB" if size >= 10**9 else f"{size / 1e6:,.1f} MB"
