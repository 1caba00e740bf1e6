"""A study file from anyone: whatever is wrong with it is told in a sentence, and nothing of it is left anywhere."""

from __future__ import annotations

import io
import json
import random
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any
from zipfile import ZIP_BZIP2, ZIP_DEFLATED, ZipFile

import pytest
from hypothesis import HealthCheck, given
from hypothesis import settings as trials
from hypothesis import strategies as st
from store_engines import SqliteStores
from study_file_cases import (
    archive_of,
    changed,
    everything_below,
    members_of,
    with_curves,
    with_file,
    write_members,
)

from backend.store.database import Database, open_database
from backend.store.settings import Settings
from backend.store.studies.matrix import list_studies
from backend.store.study_files.placing import IMPORT_LOCK, import_study
from backend.store.study_files.records import STUDY_MEMBER
from sldr_core.errors import BadFile

HUGE = 40 * 2**20
"""Zeros in a bomb [bytes]."""

Listed = dict[str, Any]


def refused(db: Database, home: Settings, source: Path, match: str) -> None:
    """Expect that a file is refused, and that nothing is left of it."""
    before = everything_below(home.home)

    with pytest.raises(BadFile, match=match):
        import_study(db, home, source, "The file")

    assert everything_below(home.home) - before <= {"runs", IMPORT_LOCK}
    assert list_studies(db, 10) == []


def run_of(listed: Listed, place: int = -1) -> Listed:
    return listed["runs"][place]


CHANGES: dict[str, tuple[Callable[[Listed], object], str]] = {
    "newer-format": (lambda file: file.update(format=2), "reads: format"),
    "unknown-field": (lambda file: file.update(more=1), "reads: more"),
    "no-runs": (lambda file: file.update(runs=[]), "reads: runs"),
    "text-for-a-number": (lambda file: run_of(file).update(success_rate="1"), "success_rate"),
    "success-beyond-one": (lambda file: run_of(file).update(success_rate=1.5), "success_rate"),
    "time-without-zone": (lambda file: run_of(file).update(created_at="2026-01-01T00:00:00"), "created_at"),
    "time-out-of-reason": (lambda file: run_of(file).update(ended_at="9999-12-31T23:59:59-12:00"), "ended_at"),
    "path-in-a-key": (lambda file: run_of(file).update(key="../../etc"), "key"),
    "path-in-a-name": (lambda file: run_of(file)["files"][0].update(name="../policy-best.pt"), "name"),
    "foreign-file": (lambda file: run_of(file)["files"][0].update(name="checkpoint.pt"), "name"),
    "zero-in-a-note": (lambda file: file["study"].update(note="a\0b"), "note"),
    "unknown-task": (lambda file: file["study"]["spec"].update(tasks=["Nothing"]), "No task is called"),
    "unknown-setting": (lambda file: file["study"]["spec"].update(overrides={"loop": {"no": 1}}), "does not have"),
    "too-many-seeds": (lambda file: file["study"]["spec"].update(seeds=list(range(2001))), "seeds"),
    "huge-seed": (lambda file: run_of(file)["config"].update(seed=2**70), "does not"),
    "broken-config": (lambda file: run_of(file)["config"].update(loop=3), "does not have"),
    "unknown-preset": (lambda file: run_of(file).update(preset="none"), "No preset is called"),
    "same-run-twice": (lambda file: file["runs"].append(run_of(file)), "twice"),
    "elsewhere": (lambda file: run_of(file)["place"].update(seed=9), "stands where it cannot"),
    "nowhere": (lambda file: run_of(file).update(place=None), "stands nowhere"),
    "needs-a-robot": (lambda file: run_of(file).update(needs=[run_of(file, -2)["key"]]), "needs a locomotion run"),
    "needs-nobody": (lambda file: run_of(file).update(needs=["abc"]), "needs a locomotion run"),
    "unknown-event": (lambda file: run_of(file)["events"][0].update(event="exploded"), "cannot"),
    "unknown-tag": (lambda file: run_of(file)["episodes"][0].update(tag="odd"), "no file holds"),
    "other-epoch": (lambda file: run_of(file)["episodes"][0].update(epoch=8), "no file holds"),
    "file-twice": (lambda file: run_of(file)["files"].append(run_of(file)["files"][0]), "a file twice"),
    "lost-file": (lambda file: run_of(file)["files"][0].update(name="policy-newest.pt"), "holds"),
    "wrong-sum": (lambda file: run_of(file)["files"][0].update(sha256="0" * 64), "not what its list says"),
    "wrong-size": (lambda file: run_of(file)["files"][0].update(size=3), "longer than"),
    "wrong-curves": (lambda file: run_of(file)["metrics"].update(sha256="0" * 64), "not what its list says"),
}


