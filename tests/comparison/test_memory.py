"""Answers are kept as long as they are small together; a large one pushes out the others, not itself."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest

from backend.comparison import memory
from backend.comparison.memory import ANSWERS_KEPT, ComparisonMemory, count_values


@dataclass(frozen=True)
class Answer:
    name: str = "a"
    columns: list[list[float]] = field(default_factory=list[list[float]])


def answer(length: int) -> Answer:
    return Answer(columns=[[0.0] * length])


def made(kept: ComparisonMemory, version: str, length: int) -> bool:
    """Ask once; return whether the answer had to be made."""
    asked: list[str] = []

    def make() -> Answer:
        asked.append(version)
        return answer(length)

    kept.answer(version, make)
    return asked == [version]


def test_all_values_of_an_answer_are_counted():
    assert count_values(Answer("a", [[1.0, 2.0], [], [3.0]])) == 4
    assert count_values([Answer(), Answer("b", [[1.0]])]) == 3


def test_an_answer_is_made_once():
    kept = ComparisonMemory()
    assert [made(kept, "first", 5), made(kept, "first", 5)] == [True, False]


def test_large_answers_push_each_other_out(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(memory, "VALUES_KEPT", 100)
    kept = ComparisonMemory()
    for version in ("first", "second", "third"):
        made(kept, version, 45)
    assert [made(kept, version, 45) for version in ("third", "second")] == [False, False]
    assert made(kept, "first", 45)


def test_an_answer_larger_than_all_that_may_be_kept_is_kept_alone(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(memory, "VALUES_KEPT", 100)
    kept = ComparisonMemory()
    made(kept, "small", 5)
    made(kept, "huge", 1000)
    assert [made(kept, "huge", 1000), made(kept, "small", 5)] == [False, True]


def test_no_more_than_so_many_are_kept_however_small_they_are():
    kept = ComparisonMemory()
    for number in range(ANSWERS_KEPT + 1):
        made(kept, str(number), 1)
    assert [made(kept, "1", 1), made(kept, "0", 1)] == [False, True]
