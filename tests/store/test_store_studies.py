"""A study makes what nothing serves yet, and nothing twice, however often and by whomever it is asked for."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import pytest
from store_cases import at_once, order
from study_cases import cell_of, small_spec, train_next

from backend.store.actions import Action, act, act_on, request_cancel
from backend.store.database import Database
from backend.store.errors import NotFound, Refused
from backend.store.launches import launch
from backend.store.outcomes import Failed, Succeeded
from backend.store.run_filter import RunFilter
from backend.store.runs import get_run, list_runs
from backend.store.speeds import STARTING_S
from backend.store.states import RunState
from backend.store.studies.estimate import estimate_study
from backend.store.studies.launch import (
    Launched,
    create_study,
    delete_study,
    extend_study,
    fill_study,
    preview_study,
    rename_study,
    restore_study,
)
from backend.store.studies.matrix import get_study, list_studies, study_run_ids
from backend.store.studies.plan import Standing
from backend.store.studies.retry import retry_study
from backend.store.studies.spec import Addition, Variant
from sldr_core.errors import InvalidConfig

DIVERGED = Failed("The numbers diverged.", retry=False)


def run_count(db: Database) -> int:
    return list_runs(db, RunFilter(), 1).total


def made(db: Database, name: str = "first", **changes) -> str:
    return create_study(db, name, small_spec(**changes)).study_id


def test_a_study_makes_every_combination_and_one_shared_locomotion_run(db: Database) -> None:
    launched = create_study(db, "both", small_spec(tasks=("FetchPush", "FetchSlide")))

    rows = list_runs(db, RunFilter(), 100).rows
    assert launched.queued == len(rows) == 2 * 2 * 2 + 2
    assert {(row.task, row.method, row.seed) for row in rows if row.phase == "manipulation"} == {
        (task, method, seed)
        for task in ("FetchPush", "FetchSlide")
        for method in ("her", "her-sldr")
        for seed in (0, 1)
    }
    assert sorted(row.task for row in rows if row.phase == "locomotion") == ["FetchPush", "FetchSlide"]


def test_a_preview_says_what_is_then_done_and_does_nothing(db: Database) -> None:
    plan = preview_study(db, small_spec())

    assert [planned.standing for planned in plan.places] == 4 * [Standing.NEW]
    assert [run.phase for run in plan.new_runs].count("locomotion") == 1
    assert run_count(db) == 0
    assert create_study(db, "first", small_spec()).queued == len(plan.new_runs) == run_count(db)


def test_the_same_study_again_queues_nothing_and_joins_everything(db: Database) -> None:
    first = made(db)
    again = create_study(db, "second", small_spec())

    assert (again.queued, again.joined) == (0, 4)
    assert study_run_ids(db, again.study_id) == study_run_ids(db, first)
    assert run_count(db) == 5


def test_a_run_that_was_launched_alone_is_joined_and_the_preview_says_so(db: Database) -> None:
    (alone,) = launch(db, order("her", seeds=(1,)))

    plan = preview_study(db, small_spec())

    assert [(planned.place.seed, planned.run_id) for planned in plan.places if planned.standing is Standing.JOINED] == [
        (1, alone)
    ]
    assert cell_of(db, made(db), "her").runs[1].run_id == alone


def test_the_locomotion_run_of_an_earlier_launch_is_shared(db: Database) -> None:
    locomotion, _ = launch(db, order("her-sldr", seeds=(7,)))

    (planned,) = preview_study(db, small_spec()).locomotion

    assert planned.reused_run_id == locomotion


def test_a_run_serves_only_with_the_locomotion_run_that_is_asked_for(db: Database) -> None:
    good, bad = (launch(db, order(phase="locomotion", seeds=(seed,)))[0] for seed in (1, 2))
    asked = {"methods": ("her", "her-sldr"), "seeds": (0,)}
    first = create_study(db, "good", small_spec(**asked, locomotion=good))

    other = create_study(db, "bad", small_spec(**asked, locomotion=bad))
    own = create_study(db, "own", small_spec(**asked))
    again = create_study(db, "again", small_spec(**asked, locomotion=good))

    assert [(study.queued, study.joined) for study in (first, other, own, again)] == [(2, 0), (1, 1), (2, 1), (0, 2)]
    (run,) = cell_of(db, other.study_id, "her-sldr").runs
    assert get_run(db, run.run_id).needs == (bad,)
    assert study_run_ids(db, again.study_id) == study_run_ids(db, first.study_id)


def test_a_run_serves_though_its_locomotion_run_was_deleted_since(db: Database) -> None:
    first = made(db, methods=("her-sldr",), seeds=(0,))
    locomotion, trained = train_next(db, Succeeded(1.0)), train_next(db, Succeeded(1.0))
    act(db, Action.DELETE, locomotion)

    assert [place.run_id for place in preview_study(db, small_spec(methods=("her-sldr",), seeds=(0,))).places] == [
        trained
    ]
    assert study_run_ids(db, first) == [trained]


def test_a_failed_run_serves_no_new_study(db: Database) -> None:
    (failed,) = launch(db, order("her", seeds=(0,)))
    train_next(db, DIVERGED)

    assert failed not in study_run_ids(db, made(db))


def test_two_launches_of_one_study_at_once_make_every_run_once(db: Database) -> None:
    results = at_once(*[partial(create_study, db, f"study {number}", small_spec()) for number in range(3)])

    queued = sorted(result.queued for result in results if isinstance(result, Launched))
    assert queued == [0, 0, 5]
    assert run_count(db) == 5


def test_a_name_is_taken_once(db: Database) -> None:
    made(db, "taken")

    with pytest.raises(Refused, match="called 'taken' already; choose another name"):
        made(db, " taken ")
    assert len(list_studies(db, 10)) == 1


def test_filling_finds_nothing_to_do_until_a_run_is_deleted(db: Database) -> None:
    study = made(db)
    assert fill_study(db, study).queued == 0
    deleted = cell_of(db, study, "her").runs[0].run_id
    act(db, Action.DELETE, deleted)
    assert cell_of(db, study, "her").missing_seeds == (0,)

    assert fill_study(db, study).queued == 1

    assert cell_of(db, study, "her").missing_seeds == ()
    assert deleted not in study_run_ids(db, study)
    assert fill_study(db, study).queued == 0


def test_adding_a_seed_makes_only_that_seed(db: Database) -> None:
    study = made(db)
    before = set(study_run_ids(db, study))

    assert extend_study(db, study, Addition(seeds=(2,))).queued == 2

    added = set(study_run_ids(db, study)) - before
    assert {get_run(db, run_id).seed for run_id in added} == {2}
    assert [len(cell.runs) for cell in get_study(db, study).cells] == [3, 3]


def test_adding_a_variant_makes_only_its_runs(db: Database) -> None:
    base, low, high = (
        Variant("base"),
        Variant("low", {"agent": {"gamma": 0.9}}),
        Variant("high", {"agent": {"gamma": 0.99}}),
    )
    study = create_study(db, "axis", replace(small_spec(), methods=("her",), variants=(base, low))).study_id
    before = set(study_run_ids(db, study))

    assert extend_study(db, study, Addition(variants=(low, high))).queued == 2

    added = set(study_run_ids(db, study)) - before
    assert {get_run(db, run_id).config["agent"]["gamma"] for run_id in added} == {0.99}
    assert [cell.cell.variant for cell in get_study(db, study).cells] == ["base", "low", "high"]


@pytest.mark.parametrize(
    ("variant", "sentence"),
    [
        (Variant("low", {"agent": {"gamma": 0.95}}), "variants: low is listed more than once"),
        (Variant("again", {"agent": {"gamma": 0.9}}), "'low' and 'again' are the same training for FetchPush with her"),
        (Variant("nothing", {"loop": {"epochs": -1}}), r"loop.epochs.*for FetchPush, her, nothing"),
    ],
)
def test_a_variant_that_cannot_be_added_changes_nothing(db: Database, variant: Variant, sentence: str) -> None:
    variants = (Variant("base"), Variant("low", {"agent": {"gamma": 0.9}}))
    study = create_study(db, "axis", replace(small_spec(), methods=("her",), variants=variants)).study_id
    before = study_run_ids(db, study)

    with pytest.raises(InvalidConfig, match=sentence):
        extend_study(db, study, Addition(variants=(variant,)))

    assert study_run_ids(db, study) == before
    assert get_study(db, study).study.spec.variants == variants


def test_a_study_without_variants_says_how_to_come_by_them(db: Database) -> None:
    study = made(db)

    with pytest.raises(InvalidConfig, match="launch a new study with the variants"):
        extend_study(db, study, Addition(variants=(Variant("low", {"agent": {"gamma": 0.9}}),)))


def test_a_longer_axis_can_be_previewed_for_the_study_it_is_for(db: Database) -> None:
    study = made(db)

    plan = preview_study(db, small_spec(methods=("her", "her-sldr", "ddpg")), study)

    standings = [planned.standing for planned in plan.places]
    assert standings == [Standing.IN_STUDY] * 4 + [Standing.NEW] * 2


def test_adding_what_is_there_is_refused(db: Database) -> None:
    study = made(db)

    with pytest.raises(InvalidConfig, match="has all of that already"):
        extend_study(db, study, Addition(seeds=(1,), methods=("her",)))


def test_failed_runs_and_the_locomotion_run_they_need_are_tried_again(db: Database) -> None:
    study = made(db, methods=("her-sldr",), seeds=(0,))
    locomotion = train_next(db, DIVERGED)

    results = retry_study(db, study)

    assert [(result.run_id, result.done) for result in results] == [(locomotion, True)]
    assert get_run(db, locomotion).state is RunState.QUEUED
    assert retry_study(db, study) == []


def test_cancelled_runs_are_left_alone_unless_they_are_meant(db: Database) -> None:
    study = made(db, methods=("her",), seeds=(0,))
    (cancelled,) = study_run_ids(db, study)
    request_cancel(db, cancelled)

    assert retry_study(db, study) == []
    assert [result.run_id for result in retry_study(db, study, cancelled=True)] == [cancelled]


def test_a_locomotion_run_that_was_cancelled_and_deleted_is_tried_again_with_those_that_need_it(db: Database) -> None:
    study = made(db, methods=("her-sldr",))
    (locomotion,) = get_study(db, study).locomotion
    needing = study_run_ids(db, study)
    act_on(db, Action.CANCEL, [*needing, locomotion.run_id])
    act_on(db, Action.DELETE, [locomotion.run_id])

    results = retry_study(db, study, cancelled=True)

    assert [(result.run_id, result.done) for result in results] == [
        *((run_id, True) for run_id in needing),
        (locomotion.run_id, True),
    ]
    assert get_run(db, locomotion.run_id).state is RunState.QUEUED
    assert {get_run(db, run_id).reason for run_id in needing} == {f"Waits for the locomotion run {locomotion.run_id}."}


def test_a_deleted_study_keeps_its_runs_and_comes_back(db: Database) -> None:
    study = made(db)
    delete_study(db, study)

    assert [row.id for row in list_studies(db, 10)] == []
    assert [row.id for row in list_studies(db, 10, deleted=True)] == [study]
    assert run_count(db) == 5
    for change in (fill_study, retry_study, delete_study):
        with pytest.raises(Refused, match="is deleted; restore it first"):
            change(db, study)
    restore_study(db, study)
    assert [row.id for row in list_studies(db, 10)] == [study]
    with pytest.raises(Refused, match="is not deleted"):
        restore_study(db, study)


def test_a_study_whose_name_was_taken_meanwhile_does_not_come_back(db: Database) -> None:
    study = made(db, "name")
    delete_study(db, study)
    made(db, "name")

    with pytest.raises(Refused, match="choose another name"):
        restore_study(db, study)


def test_a_study_gets_another_name_and_note(db: Database) -> None:
    study = made(db)
    rename_study(db, study, name="better")
    rename_study(db, study, note="What it shows.\n<script>")

    row = get_study(db, study).study
    assert (row.name, row.note) == ("better", "What it shows.\n<script>")
    rename_study(db, study, name="better")


def test_a_study_that_does_not_exist_is_named(db: Database) -> None:
    for change in (fill_study, retry_study, delete_study, restore_study, study_run_ids, get_study):
        with pytest.raises(NotFound, match="There is no study 'nope'"):
            change(db, "nope")


def test_what_a_refused_study_would_have_made_is_not_made(db: Database) -> None:
    spec = small_spec(variants=(Variant("a", {}), Variant("b", {"loop": {"batch_size": -1}})))

    with pytest.raises(InvalidConfig, match=r"loop.batch_size.*for FetchPush, her, b"):
        create_study(db, "bad", spec)
    assert (run_count(db), list_studies(db, 10)) == (0, [])


def test_variants_are_cells_of_their_own(db: Database) -> None:
    variants = (Variant("0.9", {"agent": {"gamma": 0.9}}), Variant("0.95", {"agent": {"gamma": 0.95}}))
    study = create_study(db, "axis", replace(small_spec(), methods=("her",), variants=variants)).study_id

    cells = get_study(db, study).cells
    gammas = {cell.cell.variant: get_run(db, cell.runs[0].run_id).config["agent"]["gamma"] for cell in cells}
    assert gammas == {"0.9": 0.9, "0.95": 0.95}


def test_the_matrix_tells_states_progress_and_the_median_of_the_best_tests(db: Database) -> None:
    study = made(db, methods=("her",), seeds=(0, 1, 2, 3))
    train_next(db, Succeeded(0.5), best=0.75, fraction=0.9)
    train_next(db, Succeeded(0.25), best=0.25)
    train_next(db, DIVERGED, fraction=0.5)

    matrix = get_study(db, study)
    (cell,) = matrix.cells
    assert dict(cell.states) == {RunState.SUCCEEDED: 2, RunState.FAILED: 1, RunState.QUEUED: 1}
    assert cell.best_success_rate == pytest.approx((0.75 + 0.25) / 2)
    assert cell.tested == 2
    assert cell.progress == pytest.approx((1.0 + 1.0 + 0.5 + 0.0) / 4)
    assert matrix.study.progress == pytest.approx(cell.progress)
    assert dict(matrix.study.states) == dict(cell.states)
    assert list_studies(db, 1)[0].progress == pytest.approx(cell.progress)


def test_time_is_told_from_the_runs_of_this_store(db: Database) -> None:
    spec = small_spec(methods=("her",), seeds=(0, 1))
    create_study(db, "first", replace(spec, seeds=(0,)))
    train_next(db, Succeeded(0.5))

    alike, longer = (
        estimate_study(db, preview_study(db, replace(spec, overrides=overrides)))
        for overrides in ({}, {"loop": {"epochs": 4}})
    )

    assert alike.training_s is not None
    assert alike.training_s < STARTING_S  # what the run beside it took: nothing was trained in it
    # warm-up, eight cycles and four tests of 4 episodes of 50 steps at 500 a second; 4 updates a cycle at 10 a second
    assert longer.training_s == pytest.approx(2 * (STARTING_S + 13 * 200 / 500.0 + 32 / 10.0))
    assert (alike.unknown_runs, longer.unknown_runs) == (0, 0)
