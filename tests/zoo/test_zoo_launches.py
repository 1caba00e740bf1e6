"""A launch takes its locomotion models from the zoo, trains its own, or takes those of runs that a person names."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from zoo_cases import TASK

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.files import find_file
from backend.store.labels import select_tags
from backend.store.launches import LaunchOrder, launch, plan_launch
from backend.store.queue import claim
from backend.store.runs import get_run, get_runs
from backend.store.settings import Settings
from backend.store.states import RunState
from backend.store.storage import FileStorage
from backend.store.studies.launch import create_study, fill_study
from backend.store.studies.spec import StudySpec
from backend.store.zoo_runs import ZooShelf
from sldr_core.errors import BadFile, InvalidConfig
from sldr_core.zoo.index import ZooModel
from worker.cli.commands import launch as launch_command
from worker.cli.commands import list as list_command
from worker.locomotion_files import find_locomotion_models


def order(locomotion: str = "zoo", task: str = TASK, **changes) -> LaunchOrder:
    values = {"method": "her-sldr", "seeds": (0, 1), "preset": "smoke", **changes}
    return LaunchOrder(task, "manipulation", locomotion=locomotion, **values)


@pytest.fixture
def shelf(settings: Settings, zoo: ZooModel) -> ZooShelf:
    return ZooShelf(settings)


def test_the_zoo_s_model_is_imported_once_and_its_runs_are_queued_at_once(
    db: Database, settings: Settings, shelf: ZooShelf, zoo: ZooModel
) -> None:
    assert [planned.model for planned in plan_launch(db, order(), shelf)] == [zoo, None, None]
    assert not settings.runs_directory.exists(), "a plan changes nothing"

    model_run, *robots = get_runs(db, launch(db, order(), shelf))

    assert (model_run.state, model_run.success_rate) == (RunState.SUCCEEDED, zoo.measured.success_rate)
    with db.read() as conn:
        assert select_tags(conn, [model_run.id]) == {model_run.id: ("zoo",)}
    assert [run.state for run in robots] == [RunState.QUEUED, RunState.QUEUED]
    again = launch(db, order(seeds=(2,)), shelf)
    assert again[0] == model_run.id
    assert len(list(settings.runs_directory.iterdir())) == 1


def test_a_worker_is_given_the_shipped_bytes(db: Database, settings: Settings, shelf: ZooShelf, zoo: ZooModel) -> None:
    launch(db, order(), shelf)
    held = claim(db, "worker-1", 60.0)
    assert isinstance(held, Claim)

    [model] = find_locomotion_models(db, settings, held)

    assert model.read_bytes() == zoo.path.read_bytes()
    assert model.is_relative_to(settings.home)


def test_the_gate_holds_with_the_measured_success(db: Database, shelf: ZooShelf) -> None:
    _, robot = get_runs(db, launch(db, order(seeds=(0,), overrides={"sldr": {"gate": 0.99}}), shelf))

    assert robot.state is RunState.BLOCKED
    assert "below the gate of 99.0%" in str(robot.reason)


def test_what_the_zoo_lacks_is_trained(db: Database, shelf: ZooShelf) -> None:
    locomotion, robot = get_runs(db, launch(db, order(task="FetchSlide", seeds=(0,)), shelf))

    assert (locomotion.task, locomotion.state) == ("FetchSlide", RunState.QUEUED)
    assert robot.state is RunState.BLOCKED


def test_a_launch_may_train_its_own(db: Database, shelf: ZooShelf) -> None:
    locomotion, _ = get_runs(db, launch(db, order("train", seeds=(0,)), shelf))

    assert locomotion.state is RunState.QUEUED


def test_a_launch_may_name_the_run(db: Database, shelf: ZooShelf) -> None:
    own = launch(db, LaunchOrder(TASK, "locomotion", "her", (7,), "smoke"))[0]

    assert launch(db, order(own, seeds=(0,)), shelf)[0] == own


@pytest.mark.parametrize("task", ["FetchSlide", "HandBlockFull"])
def test_a_named_run_of_another_task_is_refused(db: Database, shelf: ZooShelf, task: str) -> None:
    own = launch(db, LaunchOrder(TASK, "locomotion", "her", (7,), "smoke"))[0]

    with pytest.raises(InvalidConfig, match="is needed too"):
        launch(db, order(own, task=task), shelf)


@pytest.mark.parametrize(("choice", "problem"), [("nothing", "there is no run 'nothing'"), (" , ", "there is no run")])
def test_a_run_that_is_not_there_is_named(db: Database, shelf: ZooShelf, choice: str, problem: str) -> None:
    with pytest.raises(InvalidConfig, match=problem):
        plan_launch(db, order(choice), shelf)


def test_a_run_of_the_robot_has_no_model_to_give(db: Database, shelf: ZooShelf) -> None:
    robot = launch(db, order(method="her", seeds=(0,)), shelf)[0]

    with pytest.raises(InvalidConfig, match="of the robot"):
        plan_launch(db, order(robot), shelf)


def test_a_damaged_model_stops_the_launch_and_leaves_no_run(
    db: Database, settings: Settings, shelf: ZooShelf, zoo: ZooModel, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "zoo").mkdir()
    content = json.loads((zoo.path.parent / "index.json").read_text())
    (tmp_path / "zoo" / "index.json").write_text(json.dumps(content))
    (tmp_path / "zoo" / zoo.path.name).write_bytes(b"something else")
    monkeypatch.setenv("SLDR_ZOO", str(tmp_path / "zoo"))

    with pytest.raises(BadFile, match="not the one that was measured"):
        launch(db, order(), ZooShelf(settings))

    assert claim(db, "worker-1", 60.0) is None


def test_a_study_keeps_its_choice(db: Database, settings: Settings, shelf: ZooShelf) -> None:
    spec = StudySpec((TASK,), ("her", "her-sldr"), (0,), "smoke", locomotion="zoo")

    launched = create_study(db, "With the zoo", spec, shelf=shelf)

    assert launched.queued == 2, "the model's run is there and is not queued"
    assert fill_study(db, launched.study_id, shelf).queued == 0
    [model_run] = list(settings.runs_directory.iterdir())
    row = find_file(db, model_run.name, "locomotion.pt")
    assert FileStorage(settings).bring(row) == model_run / "locomotion.pt"
    assert get_run(db, model_run.name).state is RunState.SUCCEEDED


def test_models_are_listed_for_people_and_programs(zoo: ZooModel, capsys: pytest.CaptureFixture[str]) -> None:
    list_command.main(["models"])
    told = capsys.readouterr().out
    list_command.main(["models", "--json"])
    [entry] = json.loads(capsys.readouterr().out)

    assert told.startswith("FetchPush  position")
    assert "of 2 episodes" in told
    assert (entry["name"], entry["sha256"]) == ("FetchPush", zoo.sha256)


@pytest.mark.parametrize(("locomotion", "word", "queued"), [("zoo", "zoo", 2), ("train", "new", 3)])
def test_a_study_says_where_its_model_comes_from_as_a_launch_does(
    locomotion: str,
    word: str,
    queued: int,
    zoo: ZooModel,
    settings: Settings,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name, value in settings.as_environment().items():
        monkeypatch.setenv(name, value)
    asked = ["--task", TASK, "--preset", "smoke", "--seeds", "0-1", "--locomotion", locomotion, "--dry-run"]

    launch_command.main(asked)
    alone = capsys.readouterr().out
    launch_command.main([*asked, "--study", "two"])
    study = capsys.readouterr().out

    assert alone.split()[:3] == study.split()[:3] == [word, TASK, "locomotion"]
    assert f"{queued} to be queued" in study


def test_an_empty_zoo_is_told(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path) -> None:
    monkeypatch.setenv("SLDR_ZOO", str(tmp_path))

    list_command.main(["models"])

    assert "is empty" in capsys.readouterr().out
