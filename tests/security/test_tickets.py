"""A ticket opens one address to read, for some minutes, and nothing else."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest
from guarded_api import Guarded

from backend.api.access.tickets import LIFETIME, Tickets
from backend.store.files import register_file
from backend.store.launches import LaunchOrder, launch
from backend.store.queue import claim

PATH = "/api/runs/aaaa/files/recording-attempt-1.rrd"
NOW = datetime(2026, 1, 2, tzinfo=UTC)
SECRET = b"s" * 32


@pytest.mark.parametrize(
    ("secret", "path", "later", "opens"),
    [
        (SECRET, PATH, timedelta(0), True),
        (SECRET, PATH, LIFETIME - timedelta(seconds=1), True),
        (SECRET, PATH, LIFETIME, False),
        (SECRET, PATH.replace("aaaa", "bbbb"), timedelta(0), False),
        (SECRET, "/api/runs", timedelta(0), False),
        (b"t" * 32, PATH, timedelta(0), False),
    ],
)
def test_it_opens_its_address_for_its_time(secret: bytes, path: str, later: timedelta, opens: bool) -> None:
    ticket = Tickets(secret).sign(PATH, NOW)

    assert Tickets(SECRET).open(ticket, path, NOW + later) is opens


@pytest.mark.parametrize("forged", ["", "x", "x.y.z", "W10.AAAA"])
def test_a_forged_one_opens_nothing(forged: str) -> None:
    assert not Tickets(SECRET).open(forged, PATH, NOW)


def test_a_recording_comes_with_a_ticket_that_opens_it_alone(api: Guarded) -> None:
    launch(api.database, LaunchOrder("FetchPush", "manipulation", "her", (0,), "smoke"))
    held = claim(api.database, "here", lease_s=3600.0)
    assert held is not None
    directory = api.settings.run_directory(held.run_id)
    directory.mkdir(parents=True)
    for name, kind in (("recording-attempt-1.rrd", "recording"), ("policy-newest.pt", "policy")):
        (directory / name).write_bytes(b"bytes")
        place = str((directory / name).relative_to(api.settings.home))
        register_file(api.database, held, name, kind, place, 5, "0" * 64)

    files = {
        file["name"]: file for file in api.programs["viewer"].get(f"/api/runs/{held.run_id}/files").json()["files"]
    }

    recording, policy = files["recording-attempt-1.rrd"], files["policy-newest.pt"]
    shown = {"ticket": recording["ticket"], "version": "1"}
    assert api.nobody.get(recording["url"], params=shown).content == b"bytes"
    assert policy["ticket"] is None
    for method, path in (("GET", policy["url"]), ("GET", "/api/runs"), ("POST", recording["url"]), ("GET", "/metrics")):
        assert api.nobody.request(method, path, params=shown).status_code == 401, path
