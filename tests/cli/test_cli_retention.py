"""`sldr retention`, as typed."""

from __future__ import annotations

import pytest
from command_line import run, use

from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.outcomes import Succeeded
from backend.store.queue import claim, finish
from backend.store.settings import Settings
from backend.store.workers import register_worker


@pytest.fixture(autouse=True)
def _in_the_store(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> None:
    use(settings, monkeypatch)


def test_a_preview_comes_before_anything_goes(capsys: pytest.CaptureFixture[str], db: Database, settings: Settings):
    launch(db, LaunchOrder("FetchPush", "manipulation", "her", (0,), "smoke"))
    held = claim(db, register_worker(db, "here", 1, 1))
    assert held is not None
    replay = settings.run_directory(held.run_id) / "replay.bin"
    replay.parent.mkdir(parents=True)
    replay.write_bytes(b"x" * 3_000_000)
    finish(db, held, Succeeded(1.0))
    _, young, _ = run(capsys, "retention", "--preview")
    assert "Spared: 1 that ended less than 30 days ago" in young
    code, shown, _ = run(capsys, "retention", "--preview", "--older-than", "0")
    assert (code, f"3.0 MB  run {held.run_id}  FetchPush manipulation her seed 0, succeeded" in shown) == (0, True)
    assert replay.exists()
    code, out, _ = run(capsys, "retention", "--apply", "--older-than", "0", "--kind", "replay", "--kind", "videos")
    assert (code, "Removed 1 files of 1 runs: 3.0 MB." in out, replay.exists()) == (0, True, False)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((), "say one of --preview"),
        (("--preview", "--apply"), "say one of --preview"),
        (("--preview", "--kind", "replai"), "Did you mean 'replay'?"),
        (("--preview", "--older-than", "-1"), "it must be between 0 and 3650 days"),
    ],
)
def test_what_cannot_work_is_told_in_one_sentence(
    capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], sentence: str
):
    code, out, err = run(capsys, "retention", *arguments)
    assert (code, out) == (2, "")
    assert sentence in err
