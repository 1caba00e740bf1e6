"""One run of which everything is drawn once, by a real drawing process."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass

import pytest
from media_cases import EPOCH, claimed_run, store_episodes, store_policy, tick_until_ended

from backend.store.database import Database, open_database
from backend.store.files import find_file
from backend.store.media_jobs import MediaJob, MediaOrder, order_media
from backend.store.settings import Settings, sqlite_url
from backend.store.thumbnails import plan_thumbnail
from sldr_core.episodes import episodes_file
from worker.media.host import MediaHost

SIZE = (168, 104)
"""Of the videos: multiples of 8 and not of 16, which a codec might round to."""


@dataclass(frozen=True)
class DrawnRun:
    """What became of every order."""

    db: Database
    settings: Settings
    run_id: str
    jobs: dict[str, MediaJob]
    """By the file that was asked for."""


@pytest.fixture(scope="session")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> Iterator[DrawnRun]:
    """Return a run with a thumbnail, a video in each form, and an order that cannot be filled."""
    home = tmp_path_factory.mktemp("media")
    settings = Settings(home=home, database_url=sqlite_url(home))
    with closing(open_database(settings)) as db:
        held = claimed_run(db)
        store_policy(db, settings, held)
        store_episodes(db, settings, held)
        source = find_file(db, held.run_id, episodes_file(EPOCH))

        def order(name: str, number: int = 0) -> MediaJob:
            arguments = {"file": source.name, "number": number, "width": SIZE[0], "height": SIZE[1]}
            return order_media(db, MediaOrder(held.run_id, "video", source.sha256, name, arguments))

        jobs = [order("a.mp4"), order("a.webm"), order("missing.mp4", number=7), plan_thumbnail(db)]
        host = MediaHost(db, settings)
        try:
            ended = {job.file_name: tick_until_ended(host, db, job.id) for job in jobs if job is not None}
        finally:
            host.close()
        yield DrawnRun(db, settings, held.run_id, ended)
