"""The script that runs every check: it goes on after a failure and names it at the end."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

CHECKS = Path(__file__).parents[2] / ".ci" / "checks.sh"
TIMEOUT_S = 20


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """Return a tree whose tools all succeed at once."""
    (tmp_path / ".ci").mkdir()
    shutil.copy(CHECKS, tmp_path / ".ci")
    (tmp_path / ".venv" / "bin").mkdir(parents=True)
    for name in ("ruff", "lint-imports", "pyright"):
        set_result(tmp_path, name, 0)
    return tmp_path


def set_result(tree: Path, name: str, code: int) -> None:
    tool = tree / ".venv" / "bin" / name
    tool.write_text(f"#!/bin/bash\necho {name} ran\nexit {code}\n")
    tool.chmod(0o755)


def check(tree: Path, *parts: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["/bin/bash", tree / ".ci" / "checks.sh", *parts],
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=False,
    )


def test_success_is_silent_about_failures(tree: Path) -> None:
    result = check(tree, "lint", "types")

    assert result.returncode == 0
    assert "FAILED" not in result.stdout
    assert result.stderr == ""


def test_every_failing_part_is_named_at_the_end(tree: Path) -> None:
    set_result(tree, "lint-imports", 1)
    set_result(tree, "pyright", 1)

    result = check(tree, "lint", "imports", "types")

    assert result.returncode == 1
    assert result.stderr.startswith("Failed: imports types.")


def test_a_failure_does_not_hide_what_comes_after(tree: Path) -> None:
    set_result(tree, "ruff", 1)

    assert "pyright ran" in check(tree, "lint", "types").stdout


def test_an_unknown_part_is_answered_with_those_there_are(tree: Path) -> None:
    result = check(tree, "typos")

    assert result.returncode == 2
    assert result.stderr.startswith("No check is called 'typos'. There are: lint format imports types ")


def set_pytest(tree: Path, beside_others: int, alone: int) -> None:
    """Let pytest end so with all tests in several processes, and so with those that failed."""
    (tree / ".ci" / "find-chromium.sh").write_text("#!/bin/bash\necho chromium\n")
    (tree / ".ci" / "find-chromium.sh").chmod(0o755)
    set_result(tree, "pytest", 0)
    (tree / ".venv" / "bin" / "pytest").write_text(
        f"#!/bin/bash\n[[ $* == *--last-failed* ]] && exit {alone}\nexit {beside_others}\n"
    )


@pytest.mark.parametrize(("beside_others", "alone", "expected"), [(0, 1, 0), (1, 0, 0), (1, 1, 1), (4, 5, 1)])
def test_a_test_that_fails_is_asked_once_more_alone(tree: Path, beside_others: int, alone: int, expected: int) -> None:
    set_pytest(tree, beside_others, alone)

    result = check(tree, "pytest")

    assert result.returncode == expected
    assert ("passed alone" in result.stderr) is (beside_others == 1 and alone == 0)


def test_static_checks_run_beside_pytest_and_are_reported_in_their_order(tree: Path) -> None:
    set_pytest(tree, 0, 0)
    set_result(tree, "pyright", 1)

    result = check(tree, "types", "lint", "pytest")

    lines = result.stdout.splitlines()
    assert [line for line in lines if line.startswith("== ")] == ["== lint", "== pytest", "== types", "== all checks"]
    assert [line.split()[:2] for line in lines[-3:]] == [["types", "FAILED"], ["lint", "ok"], ["pytest", "ok"]]
    assert result.stderr.startswith("Failed: types.")
