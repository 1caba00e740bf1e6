"""Runs start by priority, then by their place, and a person can change both."""

from __future__ import annotations

import random

import pytest
from sqlalchemy import update
from store_cases import claim_next, claimed_run, order

from backend.store.actions import Action, act_on
from backend.store.database import Database
from backend.store.errors import NotFound, Refused
from backend.store.launches import launch
from backend.store.order import move_run, set_priority
from backend.store.runs import get_run
from backend.store.tables import runs
from sldr_core.errors import InvalidConfig


def launch_runs(db: Database, count: int) -> list[str]:
    return launch(db, order(seeds=tuple(range(count))))


def claimed_in_order(db: Database, count: int) -> list[str]:
    return [claim_next(db).run_id for _ in range(count)]


def test_a_higher_priority_goes_first(db: Database) -> None:
    a, b, c, d = launch_runs(db, 4)
    set_priority(db, [c, d], 5)
    set_priority(db, [a], -1)

    assert get_run(db, c).priority == 5
    assert claimed_in_order(db, 4) == [c, d, b, a]


@pytest.mark.parametrize("priority", [-101, 101])
def test_a_priority_that_does_not_exist_is_refused(db: Database, priority: int) -> None:
    with pytest.raises(InvalidConfig, match=r"between -100 and 100"):
        set_priority(db, launch_runs(db, 1), priority)


def test_a_priority_for_a_run_that_does_not_exist_changes_nothing(db: Database) -> None:
    (a,) = launch_runs(db, 1)

    with pytest.raises(NotFound, match="no run 'nobody'"):
        set_priority(db, [a, "nobody"], 3)

    assert get_run(db, a).priority == 0


def test_a_run_moves_before_another(db: Database) -> None:
    a, b, c, d = launch_runs(db, 4)
    move_run(db, d, before=b)
    move_run(db, a, before=c)

    assert claimed_in_order(db, 4) == [d, b, a, c]


def test_a_run_moves_to_the_end_and_stays_before_later_launches(db: Database) -> None:
    a, b, c = launch_runs(db, 3)
    move_run(db, a, before=None)
    move_run(db, b, before=None)
    (later,) = launch_runs(db, 1)

    assert claimed_in_order(db, 4) == [c, a, b, later]


def test_a_run_moved_past_others_takes_the_nearest_priority_that_fits(db: Database) -> None:
    a, b, c, d = launch_runs(db, 4)
    set_priority(db, [a], 9)
    set_priority(db, [b], 5)

    move_run(db, d, before=b)
    assert get_run(db, d).priority == 5
    move_run(db, a, before=c)

    assert get_run(db, a).priority == 5
    assert claimed_in_order(db, 4) == [d, b, a, c]


def test_moving_a_run_before_itself_changes_nothing(db: Database) -> None:
    a, b = launch_runs(db, 2)
    move_run(db, b, before=b)

    assert claimed_in_order(db, 2) == [a, b]


def test_equal_positions_are_numbered_afresh_when_something_goes_between(db: Database) -> None:
    a, b, c = launch_runs(db, 3)
    with db.write() as conn:
        conn.execute(update(runs).values(queue_position=7.0))

    move_run(db, c, before=b)

    assert claimed_in_order(db, 3) == [a, c, b]


def test_a_long_row_of_moves_ends_like_the_same_moves_of_a_list(db: Database) -> None:
    queue = launch_runs(db, 6)
    drawn = random.Random(7)
    for _ in range(120):
        moved, before = drawn.sample(queue, 2)
        move_run(db, moved, before)
        queue.remove(moved)
        queue.insert(queue.index(before), moved)

    assert claimed_in_order(db, 6) == queue


def test_moving_always_into_the_same_gap_never_runs_out_of_room(db: Database) -> None:
    first, *others = launch_runs(db, 3)
    for turn in range(70):
        move_run(db, others[turn % 2], before=others[1 - turn % 2])

    assert claimed_in_order(db, 3) == [first, others[1], others[0]]


def test_only_waiting_runs_have_a_place(db: Database) -> None:
    running = claimed_run(db).run_id
    a, b = launch_runs(db, 2)
    act_on(db, Action.DELETE, [b])

    for missing in (running, b):
        with pytest.raises(Refused, match="only waiting runs have a place"):
            move_run(db, a, before=missing)
    with pytest.raises(NotFound, match="no run 'nobody'"):
        move_run(db, "nobody", before=a)
