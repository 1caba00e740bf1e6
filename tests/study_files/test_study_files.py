"""A study that is packed and taken in elsewhere is the same study: curves, files, episodes, places."""

from __future__ import annotations

import hashlib
import json
import platform
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import select, update
from store_engines import ENGINES
from study_file_cases import EPOCH, SPEC, changed, everything_below, members_of, trained_study

from backend.store.database import Database
from backend.store.episodes import EpisodeFilter, list_episodes
from backend.store.errors import NotFound, Refused
from backend.store.files import list_files
from backend.store.labels import select_tags
from backend.store.launches import LaunchOrder, plan_launch
from backend.store.metric_summaries import list_metric_names
from backend.store.metrics import read_metrics
from backend.store.queue import claim
from backend.store.retention.plan import plan_retention
from backend.store.retention.removal import apply_retention, finish_removals
from backend.store.retention.rule import Removable, Rule
from backend.store.runs import get_run, list_events
from backend.store.settings import Settings
from backend.store.states import RunState
from backend.store.storage import FileStorage, checksum
from backend.store.studies.launch import create_study, delete_study, extend_study, fill_study
from backend.store.studies.matrix import StudyMatrix, get_study, list_studies
from backend.store.studies.spec import LONGEST_NOTE, Addition
from backend.store.study_files.chosen_files import EpisodeChoice
from backend.store.study_files.packing import pack_study
from backend.store.study_files.placing import import_study
from backend.store.tables import attempts, studies
from backend.store.workers import Machine, register_worker

ALL_EPISODES = (EpisodeFilter(), "epoch", True, 10, 0)

pytestmark = pytest.mark.parametrize("engine", ENGINES, scope="module")


def told(matrix: StudyMatrix) -> list[tuple]:
    return [(cell.cell, cell.states, cell.best_success_rate, [run.seed for run in cell.runs]) for cell in matrix.cells]


def test_a_study_is_the_same_elsewhere(
    db: Database, settings: Settings, exported: Path, tmp_path_factory: pytest.TempPathFactory, sqlite_stores
) -> None:
    imported = import_study(db, settings, exported, "It")

    matrix = get_study(db, imported.study_id)
    assert (imported.runs, imported.already_there) == (5, False)
    assert matrix.study.name == "Two methods"
    assert matrix.study.note.startswith("What was asked.\n\nImported from a study file made ")
    assert [cell.states for cell in matrix.cells] == [{RunState.SUCCEEDED: 2}] * 2
    assert len(matrix.locomotion) == 1
    run = matrix.cells[1].runs[0]
    columns = read_metrics(db, run.run_id)
    assert columns.epoch == [1, 2, 3]
    assert columns.values["test/success_rate"][-1] == pytest.approx(get_run(db, run.run_id).success_rate)
    assert "critic/task/loss" in list_metric_names(db)
    files = list_files(db, run.run_id)
    assert sorted(file.name for file in files) == ["episodes-epoch-0003.npz", "policy-best.pt"]
    for file in files:
        assert FileStorage(settings).bring(file).is_relative_to(settings.home)
    page = list_episodes(db, run.run_id, EpisodeFilter(), "epoch", True, 10, 0)
    assert (page.total, page.epochs) == (1, [EPOCH])


def test_imported_runs_are_marked_and_never_trained_or_joined(db: Database, settings: Settings, exported: Path) -> None:
    matrix = get_study(db, import_study(db, settings, exported, "It").study_id)
    run_id = matrix.cells[0].runs[0].run_id

    with db.read() as conn:
        assert select_tags(conn, [run_id]) == {run_id: ("imported",)}
    assert list_events(db, run_id)[-1].event == "imported"
    assert claim(db, "worker-1", 60.0) is None
    assert fill_study(db, matrix.study.id).queued == 0
    [planned] = plan_launch(db, LaunchOrder("FetchPush", "manipulation", "her", (0,), "smoke"))
    assert planned.reused_run_id is None
    assert create_study(db, "My own", SPEC).joined == 0


