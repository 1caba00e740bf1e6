"""The commands that answer at once, and what they say of input that cannot work."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from recorded_tests import made_episode, made_test

from sldr_core.episodes import write_episodes
from worker.cli import COMMANDS, main


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Run a command in this process; return its exit code and what it printed."""
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    printed = capsys.readouterr()
    assert isinstance(ended.value.code, int)
    return ended.value.code, printed.out, printed.err


def test_help_names_every_command(capsys: pytest.CaptureFixture[str]):
    code, out, _ = run(capsys, "--help")
    assert code == 0
    assert all(name in out for name in COMMANDS)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_explains_itself(capsys: pytest.CaptureFixture[str], command: str):
    code, out, _ = run(capsys, command, "--help")
    assert code == 0
    assert f"sldr {command}" in out


def test_listing_loads_nothing_heavy():
    program = (
        "import sys\n"
        "from worker.cli import main\n"
        "try: main(['list', 'tasks'])\n"
        "except SystemExit: pass\n"
        "print([name for name in ('torch', 'mujoco', 'fastapi', 'sqlalchemy', 'viser') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


@pytest.mark.parametrize(("kind", "name"), [("tasks", "FetchPush"), ("methods", "her-sldr"), ("presets", "quick")])
def test_lists_are_for_people_and_for_programs(capsys: pytest.CaptureFixture[str], kind: str, name: str):
    _, lines, _ = run(capsys, "list", kind)
    _, text, _ = run(capsys, "list", kind, "--json")
    assert name in lines
    assert name in [entry["name"] for entry in json.loads(text)]


TRAIN = ("train", "--task", "FetchPush", "--method", "her", "--preset", "smoke")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("fly",), "No command is called 'fly'."),
        (("train", "--task", "FetchPus"), "Did you mean 'FetchPush'?"),
        (("train", "--task", "FetchPush", "--method", "herr"), "No method is called 'herr'."),
        (("train", "--task", "FetchPush", "--method", "her", "--preset", "q"), "No preset is called 'q'."),
        ((*TRAIN, "--seed", "-1"), "seed: "),
        ((*TRAIN, "--set", "loop.batch_size=-5"), "loop.batch_size: Input should be greater than 0 (got -5)"),
        ((*TRAIN, "--set", "loop.batch_size=many"), "loop.batch_size: "),
        ((*TRAIN, "--set", "loop.batch_sise=5"), "loop.batch_sise: "),
        ((*TRAIN, "--set", "batch"), "'batch' is not of the form group.name=value"),
        ((*TRAIN, "--set", "loop=1", "--set", "loop.epochs=1"), "'loop' is already set to a value"),
        (("train", "--task", "FetchPush"), "sldr train --task FetchPush --phase locomotion"),
        (
            ("train", "--task", "FetchPush", "--locomotion-model", "nowhere.pt"),
            "There is no locomotion model nowhere.pt",
        ),
        ((*TRAIN, "--locomotion-model", "nowhere.pt"), "locomotion-model: method her takes no reward from one"),
        ((*TRAIN, "--set", "method=ddpg"), "method: is named by the launch itself"),
        (("evaluate", "nowhere.pt"), "There is no file nowhere.pt"),
        (("evaluate", "nowhere.pt", "--episodes", "0"), "episodes: at least 1"),
        (("replay", "nowhere.npz"), "There is no file nowhere.npz; give a file of recorded episodes"),
        (("render", "--task", "FetchPus", "--out", "a.png"), "Did you mean 'FetchPush'?"),
        (("render", "--task", "FetchPush", "--out", "no/such/a.png"), "there is no directory"),
        (("render", "--task", "FetchPush", "--out", "a.png", "--width", "0"), "at least one pixel"),
        (("worker", "--slots", "0"), "slots: a worker needs at least 1, got 0"),
        (("worker", "--cores", "4"), "cores: only on a cluster are they set aside for runs; add --executor ray"),
        (("accounts", "--role", "admin"), "role: whose it is to be is not said; name the account with --invite"),
        (
            ("export", "figure", "--out", "a.svg", "--study-file", "sample", "--server", "http://127.0.0.1:1"),
            "server: a study file has the runs already",
        ),
        (("viewer", "--port", "8080"), "port: views for the page need none; it is for --policy"),
        (("serve", "--port", "0"), "port: it must be between 1 and 65535, got 0"),
        (("serve", "--workers", "-1"), "workers: it must be 0 or more, got -1"),
        (("serve", "--host", "192.0.2.1"), "Cannot listen on 192.0.2.1 port 8000"),
    ],
)
def test_input_that_cannot_work_is_told_in_one_sentence(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: tuple[str, ...],
    sentence: str,
):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, *arguments)
    assert (code, out, len(err.splitlines())) == (2, "", 1)
    assert sentence in err
    assert err.startswith("sldr: ")


def test_words_that_are_no_options_end_with_the_same_code(capsys: pytest.CaptureFixture[str]):
    code, _, err = run(capsys, "train", "--task", "FetchPush", "--seed", "x")
    assert code == 2
    assert "--seed" in err
    assert "Traceback" not in err


def test_an_episode_that_comes_out_differently_is_told(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    write_episodes(tmp_path / "episodes.npz", made_test(made_episode(0), made_episode(3, tag="too_slow")))
    monkeypatch.setattr("sldr_core.training.resimulate", lambda test: [None, 2])
    code, out, _ = run(capsys, "replay", str(tmp_path / "episodes.npz"))
    assert code == 1
    assert out.splitlines() == [
        "episode 0: other, 4 steps, the same to the last bit",
        "episode 3: too slow, 4 steps, different from step 2 on",
    ]


def test_episodes_of_another_scene_are_refused_in_one_sentence(capsys: pytest.CaptureFixture[str], tmp_path: Path):
    write_episodes(tmp_path / "episodes.npz", made_test())
    code, out, err = run(capsys, "replay", str(tmp_path / "episodes.npz"))
    assert (code, out, len(err.splitlines())) == (2, "", 1)
    assert "cannot be simulated by this version" in err
