"""The runs that a comparison was asked for, sorted into groups; every kind of comparison begins with it."""

from __future__ import annotations

from dataclasses import dataclass

from backend.comparison.groups import Grouping, group_runs
from backend.comparison.memory import ComparisonMemory
from backend.comparison.models import name_models
from backend.store.compared_runs import ComparedRun, RunChoice, find_compared_runs, read_configs
from backend.store.database import Database


@dataclass(frozen=True)
class Selection:
    """Hold the runs of a comparison."""

    db: Database
    memory: ComparisonMemory
    runs: list[ComparedRun]
    unread: int
    """Further runs that pass the filters."""

    def group(self, anonymous: bool) -> Grouping:
        """Sort the runs into groups, whose names hold no ids if they are to be anonymous."""
        needed = sorted({run_id for run in self.runs for run_id in run.needs})
        models = name_models(self.runs, read_configs(self.db, needed) if needed else {}, anonymous)
        return group_runs(self.runs, self.memory.variants(self.db, self.runs), models)


def select_runs(db: Database, memory: ComparisonMemory, choice: RunChoice) -> Selection:
    """Find the runs of a comparison."""
    found = find_compared_runs(db, choice)
    return Selection(db, memory, found.runs, found.total - len(found.runs))
