"""Logs and files of runs."""

from __future__ import annotations

from pathlib import Path

import pytest
from live_api import Service, problem_fields

from backend.api.routes.run_files import LOG_PIECE, read_log

CONTENT = bytes(range(256)) * 8


@pytest.fixture
def run_id(service: Service) -> str:
    """Return a run that has stored a file."""
    service.launch()
    held = service.claim()
    service.write_file(held, "policy-best.pt", CONTENT)
    return held.run_id


def test_files_are_listed_with_size_and_address(service: Service, run_id: str):
    [file] = service.get(f"/api/runs/{run_id}/files")["files"]
    assert (file["name"], file["kind"], file["size"]) == ("policy-best.pt", "policy", len(CONTENT))
    assert service.client.get(file["url"]).content == CONTENT


def test_a_download_keeps_its_name_and_is_not_compressed_again(service: Service, run_id: str):
    answer = service.client.get(f"/api/runs/{run_id}/files/policy-best.pt")
    assert answer.headers["content-disposition"] == 'attachment; filename="policy-best.pt"'
    assert "content-encoding" not in answer.headers


@pytest.mark.parametrize(
    ("asked", "part"), [("bytes=0-9", CONTENT[:10]), ("bytes=2040-", CONTENT[2040:]), ("bytes=-5", CONTENT[-5:])]
)
def test_a_range_is_answered_with_that_part(service: Service, run_id: str, asked: str, part: bytes):
    answer = service.client.get(f"/api/runs/{run_id}/files/policy-best.pt", headers={"range": asked})
    assert (answer.status_code, answer.content) == (206, part)


@pytest.mark.parametrize(
    "asked",
    ["bytes=9999-", "bytes=5-2", "bytes=-0", "bytes=-", "lines=1-2", "bytes=0-1,4-5", f"bytes=0-{'9' * 5000}"],
)
def test_a_range_that_cannot_be_answered_is_refused_in_words(service: Service, run_id: str, asked: str):
    answer = service.client.get(f"/api/runs/{run_id}/files/policy-best.pt", headers={"range": asked})
    assert answer.status_code == 416
    assert problem_fields(answer) == ["Range"]


def test_an_unknown_file_is_not_found(service: Service, run_id: str):
    answer = service.client.get(f"/api/runs/{run_id}/files/other.pt")
    assert answer.status_code == 404
    assert "other.pt" in answer.json()["problems"][0]["message"]


def test_a_file_that_left_the_disk_is_said_to_be_gone(service: Service, run_id: str):
    (service.settings.run_directory(run_id) / "policy-best.pt").unlink()
    answer = service.client.get(f"/api/runs/{run_id}/files/policy-best.pt")
    assert answer.status_code == 404
    assert "no longer on the disk" in answer.json()["problems"][0]["message"]


def test_a_log_that_is_not_there_yet_is_empty(service: Service, run_id: str):
    assert service.get(f"/api/runs/{run_id}/log") == {"text": "", "offset": 0}


def test_a_log_is_followed_from_the_offset(service: Service, run_id: str):
    path = service.settings.run_directory(run_id) / "log.txt"
    path.write_text("one\n")
    first = service.get(f"/api/runs/{run_id}/log")
    path.write_text("one\ntwo\n")
    second = service.get(f"/api/runs/{run_id}/log", params={"after": first["offset"]})
    assert (first["text"], second["text"]) == ("one\n", "two\n")


def test_only_the_end_of_a_long_log_is_sent(tmp_path: Path):
    path = tmp_path / "log.txt"
    path.write_bytes(b"a" * LOG_PIECE + b"b" * LOG_PIECE)
    tail = read_log(path, None)
    assert (tail.text, tail.offset) == ("b" * LOG_PIECE, 2 * LOG_PIECE)


def test_a_character_cut_off_at_the_end_waits_for_its_rest(tmp_path: Path):
    path = tmp_path / "log.txt"
    whole = "5 % → 95 %".encode()
    path.write_bytes(whole[:6])
    first = read_log(path, 0)
    path.write_bytes(whole)
    assert first.text + read_log(path, first.offset).text == "5 % → 95 %"


def test_a_log_written_anew_is_read_from_its_end(tmp_path: Path):
    path = tmp_path / "log.txt"
    path.write_text("new")
    assert read_log(path, 1000).text == "new"
