"""Study files on the command line: written, taken in, and drawn from without a store."""

from __future__ import annotations

from pathlib import Path

import pytest
from study_file_cases import trained_study

from backend.samples import SAMPLE_VARIABLE
from backend.store.database import Database
from backend.store.settings import DATABASE_VARIABLE, HOME_VARIABLE, Settings
from worker.cli import main


@pytest.fixture
def sldr(settings: Settings, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]):
    """Return a way to run a command in this process: its exit code and what it says."""
    monkeypatch.setenv(HOME_VARIABLE, str(settings.home))
    monkeypatch.setenv(DATABASE_VARIABLE, settings.database_url)

    def run(*words: str) -> tuple[int | str | None, str, str]:
        with pytest.raises(SystemExit) as ended:
            main(words)
        told = capsys.readouterr()
        return ended.value.code, told.out, told.err

    return run


def test_a_study_is_exported_and_imported(sldr, db: Database, settings: Settings, tmp_path: Path) -> None:
    study_id = trained_study(db, settings)

    code, out, _ = sldr("export", "--study", study_id, str(tmp_path / "out.zip"))
    assert (code, out) == (0, f"{tmp_path / 'out.zip'}: 5 runs, 0.0 MB\n")
    code, out, _ = sldr("import", str(tmp_path / "out.zip"))
    assert (code, out.split()[2:]) == (0, ["holds", "5", "runs."])
    code, out, _ = sldr("import", str(tmp_path / "out.zip"))
    assert (code, out.split()[2:]) == (0, ["was", "there", "already."])


def test_what_cannot_be_halved_is_named_and_nothing_is_left(
    sldr, db: Database, settings: Settings, tmp_path: Path
) -> None:
    study_id = trained_study(db, settings)

    code, _, err = sldr("export", "study", study_id, str(tmp_path / "out.zip"), "--half")

    assert code == 2
    assert "locomotion.pt is corrupt or no file of ours" in err
    assert not list(tmp_path.glob("out*"))


def test_a_figure_is_drawn_from_a_study_file_alone(
    sldr, exported: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(SAMPLE_VARIABLE, str(exported))
    for name, source in (("one.csv", str(exported)), ("two.csv", "sample")):
        assert sldr("export", "figure", "--out", str(tmp_path / name), "--study-file", source)[0] == 0

    lines = (tmp_path / "one.csv").read_text().splitlines()
    assert lines == (tmp_path / "two.csv").read_text().splitlines()
    assert len([line for line in lines if "FetchPush" in line]) >= 6


@pytest.mark.parametrize(
    "words", [("import", "none.zip"), ("export", "figure", "--out", "x.csv", "--study-file", "no")]
)
def test_a_file_that_is_not_there_is_named(sldr, words: tuple[str, ...]) -> None:
    code, _, err = sldr(*words)

    assert code == 2
    assert "There is no" in err
    assert len(err.splitlines()) == 1
