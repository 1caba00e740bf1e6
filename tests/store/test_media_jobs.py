"""Orders of pictures and videos: made once, held by one host at a time, given up in the end."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sqlalchemy import insert, select
from store_cases import claimed_run

from backend.store.claims import Claim
from backend.store.database import Database, current_time
from backend.store.errors import NotFound
from backend.store.files import find_file, register_file
from backend.store.media_jobs import (
    GIVEN_UP,
    MOST_CLAIMS,
    MadeFile,
    MediaJob,
    MediaOrder,
    claim_media,
    fail_media,
    finish_media,
    get_media,
    list_media,
    order_media,
    release_media,
    renew_media,
)
from backend.store.outcomes import Succeeded
from backend.store.queue import finish
from backend.store.tables import SHARED, file_removals
from backend.store.thumbnails import THUMBNAIL_FILE, THUMBNAIL_SOURCE, plan_thumbnail

MADE = MadeFile("runs/x/video.mp4", 12, "a" * 64)


@pytest.fixture
def held(db: Database) -> Claim:
    return claimed_run(db)


@pytest.fixture
def order(held: Claim) -> MediaOrder:
    return MediaOrder(held.run_id, "video", "b" * 64, "video.mp4", {"width": 320, "height": 200})


def claimed(db: Database, lease_s: float = 60.0) -> MediaJob:
    job = claim_media(db, lease_s)
    assert job is not None
    return job


def store_policy(db: Database, held: Claim, sha256: str) -> None:
    register_file(db, held, THUMBNAIL_SOURCE, "policy", f"runs/{held.run_id}/{THUMBNAIL_SOURCE}", 7, sha256)


def test_the_same_picture_is_ordered_and_drawn_once(db: Database, order: MediaOrder) -> None:
    first = order_media(db, order)
    assert order_media(db, replace(order, arguments={"height": 200, "width": 320})).id == first.id
    assert finish_media(db, claimed(db), MADE) is None
    assert order_media(db, order).state == "done"
    assert claim_media(db) is None
    row = find_file(db, order.run_id, "video.mp4")
    assert (row.path, row.size, row.sha256, row.kind) == (MADE.path, 12, "a" * 64, "video")


def test_other_arguments_or_another_source_make_another_picture(db: Database, order: MediaOrder) -> None:
    others = [replace(order, arguments={}), replace(order, source="c" * 64), replace(order, file_name="other.mp4")]
    assert len({order_media(db, one).id for one in [order, *others]}) == 4
    assert len(list_media(db, order.run_id, "video")) == 4


def test_an_order_for_no_run_is_refused(db: Database) -> None:
    with pytest.raises(NotFound):
        order_media(db, MediaOrder("nobody", "video", "", "video.mp4", {}))
    with pytest.raises(NotFound):
        get_media(db, "nothing")


def test_one_that_failed_is_tried_again_when_it_is_ordered_again(db: Database, order: MediaOrder) -> None:
    order_media(db, order)
    assert fail_media(db, claimed(db), "No EGL.")
    assert (get_media(db, order.job_id).state, get_media(db, order.job_id).reason) == ("failed", "No EGL.")
    assert (order_media(db, order).state, order_media(db, order).reason) == ("queued", None)
    assert claimed(db).id == order.job_id


def test_a_host_that_gives_no_sign_of_life_loses_its_job(db: Database, order: MediaOrder) -> None:
    order_media(db, order)
    lost = claimed(db, lease_s=-1.0)
    taken = claimed(db)
    assert not renew_media(db, lost)
    assert renew_media(db, taken)
    assert not fail_media(db, lost, "Late.")
    assert finish_media(db, lost, MADE) == MADE.path
    assert finish_media(db, taken, MADE) is None
    assert get_media(db, order.job_id).state == "done"


def test_a_file_that_is_registered_stays_when_the_same_is_told_again(db: Database, order: MediaOrder) -> None:
    order_media(db, order)
    job = claimed(db)
    assert finish_media(db, job, MADE) is None
    assert finish_media(db, job, MADE) is None, "the first answer was lost"
    assert find_file(db, order.run_id, "video.mp4").path == MADE.path


def test_a_file_that_is_drawn_anew_is_not_removed_any_more(db: Database, order: MediaOrder) -> None:
    with db.write() as conn:
        mark = {"run_id": order.run_id, "size": 1, "fence": 1, "marked_at": current_time(conn)}
        for path in (MADE.path, f"{SHARED}{MADE.path}", "runs/x/other.mp4"):
            conn.execute(insert(file_removals).values({**mark, "path": path}))
    order_media(db, order)
    finish_media(db, claimed(db), MADE)
    with db.read() as conn:
        assert list(conn.execute(select(file_removals.c.path)).scalars()) == ["runs/x/other.mp4"]


def test_a_job_that_ends_every_host_is_given_up(db: Database, order: MediaOrder) -> None:
    order_media(db, order)
    for _ in range(MOST_CLAIMS):
        claimed(db, lease_s=-1.0)
    assert claim_media(db) is None
    assert (get_media(db, order.job_id).state, get_media(db, order.job_id).reason) == ("failed", GIVEN_UP)


def test_a_job_that_is_put_back_is_taken_by_the_next(db: Database, order: MediaOrder) -> None:
    order_media(db, order)
    release_media(db, claimed(db))
    assert claimed(db).id == order.job_id


def test_hosts_that_end_in_good_order_have_not_died(db: Database, order: MediaOrder) -> None:
    order_media(db, order)
    for _ in range(MOST_CLAIMS + 1):
        release_media(db, claimed(db))
    taken = claimed(db)
    assert finish_media(db, taken, MADE) is None
    assert get_media(db, order.job_id).state == "done"


def test_a_host_that_lost_its_job_cannot_write_whoever_gives_it_back_meanwhile(db: Database, order: MediaOrder) -> None:
    order_media(db, order)
    lost = claimed(db, lease_s=-1.0)
    release_media(db, claimed(db))
    assert not renew_media(db, lost)
    claimed(db)
    assert not renew_media(db, lost)


def test_a_file_that_is_replaced_leaves_its_old_path(db: Database, order: MediaOrder) -> None:
    order_media(db, order)
    finish_media(db, claimed(db), MADE)
    newer = replace(order, source="d" * 64)
    order_media(db, newer)
    assert finish_media(db, claimed(db), replace(MADE, path="runs/x/other.mp4")) == MADE.path
    assert [job.id for job in list_media(db, order.run_id, "video")] == [newer.job_id]


def test_a_run_gets_its_thumbnail_after_its_first_policy_and_a_new_one_at_its_end(db: Database, held: Claim) -> None:
    assert plan_thumbnail(db) is None
    store_policy(db, held, "1" * 64)
    planned = plan_thumbnail(db)
    assert planned is not None
    assert plan_thumbnail(db) is None
    finish_media(db, claimed(db), MADE)
    assert find_file(db, held.run_id, THUMBNAIL_FILE).kind == "thumbnail"
    store_policy(db, held, "2" * 64)
    assert plan_thumbnail(db) is None, "the one there is not old enough while the run trains"
    finish(db, held, Succeeded(1.0))
    newer = plan_thumbnail(db)
    assert newer is not None
    assert newer.source == "2" * 64


def test_a_thumbnail_that_failed_is_not_planned_again(db: Database, held: Claim) -> None:
    store_policy(db, held, "1" * 64)
    plan_thumbnail(db)
    fail_media(db, claimed(db), "No EGL.")
    assert plan_thumbnail(db) is None
