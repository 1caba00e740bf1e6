"""A launch makes what its plan says; a locomotion run is shared, and its gate holds."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sqlalchemy import update
from store_cases import claim_next, order

from backend.store.actions import Action, act_on, request_cancel
from backend.store.database import Database, current_time
from backend.store.errors import Refused
from backend.store.launches import LaunchOrder, launch, plan_launch
from backend.store.outcomes import Failed, Succeeded
from backend.store.queue import claim, finish
from backend.store.run_plans import make_runs
from backend.store.runs import RunFilter, get_run, list_runs
from backend.store.states import RunState
from backend.store.tables import runs
from sldr_core.errors import InvalidConfig, UnknownName

GATED = {"sldr": {"gate": 0.95}}


def sldr(seeds: tuple[int, ...] = (0,)) -> LaunchOrder:
    return order(method="her-sldr", seeds=seeds, overrides=GATED)


def run_count(db: Database) -> int:
    return list_runs(db, RunFilter(), 1).total


def test_a_launch_makes_exactly_what_its_plan_says(db: Database) -> None:
    plan = plan_launch(db, sldr((0, 1)))

    rows = [get_run(db, run_id) for run_id in launch(db, sldr((0, 1)))]

    assert [(row.phase, row.method, row.seed, row.config_hash) for row in rows] == [
        (planned.phase, planned.method, planned.seed, planned.config_hash) for planned in plan
    ]
    assert [planned.phase for planned in plan] == ["locomotion", "manipulation", "manipulation"]


def test_planning_makes_nothing(db: Database) -> None:
    plan_launch(db, sldr())

    assert run_count(db) == 0


def test_a_run_waits_for_its_locomotion_run(db: Database) -> None:
    locomotion, manipulation = launch(db, sldr())

    run = get_run(db, manipulation)
    assert (run.state, run.needs) == (RunState.BLOCKED, (locomotion,))
    assert run.reason == f"Waits for the locomotion run {locomotion}."
    assert get_run(db, locomotion).state is RunState.QUEUED


def test_an_equal_locomotion_run_is_shared(db: Database) -> None:
    locomotion, _ = launch(db, sldr())
    plan = plan_launch(db, sldr((1,)))

    assert plan[0].reused_run_id == locomotion
    assert launch(db, sldr((1,)))[0] == locomotion
    assert run_count(db) == 3


def test_a_locomotion_run_launched_by_itself_is_shared_too(db: Database) -> None:
    alone = order(phase="locomotion")

    assert launch(db, alone) == launch(db, alone)


def test_a_robot_s_run_is_trained_again_and_says_which_it_repeats(db: Database) -> None:
    assert [planned.equal_run_id for planned in plan_launch(db, sldr())] == [None, None]
    locomotion, first = launch(db, sldr())

    again = plan_launch(db, sldr((0, 1)))

    assert [(planned.reused_run_id, planned.equal_run_id) for planned in again] == [
        (locomotion, None),
        (None, first),
        (None, None),
    ]
    assert first not in launch(db, sldr())
    request_cancel(db, first)
    assert plan_launch(db, sldr((0,)))[1].equal_run_id not in (None, first)


def test_another_preset_trains_its_own_locomotion_run(db: Database) -> None:
    launch(db, sldr())

    assert plan_launch(db, replace(sldr(), preset="quick"))[0].reused_run_id is None


def test_a_failed_locomotion_run_is_not_shared(db: Database) -> None:
    locomotion, _ = launch(db, sldr())
    finish(db, claim_next(db), Failed("The numbers diverged.", retry=False))

    assert launch(db, sldr())[0] != locomotion


def test_a_cancelled_locomotion_run_is_not_shared(db: Database) -> None:
    locomotion, _ = launch(db, sldr())
    request_cancel(db, locomotion)

    assert launch(db, sldr())[0] != locomotion


def test_a_locomotion_run_that_succeeded_before_its_cancelling_is_shared(db: Database) -> None:
    locomotion, _ = launch(db, sldr())
    held = claim_next(db)
    request_cancel(db, locomotion)
    finish(db, held, Succeeded(1.0))

    assert not get_run(db, locomotion).cancel_requested
    assert launch(db, sldr())[0] == locomotion


def test_what_an_earlier_version_left_marked_is_shared_too(db: Database) -> None:
    locomotion, _ = launch(db, sldr())
    finish(db, claim_next(db), Succeeded(1.0))
    with db.write() as conn:
        conn.execute(update(runs).where(runs.c.id == locomotion).values(cancel_requested=True))

    assert launch(db, sldr())[0] == locomotion


@pytest.mark.parametrize("places", [(0, 1), (1, 0)])
def test_two_named_locomotion_runs_of_one_task_are_refused(db: Database, places: tuple[int, int]) -> None:
    ids = [launch(db, order(phase="locomotion", seeds=(seed,)))[0] for seed in (0, 1)]
    first, second = (ids[place] for place in places)

    with pytest.raises(InvalidConfig, match=f"{ids[0]} and {ids[1]} are both of FetchPush; name one of them"):
        launch(db, replace(sldr(), locomotion=f"{first},{second}"))


def test_a_locomotion_run_that_is_deleted_meanwhile_is_not_shared(db: Database) -> None:
    locomotion, manipulation = launch(db, sldr())
    plan = plan_launch(db, sldr((1,)))
    act_on(db, Action.DELETE, [manipulation, locomotion])

    with pytest.raises(Refused, match=f"The locomotion run {locomotion} was deleted just now"), db.write() as conn:
        make_runs(conn, plan, current_time(conn))


def test_a_run_starts_when_the_gate_is_met(db: Database) -> None:
    locomotion, manipulation = launch(db, sldr())
    finish(db, claim_next(db), Succeeded(0.95))

    claimed = claim_next(db)

    assert (claimed.run_id, claimed.locomotion_run_ids) == (manipulation, (locomotion,))


def test_a_run_stays_blocked_with_the_numbers_when_the_gate_is_missed(db: Database) -> None:
    locomotion, manipulation = launch(db, sldr())
    finish(db, claim_next(db), Succeeded(0.9))

    run = get_run(db, manipulation)
    assert run.state is RunState.BLOCKED
    assert f"{locomotion} reached 90.0% test success, below the gate of 95.0%" in (run.reason or "")
    assert claim(db, "worker-1") is None


def test_a_launch_after_a_missed_gate_says_so_at_once(db: Database) -> None:
    launch(db, sldr())
    finish(db, claim_next(db), Succeeded(0.9))

    _, manipulation = launch(db, sldr((1,)))

    assert "below the gate" in (get_run(db, manipulation).reason or "")


def test_a_launch_after_a_met_gate_is_queued_at_once(db: Database) -> None:
    launch(db, sldr())
    finish(db, claim_next(db), Succeeded(1.0))

    _, manipulation = launch(db, sldr((1,)))

    assert get_run(db, manipulation).state is RunState.QUEUED


def test_dependents_of_a_failed_run_say_why_they_wait(db: Database) -> None:
    locomotion, manipulation = launch(db, sldr())
    finish(db, claim_next(db), Failed("The numbers diverged.", retry=False))

    run = get_run(db, manipulation)
    assert run.state is RunState.BLOCKED
    assert run.reason == f"Its locomotion run {locomotion} failed, so there is no reward to learn from; retry that one."


def test_dependents_of_a_cancelled_run_say_why_they_wait(db: Database) -> None:
    locomotion, manipulation = launch(db, sldr())
    request_cancel(db, locomotion)

    assert f"{locomotion} was cancelled" in (get_run(db, manipulation).reason or "")


@pytest.mark.parametrize(
    ("changes", "kind"),
    [
        ({"task": "FetchPus"}, "task"),
        ({"method": "hre"}, "method"),
        ({"preset": "slow"}, "preset"),
        ({"phase": "flying"}, "phase"),
    ],
)
def test_a_name_that_does_not_exist_is_refused_by_kind(db: Database, changes: dict[str, str], kind: str) -> None:
    with pytest.raises(UnknownName) as caught:
        launch(db, replace(order(), **changes))

    assert caught.value.kind == kind
    assert run_count(db) == 0


@pytest.mark.parametrize(
    ("changes", "setting"),
    [
        ({"overrides": {"loop": {"batch_size": -1}}}, "loop.batch_size"),
        ({"overrides": {"loop": {"tempo": 3}}}, "loop.tempo"),
        ({"overrides": {"seed": 3}}, "seed"),
        ({"phase": "locomotion", "method": "her-sldr"}, "method"),
        ({"seeds": ()}, "seeds"),
        ({"seeds": (4, 4)}, "seeds"),
    ],
)
def test_a_setting_that_cannot_work_is_refused_by_name(db: Database, changes: dict, setting: str) -> None:
    with pytest.raises(InvalidConfig) as caught:
        plan_launch(db, replace(order(), **changes))

    assert list(caught.value.problems) == [setting]
