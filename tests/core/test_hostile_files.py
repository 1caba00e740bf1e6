"""Whatever a file of weights, a checkpoint or a file of episodes holds: it is taken, or refused in one sentence."""

from __future__ import annotations

import copy
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import torch
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from recorded_tests import made_test
from small_training import collected_parts, run, save_untrained_model, tiny_config

from sldr_core.episodes import read_episodes, write_episodes
from sldr_core.errors import BadFile
from sldr_core.nets.locomotion_model import load_locomotion_model
from sldr_core.training.build import Parts
from sldr_core.training.checkpoint import read_checkpoint, restore_training
from sldr_core.training.policy import load_policy

TRIALS = 40

trials = settings(
    max_examples=TRIALS,
    deadline=None,
    database=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)

VALUES = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(2**70), 2**70),
    st.floats(),
    st.text(max_size=8),
    st.lists(st.integers(-3, 3), max_size=3),
    st.dictionaries(st.text(max_size=3), st.integers(), max_size=2),
    st.sampled_from([torch.zeros(0), torch.tensor(float("nan")), torch.ones(3, 2, dtype=torch.int64)]),
)
"""What stands somewhere in a file instead of what belongs there."""

PLACES = st.tuples(st.lists(st.integers(0, 40), min_size=1, max_size=4), VALUES)


@dataclass(frozen=True)
class Shelf:
    """One good file of each kind, and the training that made the checkpoint."""

    directory: Path
    parts: Parts

    def read(self, name: str, path: Path) -> object:
        """Read a file as the product does; `name` is the good one that it comes from."""
        if name == "checkpoint.pt":
            kept = read_checkpoint(path, self.parts.config)
            restore_training(kept, self.parts)
            return kept
        readers: dict[str, Callable[[Path], object]] = {
            "model.pt": load_locomotion_model,
            "policy-newest.pt": load_policy,
            "episodes.npz": read_episodes,
        }
        return readers[name](path)


FILES = ("checkpoint.pt", "model.pt", "policy-newest.pt", "episodes.npz")


@pytest.fixture(scope="module")
def shelf(tmp_path_factory: pytest.TempPathFactory, short_push: None) -> Shelf:
    directory = tmp_path_factory.mktemp("good")
    run(tiny_config(), directory)
    save_untrained_model(directory / "model.pt")
    write_episodes(directory / "episodes.npz", made_test())
    return Shelf(directory, collected_parts(tiny_config(), tmp_path_factory.mktemp("parts")))


def assert_taken_or_refused(shelf: Shelf, name: str, path: Path) -> None:
    before, refusal = sorted(path.parent.iterdir()), str(path)
    try:
        shelf.read(name, path)
    except BadFile as err:
        refusal = str(err)
    assert str(path) in refusal
    assert "\n" not in refusal
    assert sorted(path.parent.iterdir()) == before


@pytest.mark.parametrize("name", FILES)
def test_the_good_ones_are_taken(shelf: Shelf, name: str) -> None:
    assert shelf.read(name, shelf.directory / name) is not None


@pytest.mark.parametrize("name", FILES)
@given(st.lists(st.tuples(st.floats(0.0, 1.0, exclude_max=True), st.integers(0, 255)), max_size=6), st.floats(0.0, 1.0))
@trials
def test_changed_bytes_and_cuts_are_taken_or_refused(
    shelf: Shelf, name: str, changes: list[tuple[float, int]], kept: float
) -> None:
    content = bytearray((shelf.directory / name).read_bytes())
    for place, byte in changes:
        content[int(place * len(content))] = byte
    path = shelf.directory / f"changed-{name}"
    path.write_bytes(content[: round(kept * len(content))] if kept < 0.5 else content)
    assert_taken_or_refused(shelf, name, path)


@pytest.mark.parametrize("name", [name for name in FILES if name.endswith(".pt")])
@given(PLACES)
@trials
def test_whatever_stands_in_the_place_of_a_part_is_taken_or_refused(
    shelf: Shelf, name: str, drawn: tuple[list[int], Any]
) -> None:
    content = torch.load(shelf.directory / name, weights_only=True)
    put(content, *drawn)
    path = shelf.directory / f"changed-{name}"
    torch.save(content, path)
    assert_taken_or_refused(shelf, name, path)


def put(content: dict[str, Any], way: list[int], value: Any) -> None:
    """Follow a way through dictionaries as far as it goes, and put a value there."""
    place = content
    for turn in way[:-1]:
        inner = place[sorted(place, key=str)[turn % len(place)]]
        if not isinstance(inner, dict) or not inner:
            break
        place = inner
    place[sorted(place, key=str)[way[-1] % len(place)]] = copy.deepcopy(value)
