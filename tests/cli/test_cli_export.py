"""`sldr export`: what it writes, and what it says of what it cannot."""

from __future__ import annotations

import csv
import json
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from store_cases import run_on_two_models
from store_samples import SampleSize, fill_store

from backend.store.database import open_database
from backend.store.metrics import read_metrics
from backend.store.runs import RunFilter, list_runs
from backend.store.settings import HOME_VARIABLE, Settings, sqlite_url
from worker.cli import main

Export = Callable[..., tuple[int, str, str]]


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data directory with three runs."""
    home = tmp_path_factory.mktemp("exported")
    db = open_database(Settings(home=home, database_url=sqlite_url(home)))
    fill_store(db, SampleSize(tasks=("FetchPush",), methods=("her",), seeds=3, epochs=4))
    db.close()
    return home


@pytest.fixture
def export(home: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Export:
    """Return a way to run the command: exit code and what it printed."""
    monkeypatch.setenv(HOME_VARIABLE, str(home))
    monkeypatch.delenv("SLDR_DATABASE_URL", raising=False)

    def run(*arguments: str) -> tuple[int, str, str]:
        with pytest.raises(SystemExit) as ended:
            main(["export", *arguments])
        printed = capsys.readouterr()
        assert isinstance(ended.value.code, int)
        return ended.value.code, printed.out, printed.err

    return run


@pytest.fixture
def two_models(tmp_path: Path, export: Export, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Let the command look at runs that differ in nothing but their locomotion model; return the ids of all runs."""
    monkeypatch.setenv(HOME_VARIABLE, str(tmp_path))
    db = open_database(Settings(home=tmp_path, database_url=sqlite_url(tmp_path)))
    ids = run_on_two_models(db)
    db.close()
    return ids


def test_the_numbers_of_a_figure_are_written(export: Export, tmp_path: Path):
    out = tmp_path / "curves.csv"
    code, printed, _ = export("figure", "--out", str(out), "--x", "env_steps")
    rows = list(csv.DictReader(out.read_text(encoding="utf-8").splitlines()))
    assert (code, printed.strip()) == (0, str(out))
    assert [row["env_steps"] for row in rows] == ["95000.0", "190000.0", "285000.0", "380000.0"]


def test_a_figure_is_drawn(export: Export, tmp_path: Path):
    out = tmp_path / "best.svg"
    assert export("figure", "--out", str(out), "--kind", "best", "--width", "single")[0] == 0
    assert "<svg" in out.read_text(encoding="utf-8")


def test_a_figure_of_no_known_kind_is_refused(export: Export, tmp_path: Path):
    code, _, told = export("figure", "--out", str(tmp_path / "curves.gif"))
    assert (code, "There are: csv, pdf, png, svg, tex" in told) == (2, True)


def test_a_bundle_is_packed(export: Export, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("backend.figures.bundle.draw_apart", lambda drawings: [b"drawn"] * len(drawings))
    out = tmp_path / "bundle.zip"
    assert export("bundle", "--out", str(out), "--anonymous")[0] == 0
    with zipfile.ZipFile(out) as archive:
        assert "configs/run-0003.json" in archive.namelist()


def test_an_anonymous_bundle_holds_no_ids(
    export: Export, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, two_models: list[str]
):
    monkeypatch.setattr("backend.figures.bundle.draw_apart", lambda drawings: [b"drawn"] * len(drawings))
    out = tmp_path / "bundle.zip"
    assert export("bundle", "--out", str(out), "--anonymous")[0] == 0
    with zipfile.ZipFile(out) as archive:
        told = "\n".join(archive.read(name).decode() for name in archive.namelist())
    assert "locomotion 2" in told
    assert [run_id for run_id in two_models if run_id in told] == []


def test_runs_that_do_not_exist_are_told(export: Export, tmp_path: Path):
    code, _, told = export("tensorboard", "--out", str(tmp_path), "--task", "FetchSlide")
    assert (code, "none passes" in told) == (2, True)


UNKNOWN = {
    "task": ("--task", "FetchPsh", "No task is called 'FetchPsh'. Did you mean 'FetchPush'?"),
    "method": ("--method", "hre", "No method is called 'hre'. Did you mean 'her'?"),
    "preset": ("--preset", "papr", "No preset is called 'papr'. Did you mean 'paper'?"),
    "metric": ("--metric", "test/succes_rate", "No metric of these runs is called 'test/succes_rate'. Did you mean"),
    "run": ("--run", "0123456789ab", "run: no '0123456789ab' passes these options"),
    "study": ("--study", "0123456789ab", "There is no study '0123456789ab'"),
    "no runs of it": ("--task", "FetchSlide", "runs: none passes these options"),
}


@pytest.mark.parametrize("what", ["figure", "bundle"])
@pytest.mark.parametrize(("option", "name", "sentence"), UNKNOWN.values(), ids=UNKNOWN)
def test_a_name_that_nobody_knows_is_told(
    export: Export, tmp_path: Path, what: str, option: str, name: str, sentence: str
):
    out = tmp_path / {"figure": "curves.csv", "bundle": "bundle.zip"}[what]
    code, _, told = export(what, "--out", str(out), option, name)
    assert (code, sentence in told, out.exists()) == (2, True, False), told


def test_tensorboard_reads_back_every_point(export: Export, home: Path, tmp_path: Path):
    from tensorboard.backend.event_processing.event_file_loader import EventFileLoader

    code, printed, _ = export("tensorboard", "--out", str(tmp_path))
    db = open_database(Settings(home=home, database_url=sqlite_url(home)))
    [run] = [row for row in list_runs(db, RunFilter(), 10).rows if row.seed == 1]
    directory = next(Path(line) for line in printed.splitlines() if line.endswith(run.id))
    [events] = directory.glob("events.*")
    told = {
        (event.step, value.tag): value.tensor.float_val[0]
        for event in EventFileLoader(str(events)).Load()
        for value in event.summary.value
    }
    own = read_metrics(db, run.id)
    db.close()
    expected = {
        (step, name): pytest.approx(value, rel=1e-6)
        for name, column in own.values.items()
        for step, value in zip(own.env_steps, column, strict=True)
    }
    assert code == 0
    assert told == expected
    assert json.loads((directory / "config.json").read_text(encoding="utf-8")) == run.config


def test_an_earlier_export_is_not_mixed_with_a_new_one(export: Export, tmp_path: Path):
    arguments = ("tensorboard", "--out", str(tmp_path))
    assert export(*arguments)[0] == 0
    code, _, told = export(*arguments)
    assert (code, "--overwrite" in told) == (2, True)
    assert export(*arguments, "--overwrite")[0] == 0


def test_a_missing_library_is_told_with_the_extra_that_brings_it(export: Export, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "mlflow", None)
    code, _, told = export("mlflow", "--uri", "file:/nowhere")
    assert (code, "pip install '.[mlflow]'" in told) == (2, True)
