"""The methods compared in the paper, as combinations of sampler, environment reward and streams.

A method is data: the training loop has no branch on its name. Sections and equations are the paper's.
"""

from __future__ import annotations

from typing import Literal

from pydantic import ConfigDict
from pydantic.dataclasses import dataclass

from sldr_core.config.tasks.spec import PHASES, Phase, TaskSpec
from sldr_core.errors import UnknownName

SamplerName = Literal["hindsight", "curriculum"]
"""Which transitions an update learns from: any, or those that a curriculum keeps of more."""

RewardKind = Literal["sparse", "dense"]
"""The environment's own reward: 0 at the goal and -1 elsewhere, or minus the distance from the goal."""

Auxiliary = Literal["sldr", "rnd"]
"""A further reward: for moving the object as it would move itself, or for seeing what is new."""

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
    explanation: str
    """How that is done, and with what consequence, for a person who wants to know more."""
    paper: str
    """Where the paper tells of it."""
    relabel_probability: float
    """Share of sampled transitions whose goal is replaced by one achieved later (0: no hindsight)."""
    sampler: SamplerName
    """What draws the transitions of each update."""
    reward: RewardKind
    """The environment's own reward."""
    auxiliary: tuple[Auxiliary, ...]
    """Further rewards beside the environment's; each brings at least one critic of its own."""

    @property
    def needs_locomotion(self) -> bool:
        """Tell whether a run of this method takes its reward from a locomotion model."""
        return "sldr" in self.auxiliary

    @property
    def phases(self) -> tuple[Phase, ...]:
        """The phases it can train: an object learns from the sparse reward alone (paper, Algorithm 1)."""
        return PHASES if self.reward == "sparse" and not self.auxiliary else ("manipulation",)


HER_RELABEL_PROBABILITY = 0.8
"""k = 4 relabelled samples for each original one."""

METHODS: dict[str, MethodSpec] = {
    spec.name: spec
    for spec in (
        MethodSpec(
            name="ddpg",
            title="DDPG-Sparse",
            summary="The sparse reward alone, with the goals as they were.",
            explanation="Deep deterministic policy gradients: one critic learns the return of the sparse reward, the "
            "actor climbs it. Before the first success every reward is the same, so there is nothing to learn from.",
            paper="§3.2, Eq. 3 and 4",
            relabel_probability=0.0,
            sampler="hindsight",
            reward="sparse",
            auxiliary=(),
        ),
        MethodSpec(
            name="her",
            title="HER-Sparse",
            summary="The sparse reward, with goals replaced in hindsight by what was achieved later.",
            explanation="Hindsight experience replay: four of five sampled transitions get a goal that was achieved "
            "later in their own episode, and their reward is computed anew. Failures become successes at other goals.",
            paper="§3.3",
            relabel_probability=HER_RELABEL_PROBABILITY,
            sampler="hindsight",
            reward="sparse",
            auxiliary=(),
        ),
        MethodSpec(
            name="cher",
            title="CHER-Sparse",
            summary="HER on a curriculum: samples with diverse goals first, then those near their goals.",
            explanation="Curriculum-guided HER: of each group of 128 relabelled candidates the 64 are kept that stand "
            "for the others and lie near their goals; nearness counts more with every update of an epoch. A batch is "
            "a quarter of the usual one, as in the method's own code: 64 of each worker's 256.",
            paper="§6.2",
            relabel_probability=HER_RELABEL_PROBABILITY,
            sampler="curriculum",
            reward="sparse",
            auxiliary=(),
        ),
        MethodSpec(
            name="her-dense",
            title="HER-Dense",
            summary="HER with minus the distance from the goal as the reward.",
            explanation="The environment rewards every step by how far the goal is: metres on the table; in the hand "
            "ten times the metres plus the radians, of what counts. Success is measured and values are clipped as with "
            "the sparse reward.",
            paper="§6.2",
            relabel_probability=HER_RELABEL_PROBABILITY,
            sampler="hindsight",
            reward="dense",
            auxiliary=(),
        ),
        MethodSpec(
            name="ddpg-sldr",
            title="DDPG-Sparse+SLDR",
            summary="The sparse reward, and one for moving the object as it would move itself; no hindsight.",
            explanation="As her-sldr, with the goals as they were: it shows what the demonstrations of the object "
            "give by themselves.",
            paper="§4.2 and §4.3, Eq. 8, 10 and 11, Algorithm 2",
            relabel_probability=0.0,
            sampler="hindsight",
            reward="sparse",
            auxiliary=("sldr",),
        ),
        MethodSpec(
            name="her-rnd",
            title="HER-Sparse+RNDR",
            summary="HER, and a second reward for reaching states that were seldom seen.",
            explanation="Random network distillation: a network learns what a fixed random one says of each next "
            "state, and where it errs more than usual the state is new. Targets of its critic are clipped to the same "
            "range below 0, so it avoids what is familiar rather than hoping for what is new.",
            paper="§6.2",
            relabel_probability=HER_RELABEL_PROBABILITY,
            sampler="hindsight",
            reward="sparse",
            auxiliary=("rnd",),
        ),
        MethodSpec(
            name="her-sldr",
            title="HER-Sparse+SLDR",
            summary="HER, and a second reward for moving the object as it would move itself.",
            explanation="Simulated locomotion demonstration rewards: the object's own policy says what the object "
            "should do now, an inverse model what the robot made it do; the reward is the difference of their values "
            "in the object's critic. Each object or part has a reward and a critic of its own.",
            paper="§4, Eq. 8, 10 and 11, Algorithm 2",
            relabel_probability=HER_RELABEL_PROBABILITY,
            sampler="hindsight",
            reward="sparse",
            auxiliary=("sldr",),
        ),
    )
}
"""The methods, in the order in which parts are added to the plainest."""

