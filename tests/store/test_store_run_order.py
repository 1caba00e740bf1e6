"""Lists of runs in every order, page by page."""

from __future__ import annotations

import pytest
from store_cases import claim_next, order, put_in_state

from backend.store.database import Database
from backend.store.launches import launch
from backend.store.metrics import append_metrics
from backend.store.progress import Progress
from backend.store.run_order import parse_order
from backend.store.runs import RunFilter, list_runs
from backend.store.states import RunState


def listed(db: Database, sort: str, descending: bool, limit: int = 2) -> list[str]:
    """Return the ids of all runs, read in small pages."""
    ids: list[str] = []
    cursor = None
    while True:
        page = list_runs(db, RunFilter(), limit, cursor, parse_order(sort, descending))
        ids += [row.id for row in page.rows]
        if page.next_cursor is None:
            return ids
        cursor = page.next_cursor


def five_runs(db: Database) -> list[str]:
    """Queue five runs; return their ids, oldest first."""
    return launch(db, order(seeds=(0, 1, 2, 3, 4)))


def report_success(db: Database, success: float | None) -> str:
    """Let the next run be claimed and report a test's success; return its id."""
    held = claim_next(db)
    append_metrics(db, held, [], Progress(1, 2, 400, 8, 16, 0.25, success, success, None, None, None))
    return held.run_id


@pytest.mark.parametrize("descending", [True, False])
def test_by_launch_the_newest_or_the_oldest_come_first(db: Database, descending: bool):
    ids = five_runs(db)
    assert listed(db, "launched", descending) == (ids[::-1] if descending else ids)


def test_by_success_runs_without_a_test_stand_last_both_ways(db: Database):
    five_runs(db)
    half, best, untested, worst = (report_success(db, success) for success in (0.5, 0.9, None, 0.0))
    unclaimed = next(iter(set(listed(db, "launched", True)) - {half, best, untested, worst}))
    assert listed(db, "success", descending=True) == [best, half, worst, unclaimed, untested]
    assert listed(db, "success", descending=False) == [worst, half, best, unclaimed, untested]


def test_by_state_what_runs_comes_first_and_equal_ones_newest_first(db: Database):
    ids = five_runs(db)
    states = (RunState.CANCELLED, RunState.QUEUED, RunState.RUNNING, RunState.QUEUED, RunState.FAILED)
    for run_id, state in zip(ids, states, strict=True):
        put_in_state(db, run_id, state)
    assert listed(db, "state", descending=False) == [ids[2], ids[3], ids[1], ids[4], ids[0]]


def test_by_task_names_stand_in_the_alphabets_order(db: Database):
    slide, push = (launch(db, order(task=task))[0] for task in ("FetchSlide", "FetchPush"))
    assert listed(db, "task", descending=False, limit=1) == [push, slide]
    assert listed(db, "task", descending=True, limit=1) == [slide, push]
