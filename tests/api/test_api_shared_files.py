"""Files and logs that another machine has written are sent all the same."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from live_api import Service, problem_fields
from store_engines import Stores

from backend.store.claims import Claim
from backend.store.files import find_file, register_file
from backend.store.settings import Settings
from backend.store.storage import FileStorage, checksum

CONTENT = bytes(range(256)) * 8
NAME = "policy-best.pt"


@pytest.fixture
def settings(stores: Stores, tmp_path: Path) -> Iterator[Settings]:
    home = tmp_path / "here"
    home.mkdir()
    with stores.fresh(home) as settings:
        yield replace(settings, files_url=f"file://{tmp_path}/shared")


@pytest.fixture
def held(service: Service, tmp_path: Path) -> Claim:
    """Return a run that another machine trains, which has kept a file."""
    service.launch()
    held = service.claim()
    keep_elsewhere(service, held, tmp_path, NAME, CONTENT)
    return held


def keep_elsewhere(service: Service, held: Claim, tmp_path: Path, name: str, content: bytes) -> None:
    there = replace(service.settings, home=tmp_path / "there")
    path = there.run_directory(held.run_id) / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    place = FileStorage(there).keep(held.run_id, held.attempt, path, checksum(path))
    register_file(service.database, held, name, "policy", place, len(content), checksum(path))


def test_a_file_of_another_machine_is_sent(service: Service, held: Claim):
    answer = service.client.get(f"/api/runs/{held.run_id}/files/{NAME}")
    assert (answer.status_code, answer.content) == (200, CONTENT)
    assert answer.headers["content-length"] == str(len(CONTENT))
    assert NAME in answer.headers["content-disposition"]


@pytest.mark.parametrize(
    ("asked", "part", "said"),
    [
        ("bytes=0-9", CONTENT[:10], "bytes 0-9/2048"),
        ("bytes=2040-", CONTENT[2040:], "bytes 2040-2047/2048"),
        ("bytes=-5", CONTENT[-5:], "bytes 2043-2047/2048"),
    ],
)
def test_a_range_of_it_is_answered_with_that_part(service: Service, held: Claim, asked: str, part: bytes, said: str):
    answer = service.client.get(f"/api/runs/{held.run_id}/files/{NAME}", headers={"range": asked})
    assert (answer.status_code, answer.content, answer.headers["content-range"]) == (206, part, said)


def test_a_range_outside_it_is_refused_in_words(service: Service, held: Claim):
    answer = service.client.get(f"/api/runs/{held.run_id}/files/{NAME}", headers={"range": "bytes=9999-"})
    assert answer.status_code == 416
    assert problem_fields(answer) == ["Range"]


def test_a_file_that_left_the_shared_place_is_said_to_be_gone(service: Service, held: Claim, tmp_path: Path):
    (tmp_path / "shared" / find_file(service.database, held.run_id, NAME).path).unlink()
    answer = service.client.get(f"/api/runs/{held.run_id}/files/{NAME}")
    assert answer.status_code == 404
    assert "no longer there" in answer.json()["problems"][0]["message"]


def test_a_shared_place_out_of_reach_is_trouble_that_may_pass(service: Service, held: Claim, tmp_path: Path):
    (tmp_path / "shared").rename(tmp_path / "unplugged")
    (tmp_path / "shared").write_text("")
    answer = service.client.get(f"/api/runs/{held.run_id}/files/{NAME}")
    assert (answer.status_code, answer.headers["retry-after"]) == (503, "1")


def test_the_log_of_another_machine_is_followed(service: Service, held: Claim, tmp_path: Path):
    keep_elsewhere(service, held, tmp_path, "log.txt", b"one\n")
    first = service.get(f"/api/runs/{held.run_id}/log")
    keep_elsewhere(service, held, tmp_path, "log.txt", b"one\ntwo\n")
    second = service.get(f"/api/runs/{held.run_id}/log", params={"after": first["offset"]})
    assert (first["text"], second["text"]) == ("one\n", "two\n")


def test_a_log_that_this_machine_still_writes_needs_no_copy(service: Service, held: Claim, tmp_path: Path):
    keep_elsewhere(service, held, tmp_path, "log.txt", b"one\n")
    path = service.settings.run_directory(held.run_id) / "log.txt"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("one\ntwo\n")
    assert service.get(f"/api/runs/{held.run_id}/log")["text"] == "one\ntwo\n"
