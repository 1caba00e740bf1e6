"""The words that a supervisor says to a child, each one line on its standard input."""

from __future__ import annotations

from typing import Literal, get_args

StopWord = Literal["cancel", "pause", "shutdown"]
"""Why a child should end: for good, until a person resumes the run, or until a worker is free again."""

STOP_WORDS: tuple[StopWord, ...] = get_args(StopWord)
