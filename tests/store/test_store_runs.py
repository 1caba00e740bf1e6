"""Runs can be listed in pages, filtered and searched; their progress and files come with them."""

from __future__ import annotations

from dataclasses import replace

import pytest
from store_cases import claimed_run, order

from backend.store.database import Database
from backend.store.errors import NotFound
from backend.store.files import find_file, list_files, register_file
from backend.store.launches import launch
from backend.store.metrics import append_metrics
from backend.store.progress import Progress, find_progress
from backend.store.runs import RunFilter, get_run, get_runs, list_events, list_runs
from backend.store.states import RunState
from sldr_core.errors import InvalidConfig

HALFWAY = Progress(1, 2, 400, 8, 8, 0.5, 0.25, 0.5, 900.0, 80.0, 3.5)


def ids(db: Database, wanted: RunFilter) -> list[str]:
    return [row.id for row in list_runs(db, wanted, 50).rows]


def test_pages_hold_every_run_once_newest_first(db: Database) -> None:
    launched = launch(db, order(seeds=(0, 1, 2, 3, 4)))
    seen: list[str] = []
    cursor = None
    while True:
        page = list_runs(db, RunFilter(), 2, cursor)
        seen += [row.id for row in page.rows]
        cursor = page.next_cursor
        if cursor is None:
            break

    assert seen == launched[::-1]
    assert page.total == 5


def test_a_filter_leaves_out_the_others(db: Database) -> None:
    (her,) = launch(db, order())
    locomotion, blocked = launch(db, order(method="her-sldr"))

    assert ids(db, RunFilter(methods=["her-sldr"])) == [blocked]
    assert ids(db, RunFilter(phases=["locomotion"])) == [locomotion]
    assert ids(db, RunFilter(states=[RunState.QUEUED], phases=["manipulation"])) == [her]
    assert ids(db, RunFilter(tasks=["FetchSlide"])) == []


def test_a_search_needs_every_word(db: Database) -> None:
    _, second = launch(db, order(seeds=(1, 2)))

    assert ids(db, RunFilter(search="PUSH 2 smoke")) == [second]
    assert ids(db, RunFilter(search=second[:6])) == [second]
    assert ids(db, RunFilter(search="100%")) == []


def test_a_cursor_that_came_from_nowhere_is_refused(db: Database) -> None:
    with pytest.raises(InvalidConfig, match="cursor: 'x' is no cursor"):
        list_runs(db, RunFilter(), 10, "x")


def test_a_run_that_does_not_exist_is_named(db: Database) -> None:
    with pytest.raises(NotFound, match="no run 'nobody'"):
        get_run(db, "nobody")
    with pytest.raises(NotFound, match="no run 'nobody'"):
        list_events(db, "nobody")


def test_several_runs_come_in_the_order_asked_for(db: Database) -> None:
    first, second = launch(db, order(seeds=(0, 1)))

    assert [row.id for row in get_runs(db, [second, "nobody", first])] == [second, first]


def test_the_newest_progress_replaces_the_one_before(db: Database) -> None:
    claim = claimed_run(db)
    assert get_run(db, claim.run_id).progress is None

    append_metrics(db, claim, [], HALFWAY)
    append_metrics(db, claim, [], replace(HALFWAY, fraction=0.75))

    assert get_run(db, claim.run_id).progress == find_progress(db, claim.run_id) == replace(HALFWAY, fraction=0.75)


def test_a_file_of_the_same_name_is_replaced(db: Database) -> None:
    claim = claimed_run(db)
    register_file(db, claim, "policy.pt", "policy", "runs/x/policy.pt", 10, "a" * 64)
    register_file(db, claim, "policy.pt", "policy", "runs/x/policy.pt", 20, "b" * 64)

    assert [(row.size, row.sha256) for row in list_files(db, claim.run_id)] == [(20, "b" * 64)]


def test_a_file_that_does_not_exist_is_named(db: Database) -> None:
    claim = claimed_run(db)

    with pytest.raises(NotFound, match=r"called 'policy\.pt'"):
        find_file(db, claim.run_id, "policy.pt")


def test_times_are_aware(db: Database) -> None:
    run = get_run(db, claimed_run(db).run_id)

    assert run.created_at.utcoffset() is not None
    assert run.started_at is not None
    assert run.started_at >= run.created_at
