"""Seeds that a measurement had finished when it was interrupted, and when they do not count."""

from __future__ import annotations

from pathlib import Path

import kept_seeds
import pytest
from kept_seeds import Reached, reach_each

TAKEN = {0: Reached(60.0, 0.93), 1: Reached(float("inf"), 0.4), 2: Reached(90.0, 1.0)}


class _Trainings:
    """Train in no time, and be interrupted before a seed if told so."""

    def __init__(self, interrupted_at: int | None = None) -> None:
        self.trained: list[int] = []
        self._interrupted_at = interrupted_at

    def __call__(self, task: str, seed: int) -> Reached:
        assert task == "FetchPush"
        if seed == self._interrupted_at:
            raise KeyboardInterrupt
        self.trained.append(seed)
        return TAKEN[seed]


@pytest.fixture(autouse=True)
def interrupted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave a measurement of which two seeds are done."""
    monkeypatch.setattr(kept_seeds, "KEPT", tmp_path / "reached")
    with pytest.raises(KeyboardInterrupt):
        reach_each("FetchPush", (0, 1, 2), _Trainings(interrupted_at=2), take_kept=False)


def _go_on(take_kept: bool = True) -> list[int]:
    """Measure, and return which seeds were trained for it."""
    trainings = _Trainings()
    assert reach_each("FetchPush", (0, 1, 2), trainings, take_kept) == list(TAKEN.values())
    return trainings.trained


def test_an_interrupted_measurement_goes_on_with_the_seeds_that_are_left() -> None:
    assert _go_on() == [2]
    assert _go_on() == []


def test_all_are_trained_unless_going_on_is_asked_for() -> None:
    assert _go_on(take_kept=False) == [0, 1, 2]


@pytest.mark.parametrize("part", ["machine", "code"])
def test_seeds_of_another_machine_or_of_other_code_do_not_count(
    part: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if part == "machine":
        monkeypatch.setattr(kept_seeds, "describe_machine", lambda: "64 cores")
    else:
        (tmp_path / "sldr_core").mkdir()
        (tmp_path / "sldr_core" / "train.py").write_text("")
        monkeypatch.setattr(kept_seeds.sldr_core, "__path__", [str(tmp_path / "sldr_core")])
    assert _go_on() == [0, 1, 2]


def test_a_seed_counts_for_what_it_began_with(monkeypatch: pytest.MonkeyPatch) -> None:
    def changing(_task: str, seed: int) -> Reached:
        monkeypatch.setattr(kept_seeds, "describe_machine", lambda: "64 cores")
        return TAKEN[seed]

    reach_each("FetchPush", (0, 1, 2), changing, take_kept=False)
    assert _go_on() == [0, 1, 2]
