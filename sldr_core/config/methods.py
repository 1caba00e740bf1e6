"""The methods compared in the paper, as combinations of sampler, environment reward and streams.

A method is data: the training loop has no branch on its name.
"""

from __future__ import annotations

from typing import Literal

from pydantic import ConfigDict
from pydantic.dataclasses import dataclass

from sldr_core.errors import UnknownName

_FROZEN = ConfigDict(extra="forbid", use_attribute_docstrings=True)


@dataclass(frozen=True, config=_FROZEN)
class MethodSpec:
    """Say which parts a method is made of (paper §6.2)."""

    name: str
    """The method's name, as in commands and in the API."""
    title: str
    """The method's name in the paper's figures."""
    summary: str
    """What the robot learns from, in one sentence for a person."""
    relabel_probability: float
    """Share of sampled transitions whose goal is replaced by one achieved later (0: no hindsight)."""
    reward: Literal["sparse"]
    """The environment's own reward."""
    auxiliary: tuple[Literal["sldr"], ...]
    """Further rewards beside the environment's; each brings a critic of its own."""

    @property
    def needs_locomotion(self) -> bool:
        """Tell whether a run of this method takes its reward from a locomotion model."""
        return "sldr" in self.auxiliary


HER_RELABEL_PROBABILITY = 0.8
"""k = 4 relabelled samples for each original one."""

METHODS: dict[str, MethodSpec] = {
    spec.name: spec
    for spec in (
        MethodSpec(
            name="ddpg",
            title="DDPG-Sparse",
            summary="The sparse reward alone, with the goals as they were.",
            relabel_probability=0.0,
            reward="sparse",
            auxiliary=(),
        ),
        MethodSpec(
            name="her",
            title="HER-Sparse",
            summary="The sparse reward, with goals replaced in hindsight by what was achieved later.",
            relabel_probability=HER_RELABEL_PROBABILITY,
            reward="sparse",
            auxiliary=(),
        ),
        MethodSpec(
            name="her-sldr",
            title="HER-Sparse+SLDR",
            summary="HER, and a second reward for moving the object as it would move itself.",
            relabel_probability=HER_RELABEL_PROBABILITY,
            reward="sparse",
            auxiliary=("sldr",),
        ),
    )
}

LOCOMOTION_METHOD = "her"
"""Every locomotion run is trained with this method (paper, Algorithm 1)."""


def find_method(name: str) -> MethodSpec:
    """Return the spec of a method.

    Raises:
        UnknownName: no method is called `name`.
    """
    if name not in METHODS:
        raise UnknownName("method", name, METHODS)
    return METHODS[name]