def test_a_model_of_the_zoo_that_comes_with_a_study_trains_no_longer(
    db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    def untrained(listed: dict[str, Any]) -> None:
        for run in listed["runs"]:
            run.update(started_at=None, ended_at=None)

    imported = import_study(db, settings, changed(exported, tmp_path / "zoo.zip", untrained), "It")

    run = get_run(db, get_study(db, imported.study_id).cells[0].runs[0].run_id)
    assert (run.state, run.training_time.since) == (RunState.SUCCEEDED, None)


def test_the_same_file_is_the_same_study(db: Database, settings: Settings, exported: Path) -> None:
    first = import_study(db, settings, exported, "It")
    before = everything_below(settings.runs_directory)
    delete_study(db, first.study_id)

    again = import_study(db, settings, exported, "It")

    assert (again.study_id, again.already_there) == (first.study_id, True)
    assert everything_below(settings.runs_directory) == before
    assert [study.name for study in list_studies(db, 10)] == ["Two methods"]


def test_a_study_that_comes_back_leaves_its_name_to_the_one_that_took_it(
    db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    first = import_study(db, settings, exported, "It")
    delete_study(db, first.study_id)
    other = changed(exported, tmp_path / "other.zip", lambda listed: listed["study"].update(note="Another."))
    second = import_study(db, settings, other, "It")

    import_study(db, settings, exported, "It")

    names = {study.id: study.name for study in list_studies(db, 10)}
    assert names == {first.study_id: "Two methods (2)", second.study_id: "Two methods"}


def test_two_imports_of_the_same_file_at_once_are_one(db: Database, settings: Settings, exported: Path) -> None:
    with ThreadPoolExecutor(4) as pool:
        imports = list(pool.map(lambda _: import_study(db, settings, exported, "It"), range(4)))

    assert sorted(imported.already_there for imported in imports) == [False, True, True, True]
    for run in (run for cell in get_study(db, imports[0].study_id).cells for run in cell.runs):
        for file in list_files(db, run.run_id):
            assert checksum(FileStorage(settings).bring(file)) == file.sha256


def test_what_was_removed_comes_back_with_the_same_file(db: Database, settings: Settings, exported: Path) -> None:
    study_id = import_study(db, settings, exported, "It").study_id
    run_id = get_study(db, study_id).cells[0].runs[0].run_id
    before = everything_below(settings.runs_directory), list_episodes(db, run_id, *ALL_EPISODES)
    removed = apply_retention(db, settings, plan_retention(db, settings, Rule(frozenset({Removable.EPISODES}), 0)))
    policy = settings.run_directory(run_id) / "policy-best.pt"
    policy.unlink()
    assert removed.files == 4

    again = import_study(db, settings, exported, "It")

    assert again.already_there
    assert everything_below(settings.runs_directory) == before[0]
    assert list_episodes(db, run_id, *ALL_EPISODES) == before[1]
    assert finish_removals(db, settings).files == 0


def test_a_long_note_is_shortened_by_what_the_import_says(
    db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    long = changed(exported, tmp_path / "long.zip", lambda listed: listed["study"].update(note="x" * LONGEST_NOTE))

    study_id = import_study(db, settings, long, "It").study_id

    note = get_study(db, study_id).study.note
    assert len(note) == LONGEST_NOTE
    assert "\n\nImported from a study file made " in note
    pack_study(db, settings, study_id, tmp_path / "again.zip")
    with db.write() as conn:  # as an earlier version left it
        conn.execute(update(studies).where(studies.c.id == study_id).values(note=note + note))
    pack_study(db, settings, study_id, tmp_path / "older.zip")


def test_a_name_that_is_taken_gets_a_number(db: Database, settings: Settings, exported: Path, tmp_path: Path) -> None:
    import_study(db, settings, exported, "It")
    other = changed(exported, tmp_path / "other.zip", lambda listed: listed["study"].update(note="Another."))

    second = import_study(db, settings, other, "It")

    assert get_study(db, second.study_id).study.name == "Two methods (2)"


def test_a_study_whose_name_has_several_lines_is_exported(db: Database, settings: Settings, tmp_path: Path) -> None:
    study_id = trained_study(db, settings)
    with db.write() as conn:
        conn.execute(update(studies).where(studies.c.id == study_id).values(name="push\there\nor there"))

    pack_study(db, settings, study_id, tmp_path / "study.zip")

    assert json.loads(members_of(tmp_path / "study.zip")["study.json"])["study"]["name"] == "push here or there"


def test_what_was_imported_can_be_exported_again(
    db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    imported = import_study(db, settings, exported, "It")

    packed = pack_study(db, settings, imported.study_id, tmp_path / "again.zip")

    assert (packed.runs, packed.left_out) == (5, 0)
    curves = [content for name, content in members_of(exported).items() if name.startswith("metrics/")]
    again = [content for name, content in members_of(tmp_path / "again.zip").items() if name.startswith("metrics/")]
    assert sorted(again) == sorted(curves)


@pytest.mark.parametrize(("episodes_of", "seeds"), [("every", {0, 1}), ("first-seed", {0}), ("none", set())])
def test_a_smaller_file_has_the_episodes_of_fewer_runs(
    db: Database, settings: Settings, exported: Path, tmp_path: Path, episodes_of: EpisodeChoice, seeds: set[int]
) -> None:
    imported = import_study(db, settings, exported, "It")

    pack_study(db, settings, imported.study_id, tmp_path / "smaller.zip", episodes_of)

    again = import_study(db, settings, tmp_path / "smaller.zip", "It")
    cells = get_study(db, again.study_id).cells
    assert len(cells) == 2
    for run in (run for cell in cells for run in cell.runs):
        names = {file.name for file in list_files(db, run.run_id)}
        assert names - {"policy-best.pt"} == ({"episodes-epoch-0003.npz"} if run.seed in seeds else set())
        assert list_episodes(db, run.run_id, EpisodeFilter(), "epoch", True, 10, 0).total == (run.seed in seeds)


def test_weights_may_be_made_smaller_on_the_way_and_nothing_else(
    db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    imported = import_study(db, settings, exported, "It")

    pack_study(
        db, settings, imported.study_id, tmp_path / "smaller.zip", read_weights=lambda path: path.read_bytes()[1:]
    )

    by_length = {}
    for which, source in (("whole", exported), ("smaller", tmp_path / "smaller.zip")):
        for name, content in members_of(source).items():
            by_length.setdefault(name.partition("/")[2].partition("/")[2], {}).setdefault(which, []).append(
                len(content)
            )
    for name, lengths in by_length.items():
        less = 1 if name.endswith(".pt") else 0
        if name:
            assert sorted(lengths["smaller"]) == sorted(length - less for length in lengths["whole"]), name
    listed = json.loads(members_of(tmp_path / "smaller.zip")["study.json"])
    files = {f"runs/{run['key']}/{file['name']}": file for run in listed["runs"] for file in run["files"]}
    assert len(files) == 9
    for name, file in files.items():
        content = members_of(tmp_path / "smaller.zip")[name]
        assert (file["size"], file["sha256"]) == (len(content), hashlib.sha256(content).hexdigest())


def test_each_run_tells_what_trained_it_and_names_nobody(
    db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    imported = import_study(db, settings, exported, "It")
    trained, other = (run.run_id for run in get_study(db, imported.study_id).cells[0].runs)
    worker_id = register_worker(db, "a-name", 1, 1, Machine(cores=16, processor="AMD EPYC", gpu="NVIDIA H200"))
    with db.write() as conn:
        conn.execute(update(attempts).where(attempts.c.run_id == trained).values(worker_id=worker_id, host="a-name"))

    pack_study(db, settings, imported.study_id, tmp_path / "again.zip")

    listed = members_of(tmp_path / "again.zip")["study.json"].decode()
    told = {run["key"]: run["machine"] for run in json.loads(listed)["runs"]}
    assert told[trained] == f"{platform.machine()}, 16 cores of AMD EPYC, NVIDIA H200"
    # By the worker that these runs came from.
    assert told[other] == f"{platform.machine()}, 64 cores, H100"
    assert "a-name" not in listed


def test_what_trained_a_run_is_known_where_it_was_imported_and_wherever_it_goes_from_there(
    db: Database, settings: Settings, exported: Path, tmp_path: Path
) -> None:
    def name_the_first(listed: dict[str, Any]) -> None:
        listed["runs"][0]["machine"] = "x86_64, 1 core, no GPU"

    imported = import_study(db, settings, changed(exported, tmp_path / "known.zip", name_the_first), "It")

    with db.read() as conn:
        hosts = [row.host for row in conn.execute(select(attempts))]
    assert imported.runs == len(hosts) == 5
    assert hosts.count("x86_64, 1 core, no GPU") == 1
    pack_study(db, settings, imported.study_id, tmp_path / "again.zip")
    packed = json.loads(members_of(tmp_path / "again.zip")["study.json"])
    assert sorted(run["machine"] for run in packed["runs"]) == sorted(hosts)


def test_a_study_of_which_nothing_has_succeeded_is_not_packed(db: Database, settings: Settings, tmp_path: Path) -> None:
    study_id = create_study(db, "Just begun", SPEC).study_id

    with pytest.raises(Refused, match="No run of study 'Just begun' has succeeded yet"):
        pack_study(db, settings, study_id, tmp_path / "out.zip")
    with pytest.raises(NotFound):
        pack_study(db, settings, "nothing", tmp_path / "out.zip")
    assert not (tmp_path / "out.zip").exists()


def test_a_study_that_no_import_would_take_is_not_packed(
    db: Database, settings: Settings, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    study_id = trained_study(db, settings)
    monkeypatch.setattr("backend.store.study_files.packing.LARGEST_SUM", 2000)

    with pytest.raises(Refused, match=r"'Two methods' holds more than .* --episodes-of none --half"):
        pack_study(db, settings, study_id, tmp_path / "study.zip")

    assert not list(tmp_path.glob("*study*"))


def test_what_has_not_succeeded_is_left_out(db: Database, settings: Settings, tmp_path: Path) -> None:
    study_id = trained_study(db, settings)

    extend_study(db, study_id, Addition(seeds=(7,)))

    packed = pack_study(db, settings, study_id, tmp_path / "out.zip")

    assert (packed.runs, packed.left_out) == (5, 2)
    assert not any("checkpoint" in name for name in members_of(tmp_path / "out.zip"))
