"""Study files over the API: out, in, and the sample that comes with the product."""

from __future__ import annotations

import json
import shutil
from contextlib import closing
from pathlib import Path
from zipfile import ZipFile

import httpx
import pytest
from live_api import Service
from other_processes import wait_until
from size_limit import no_file_longer_than
from store_engines import SqliteStores
from study_file_cases import members_of, trained_study

from backend.api.routes import study_files
from backend.samples import SAMPLE_VARIABLE
from backend.store.database import open_database
from backend.store.settings import Settings
from backend.store.study_files.packing import pack_study
from backend.store.study_files.records import STUDY_MEMBER

LARGEST_SAMPLE = 15_000_000
"""What the sample studies may take together [bytes]."""


@pytest.fixture(scope="module")
def exported(sqlite_stores: SqliteStores, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a study file of a study that was trained elsewhere."""
    home = tmp_path_factory.mktemp("elsewhere")
    with sqlite_stores.fresh(home) as settings, closing(open_database(settings)) as db:
        pack_study(db, settings, trained_study(db, settings), home / "study.zip")
    return home / "study.zip"


@pytest.fixture
def client(service: Service) -> httpx.Client:
    return service.client


def upload(client: httpx.Client, content: bytes):
    return client.post("/api/study-files", content=content, headers={"content-type": "application/zip"})


def leftovers(home: Path) -> list[str]:
    """Return what of uploads and downloads still lies in a home; the last goes when it has been sent."""
    return [path.name for path in home.iterdir() if path.name.startswith((".upload", ".study"))]


def test_a_study_goes_in_and_out(client: httpx.Client, exported: Path, settings: Settings, tmp_path: Path) -> None:
    taken = upload(client, exported.read_bytes())

    assert taken.status_code == 200, taken.text
    study_id = taken.json()["study_id"]
    assert (taken.json()["runs"], taken.json()["already_there"]) == (5, False)
    assert client.get(f"/api/studies/{study_id}").json()["states"] == {"succeeded": 4}
    runs = client.get("/api/runs").json()["runs"]
    assert {tag for run in runs for tag in run["tags"]} == {"imported"}
    for run in runs:
        assert client.get(f"/api/runs/{run['id']}").status_code == 200
        assert client.get(f"/api/runs/{run['id']}/events").status_code == 200
        assert client.get(f"/api/runs/{run['id']}/attempts").status_code == 200
    out = client.get(f"/api/study-files/{study_id}")
    (tmp_path / "out.zip").write_bytes(out.content)
    assert out.headers["content-type"] == "application/zip"
    assert len(members_of(tmp_path / "out.zip")) == len(members_of(exported))
    assert upload(client, exported.read_bytes()).json()["already_there"]
    wait_until(lambda: not leftovers(settings.home), otherwise="uploads or downloads were left there")


@pytest.mark.parametrize(("part", "status"), [("bytes=0-9", 206), ("bytes=999999999-", 416), ("lines=1", 400)])
def test_nothing_is_left_of_what_was_packed_for_an_answer(
    client: httpx.Client, exported: Path, settings: Settings, part: str, status: int
) -> None:
    study_id = upload(client, exported.read_bytes()).json()["study_id"]
    assert client.get(f"/api/study-files/{study_id}", headers={"range": part}).status_code == status
    wait_until(lambda: not leftovers(settings.home), otherwise="the download was left there")


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"{}"], ids=["empty", "cut", "text"])
def test_what_is_no_study_file_is_told(client: httpx.Client, content: bytes) -> None:
    answer = upload(client, content)

    assert answer.status_code == 422
    assert "is no study file" in answer.json()["problems"][0]["message"]


def test_a_body_that_is_too_long_is_not_read_on(client: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(study_files, "LARGEST_STUDY_FILE", 1000)

    assert upload(client, b"0" * 1001).status_code == 413


def test_an_upload_to_a_full_disk_is_told_in_a_sentence(client: httpx.Client, settings: Settings) -> None:
    with no_file_longer_than(8 * 2**20):
        answer = upload(client, b"0" * 12 * 2**20)

    assert answer.status_code == 422
    assert "There is no room for the uploaded file" in answer.json()["problems"][0]["message"]
    assert leftovers(settings.home) == []


def test_a_study_that_is_not_there_cannot_be_taken_along(client: httpx.Client) -> None:
    assert client.get("/api/study-files/nothing").status_code == 404


def test_the_sample_is_opened_in_one_step(
    client: httpx.Client, exported: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(SAMPLE_VARIABLE, str(exported))

    assert client.get("/api/study-files/sample").json() == {"files": 1, "size": exported.stat().st_size}
    (opened,) = client.post("/api/study-files/sample").json()["studies"]

    assert client.get(f"/api/studies/{opened['study_id']}").status_code == 200
    assert client.post("/api/study-files/sample").json() == {"studies": [{**opened, "already_there": True}]}


def test_all_samples_of_a_directory_are_opened(
    client: httpx.Client, exported: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The second file holds the study of the first under another name."""
    with ZipFile(exported) as archive, ZipFile(tmp_path / "b.zip", "w") as renamed:
        for name in archive.namelist():
            content = archive.read(name)
            if name == STUDY_MEMBER:
                told = json.loads(content)
                told["study"]["name"] = "another"
                content = json.dumps(told).encode()
            renamed.writestr(name, content)
    shutil.copy(exported, tmp_path / "a.zip")
    monkeypatch.setenv(SAMPLE_VARIABLE, str(tmp_path))

    assert client.get("/api/study-files/sample").json()["files"] == 2
    opened = client.post("/api/study-files/sample").json()["studies"]

    assert len({study["study_id"] for study in opened}) == 2
    assert {study["runs"] for study in opened} == {5}


def test_without_a_sample_none_is_offered(client: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(SAMPLE_VARIABLE, "/nonexistent")

    assert client.get("/api/study-files/sample").json() == {"files": 0, "size": 0}
    assert client.post("/api/study-files/sample").status_code == 404


def test_the_shipped_samples_are_small_and_open(client: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(SAMPLE_VARIABLE)

    told = client.get("/api/study-files/sample").json()
    opened = client.post("/api/study-files/sample").json()["studies"]

    assert told["size"] <= LARGEST_SAMPLE
    assert len(opened) == told["files"] > 0
