"""Which run will start when: the workers that are alive take the runs as they would, one slot after the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from heapq import heappop, heappush

from backend.store.runs import RunRow
from backend.store.states import RunState
from backend.store.workers import WorkerRow

NOBODY_KNOWS_S = 3600.0
"""Taken for a run of whose like none has succeeded, to find an order; no time is told that rests on it [s]."""

END_OF_TIME = datetime.max.replace(tzinfo=UTC)
"""Stands for a moment that no calendar holds: it serves to find an order, and is not told."""


@dataclass(frozen=True, order=True)
class Moment:
    """Hold a time that rests on measurements or, if not, only serves to find an order."""

    at: datetime
    is_guess: bool = False

    @property
    def told(self) -> datetime | None:
        """The time, if it is fit to be told."""
        return None if self.is_guess else self.at

    def after(self, seconds: float | None) -> Moment:
        """Return the moment so many seconds later; None stands for nobody knows how many."""
        try:
            later = self.at + timedelta(seconds=NOBODY_KNOWS_S if seconds is None else seconds)
        except OverflowError:
            return Moment(END_OF_TIME, is_guess=True)
        return Moment(later, self.is_guess or seconds is None)


@dataclass(frozen=True)
class Planned:
    """Say when a run starts and ends."""

    start: Moment
    end: Moment


@dataclass(order=True)
class _Slot:
    """Hold a worker's place for one run."""

    free: Moment
    number: int
    has_gpu: bool = field(compare=False)


def plan_starts(
    queue: Sequence[RunRow], workers: Sequence[WorkerRow], seconds: Mapping[str, float | None], at: datetime
) -> dict[str, Planned]:
    """Return when runs start and end; runs that would never start by themselves are left out.

    Args:
        queue: the runs that have not ended, in the order in which workers take them.
        workers: those that are alive.
        seconds: what each run will still take once it trains; None if nobody knows [s].
        at: now.
    """
    plan = _Plan(queue, seconds, Moment(at))
    plan.keep_running(workers)
    plan.fill_slots()
    return plan.planned


class _Plan:
    """Follow slots and runs through the time to come."""

    def __init__(self, queue: Sequence[RunRow], seconds: Mapping[str, float | None], now: Moment) -> None:
        self.planned: dict[str, Planned] = {}
        self._queue = queue
        self._seconds = seconds
        self._now = now
        self._slots: list[_Slot] = []
        self._idle: list[_Slot] = []
        self._due: list[tuple[Moment, int]] = []
        """Runs that will be ready, and when."""
        self._ready: dict[bool, list[int]] = {False: [], True: []}
        """Runs that are ready, by whether they ask for a GPU."""
        self._waiting_for: dict[str, list[int]] = {}
        """Blocked runs, by each of the runs that they need."""
        self._missing: dict[int, int] = {}
        """How many of those have not been planned yet, by blocked run."""
        self._met_at: dict[int, Moment] = {}
        """When the last of those ends."""
        active = {run.id for run in queue if run.state is not RunState.PAUSED}
        for place, run in enumerate(queue):
            if run.state is RunState.QUEUED:
                heappush(self._due, (max(now, Moment(run.not_before or now.at)), place))
            elif run.state is RunState.BLOCKED and run.unmet:
                self._note_needs(place, run, active)

    def keep_running(self, workers: Sequence[WorkerRow]) -> None:
        """Let every worker go on with what it has, and open its slots when that ends."""
        ends: dict[str | None, list[Moment]] = {}
        for run in self._queue:
            if run.state is RunState.RUNNING:
                end = self._now.after(self._seconds[run.id])
                ends.setdefault(run.worker_id, []).append(end)
                self._put(run, Planned(Moment(run.started_at or self._now.at), end))
        for worker in workers:
            if worker.draining:
                continue
            busy = ends.get(worker.id, [])
            for free in [*busy, *[self._now] * (worker.slots - len(busy))]:
                heappush(self._slots, _Slot(free, len(self._slots), worker.gpu is not None))

    def fill_slots(self) -> None:
        """Let each slot, when it is free, take the first run that is ready."""
        while self._slots:
            slot = heappop(self._slots)
            while self._due and self._due[0][0] <= slot.free:
                place = heappop(self._due)[1]
                heappush(self._ready[self._queue[place].needs_gpu], place)
            queues = [ready for gpu, ready in self._ready.items() if ready and gpu <= slot.has_gpu]
            if queues:
                self._take(slot, heappop(min(queues, key=lambda ready: ready[0])))
            elif self._due:
                heappush(self._slots, _Slot(self._due[0][0], slot.number, slot.has_gpu))
            else:
                self._idle.append(slot)

    def _note_needs(self, place: int, run: RunRow, active: set[str]) -> None:
        """Remember what a blocked run waits for, unless that will not come."""
        if active.issuperset(run.unmet):
            self._missing[place] = len(run.unmet)
            for needed in run.unmet:
                self._waiting_for.setdefault(needed, []).append(place)

    def _take(self, slot: _Slot, place: int) -> None:
        run = self._queue[place]
        planned = Planned(slot.free, slot.free.after(self._seconds[run.id]))
        heappush(self._slots, _Slot(planned.end, slot.number, slot.has_gpu))
        self._put(run, planned)

    def _put(self, run: RunRow, planned: Planned) -> None:
        """Write down when a run starts and ends, and let those that waited for nothing else be ready then."""
        self.planned[run.id] = planned
        for place in self._waiting_for.pop(run.id, ()):
            self._missing[place] -= 1
            self._met_at[place] = max(planned.end, self._met_at.get(place, planned.end))
            if not self._missing[place]:
                heappush(self._due, (self._met_at[place], place))
                while self._idle:
                    heappush(self._slots, self._idle.pop())
