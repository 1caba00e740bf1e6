"""The runs table on the server: every filter, every order page by page, groups, tags, notes and saved views."""

from __future__ import annotations

import random

import numpy as np
import pytest
from store_cases import claim_next, order, put_in_state, step

from backend.store.database import Database
from backend.store.errors import NotFound, Refused
from backend.store.labels import LONGEST_NOTES, MOST_TAGS, change_tags, list_tags, set_notes
from backend.store.launches import launch
from backend.store.metric_columns import MetricColumn
from backend.store.metrics import MetricPoint, append_metrics
from backend.store.progress import Progress
from backend.store.run_filter import RunFilter
from backend.store.run_groups import group_runs, spread_of
from backend.store.run_order import SortKey, parse_order
from backend.store.runs import get_run, list_runs
from backend.store.saved_views import change_view, delete_view, list_views, save_view
from backend.store.states import RunState
from sldr_core.errors import InvalidConfig

SCORE = MetricColumn("test/score")


def ids(db: Database, wanted: RunFilter) -> list[str]:
    return [row.id for row in list_runs(db, wanted, 50).rows]


def score_next(db: Database, score: float | None, success: float) -> str:
    """Claim the next run, let it report a success and perhaps a score; return its id."""
    held = claim_next(db)
    append_metrics(db, held, [], Progress(1, 2, 400, 8, 16, success / 2, success, success, 100.0, 9.0, 8.0))
    if score is not None:
        append_metrics(db, held, [MetricPoint(step(1), {"test/score": score})])
    return held.run_id


def test_runs_are_found_by_their_tags(db: Database) -> None:
    both, good, plain = launch(db, order(seeds=(0, 1, 2)))
    change_tags(db, [both, good], ["good"], [])
    change_tags(db, [both], ["to check"], [])

    assert ids(db, RunFilter(tags=["good", "to check"])) == [both]
    assert ids(db, RunFilter(any_tags=["good", "to check", "unused"])) == [good, both]
    assert ids(db, RunFilter(no_tags=["to check"])) == [plain, good]
    assert ids(db, RunFilter(search="CHECK")) == [both]
    assert get_run(db, both).tags == ("good", "to check")
    assert [(count.tag, count.runs) for count in list_tags(db)] == [("good", 2), ("to check", 1)]


def test_runs_are_found_between_seeds_and_successes(db: Database) -> None:
    first, second, third = launch(db, order(seeds=(3, 5, 8)))
    for success in (0.25, 0.5, 1.0):
        score_next(db, None, success)

    assert ids(db, RunFilter(seed_from=4)) == [third, second]
    assert ids(db, RunFilter(seed_from=3, seed_to=5)) == [second, first]
    assert ids(db, RunFilter(success_from=0.5, success_to=0.99)) == [second]
    assert ids(db, RunFilter(success_to=0.5)) == [second, first]


def test_runs_are_found_by_several_names_at_once(db: Database) -> None:
    (push,), (slide,) = launch(db, order()), launch(db, order(task="FetchSlide"))
    put_in_state(db, slide, RunState.FAILED)

    assert ids(db, RunFilter(tasks=["FetchPush", "FetchSlide"], presets=["smoke"])) == [slide, push]
    assert ids(db, RunFilter(states=[RunState.FAILED, RunState.PAUSED])) == [slide]
    assert list_runs(db, RunFilter(success_from=0.1), 10).total == 0


@pytest.mark.parametrize("descending", [True, False])
@pytest.mark.parametrize("sort", ["seed", "method", "progress", "best", "speed", "left", "duration", "test/score:last"])
def test_every_order_is_the_same_page_by_page_and_by_offset(db: Database, sort: SortKey, descending: bool) -> None:
    launch(db, order(seeds=(4, 1, 3)))
    launch(db, order(method="ddpg", seeds=(1, 7)))
    for score in (0.5, None, 0.25, 0.5):
        score_next(db, score, 0.5)
    by = parse_order(sort, descending)
    whole = [row.id for row in list_runs(db, RunFilter(), 10, order=by).rows]
    paged: list[str] = []
    cursor = None
    while len(paged) < 5:
        page = list_runs(db, RunFilter(), 1, cursor, by)
        paged, cursor = [*paged, page.rows[0].id], page.next_cursor

    assert paged == whole
    assert [list_runs(db, RunFilter(), 1, order=by, offset=at).rows[0].id for at in range(5)] == whole
    assert cursor is None


def test_runs_that_have_not_logged_a_metric_stand_last_both_ways(db: Database) -> None:
    launch(db, order(seeds=(0, 1, 2)))
    low, none, high = (score_next(db, score, 0.0) for score in (-2.0, None, 3.0))

    for descending, expected in ((True, [high, low, none]), (False, [low, high, none])):
        page = list_runs(db, RunFilter(), 10, order=parse_order("test/score:last", descending), columns=[SCORE])
        assert [row.id for row in page.rows] == expected
        assert page.values[-1] == (None,)


