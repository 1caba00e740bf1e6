"""Notices and their deliveries: each once, tried again after a pause, given up in the end, whoever sends."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest
from sqlalchemy import update
from store_cases import claim_next, claimed_run

from backend.store.actions import Action, act
from backend.store.database import Database
from backend.store.errors import NotFound, Refused
from backend.store.notices import list_notices
from backend.store.outcomes import Failed, Succeeded
from backend.store.queue import finish
from backend.store.studies.launch import create_study, delete_study, fill_study
from backend.store.studies.spec import StudySpec
from backend.store.tables import webhook_deliveries
from backend.store.webhooks import (
    BACKOFFS_S,
    MOST_WEBHOOKS,
    add_test,
    add_webhook,
    list_webhooks,
    note_sent,
    plan_deliveries,
    remove_webhook,
    take_delivery,
)
from backend.webhooks.messages import body_of

EVER = datetime(2020, 1, 1, tzinfo=UTC)
BROKEN = Failed("It broke.", retry=False)


def fail_one(db: Database) -> str:
    held = claimed_run(db)
    finish(db, held, BROKEN)
    return held.run_id


def make_due(db: Database) -> None:
    with db.write() as conn:
        conn.execute(update(webhook_deliveries).values(not_before=datetime.now(UTC) - timedelta(hours=1)))


def test_a_failed_run_is_told_of_each_time_it_fails(db: Database):
    run_id = fail_one(db)
    (first,) = list_notices(db, EVER)
    assert (first.event, first.subject, first.path) == ("run_failed", run_id, f"/runs/{run_id}")
    assert first.message.endswith("her, seed 0): It broke.")
    assert list_notices(db, first.at) == []
    act(db, Action.RETRY, run_id)
    assert list_notices(db, EVER) == []
    finish(db, claim_next(db), BROKEN)
    (again,) = list_notices(db, EVER)
    assert again.occasion != first.occasion


def test_a_study_is_told_of_once_its_last_run_has_ended(db: Database):
    study_id = create_study(db, "pair", StudySpec(("FetchPush",), ("her", "ddpg"), (0,), "smoke")).study_id
    finish(db, claim_next(db), Succeeded(1.0))
    assert list_notices(db, EVER) == []
    finish(db, claim_next(db), BROKEN)
    notices = {notice.event: notice for notice in list_notices(db, EVER)}
    ended = notices["study_ended"]
    assert (ended.subject, ended.message) == (study_id, "Study 'pair' has ended: 1 failed, 1 succeeded.")
    assert ended.at == notices["run_failed"].at
    delete_study(db, study_id)
    assert [notice.event for notice in list_notices(db, EVER)] == ["run_failed"]


def test_each_address_hears_each_notice_of_its_kind_once(db: Database):
    fail_one(db)
    both = add_webhook(db, "https://a.example/", ["study_ended", "run_failed"])
    add_webhook(db, "https://b.example/", ["study_ended"])
    assert plan_deliveries(db, body_of) == 0  # what happened before an address was named is not told
    run_id = fail_one(db)
    assert [plan_deliveries(db, body_of) for _ in range(3)] == [1, 0, 0]
    taken = take_delivery(db)
    assert taken is not None
    assert (taken.url, taken.secret, run_id in taken.delivery.body) == (both.url, both.secret, True)
    assert take_delivery(db) is None
    note_sent(db, taken, None)
    first, second = list_webhooks(db)
    assert [(delivery.state, delivery.tries) for delivery in first.deliveries] == [("sent", 1)]
    assert second.deliveries == ()


def test_the_end_of_a_study_is_told_once_though_the_run_that_ended_last_is_deleted(db: Database):
    study_id = create_study(db, "pair", StudySpec(("FetchPush",), ("her",), (0, 1), "smoke")).study_id
    add_webhook(db, "https://a.example/", ["study_ended"])
    for _ in range(2):
        last = claim_next(db)
        finish(db, last, Succeeded(1.0))
    assert plan_deliveries(db, body_of) == 1
    act(db, Action.DELETE, last.run_id)
    assert plan_deliveries(db, body_of) == 0
    fill_study(db, study_id)
    finish(db, claim_next(db), Succeeded(1.0))
    assert plan_deliveries(db, body_of) == 1


def test_a_delivery_is_tried_again_after_growing_pauses_and_given_up(db: Database):
    webhook = add_webhook(db, "https://a.example/", ["run_failed"])
    add_test(db, webhook.id, {})
    pauses: list[float] = []
    for _ in range(len(BACKOFFS_S)):
        make_due(db)
        taken = take_delivery(db)
        assert taken is not None
        note_sent(db, taken, "Nobody answers.")
        ((delivery,),) = [found.deliveries for found in list_webhooks(db)]
        assert (delivery.state, delivery.problem) == ("waiting", "Nobody answers.")
        pauses.append((delivery.not_before - datetime.now(UTC)).total_seconds())
    assert pauses == pytest.approx(BACKOFFS_S, abs=30.0)
    assert pauses == sorted(pauses)
    make_due(db)
    taken = take_delivery(db)
    assert taken is not None
    note_sent(db, taken, "Nobody answers.")
    ((delivery,),) = [found.deliveries for found in list_webhooks(db)]
    assert (delivery.state, delivery.tries) == ("failed", len(BACKOFFS_S) + 1)
    make_due(db)
    assert take_delivery(db) is None


def test_a_sender_that_died_is_replaced_and_its_late_word_ignored(db: Database):
    add_test(db, add_webhook(db, "https://a.example/", ["run_failed"]).id, {})
    lost = take_delivery(db)
    assert (lost is not None, take_delivery(db)) == (True, None)
    make_due(db)
    taken = take_delivery(db)
    assert lost is not None
    assert taken is not None
    assert (taken.delivery.id, taken.delivery.tries) == (lost.delivery.id, 2)
    note_sent(db, lost, None)
    ((delivery,),) = [found.deliveries for found in list_webhooks(db)]
    assert delivery.state == "waiting"


def test_an_address_can_be_removed_and_there_is_a_limit(db: Database):
    webhook = add_webhook(db, "https://a.example/", ["run_failed"])
    add_test(db, webhook.id, {})
    remove_webhook(db, webhook.id)
    assert (list_webhooks(db), take_delivery(db)) == ([], None)
    for call in (lambda: remove_webhook(db, webhook.id), lambda: add_test(db, webhook.id, {})):
        with pytest.raises(NotFound, match="There is no webhook"):
            call()
    for number in range(MOST_WEBHOOKS):
        add_webhook(db, f"https://a.example/{number}", ["run_failed"])
    with pytest.raises(Refused, match="remove one first"):
        add_webhook(db, "https://a.example/", ["run_failed"])
