"""`sldr launch` and `sldr runs`, as typed."""

from __future__ import annotations

import json

import pytest
from command_line import run, use

from backend.store.database import Database
from backend.store.run_filter import RunFilter
from backend.store.runs import list_runs
from backend.store.settings import Settings
from backend.store.studies.matrix import list_studies

ONE = ("launch", "--task", "FetchPush", "--method", "her-sldr", "--preset", "smoke", "--seeds", "0-1")
STUDY = (*ONE, "--method", "her", "--study", "both")


@pytest.fixture(autouse=True)
def _in_the_store(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> None:
    use(settings, monkeypatch)


def test_a_dry_run_says_what_a_launch_then_does(capsys: pytest.CaptureFixture[str], db: Database):
    _, planned, _ = run(capsys, *ONE, "--dry-run")
    assert [line.split()[:4] for line in planned.splitlines()] == [
        ["new", "FetchPush", "locomotion", "her"],
        ["new", "FetchPush", "manipulation", "her-sldr"],
        ["new", "FetchPush", "manipulation", "her-sldr"],
    ]
    assert list_runs(db, RunFilter(), 1).total == 0
    code, out, _ = run(capsys, *ONE)
    assert (code, out.startswith(planned)) == (0, True)
    assert {row.id for row in list_runs(db, RunFilter(), 10).rows} == {
        line.split()[1] for line in out.splitlines() if line.startswith("queued")
    }


def test_a_study_is_launched_and_joins_what_is_there(capsys: pytest.CaptureFixture[str], db: Database):
    run(capsys, *ONE)
    _, planned, _ = run(capsys, *STUDY, "--dry-run")
    assert "her-sldr" in planned
    assert "2 reused" in planned
    assert "2 to be queued, nobody knows how long yet (2 are unlike any that succeeded here)" in planned
    code, out, _ = run(capsys, *STUDY)
    (study,) = list_studies(db, 10)
    assert (code, study.name, study.spec.methods) == (0, "both", ("her-sldr", "her"))
    assert out.splitlines()[-1] == f"Study {study.id} 'both': 2 runs queued, 2 reused."


def test_a_template_can_be_changed(capsys: pytest.CaptureFixture[str], db: Database):
    run(capsys, "launch", "--template", "paper-stack", "--preset", "smoke", "--seeds", "3", "--study", "stacks")
    (study,) = list_studies(db, 10)
    assert (study.spec.tasks, study.spec.seeds, study.spec.size) == (("FetchStack2", "FetchStack3"), (3,), 14)


def test_a_setting_is_laid_over_those_of_a_template(capsys: pytest.CaptureFixture[str], db: Database):
    run(capsys, "launch", "--template", "two-minutes", "--set", "loop.batch_size=64", "--study", "small")
    (study,) = list_studies(db, 10)
    assert (study.spec.overrides["loop"]["epochs"], study.spec.overrides["loop"]["batch_size"]) == (5, 64)


def test_runs_are_listed_for_people_and_for_programs(capsys: pytest.CaptureFixture[str], db: Database):
    run(capsys, *ONE)
    _, lines, _ = run(capsys, "runs", "--phase", "manipulation", "--limit", "1")
    head, first, more = lines.splitlines()
    assert head.split()[:3] == ["ID", "STATE", "TASK"]
    assert first.split()[1:6] == ["blocked", "FetchPush", "manipulation", "her-sldr", "1"]
    assert more == "1 of 2 runs; --limit shows more."
    _, out, _ = run(capsys, "runs", "--json", "--state", "queued")
    (queued,) = json.loads(out)
    assert (queued["phase"], queued["config"]["loop"]["epochs"]) == ("locomotion", 2)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("launch",), "task: 0 are given; give one, or name a study with --study"),
        ((*ONE, "--task", "FetchSlide"), "task: 2 are given"),
        (("launch", "--task", "FetchPus"), "Did you mean 'FetchPush'?"),
        ((*ONE[:-1], "4-0"), "seeds: the range 4-0 runs backwards"),
        ((*ONE[:-1], "two"), "seeds: 'two' is no seed"),
        (("launch", "--template", "papr"), "Did you mean 'paper'?"),
        (("launch", "--study", "s"), "tasks: none is given"),
        ((*STUDY, "--phase", "locomotion"), "phase: a study is of the robot"),
        (("runs", "--state", "runing"), "Did you mean 'running'?"),
        (("runs", "--limit", "0"), "limit: it must be between 1 and"),
    ],
)
def test_what_cannot_work_is_told_in_one_sentence(
    capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], sentence: str
):
    code, out, err = run(capsys, *arguments)
    assert (code, out, len(err.splitlines())) == (2, "", 1)
    assert sentence in err