LOCOMOTION_METHOD = "her"
"""Locomotion runs are trained with this method unless told otherwise (paper, Algorithm 1)."""

SWITCHES = {
    "sampler": "sampler",
    "relabel_probability": "share of goals replaced in hindsight",
    "reward": "the environment's reward",
    "auxiliary": "further rewards",
}
"""The fields of a method that decide what is learnt, with their names for a person; all others are words about it."""


@dataclass(frozen=True, config=_FROZEN)
class Switch:
    """Name one thing by which two methods differ."""

    name: str
    """The field of `MethodSpec`."""
    title: str
    """What it is, for a person."""
    first: str
    """Its value in the first method."""
    second: str
    """Its value in the second method."""


def find_method(name: str) -> MethodSpec:
    """Return the spec of a method.

    Raises:
        UnknownName: no method is called `name`.
    """
    if name not in METHODS:
        raise UnknownName("method", name, METHODS)
    return METHODS[name]


def method_switches(first: str, second: str) -> tuple[Switch, ...]:
    """Return everything by which two methods differ; nothing for the same method.

    Raises:
        UnknownName: no method is called so.
    """
    one, other = find_method(first), find_method(second)
    return tuple(
        Switch(name, title, _as_text(getattr(one, name)), _as_text(getattr(other, name)))
        for name, title in SWITCHES.items()
        if getattr(one, name) != getattr(other, name)
    )


def stream_names(method: MethodSpec, task: TaskSpec) -> tuple[str, ...]:
    """Return the rewards that a method learns from in a task; each has a critic of its own."""
    brought: dict[Auxiliary, tuple[str, ...]] = {
        "sldr": tuple(f"sldr/{part.name}" for part in task.parts),
        "rnd": ("rnd",),
    }
    return ("task", *(name for auxiliary in method.auxiliary for name in brought[auxiliary]))


def _as_text(value: float | str | tuple[str, ...]) -> str:
    if isinstance(value, tuple):
        return " and ".join(value) or "none"
    return value if isinstance(value, str) else f"{value:g}"
