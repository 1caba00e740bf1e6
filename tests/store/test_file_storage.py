"""Files at a shared place: found whole by other machines, never overwritten, their troubles told in words."""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime
from pathlib import Path

import pytest

from backend.store.blocks import BLOCK, EMPTY, get_blocks, put_blocks, read_block_list
from backend.store.errors import BadAddress, FileGone, FilesUnavailable
from backend.store.files import FileRow
from backend.store.settings import Settings, sqlite_url
from backend.store.storage import FileStorage, SharedPlace
from sldr_core.errors import BadFile

CONTENT = bytes(range(256)) * 10
RUN = "4ad5e0"


@pytest.fixture(scope="session")
def engine() -> str:
    return "sqlite"  # no test here asks the store


@pytest.fixture(params=["file", "memory"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[str]:
    """Return the address of an empty shared place."""
    if request.param == "file":
        yield f"file://{tmp_path}/shared"
        return
    yield "memory://shared"
    from fsspec.implementations.memory import MemoryFileSystem

    MemoryFileSystem.store.clear()


def machine(tmp_path: Path, name: str, url: str | None) -> Settings:
    home = tmp_path / name
    home.mkdir(exist_ok=True)
    return Settings(home=home, database_url=sqlite_url(home), files_url=url)


def written(settings: Settings, content: bytes = CONTENT, name: str = "policy-best.pt") -> Path:
    path = settings.run_directory(RUN) / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    return path


def kept(settings: Settings, content: bytes = CONTENT, attempt: int = 1) -> FileRow:
    """Write and keep a file; return the row that the store would have."""
    path = written(settings, content)
    digest = hashlib.sha256(content).hexdigest()
    place = FileStorage(settings).keep(RUN, attempt, path, digest)
    return FileRow(RUN, path.name, "policy", place, len(content), digest, attempt, datetime.now(UTC))


def test_without_a_shared_place_a_file_stays_where_it_is(tmp_path: Path) -> None:
    settings = machine(tmp_path, "a", None)

    row = kept(settings)

    assert row.path == f"runs/{RUN}/policy-best.pt"
    assert FileStorage(settings).bring(row) == settings.home / row.path


def test_one_file_can_be_fetched_by_many_at_once(tmp_path: Path) -> None:
    url = f"file://{tmp_path}/shared"  # fsspec's place in memory has one cursor for all who read
    content = bytes(range(256)) * 20_000
    row = kept(machine(tmp_path, "a", url), content)
    storage = FileStorage(machine(tmp_path, "b", url))

    for _ in range(5):
        with ThreadPoolExecutor(4) as pool:
            paths = list(pool.map(storage.bring, [row] * 4))
        assert {path.read_bytes() for path in paths} == {content}
        paths[0].unlink()


def test_another_machine_gets_the_very_bytes(tmp_path: Path, url: str) -> None:
    row = kept(machine(tmp_path, "a", url))
    storage = FileStorage(machine(tmp_path, "b", url))

    assert storage.find_here(row) is None
    assert storage.bring(row).read_bytes() == CONTENT
    assert storage.find_here(row) == storage.bring(row)


def test_the_machine_that_wrote_a_file_need_not_fetch_it(tmp_path: Path, url: str) -> None:
    settings = machine(tmp_path, "a", url)

    assert FileStorage(settings).bring(kept(settings)) == settings.run_directory(RUN) / "policy-best.pt"


def test_a_file_left_from_an_earlier_attempt_is_not_taken_for_the_newest(tmp_path: Path, url: str) -> None:
    here = machine(tmp_path, "a", url)
    written(here, CONTENT[::-1])
    row = kept(machine(tmp_path, "b", url), attempt=2)

    assert FileStorage(here).bring(row).read_bytes() == CONTENT


def test_a_newer_version_leaves_the_older_whole_until_it_is_forgotten(tmp_path: Path, url: str) -> None:
    here, there = machine(tmp_path, "a", url), machine(tmp_path, "b", url)
    old, new = kept(here), kept(here, CONTENT * 2)

    assert b"".join(FileStorage(there).read(old)) == CONTENT
    FileStorage(here).forget(old.path)
    with pytest.raises(FileGone, match="recorded but no longer there"):
        FileStorage(there).read(old)
    assert FileStorage(there).bring(new).read_bytes() == CONTENT * 2


def test_attempts_never_write_the_same_name(tmp_path: Path, url: str) -> None:
    settings = machine(tmp_path, "a", url)

    assert kept(settings, attempt=1).path != kept(settings, attempt=2).path


def test_a_file_is_read_from_any_byte_on(tmp_path: Path, url: str) -> None:
    row = kept(machine(tmp_path, "a", url))

    assert b"".join(FileStorage(machine(tmp_path, "b", url)).read(row, start=2500)) == CONTENT[2500:]


def test_a_file_that_was_damaged_at_the_shared_place_is_refused(tmp_path: Path) -> None:
    row = kept(machine(tmp_path, "a", f"file://{tmp_path}/shared"))
    path = tmp_path / "shared" / row.path
    path.write_bytes(CONTENT[::-1])
    there = machine(tmp_path, "b", f"file://{tmp_path}/shared")

    with pytest.raises(BadFile, match=f"{path} is damaged"):
        FileStorage(there).bring(row)
    assert list(there.fetched_directory.rglob("*.*")) == []


def test_all_files_of_an_attempt_are_found(tmp_path: Path, url: str) -> None:
    row = kept(machine(tmp_path, "a", url))

    assert SharedPlace(url).paths_below(f"runs/{RUN}/attempt-1") == [row.path]
    assert SharedPlace(url).paths_below(f"runs/{RUN}/attempt-9") == []


def test_a_place_that_cannot_be_written_is_told_as_trouble_that_may_pass(tmp_path: Path) -> None:
    (tmp_path / "shared").write_text("a file where the directory should be")

    with pytest.raises(FilesUnavailable, match=r"SLDR_FILES_URL: .* could not be written just now"):
        kept(machine(tmp_path, "a", f"file://{tmp_path}/shared"))


def unmount(place: Path) -> None:
    """Leave what a machine sees of a place that is not mounted."""
    shutil.rmtree(place)
    place.mkdir()


@pytest.mark.parametrize("is_same_process", [True, False])
def test_a_place_that_is_not_mounted_any_more_is_not_written_in_its_stead(
    tmp_path: Path, is_same_process: bool
) -> None:
    settings = machine(tmp_path, "a", f"file://{tmp_path}/shared")
    storage = FileStorage(settings)
    row = kept(settings)
    storage.keep(RUN, 1, written(settings), row.sha256)
    unmount(tmp_path / "shared")

    storage = storage if is_same_process else FileStorage(settings)
    with pytest.raises(FilesUnavailable, match="was used before and now holds no file sldr-files: mount it again"):
        storage.keep(RUN, 2, written(settings), row.sha256)

    assert list((tmp_path / "shared").iterdir()) == []


def test_a_file_at_a_place_that_is_not_mounted_is_not_taken_for_gone(tmp_path: Path) -> None:
    there = machine(tmp_path, "b", f"file://{tmp_path}/shared")
    kept(there)
    row = kept(machine(tmp_path, "a", f"file://{tmp_path}/shared"), CONTENT * 2)
    unmount(tmp_path / "shared")

    with pytest.raises(FilesUnavailable, match="could not be read just now"):
        FileStorage(there).bring(row)


def test_a_place_from_before_there_were_marks_is_marked_when_it_is_written(tmp_path: Path) -> None:
    (tmp_path / "shared" / "runs").mkdir(parents=True)

    kept(machine(tmp_path, "a", f"file://{tmp_path}/shared"))

    assert (tmp_path / "shared" / "sldr-files").is_file()


@pytest.mark.parametrize(
    ("address", "sentence"),
    [
        ("nowhere://bucket", "cannot be used .Protocol not known: nowhere"),
        ("s3://bucket", "needs a package that is not installed: Install s3fs"),
    ],
)
def test_an_address_that_cannot_work_is_told_at_once(tmp_path: Path, address: str, sentence: str) -> None:
    with pytest.raises(BadAddress, match=sentence):
        FileStorage(machine(tmp_path, "a", address))


def blocky(*parts: bytes) -> bytes:
    return b"".join(part * BLOCK for part in parts) + b"end"


def test_a_file_of_blocks_comes_back_as_it_was(tmp_path: Path, url: str) -> None:
    file = tmp_path / "replay.bin"
    file.write_bytes(blocky(b"a", b"\0", b"b", b"a"))

    put = put_blocks(SharedPlace(url), file, "blocks", EMPTY)
    (tmp_path / "list.json").write_text(put.to_json())
    get_blocks(SharedPlace(url), read_block_list(tmp_path / "list.json"), tmp_path / "copy.bin")

    assert (tmp_path / "copy.bin").read_bytes() == file.read_bytes()
    assert len(SharedPlace(url).paths_below("blocks")) == 3


def test_only_blocks_that_changed_travel(tmp_path: Path, url: str) -> None:
    file = tmp_path / "replay.bin"
    file.write_bytes(blocky(b"a", b"b", b"c"))
    first = put_blocks(SharedPlace(url), file, "first", EMPTY)
    file.write_bytes(blocky(b"a", b"x", b"c"))

    second = put_blocks(SharedPlace(url), file, "second", first)

    assert len(SharedPlace(url).paths_below("second")) == 1
    assert len(first.paths - second.paths) == 1


def test_a_block_that_was_damaged_is_refused(tmp_path: Path) -> None:
    place = SharedPlace(f"file://{tmp_path}/shared")
    file = tmp_path / "replay.bin"
    file.write_bytes(blocky(b"a", b"b"))
    put = put_blocks(place, file, "blocks", EMPTY)
    damaged = sorted(put.paths)[0]
    (tmp_path / "shared" / damaged).write_bytes(b"z" * BLOCK)

    with pytest.raises(BadFile, match=f"{damaged} is damaged"):
        get_blocks(place, put, tmp_path / "copy.bin")
    assert not (tmp_path / "copy.bin").exists()
