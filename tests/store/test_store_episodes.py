"""Recorded episodes in the store: listed in any order, replaced when a test is held again, dropped with their files."""

from __future__ import annotations

import pytest
from store_cases import claim_next, claimed_run

from backend.store.database import Database
from backend.store.episodes import (
    EpisodeFilter,
    EpisodeSort,
    find_episode,
    forget_episodes,
    list_episodes,
    register_episodes,
)
from backend.store.errors import NotFound, StaleFence
from backend.store.files import list_files, register_file
from backend.store.outcomes import HandedBack
from backend.store.queue import finish
from sldr_core.episodes import EpisodeSummary, Tag, episodes_file


def summary(epoch: int, index: int, tag: Tag = "other", value: float = -50.0, q: float | None = -0.5) -> EpisodeSummary:
    return EpisodeSummary(
        epoch=epoch,
        index=index,
        success=tag == "success",
        tag=tag,
        task_return=value,
        worst_q=q,
        worst_q_step=None if q is None else 3,
        length=50,
        resimulates=True,
    )


FIRST = [summary(1, 0, "never_touched", -50.0, -0.9), summary(1, 1, "too_slow", -50.0, -0.2)]
SECOND = [summary(2, 0, "success", -10.0, -0.4), summary(2, 1, "overshot", -30.0, -1.0)]


def fill(db: Database) -> str:
    claim = claimed_run(db)
    for epoch, rows in ((1, FIRST), (2, SECOND)):
        register_episodes(db, claim, episodes_file(epoch), rows)
    return claim.run_id


def order_of(db: Database, run_id: str, sort: EpisodeSort, descending: bool) -> list[tuple[int, int]]:
    page = list_episodes(db, run_id, EpisodeFilter(), sort, descending, 10, 0)
    return [(row.summary.epoch, row.summary.index) for row in page.rows]


@pytest.mark.parametrize(
    ("sort", "descending", "expected"),
    [
        ("epoch", True, [(2, 0), (2, 1), (1, 0), (1, 1)]),
        ("epoch", False, [(1, 0), (1, 1), (2, 0), (2, 1)]),
        ("return", True, [(2, 0), (2, 1), (1, 0), (1, 1)]),
        ("success", True, [(2, 0), (2, 1), (1, 0), (1, 1)]),
        ("success", False, [(2, 1), (1, 0), (1, 1), (2, 0)]),
        ("worst_q", False, [(2, 1), (1, 0), (2, 0), (1, 1)]),
    ],
)
def test_episodes_stand_in_the_order_asked_for(
    db: Database, sort: EpisodeSort, descending: bool, expected: list[tuple[int, int]]
) -> None:
    assert order_of(db, fill(db), sort, descending) == expected


def test_filters_and_pages_count_what_they_let_through(db: Database) -> None:
    run_id = fill(db)

    def found(wanted: EpisodeFilter, limit: int = 10, offset: int = 0) -> tuple[list[EpisodeSummary], int, list[int]]:
        page = list_episodes(db, run_id, wanted, "epoch", False, limit, offset)
        return [row.summary for row in page.rows], page.total, page.epochs

    assert found(EpisodeFilter()) == ([*FIRST, *SECOND], 4, [1, 2])
    assert found(EpisodeFilter(), limit=2, offset=1) == ([FIRST[1], SECOND[0]], 4, [1, 2])
    assert found(EpisodeFilter(tag="too_slow")) == ([FIRST[1]], 1, [1, 2])
    assert found(EpisodeFilter(epoch=2)) == (SECOND, 2, [1, 2])
    assert found(EpisodeFilter(tag="success", epoch=1)) == ([], 0, [1, 2])


def test_runs_without_sldr_have_no_worst_q(db: Database) -> None:
    claim = claimed_run(db)
    register_episodes(db, claim, episodes_file(1), [summary(1, 0, q=None)])

    assert find_episode(db, claim.run_id, 1, 0).summary == summary(1, 0, q=None)
    assert order_of(db, claim.run_id, "worst_q", False) == [(1, 0)]


def test_an_episode_that_is_not_there_is_named(db: Database) -> None:
    run_id = fill(db)

    with pytest.raises(NotFound, match=rf"recorded episode of run {run_id} called '3\.0'"):
        find_episode(db, run_id, 3, 0)


def test_a_test_that_is_held_again_replaces_its_episodes(db: Database) -> None:
    claim = claimed_run(db)
    register_episodes(db, claim, episodes_file(1), FIRST)
    finish(db, claim, HandedBack("Its worker was asked to end."))
    again = claim_next(db)

    register_episodes(db, again, episodes_file(1), [summary(1, 0, "success")])

    (row,) = list_episodes(db, claim.run_id, EpisodeFilter(), "epoch", True, 10, 0).rows
    assert (row.summary, row.attempt, row.file) == (summary(1, 0, "success"), 2, "episodes-epoch-0001.npz")


def test_an_attempt_that_is_over_can_neither_add_nor_drop_episodes(db: Database) -> None:
    claim = claimed_run(db)
    register_episodes(db, claim, episodes_file(1), FIRST)
    finish(db, claim, HandedBack("Its worker was asked to end."))
    claim_next(db)

    with pytest.raises(StaleFence):
        register_episodes(db, claim, episodes_file(2), SECOND)
    with pytest.raises(StaleFence):
        forget_episodes(db, claim, 2, {2})
    assert list_episodes(db, claim.run_id, EpisodeFilter(), "epoch", True, 10, 0).total == 2


def test_episodes_are_dropped_with_their_files(db: Database) -> None:
    claim = claimed_run(db)
    for epoch in (1, 2, 3, 4):
        name = episodes_file(epoch)
        register_file(db, claim, name, "episodes", f"runs/{name}", 1, "0" * 64)
        register_episodes(db, claim, name, [summary(epoch, 0)])
    register_file(db, claim, "policy-best.pt", "policy", "runs/policy-best.pt", 1, "0" * 64)

    dropped = forget_episodes(db, claim, newest=3, kept_epochs={1, 3})

    assert [(row.name, row.path) for row in dropped] == [("episodes-epoch-0002.npz", "runs/episodes-epoch-0002.npz")]
    left = [episodes_file(1), episodes_file(3), episodes_file(4), "policy-best.pt"]
    assert [row.name for row in list_files(db, claim.run_id)] == left
    assert list_episodes(db, claim.run_id, EpisodeFilter(), "epoch", True, 10, 0).epochs == [1, 3, 4]
    assert forget_episodes(db, claim, newest=3, kept_epochs={1, 3}) == []
