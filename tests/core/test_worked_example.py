"""What docs/extending.md adds, applied to a copy of the library: it trains, with the new reward and its critic."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/extending.md").read_text()

STEP = re.compile(
    r"^\*\*(In|New file)\*\* `(?P<path>[^`]+)`$|^```(?P<kind>diff|python)\n(?P<code>.*?)^```$", re.M | re.S
)
"""The name of a file, or a block that is for the file named last."""

TINY = ("loop.epochs=1", "loop.cycles_per_epoch=2", "loop.updates_per_cycle=2", "loop.episodes_per_cycle=2")
TINY += ("loop.batch_size=16", "loop.test_episodes=2", "agent.hidden_sizes=[8,8]", "replay.capacity=1000")
"""Laid over the smoke preset: over in a second."""

PROBE = """
import sys
from pathlib import Path
import sldr_core
assert Path(sldr_core.__file__).is_relative_to(sys.argv[1]), sldr_core.__file__
exec(compile(Path(sys.argv[1], "tests/core/test_near_stream.py").read_text(), "the page's test", "exec"))
test_five_centimetres_cost_a_half_and_a_metre_costs_one()
import gymnasium
from sldr_core.registration import register_envs
register_envs()
gymnasium.make("sldr/FetchPushNear-v0").close()
from worker.cli import main
main(sys.argv[2:])
"""
"""Run the page's own test and one command line, in a process that knows the copy alone."""

ENDED_WITHIN_S = 600
"""Everything is over by then, even on a busy machine [s]."""


def apply_change(text: str, change: str) -> str:
    """Return a text with a change in the form of `diff -u`, whose lines must stand in it exactly once."""
    lines = change.splitlines(keepends=True)
    old = "".join(line.removeprefix(line[0].strip("\n")) for line in lines if line[0] != "+")
    new = "".join(line.removeprefix(line[0].strip("\n")) for line in lines if line[0] != "-")
    assert text.count(old) == 1, f"stands there {text.count(old)} times:\n{old}"
    return text.replace(old, new)


@pytest.fixture(scope="module")
def extended(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a directory with a copy of the library to which all that the page says has been done."""
    copy = tmp_path_factory.mktemp("extended")
    shutil.copytree(ROOT / "sldr_core", copy / "sldr_core", ignore=shutil.ignore_patterns("__pycache__"))
    (copy / "tests/core").mkdir(parents=True)
    file = copy
    for step in STEP.finditer(PAGE):
        if step["path"]:
            file = copy / step["path"]
        elif step["kind"] == "python":
            assert not file.exists()
            file.write_text(step["code"])
        else:
            file.write_text(apply_change(file.read_text(), step["code"]))
    return copy


def run_with(extended: Path, *words: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": f"{extended}:{ROOT}", "SLDR_HOME": str(extended / "home")}
    return subprocess.run(
        [sys.executable, "-W", "error::SyntaxWarning", "-c", PROBE, str(extended), *words],
        env=environment,
        cwd=extended,
        capture_output=True,
        text=True,
        timeout=ENDED_WITHIN_S,
        check=False,
    )


@pytest.mark.timeout(ENDED_WITHIN_S + 60)
def test_the_page_s_own_command_trains_with_the_new_reward(extended: Path) -> None:
    (command,) = re.findall(r"^sldr (train .*)$", PAGE, re.MULTILINE)
    settings = [word for setting in TINY for word in ("--set", setting)]
    done = run_with(extended, *command.split(), *settings)
    assert done.returncode == 0, done.stderr
    lines = (extended / "runs/near/metrics.jsonl").read_text().splitlines()
    metrics = json.loads(lines[-1])["metrics"]
    assert -1.0 <= metrics["stream/near/mean"] < 0.0
    assert metrics["critic/near/loss"] > 0.0
    assert metrics["critic/task/loss"] > 0.0


def test_the_files_of_the_page_are_in_the_style_of_the_rest(extended: Path) -> None:
    changed = sorted({step["path"] for step in STEP.finditer(PAGE) if step["path"]})
    assert len(changed) == 7
    for check in (["check"], ["format", "--check"]):
        command = [
            sys.executable,
            "-m",
            "ruff",
            *check,
            "--no-cache",
            "--config",
            str(ROOT / "pyproject.toml"),
            *changed,
        ]
        done = subprocess.run(command, cwd=extended, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr


def test_a_change_that_no_longer_fits_is_noticed() -> None:
    with pytest.raises(AssertionError, match="0 times"):
        apply_change("one\ntwo\n", " one\n+between\n three\n")
    assert apply_change("one\ntwo\n", " one\n+between\n two\n") == "one\nbetween\ntwo\n"
