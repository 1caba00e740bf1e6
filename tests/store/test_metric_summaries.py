"""What the runs table says of metrics is what a plain look at the points that count says."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from sqlalchemy import delete, select, update
from store_cases import claim_next, claimed_run, step

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.metric_columns import MetricColumn, parse_column
from backend.store.metric_summaries import TAIL_LENGTH, list_metric_names, rebuild_all_summaries
from backend.store.metrics import MetricPoint, append_metrics, read_metrics
from backend.store.outcomes import HandedBack
from backend.store.queue import finish
from backend.store.run_filter import RunFilter
from backend.store.runs import list_runs
from backend.store.tables import metric_summaries, runs
from sldr_core.errors import InvalidConfig

NAMES = ("a/up", "b/loss", "c/rare")

Points = dict[int, dict[str, float]]
"""What is logged, by cycle."""

values = st.floats(-1e6, 1e6, allow_nan=False)
some_points = st.dictionaries(
    st.integers(1, 40), st.dictionaries(st.sampled_from(NAMES), values, max_size=3), min_size=1, max_size=8
)
attempts = st.lists(st.lists(some_points, min_size=1, max_size=3), min_size=1, max_size=4)
"""For each attempt the batches that it sends, in any order and with repeats."""


def append(db: Database, claim: Claim, points: Points) -> None:
    append_metrics(db, claim, [MetricPoint(step(cycle), logged) for cycle, logged in points.items()])


def next_attempt(db: Database, claim: Claim) -> Claim:
    finish(db, claim, HandedBack("Its worker was asked to end."))
    with db.write() as conn:
        conn.execute(update(runs).values(not_before=None, failures=0, deaths=0))
    return claim_next(db)


def summaries(db: Database) -> dict[str, tuple[object, ...]]:
    with db.read() as conn:
        rows = conn.execute(select(metric_summaries)).all()
    return {row.name: (row.points, row.last_step, row.last, row.lowest, row.highest, list(row.tail)) for row in rows}


def plainly(db: Database, run_id: str) -> dict[str, tuple[object, ...]]:
    """Sum up what a reader of the whole curve sees."""
    read = read_metrics(db, run_id)
    expected: dict[str, tuple[object, ...]] = {}
    for name, column in read.values.items():
        curve = sorted((cycle, value) for cycle, value in zip(read.step, column, strict=True) if value is not None)
        logged = [value for _, value in curve]
        newest_first = logged[::-1][:TAIL_LENGTH]
        expected[name] = (len(logged), curve[-1][0], logged[-1], min(logged), max(logged), newest_first)
    return expected


@settings(max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture], database=None)
@given(attempts)
def test_summaries_are_those_of_the_curve_whatever_attempts_send(db: Database, sent: list[list[Points]]) -> None:
    with db.write() as conn:
        # A run of an earlier example must not be claimed.
        conn.execute(delete(metric_summaries))
        conn.execute(update(runs).values(state="cancelled"))
    claim = claimed_run(db)
    for number, batches in enumerate(sent):
        if number > 0:
            claim = next_attempt(db, claim)
        for batch in batches:
            append(db, claim, batch)
        assert summaries(db) == plainly(db, claim.run_id)
    append(db, claim, sent[-1][0])
    assert summaries(db) == plainly(db, claim.run_id)


def test_what_a_resumed_attempt_has_not_logged_again_does_not_count(db: Database) -> None:
    claim = claimed_run(db)
    append(db, claim, {1: {"a/up": 0.1}, 2: {"a/up": 0.9, "c/rare": 7.0}, 3: {"a/up": 0.8}})
    append(db, next_attempt(db, claim), {2: {"a/up": 0.2}})

    assert summaries(db) == {"a/up": (2, 2, 0.2, 0.1, 0.2, [0.2, 0.1])}


def test_summaries_can_be_made_again(db: Database) -> None:
    claim = claimed_run(db)
    append(db, claim, {cycle: {"a/up": cycle / 100} for cycle in range(1, 31)})
    before = summaries(db)
    with db.write() as conn:
        conn.execute(delete(metric_summaries))

    assert rebuild_all_summaries(db) == 1
    assert summaries(db) == before
    assert before["a/up"][5] == [cycle / 100 for cycle in range(30, 10, -1)]


def shown(db: Database, text: str) -> float | None:
    return list_runs(db, RunFilter(), 1, columns=[parse_column(text)]).values[0][0]


def test_columns_are_the_newest_the_best_and_the_mean_of_the_last(db: Database) -> None:
    claim = claimed_run(db)
    append(
        db, claim, {1: {"a/up": 0.25, "b/loss": 4.0}, 2: {"a/up": 1.0, "b/loss": 1.0}, 3: {"a/up": 0.5, "b/loss": 2.0}}
    )

    assert (shown(db, "a/up:last"), shown(db, "a/up:best"), shown(db, "b/loss:best")) == (0.5, 1.0, 1.0)
    assert shown(db, "a/up:mean1") == 0.5
    assert shown(db, "a/up:mean2") == pytest.approx(0.75)
    assert shown(db, "a/up:mean3") == shown(db, "a/up:mean20") == pytest.approx(1.75 / 3)
    assert shown(db, "never/logged:mean5") is None
    assert list_metric_names(db) == ["a/up", "b/loss"]


@pytest.mark.parametrize("text", ["a/up", "a/up:mean", "a/up:mean0", "a/up:mean21", "a/up:first", ":last"])
def test_a_column_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(InvalidConfig, match="is no column"):
        parse_column(text)


def test_a_column_is_written_as_it_is_read() -> None:
    for text in ("a/up:last", "a/up:best", "critic/sldr/pen:mean5"):
        assert str(parse_column(text)) == text
    assert parse_column("a/up:mean5") == MetricColumn("a/up", "mean", 5)
