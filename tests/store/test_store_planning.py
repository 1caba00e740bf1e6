"""The plan of starts is what happens when workers take runs second by second."""

from __future__ import annotations

import random
from datetime import UTC, datetime, timedelta

import pytest

from backend.store.planning import plan_starts
from backend.store.runs import RunRow
from backend.store.states import RunState
from backend.store.workers import WorkerRow

NOW = datetime(2026, 1, 1, tzinfo=UTC)
SECONDS = (1, 2, 3, 5, 8)


def run(name: int, state: RunState, needs: tuple[str, ...] = (), *, needs_gpu: bool = False) -> RunRow:
    return RunRow(
        id=str(name),
        task="FetchPush",
        phase="manipulation",
        method="her",
        seed=name,
        preset="smoke",
        state=state,
        reason=None,
        needs=needs,
        unmet=needs,
        attempt=0,
        progress=None,
        success_rate=None,
        created_at=NOW,
        started_at=None,
        ended_at=None,
        cancel_requested=False,
        pause_requested=False,
        is_below_gate=False,
        gate_waived=False,
        needs_gpu=needs_gpu,
        priority=0,
        worker_id=None,
        not_before=None,
        deleted_at=None,
        config_json="{}",
        config_hash="",
    )


def worker(name: str, slots: int, gpu: str | None = None) -> WorkerRow:
    return WorkerRow(
        id=name,
        host=name,
        pid=1,
        executor="local",
        slots=slots,
        busy=0,
        running=(),
        cores=1,
        gpu=gpu,
        processor=None,
        memory_total=0,
        memory_used=0,
        draining=False,
        beat_at=NOW,
        alive=True,
    )


def second_by_second(queue: list[RunRow], slots: int, seconds: dict[str, float | None]) -> dict[str, int]:
    """Return when each run starts, by letting every free slot take the first run that may start, each second."""
    starts: dict[str, int] = {}
    ends: dict[str, int] = {}
    for now in range(sum(int(took or 0) for took in seconds.values()) + 1):
        for candidate in queue:
            busy = sum(starts[name] <= now < ends[name] for name in starts)
            met = all(ends.get(needed, now + 1) <= now for needed in candidate.needs)
            if candidate.id not in starts and met and busy < slots:
                starts[candidate.id] = now
                ends[candidate.id] = now + int(seconds[candidate.id] or 0)
    return starts


@pytest.mark.parametrize("seed", range(20))
def test_a_plan_starts_runs_when_workers_would(seed: int) -> None:
    drawn = random.Random(seed)
    queue: list[RunRow] = []
    for name in range(12):
        free = [row.id for row in queue if not row.needs]
        needs = tuple(drawn.sample(free, drawn.randint(1, min(2, len(free))))) if free and drawn.random() < 0.4 else ()
        queue.append(run(name, RunState.BLOCKED if needs else RunState.QUEUED, needs))
    drawn.shuffle(queue)
    seconds: dict[str, float | None] = {row.id: float(drawn.choice(SECONDS)) for row in queue}
    slots = drawn.randint(1, 4)

    plan = plan_starts(queue, [worker("a", slots)], seconds, NOW)

    planned = {name: (entry.start.at - NOW) // timedelta(seconds=1) for name, entry in plan.items()}
    assert planned == second_by_second(queue, slots, seconds)


def test_runs_for_a_gpu_do_not_hold_up_the_others() -> None:
    queue = [
        run(0, RunState.QUEUED, needs_gpu=True),
        run(1, RunState.QUEUED, needs_gpu=True),
        run(2, RunState.QUEUED),
    ]
    seconds: dict[str, float | None] = {row.id: 10.0 for row in queue}

    plan = plan_starts(queue, [worker("plain", 1), worker("fast", 1, "H200")], seconds, NOW)

    starts = [(plan[row.id].start.at - NOW).total_seconds() for row in queue]
    assert starts == [0.0, 10.0, 0.0]


def test_a_slot_that_idles_takes_what_becomes_ready_on_another() -> None:
    queue = [
        run(0, RunState.QUEUED, needs_gpu=True),
        run(1, RunState.BLOCKED, ("0",)),
        run(2, RunState.BLOCKED, ("0",)),
    ]
    seconds: dict[str, float | None] = {row.id: 10.0 for row in queue}

    plan = plan_starts(queue, [worker("plain", 1), worker("fast", 1, "H200")], seconds, NOW)

    assert [(plan[row.id].start.at - NOW).total_seconds() for row in queue] == [0.0, 10.0, 10.0]


def test_a_run_that_needs_what_will_not_come_is_left_out() -> None:
    queue = [run(0, RunState.PAUSED), run(1, RunState.BLOCKED, ("0",)), run(2, RunState.BLOCKED, ("gone",))]

    assert plan_starts(queue, [worker("a", 3)], dict.fromkeys("012", 1.0), NOW) == {}


def test_without_workers_nothing_starts() -> None:
    assert plan_starts([run(0, RunState.QUEUED)], [], {"0": 1.0}, NOW) == {}


def test_a_run_that_takes_longer_than_calendars_go_has_no_end_to_tell() -> None:
    queue = [run(0, RunState.QUEUED), run(1, RunState.QUEUED), run(2, RunState.QUEUED)]
    seconds: dict[str, float | None] = {"0": 1e15, "1": 1e9, "2": 1.0}

    plan = plan_starts(queue, [worker("a", 1)], seconds, NOW)

    assert [plan[row.id].start.told for row in queue] == [NOW, None, None]
    assert [plan[row.id].end.told for row in queue] == [None, None, None]
