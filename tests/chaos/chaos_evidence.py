"""What a store must show after an attack: every run done once, nobody's writes mixed, no number lost or changed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from backend.store.attempts import list_attempts
from backend.store.database import Database
from backend.store.metrics import MetricColumns, read_metrics
from backend.store.runs import get_run, list_events
from backend.store.states import Event, RunState

OF_THE_MACHINE = ("speed/", "progress/seconds_left")
"""Metrics that tell of the machine, not of the training."""

Point = tuple[int, int, str, float]
"""Attempt, cycle, name and value of one number."""
Curves = Mapping[str, Sequence[float]]
"""The values of each metric that was logged, cycle by cycle."""


@dataclass
class Witness:
    """Remember every number that was ever seen in the store."""

    db: Database
    run_ids: Sequence[str]
    cursors: dict[str, int] = field(default_factory=dict)
    seen: dict[str, set[Point]] = field(default_factory=dict)

    def look(self) -> None:
        """Take down what is new."""
        for run_id in self.run_ids:
            columns = read_metrics(self.db, run_id, self.cursors.get(run_id, 0), superseded=True)
            self.cursors[run_id] = columns.cursor
            self.seen.setdefault(run_id, set()).update(points_of(columns))

    def count(self) -> int:
        """Return how many numbers were seen."""
        return sum(len(points) for points in self.seen.values())


def points_of(columns: MetricColumns) -> set[Point]:
    """Return the numbers of a reading."""
    return {
        (attempt, step, name, value)
        for name, values in columns.values.items()
        for attempt, step, value in zip(columns.attempt, columns.step, values, strict=True)
        if value is not None
    }


def complaints(witness: Witness, undisturbed: Mapping[str, Curves]) -> list[str]:
    """Return what is wrong with the runs, in sentences; nothing if all is well.

    Args:
        undisturbed: what each run logs when nobody disturbs it.
    """
    found: list[str] = []
    for run_id in witness.run_ids:
        found += _of_states(witness.db, run_id)
        found += _of_attempts(witness.db, run_id)
        found += _of_numbers(witness, run_id, undisturbed[run_id])
    return found


def _of_states(db: Database, run_id: str) -> list[str]:
    run = get_run(db, run_id)
    ends = [event.event for event in list_events(db, run_id) if event.event is Event.SUCCEEDED]
    if run.state is not RunState.SUCCEEDED:
        return [f"Run {run_id} is {run.state}: {run.reason}"]
    return [] if len(ends) == 1 else [f"Run {run_id} has succeeded {len(ends)} times."]


def _of_attempts(db: Database, run_id: str) -> list[str]:
    """Find attempts that were open at the same time, or fences that did not rise."""
    found: list[str] = []
    for earlier, later in pairwise(list_attempts(db, run_id)):
        if earlier.ended_at is None or earlier.ended_at > later.started_at:
            found.append(f"Run {run_id}: attempts {earlier.attempt} and {later.attempt} were open at the same time.")
        if earlier.fence >= later.fence:
            found.append(f"Run {run_id}: attempt {later.attempt} did not raise the fence.")
    return found


def _of_numbers(witness: Witness, run_id: str, undisturbed: Curves) -> list[str]:
    found: list[str] = []
    everything = read_metrics(witness.db, run_id, superseded=True)
    if everything.attempt != sorted(everything.attempt):
        found.append(f"Run {run_id}: an attempt has written after a later one.")
    missing = witness.seen.get(run_id, set()) - points_of(everything)
    if missing:
        found.append(f"Run {run_id}: {len(missing)} numbers that were stored are gone, such as {min(missing)}.")
    current = read_metrics(witness.db, run_id)
    if current.step != list(range(1, len(current.step) + 1)):
        found.append(f"Run {run_id}: its cycles are {current.step}.")
    names = {*current.values, *undisturbed}
    for name in sorted(name for name in names if not name.startswith(OF_THE_MACHINE)):
        logged = [value for value in current.values.get(name, []) if value is not None]
        if logged != list(undisturbed.get(name, [])):
            found.append(f"Run {run_id}: {name} differs from that of an undisturbed run.")
    return found
