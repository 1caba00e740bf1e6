"""The API's records of recorded episodes."""

from __future__ import annotations

from pydantic import Field

from backend.api.schemas import Strict
from sldr_core.episodes import Tag


class Episode(Strict):
    """One recorded episode of a test."""

    epoch: int = Field(description="Epochs trained when the test was held.")
    index: int = Field(description="Its number in the test, from 0.")
    attempt: int
    success: bool = Field(description="Whether the goal is reached at the last step.")
    tag: Tag = Field(description="`success`, or what went wrong.")
    task_return: float = Field(description="Sum of the task's rewards.")
    worst_q: float | None = Field(description="Least SLDR reward of any part; null without SLDR.")
    worst_q_step: int | None = Field(description="The step it was given for, from 0.")
    length: int = Field(description="Control steps.")
    resimulates: bool = Field(description="Whether start and actions alone gave the same states again, bit for bit.")
    file: str = Field(description="The run's file that holds it.")


class EpisodeList(Strict):
    """A piece of a run's list of recorded episodes."""

    episodes: list[Episode]
    total: int = Field(description="Episodes that the filter lets through.")
    epochs: list[int] = Field(description="Epochs with recorded episodes, whatever the filter.")


class EpisodeTimelines(Strict):
    """What happened in an episode, in columns: of length + 1 moments, and of the length steps between them."""

    episode: Episode
    env_steps: int = Field(description="Control steps of training episodes when the test was held.")
    distance: list[float | None] = Field(description="Largest distance of an object from its goal [m], by moment.")
    angle: list[float | None] | None = Field(
        description="Angle from the goal [rad], by moment; null without a rotation."
    )
    success: list[bool] = Field(description="Whether the goal is reached, by moment.")
    contact: dict[str, list[bool]] = Field(description="Whether the robot touches each object, by moment.")
    rewards: dict[str, list[float | None]] = Field(description="Reward of each stream, by step.")
    values: dict[str, list[float | None]] = Field(description="Q of each stream's critic, by step.")
    wanted: dict[str, list[list[float | None]]] = Field(description="Action that each part wanted, by step.")
    induced: dict[str, list[list[float | None]]] = Field(description="Action that each part was made to do, by step.")
