"""The lock file: exact, complete, and free of what belongs to one machine."""

from __future__ import annotations

import re
import tomllib
from importlib.metadata import version
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LOCKED = dict(
    line.split("==") for line in (ROOT / "requirements.lock").read_text().splitlines() if not line.startswith("#")
)
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def without_extra(requirement: str) -> str:
    return re.sub(r"\[.*?\]", "", requirement)


def normal(name: str) -> str:
    """Return a package's name as the index compares names."""
    return re.sub(r"[-_.]+", "-", name).lower()


@pytest.mark.parametrize("requirement", PROJECT["dependencies"] + PROJECT["optional-dependencies"]["test"])
def test_every_requirement_is_locked_at_its_pin(requirement: str) -> None:
    name, pin = without_extra(requirement).split("==")

    locked = {normal(name): version for name, version in LOCKED.items()}

    assert locked.get(normal(name)) == pin, "run `make lock`"


@pytest.mark.parametrize("pattern", [r"nvidia-|cuda-|triton", r"\+|@|/|--"], ids=["cuda packages", "places"])
def test_nothing_belongs_to_one_machine(pattern: str) -> None:
    assert [f"{name}=={pin}" for name, pin in LOCKED.items() if re.search(pattern, f"{name}=={pin}")] == []


def test_the_environment_is_what_is_locked() -> None:
    different = {name: pin for name, pin in LOCKED.items() if version(name).partition("+")[0] != pin}

    assert different == {}, "run `make setup`"