def test_an_order_by_nothing_is_refused() -> None:
    with pytest.raises(InvalidConfig, match="sort: 'colour' is no column"):
        parse_order("colour", True)


def test_groups_differ_in_the_seed_alone(db: Database) -> None:
    launch(db, order(seeds=(0, 1, 2)))
    launch(db, order(seeds=(1,), overrides={"loop": {"epochs": 9}}))
    scores = (0.1, 0.4, None, 0.9)
    for score in scores:
        score_next(db, score, 0.0)
    other, three = group_runs(db, RunFilter(), ("task", "method", "settings"), SCORE)

    assert (three.runs, three.seeds, three.states) == (3, (0, 1, 2), {RunState.RUNNING: 3})
    assert three.spread is not None
    assert (three.spread.n, three.spread.median) == (2, pytest.approx(0.25))
    assert (other.keys["task"], other.keys["method"], other.seeds) == ("FetchPush", "her", (1,))
    assert len(ids(db, RunFilter(settings=three.keys["settings"]))) == 3
    assert [group.runs for group in group_runs(db, RunFilter(), ("task", "task"), SCORE)] == [4]


def test_groups_are_sorted_and_those_without_a_value_stand_last(db: Database) -> None:
    for method in ("her", "ddpg", "cher"):
        launch(db, order(method=method))
    for score in (0.5, 0.75, None):
        score_next(db, score, 0.0)

    def methods(sort, descending) -> list[str]:
        return [group.keys["method"] for group in group_runs(db, RunFilter(), ("method",), SCORE, sort, descending)]

    assert methods("median", True) == ["ddpg", "her", "cher"]
    assert methods("median", False) == ["her", "ddpg", "cher"]
    assert methods("method", False) == ["cher", "ddpg", "her"]
    assert methods("launched", True) == methods("runs", True) == ["cher", "ddpg", "her"]


def test_quartiles_are_those_of_numpy() -> None:
    drawn = random.Random(0)
    assert spread_of([]) is None
    for count in range(1, 9):
        values = [drawn.uniform(-1.0, 1.0) for _ in range(count)]
        spread = spread_of(values)
        assert spread is not None
        assert (spread.lower, spread.median, spread.upper) == pytest.approx(np.quantile(values, [0.25, 0.5, 0.75]))


def test_tags_go_to_all_runs_or_to_none(db: Database) -> None:
    (run_id,) = launch(db, order())
    with pytest.raises(NotFound, match="no run 'nobody'"):
        change_tags(db, [run_id, "nobody"], ["good"], [])
    with pytest.raises(InvalidConfig, match=f"would have {MOST_TAGS + 1} tags"):
        change_tags(db, [run_id], [f"tag {i}" for i in range(MOST_TAGS + 1)], [])

    assert get_run(db, run_id).tags == ()


@pytest.mark.parametrize("tag", ["", "  ", "a,b", "two\nlines", "x" * 41])
def test_what_is_no_tag_is_refused(db: Database, tag: str) -> None:
    with pytest.raises(InvalidConfig, match="is no tag"):
        change_tags(db, [], [tag], [])


def test_tags_are_given_once_and_taken_away(db: Database) -> None:
    first, second = launch(db, order(seeds=(0, 1)))
    change_tags(db, [first, second, first], [" good ", "old"], [])
    change_tags(db, [first], ["good", "new"], ["old", "never there"])

    assert (get_run(db, first).tags, get_run(db, second).tags) == (("good", "new"), ("good", "old"))


def test_notes_are_kept_as_they_are_written(db: Database) -> None:
    (run_id,) = launch(db, order())
    assert get_run(db, run_id).notes == ""
    text = "<script>alert(1)</script>\n  second line ✓"
    set_notes(db, run_id, text)

    assert get_run(db, run_id).notes == text
    assert ids(db, RunFilter(search="alert(1)")) == [run_id]
    with pytest.raises(InvalidConfig, match="10001 characters"):
        set_notes(db, run_id, "x" * (LONGEST_NOTES + 1))
    with pytest.raises(NotFound, match="no run 'nobody'"):
        set_notes(db, "nobody", "x")


def test_views_are_kept_renamed_and_forgotten(db: Database) -> None:
    best = save_view(db, "best", "sort=success")
    failed = save_view(db, "Failed", "state=failed")
    with pytest.raises(Refused, match="called 'best' already"):
        save_view(db, "best", "x=y")
    with pytest.raises(Refused, match="called 'best' already"):
        change_view(db, failed.id, name="best")
    change_view(db, failed.id, name="Ended badly", search="state=failed,cancelled")

    assert [(view.name, view.search) for view in list_views(db)] == [
        ("best", "sort=success"),
        ("Ended badly", "state=failed,cancelled"),
    ]
    delete_view(db, best.id)
    assert [view.id for view in list_views(db)] == [failed.id]
    for act in (lambda: delete_view(db, best.id), lambda: change_view(db, best.id, name="x")):
        with pytest.raises(NotFound, match=f"no view '{best.id}'"):
            act()