@pytest.mark.parametrize("name", CHANGES)
def test_a_list_that_cannot_be_is_refused(
    name: str, db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    change, problem = CHANGES[name]
    refused(db, settings, changed(exported, tmp_path / "x.zip", change), problem)


@pytest.mark.parametrize(
    "change",
    [
        lambda curves: curves["steps"].reverse(),
        lambda curves: curves["metrics"]["test/success_rate"].update(at=[0, 1, 99]),
        lambda curves: curves["metrics"]["test/success_rate"].update(at=[0]),
        lambda curves: curves["metrics"]["test/success_rate"]["values"].__setitem__(0, float("nan")),
        lambda curves: curves["steps"][0].__setitem__(0, -1),
        lambda curves: curves["steps"][0].__setitem__(2, 2**70),
    ],
    ids=["order", "beyond", "length", "nan", "negative", "huge"],
)
def test_curves_that_cannot_be_are_refused(
    change: Callable, db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    refused(db, settings, with_curves(exported, tmp_path / "x.zip", change), "is not taken|are not taken")


@pytest.mark.parametrize("name", ["../../outside", "/etc/passwd", "runs/../../x", "C:\\x", "runs/abc/"])
def test_no_path_of_an_archive_is_ever_written(
    name: str, db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    source = write_members(tmp_path / "x.zip", {**members_of(exported), name: b"slipped"})
    outside = everything_below(tmp_path) - everything_below(settings.home)

    refused(db, settings, source, "which no study file has")

    assert everything_below(tmp_path) - everything_below(settings.home) == outside


def test_a_bomb_is_not_unpacked(db: Database, settings: Settings, tmp_path: Path) -> None:
    refused(db, settings, write_members(tmp_path / "x.zip", {STUDY_MEMBER: b"0" * HUGE}), "unpack to too much")


def test_a_bomb_within_a_file_is_not_unpacked(db: Database, settings: Settings, exported: Path, tmp_path: Path) -> None:
    bomb = io.BytesIO()
    with ZipFile(bomb, "w", ZIP_DEFLATED) as archive:
        archive.writestr("qpos.npy", b"0" * HUGE)

    refused(db, settings, with_file(exported, tmp_path / "x.zip", -1, bomb.getvalue()), "unpack to too much")


def test_a_member_that_is_longer_than_it_says_is_not_read_on(
    db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    members = members_of(exported)
    key = json.loads(members[STUDY_MEMBER])["runs"][-1]["key"]
    members[f"runs/{key}/policy-best.pt"] += b"more"

    refused(db, settings, write_members(tmp_path / "x.zip", members), "longer than")


def test_another_packing_and_a_name_that_is_there_twice_are_refused(
    db: Database, settings: Settings, tmp_path: Path
) -> None:
    with ZipFile(tmp_path / "x.zip", "w", ZIP_BZIP2) as archive:
        archive.writestr(STUDY_MEMBER, b"{}")
    refused(db, settings, tmp_path / "x.zip", "packed in a way")
    with ZipFile(tmp_path / "y.zip", "w") as archive:
        archive.writestr(STUDY_MEMBER, b"{}")
        with pytest.warns(UserWarning, match="Duplicate"):
            archive.writestr(STUDY_MEMBER, b"{}")
    refused(db, settings, tmp_path / "y.zip", "twice")


@pytest.mark.parametrize("content", [b"not an archive", archive_of(b"foreign")], ids=["text", "foreign"])
def test_a_file_of_episodes_that_is_none_is_refused(
    content: bytes, db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    refused(
        db, settings, with_file(exported, tmp_path / "x.zip", -1, content), "cannot be unpacked|no file of recorded"
    )


def test_deep_nesting_is_refused(db: Database, settings: Settings, tmp_path: Path) -> None:
    source = write_members(tmp_path / "x.zip", {STUDY_MEMBER: b"[" * 100_000})

    refused(db, settings, source, "no study file that this version reads")


FEW, MANY = 40, 5000
"""Damaged files in the usual run and in the slow one."""


@pytest.mark.parametrize("count", [FEW, pytest.param(MANY, marks=pytest.mark.slow)])
def test_a_file_damaged_anywhere_is_refused_or_whole(
    count: int, exported: Path, tmp_path: Path, sqlite_stores: SqliteStores
) -> None:
    """Turn bytes, cut and join at random; each file ends in a sentence or in the very study."""
    whole, dice = exported.read_bytes(), random.Random(5)
    with sqlite_stores.fresh(tmp_path) as home:
        db = open_database(home)
        for _ in range(count):
            content = bytearray(whole)
            for _ in range(dice.choice((1, 3, 30))):
                content[dice.randrange(len(content))] ^= 1 << dice.randrange(8)
            if dice.random() < 0.3:
                del content[dice.randrange(len(content)) :]
            try:
                import_study(db, home, io.BytesIO(content), "The file")
            except BadFile:
                continue
        outside = everything_below(tmp_path) - {
            "sldr.db",
            "sldr.db.lock",
            "sldr.db-wal",
            "sldr.db-shm",
            "runs",
            IMPORT_LOCK,
        }
        assert all(path.startswith("runs/") for path in outside)
        db.close()


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner, max_size=3),
    max_leaves=6,
)


@st.composite
def replacements(draw: st.DrawFn) -> tuple[list[int], Any]:
    """Draw a way into the list, by the places of keys and entries, and what stands there instead."""
    return draw(st.lists(st.integers(0, 30), min_size=1, max_size=6)), draw(JSON)


def replace_at(listed: Any, way: list[int], value: Any) -> None:
    """Follow a way as far as it goes and put a value there."""
    for place in way[:-1]:
        keys = list(listed) if isinstance(listed, dict) else list(range(len(listed)))
        inner = listed[keys[place % len(keys)]] if keys else None
        if not isinstance(inner, dict | list) or not inner:
            break
        listed = inner
    keys = list(listed) if isinstance(listed, dict) else list(range(len(listed)))
    if keys:
        listed[keys[way[-1] % len(keys)]] = value


@given(replacements())
@trials(
    max_examples=60,
    deadline=None,
    database=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
def test_whatever_stands_in_the_list_is_taken_or_told(
    exported: Path, tmp_path_factory: pytest.TempPathFactory, sqlite_stores: SqliteStores, drawn: tuple
) -> None:
    directory = tmp_path_factory.mktemp("drawn")
    source = changed(exported, directory / "x.zip", lambda listed: replace_at(listed, *drawn))
    (directory / "home").mkdir()
    with sqlite_stores.fresh(directory / "home") as home:
        db = open_database(home)
        with suppress(BadFile):
            import_study(db, home, source, "The file")
        db.close()
    assert {path.name for path in directory.iterdir()} == {"x.zip", "home"}
