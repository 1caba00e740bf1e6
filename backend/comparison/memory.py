"""What comparisons keep between two questions: curves that were read, and answers by the hash of their data.

Curves only grow, so of a run that goes on only its new points are read. Both memories are bounded.
"""

from __future__ import annotations

import hashlib
import threading
from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, TypeVar, cast

from backend.comparison.variants import Variant, deviations
from backend.store.compared_runs import ComparedRun, read_configs
from backend.store.curves import NO_POINTS, Points, read_points, without_superseded
from backend.store.database import Database

POINTS_KEPT = 400_000
"""Points of curves kept, about 30 MB."""

ANSWERS_KEPT = 32
"""Answers kept, unless they are large."""

VALUES_KEPT = 1_000_000
"""Values in all answers kept, about 30 MB; only the newest answer may be larger than that by itself."""

VARIANTS_KEPT = 20_000
"""Configs whose deviations are kept."""

Answer = TypeVar("Answer")


@dataclass(frozen=True)
class KnownCurve:
    """Hold one metric of one run as far as it was read."""

    newest_step_id: int
    attempt: int
    logged: Points
    """All points, superseded ones among them."""
    curve: Points
    """Those that count."""


@dataclass(frozen=True)
class KnownAnswer:
    """Hold one answer."""

    answer: Any
    values: int
    """Numbers and words in it."""


@dataclass(frozen=True)
class KnownCurves:
    """Hold one metric of several runs."""

    curves: dict[str, Points]
    """By run id."""
    every: int
    """1 if each cycle was read, k if every k-th."""


class ComparisonMemory:
    """Remember curves, variants and answers. Share one between threads."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._curves: OrderedDict[tuple[str, str], KnownCurve] = OrderedDict()
        self._points = 0
        self._variants: dict[tuple[str, str], Variant] = {}
        self._answers: OrderedDict[str, KnownAnswer] = OrderedDict()
        self._values = 0

    @property
    def size(self) -> tuple[int, int]:
        """How many points of curves and how many answers are kept."""
        with self._lock:
            return self._points, len(self._answers)

    def curves(self, db: Database, runs: Sequence[ComparedRun], metric: str) -> KnownCurves:
        """Return one metric of runs, reading what is not known yet."""
        with self._lock:
            known = {run.id: self._curves[run.id, metric] for run in runs if (run.id, metric) in self._curves}
        stale = [run for run in runs if not _is_current(known.get(run.id), run)]
        after = {run_id: curve.newest_step_id for run_id, curve in known.items()}
        page = read_points(db, stale, metric, after)
        for run in stale:
            before = known[run.id].logged if run.id in known else NO_POINTS
            logged = before.followed_by(page.points[run.id]) if len(page.points[run.id]) else before
            curve = without_superseded(logged, page.firsts.get(run.id, {}))
            known[run.id] = KnownCurve(run.newest_step_id, run.attempt, logged, curve)
        if page.every == 1:
            self._keep(metric, known)
        return KnownCurves({run_id: curve.curve for run_id, curve in known.items()}, page.every)

    def variants(self, db: Database, runs: Sequence[ComparedRun]) -> dict[str, Variant]:
        """Return by what each run deviates from its preset, by run id."""
        with self._lock:
            known = dict(self._variants)
        unknown = [run for run in runs if (run.config_hash, run.preset) not in known]
        configs = read_configs(db, [run.id for run in unknown]) if unknown else {}
        found = {(run.config_hash, run.preset): deviations(configs[run.id], run.preset) for run in unknown}
        with self._lock:
            if len(self._variants) > VARIANTS_KEPT:
                self._variants.clear()
            self._variants.update(found)
        return {run.id: (known | found)[run.config_hash, run.preset] for run in runs}

    def answer(self, version: str, make: Callable[[], Answer]) -> Answer:
        """Return the answer to a question that was asked of the same data before, or make it."""
        with self._lock:
            if version in self._answers:
                self._answers.move_to_end(version)
                return self._answers[version].answer
        made = make()
        self._keep_answer(version, KnownAnswer(made, count_values(made)))
        return made

    def _keep(self, metric: str, known: dict[str, KnownCurve]) -> None:
        with self._lock:
            for run_id, curve in known.items():
                older = self._curves.pop((run_id, metric), None)
                self._points += len(curve.logged) - (len(older.logged) if older else 0)
                self._curves[run_id, metric] = curve
            while self._points > POINTS_KEPT and self._curves:
                _, dropped = self._curves.popitem(last=False)
                self._points -= len(dropped.logged)

    def _keep_answer(self, version: str, known: KnownAnswer) -> None:
        with self._lock:
            older = self._answers.pop(version, None)
            self._values += known.values - (older.values if older else 0)
            self._answers[version] = known
            while len(self._answers) > ANSWERS_KEPT or (self._values > VALUES_KEPT and len(self._answers) > 1):
                _, dropped = self._answers.popitem(last=False)
                self._values -= dropped.values


def count_values(part: object) -> int:
    """Return how many numbers and words an answer holds; the lists in it are columns, or hold records or lists."""
    if is_dataclass(part):
        return sum(count_values(getattr(part, field.name)) for field in fields(part))
    if isinstance(part, list):
        items = cast("list[object]", part)
        is_column = bool(items) and not (isinstance(items[0], list) or is_dataclass(items[0]))
        return len(items) if is_column else sum(map(count_values, items))
    return 1


def data_version(question: object, runs: Sequence[ComparedRun]) -> str:
    """Return the hash of a question and of the data it is asked of: which runs, and how far each has come."""
    data = [(run.id, run.state, run.attempt, run.newest_step_id) for run in runs]
    return hashlib.sha256(repr((question, data)).encode()).hexdigest()[:16]


def _is_current(known: KnownCurve | None, run: ComparedRun) -> bool:
    return known is not None and (known.newest_step_id, known.attempt) == (run.newest_step_id, run.attempt)
