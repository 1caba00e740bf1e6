"""By what the configs of runs differ, and which switches lie between their methods."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from itertools import combinations

from backend.comparison.records import ComparedConfig, ConfigComparison, MethodPair, MethodSwitch, Setting
from backend.comparison.variants import as_text
from backend.store.database import Database
from backend.store.runs import get_run
from sldr_core.config import METHODS, flatten, method_switches


def compare_configs(db: Database, run_ids: Sequence[str]) -> ConfigComparison:
    """Compare the configs of runs, in the order asked for.

    Raises:
        NotFound: one of the runs does not exist.
    """
    runs = [get_run(db, run_id) for run_id in dict.fromkeys(run_ids)]
    flats = [{"preset": run.preset, **flatten(run.config)} for run in runs]
    names = list(dict.fromkeys(name for flat in flats for name in flat))
    rows = [
        Setting(name=name, values=[as_text(flat[name]) if name in flat else None for flat in flats]) for name in names
    ]
    differing = [row for row in rows if len(set(row.values)) > 1]
    return ConfigComparison(
        runs=[
            ComparedConfig(
                run_id=run.id, task=run.task, phase=run.phase, method=run.method, seed=run.seed, preset=run.preset
            )
            for run in runs
        ],
        settings=differing,
        shared=len(rows) - len(differing),
        methods=_method_pairs([run.method for run in runs]),
    )


def _method_pairs(methods: Sequence[str]) -> list[MethodPair]:
    known = [method for method in dict.fromkeys(methods) if method in METHODS]
    return [
        MethodPair(
            first=first,
            second=second,
            switches=[MethodSwitch(**asdict(switch)) for switch in method_switches(first, second)],
        )
        for first, second in combinations(known, 2)
    ]
