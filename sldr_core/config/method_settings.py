"""The settings of parts that only some methods have."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from sldr_core.config.numbers import MOST, Positive, Share, Weight

SldrReward = Literal["advantage", "action_distance"]
"""Which of the paper's rewards compares what the object does with what it wants."""

_FROZEN = ConfigDict(extra="forbid", use_attribute_docstrings=True, allow_inf_nan=False)


@dataclass(frozen=True, config=_FROZEN)
class SldrConfig:
    """The reward for moving the object as it would move itself (paper §4.2)."""

    reward: SldrReward = "advantage"
    """`advantage`: difference of the object's Q values (Eq. 8); `action_distance`: minus the squared distance of
    its actions (Eq. 7). Both are clipped to [-1, 0], the range of the sparse reward.
    """
    weight: Weight = 1.0
    """Weight of the stream's critic in the actor's loss."""
    gate: Share = 0.95
    """Test success that a locomotion model must have been measured at before its reward is used."""


@dataclass(frozen=True, config=_FROZEN)
class RndConfig:
    """The reward for states that were seldom seen: random network distillation, method `her-rnd`."""

    weight: Weight = 1.0
    """Weight of the stream's critic in the actor's loss."""
    outputs: Positive = 256
    """Outputs of the fixed network, which the other one learns to predict."""


@dataclass(frozen=True, config=_FROZEN)
class CurriculumConfig:
    """Which of more candidates an update learns from: method `cher`."""

    group_size: Positive = 256
    """Transitions of `loop.batch_size` that stand for one group, as for one worker in the method's own code."""
    candidates: Annotated[int, Field(ge=2, le=MOST)] = 128
    """Relabelled transitions drawn for each group."""
    kept: Positive = 64
    """Transitions kept of each group; a batch has this many for each `group_size` of `loop.batch_size`."""
    examined: Positive = 3
    """Candidates left that each pick compares, at random; it keeps the best of them."""
    nearness: Weight = 1.0
    """Weight of the distance between achieved and wanted goal, against diversity, at the start of each epoch."""
    nearness_growth: Annotated[float, Field(ge=0.0, le=0.1)] = 1e-4
    """Share by which that weight grows with each update of an epoch."""
