"""A disk that fills up ends a training in one sentence; with room again it ends with the same bits.

The disk is a small file system, mounted where only the training sees it. Where mounting is forbidden, that part is
skipped, and the system's limit on the size of files does the same to every file but the pages of the replay.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from small_training import assert_same_training, long_config, metrics_of, run

HERE = Path(__file__).parent
TIMEOUT_S = 280.0
DISK_SIZE = "40m"
UNSHARE = (("unshare", "--mount"), ("unshare", "--user", "--map-root-user", "--mount"))
"""Ways to a file system of one's own: as root, and as anyone."""


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("uninterrupted")
    run(long_config(), directory)
    return directory


@pytest.fixture(scope="module")
def small_disk(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    """Train on a small file system; return where the results are and what was seen."""
    out = tmp_path_factory.mktemp("small-disk")
    (out / "disk").mkdir()
    mount = f'mount -t tmpfs -o size={DISK_SIZE} none "{out}/disk"'
    refused: list[str] = []
    for unshare in UNSHARE if shutil.which("unshare") else ():
        tried = subprocess.run([*unshare, "sh", "-c", mount], capture_output=True, text=True, check=False)
        if tried.returncode == 0:
            training = f'{mount} && exec "{sys.executable}" full_disk.py small-disk "{out}"'
            return out, train_apart([*unshare, "sh", "-c", training])
        refused.append(tried.stderr.strip())
    pytest.skip(f"no file system may be mounted here ({'; '.join(refused)}); the limit on file sizes is tested instead")


@pytest.fixture(scope="module")
def size_limit(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    """Train under a limit on the size of files; return where the results are and what was seen."""
    out = tmp_path_factory.mktemp("size-limit")
    (out / "disk").mkdir()
    return out, train_apart([sys.executable, "full_disk.py", "size-limit", str(out)])


def train_apart(command: list[str]) -> dict[str, Any]:
    """Run a training in a process of its own; return what it prints at its end."""
    ended = subprocess.run(command, cwd=HERE, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    assert ended.returncode == 0, f"status {ended.returncode}: {ended.stderr}"
    return json.loads(ended.stdout.splitlines()[-1])


both = pytest.mark.parametrize("mechanism", ["small_disk", "size_limit"])


@both
@pytest.mark.parametrize("name", ["checkpoint", "metrics"])
def test_a_full_disk_names_the_file_and_leaves_the_last_checkpoint_whole(
    name: str, mechanism: str, request: pytest.FixtureRequest
) -> None:
    out, seen = request.getfixturevalue(mechanism)

    file = out / "disk" / name / {"checkpoint": "checkpoint.pt", "metrics": "metrics.jsonl"}[name]
    assert f"There is no room for {file}: " in seen[name]["told"]
    assert "free some space" in seen[name]["told"]
    assert seen[name]["checkpoint_cycle"] == 20
    assert not [left for left in seen[name]["files"] if left.endswith(".tmp")]


@both
def test_a_replay_file_that_does_not_fit_is_named_and_removed(mechanism: str, request: pytest.FixtureRequest) -> None:
    out, seen = request.getfixturevalue(mechanism)

    assert f"There is no room for {out / 'disk' / 'replay' / 'replay.bin'}: " in seen["replay"]["told"]
    assert seen["replay"]["files"] == [".training.lock"]


@both
@pytest.mark.parametrize("name", ["checkpoint", "metrics", "replay"])
def test_with_room_again_a_training_ends_with_the_same_bits(
    name: str, mechanism: str, uninterrupted: Path, request: pytest.FixtureRequest
) -> None:
    out, _ = request.getfixturevalue(mechanism)

    assert_same_training(out / name, uninterrupted)


def test_episodes_are_stored_on_a_full_disk_until_the_next_checkpoint(
    small_disk: tuple[Path, dict[str, Any]], uninterrupted: Path
) -> None:
    out, seen = small_disk

    assert "checkpoint.pt: " in seen["pages"]["told"]
    assert seen["pages"]["checkpoint_cycle"] == 20
    assert [line["cycle"] for line in metrics_of(out / "pages")] == list(range(1, 41))
    assert_same_training(out / "pages", uninterrupted)
