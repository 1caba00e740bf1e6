"""`sldr train` and `sldr evaluate`, as a person uses them."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from rich.console import Console

from sldr_core.presets import make_config
from sldr_core.records import Step
from worker.cli import main
from worker.cli.progress import ShownProgress, ShownRecorder, describe, duration
from worker.cli.settings import parse_settings

SLDR = (sys.executable, "-m", "worker.cli")
OBJECT = ("train", "--task", "FetchPush", "--phase", "locomotion", "--preset", "smoke", "--set", "compute.threads=1")
PATIENCE_S = 120
STEP = Step(cycle=4, epoch=2, env_steps=800, episodes=16, updates=16, wall_seconds=1.5)
NUMBERS = {
    "test/success_rate": 0.5,
    "test/best_success_rate": 0.75,
    "speed/env_steps_per_s": 3210.0,
    "speed/updates_per_s": 98.7,
    "progress/fraction": 0.4,
    "progress/seconds_left": 75.0,
}


def sldr(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Run a command in this process; return its exit code and what it printed."""
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    printed = capsys.readouterr()
    assert isinstance(ended.value.code, int)
    return ended.value.code, printed.out, printed.err


class KeptRecorder:
    """A recorder that remembers what it was given."""

    directory = Path("here")

    def __init__(self) -> None:
        self.logged: list[Step] = []

    def log(self, step: Step, metrics: object) -> None:
        self.logged.append(step)

    def save_file(self, name: str, kind: str, write: object) -> Path:
        return self.directory / name

    def record_episodes(self, test: object, kept_epochs: object) -> None:
        raise AssertionError("no test was held")

    def stop_requested(self) -> None:
        return None


def test_the_line_tells_epoch_success_speed_and_time_left():
    line = describe(STEP, 10, NUMBERS)
    assert line == "epoch 2/10, success 50% (best 75%), 3,210 steps/s, 99 updates/s, 1 min 15 s left"


def test_what_is_not_known_yet_is_left_out():
    assert describe(STEP, 10, {}) == "epoch 2/10"


@pytest.mark.parametrize(
    ("seconds", "words"), [(0.4, "0 s"), (59, "59 s"), (61, "1 min 1 s"), (1234, "20 min"), (7265, "2 h 1 min")]
)
def test_time_spans_are_told_in_two_units_at_most(seconds: float, words: str):
    assert duration(seconds) == words


@pytest.mark.parametrize("is_terminal", [True, False])
def test_the_recorder_shows_what_it_passes_on(tmp_path: Path, is_terminal: bool):
    config = make_config("FetchPush", "locomotion", "her", 0, "smoke")
    kept = KeptRecorder()
    with (tmp_path / "screen").open("w") as screen:
        console = Console(file=screen, force_terminal=is_terminal, width=120)
        with ShownProgress(config, console) as progress:
            ShownRecorder(kept, progress).log(STEP, NUMBERS)
    assert kept.logged == [STEP]
    assert "success 50% (best 75%)" in (tmp_path / "screen").read_text()


def test_settings_are_nested_and_read_as_json_where_they_are_json():
    words = ["loop.batch_size=256", "agent.hidden_sizes=[32, 32]", "compute.device=cpu", "loop.epochs=3"]
    assert parse_settings(words) == {
        "loop": {"batch_size": 256, "epochs": 3},
        "agent": {"hidden_sizes": [32, 32]},
        "compute": {"device": "cpu"},
    }


def test_a_training_stopped_by_ctrl_c_goes_on_from_its_checkpoint(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    out = tmp_path / "out"
    training = (*OBJECT, "--out", str(out), "--set", "loop.epochs=12")
    first = subprocess.Popen([*SLDR, *training], stderr=subprocess.PIPE, text=True)
    metrics = out / "metrics.jsonl"
    deadline = time.monotonic() + PATIENCE_S
    while not metrics.exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    os.kill(first.pid, signal.SIGINT)
    _, told = first.communicate(timeout=PATIENCE_S)
    stopped_after = len(metrics.read_text().splitlines())
    assert first.returncode == 130
    assert "To go on from there: sldr train --task FetchPush" in told
    assert (out / "checkpoint.pt").exists()

    code, out_text, err_text = sldr(capsys, *training)
    cycles = [json.loads(line)["cycle"] for line in metrics.read_text().splitlines()]
    assert (code, out_text.startswith("Finished: ")) == (0, True), err_text
    assert stopped_after < 24
    assert cycles == list(range(1, 25))

    code, out_text, err_text = sldr(capsys, "evaluate", str(out / "policy-newest.pt"), "--episodes", "4")
    assert code == 0, err_text
    assert "of 4 episodes, 95 % interval" in out_text

    code, out_text, err_text = sldr(capsys, "replay", str(out / "episodes-epoch-0012.npz"))
    assert code == 0, err_text
    assert [line.split(":")[0] for line in out_text.splitlines()] == [f"episode {index}" for index in range(4)]
    assert out_text.count("50 steps, the same to the last bit") == 4


def test_a_corrupt_checkpoint_is_told_in_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    (tmp_path / "checkpoint.pt").write_bytes(b"PK\x03\x04 cut off")
    for arguments in (("evaluate", str(tmp_path / "checkpoint.pt")), (*OBJECT, "--out", str(tmp_path))):
        code, _, err = sldr(capsys, *arguments)
        assert code == 2
        assert "checkpoint.pt is corrupt" in err.splitlines()[-1]
        assert "Traceback" not in err
