"""The host of media jobs, with drawing processes that do as they are told."""

from __future__ import annotations

import errno
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NoReturn

import media_targets
import pytest
from media_cases import claimed_run, store_episodes, store_file, tick_until_ended

from backend.store import storage
from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.files import find_file
from backend.store.media_jobs import MediaJob, MediaOrder, get_media, order_media
from backend.store.settings import Settings
from backend.store.thumbnails import THUMBNAIL_SOURCE
from worker import render
from worker.media import host as media_host
from worker.media.drawing_process import Target
from worker.media.host import MediaHost
from worker.media.orders import DrawOrder, NotDrawn
from worker.media.process import answer


@pytest.fixture
def held(db: Database, settings: Settings) -> Claim:
    held = claimed_run(db)
    store_episodes(db, settings, held)
    return held


@pytest.fixture
def make_host(db: Database, settings: Settings) -> Iterator[Callable[[Target], MediaHost]]:
    hosts: list[MediaHost] = []

    def make(target: Target) -> MediaHost:
        hosts.append(MediaHost(db, settings, target))
        return hosts[-1]

    yield make
    for host in hosts:
        host.close()


def ordered(db: Database, held: Claim, name: str = "video.mp4") -> MediaJob:
    arguments = {"file": "episodes-epoch-0003.npz", "number": 0, "width": 64, "height": 64}
    return order_media(db, MediaOrder(held.run_id, "video", "a" * 64, name, arguments))


def test_what_was_drawn_is_a_file_of_the_run(db, settings, held, make_host) -> None:
    job = ordered(db, held)
    assert tick_until_ended(make_host(media_targets.write_words), db, job.id).state == "done"
    row = find_file(db, held.run_id, "video.mp4")
    assert (settings.home / row.path).read_bytes() == media_targets.CONTENT


def test_a_process_that_dies_fails_its_job_and_the_next_gets_a_new_one(db, held, make_host) -> None:
    host = make_host(media_targets.die_of_it)
    for name in ("one.mp4", "two.mp4"):
        job = tick_until_ended(host, db, ordered(db, held, name).id)
        assert job.reason == "The drawing process ended with exit code -9; order it again."


def test_what_a_killed_process_left_half_drawn_is_removed(db, settings, held, make_host) -> None:
    host, job = make_host(media_targets.die_while_drawing), ordered(db, held)
    assert tick_until_ended(host, db, job.id).state == "failed"
    assert list(settings.run_directory(held.run_id).glob(".video.mp4.*")) == []


def test_what_a_host_that_was_killed_left_is_removed_with_the_next_drawing(db, settings, held, make_host) -> None:
    left = settings.run_directory(held.run_id) / ".video.mp4.0123456789ab.4194305.tmp"
    left.write_bytes(b"half of it")
    assert tick_until_ended(make_host(media_targets.write_words), db, ordered(db, held).id).state == "done"
    assert not left.exists()


def test_one_that_hangs_is_ended(db, held, make_host, monkeypatch) -> None:
    monkeypatch.setattr(media_host, "OVERDUE_S", 0.3)
    job = tick_until_ended(make_host(media_targets.never_answer), db, ordered(db, held).id)
    assert job.state == "failed"
    assert job.reason is not None
    assert "not drawn within" in job.reason


def test_closing_puts_back_what_is_at_hand(db, held, make_host) -> None:
    job = ordered(db, held)
    host = make_host(media_targets.never_answer)
    host.tick()
    assert get_media(db, job.id).state == "running"
    host.close()
    assert get_media(db, job.id).state == "queued"


def test_an_order_whose_source_is_gone_fails_by_itself(db, settings, held, make_host) -> None:
    (settings.run_directory(held.run_id) / "episodes-epoch-0003.npz").unlink()
    job = tick_until_ended(make_host(media_targets.write_words), db, ordered(db, held).id)
    assert job.reason is not None
    assert "is gone" in job.reason


def refuse(path: Path) -> NoReturn:
    """Stand in for the checksum of a file that another user owns."""
    raise PermissionError(errno.EACCES, "Permission denied", str(path))


def test_an_order_whose_source_cannot_be_read_fails_by_itself(
    db: Database, held: Claim, make_host: Callable[[Target], MediaHost], monkeypatch: pytest.MonkeyPatch
) -> None:
    host, job = make_host(media_targets.write_words), ordered(db, held)
    with monkeypatch.context() as patched:
        patched.setattr(storage, "checksum", refuse)
        refused = tick_until_ended(host, db, job.id)

    assert refused.reason is not None
    assert "cannot be read ([Errno 13] Permission denied: " in refused.reason
    assert tick_until_ended(host, db, ordered(db, held, "next.mp4").id).state == "done"


def test_a_machine_that_cannot_draw_says_so_once_and_plans_nothing_more(
    db: Database, settings: Settings, held: Claim, make_host: Callable[[Target], MediaHost]
) -> None:
    host = make_host(media_targets.see_nothing)
    assert tick_until_ended(host, db, ordered(db, held).id).reason == "MuJoCo cannot draw off screen here."
    path = settings.run_directory(held.run_id) / THUMBNAIL_SOURCE
    path.write_bytes(b"a policy")
    store_file(db, settings, held, path, "policy")
    for _ in range(3):
        host.tick()
        time.sleep(0.01)
    assert host.is_idle


def test_a_machine_that_can_draw_again_plans_again(
    db: Database, settings: Settings, held: Claim, make_host: Callable[[Target], MediaHost]
) -> None:
    host = make_host(media_targets.see_from_the_second_time_on)
    assert tick_until_ended(host, db, ordered(db, held).id).state == "failed"
    assert tick_until_ended(host, db, ordered(db, held, "next.mp4").id).state == "done"
    path = settings.run_directory(held.run_id) / THUMBNAIL_SOURCE
    path.write_bytes(b"a policy")
    store_file(db, settings, held, path, "policy")

    host.tick()

    assert not host.is_idle


def test_missing_egl_is_the_one_sentence_with_the_packages(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(render, "EGL_LIBRARY", "libEGL-that-is-not-there.so.1")
    reply = answer(DrawOrder("video", tmp_path / "x.npz", tmp_path / "x.mp4", 64, 64, 0))
    assert isinstance(reply, NotDrawn)
    assert reply.is_machine
    assert "apt-get install -y libegl1 libegl-mesa0 libgl1-mesa-dri" in reply.reason
    assert "\n" not in reply.reason
